// The page's parts that need no browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { encode } from "../scripts/encode.mjs";
import { fill } from "../scripts/fill.mjs";
import { mapFor } from "../src/colours.js";
import { decode } from "../src/data.js";
import { principal, scalars } from "../src/field.js";
import { number, prefixed, quantity, subscripts, unitText } from "../src/format.js";
import { creases, edges, replaced, visible } from "../src/mesh.js";
import { CELLS, makeSample, SPACING } from "../scripts/sample.mjs";

test("arrays survive encoding, deflated or not, to the bit", () => {
  for (const values of [Float32Array.of(1 / 3, -0, 6e-39), Float64Array.of(Math.PI, -1e300), Int32Array.of(-1, 2 ** 31 - 1), Uint8Array.of(0, 255)])
    for (const plain of [true, false]) assert.deepEqual(decode(encode(values, plain)), values);
  assert.deepEqual([...decode([1, null])], [1, NaN]);
  assert.throws(() => decode({ dtype: "f2", encoding: "base64", data: "" }), /f2/);
});

test("the block cannot end its own script element", () => {
  const template = '<p></p><script type="application/json" id="koshi-data"></script>';
  const data = { title: "</script><b>" };
  const page = fill(template, data);
  assert.equal(page.split("</script>").length, 2);
  assert.deepEqual(JSON.parse(page.match(/id="koshi-data">(.*)<\/script>/)[1]), data);
  assert.throws(() => fill("<p></p>", data), /0 empty data blocks/);
});

test("numbers and units read as an engineer writes them", () => {
  assert.equal(quantity(1.112e9, "Pa"), "1.112\u00a0GPa");
  assert.equal(quantity(0.002, "m"), "2\u00a0mm");
  assert.equal(quantity(7200, "s"), "7200\u00a0s");
  assert.equal(quantity(2000, "kg/m^3"), "2000\u00a0kg/m³");
  assert.equal(quantity(1.34e6, "N/m"), "1.34\u00a0MN/m");
  assert.equal(unitText("1"), "");
  assert.equal(unitText("N m"), "N·m");
  assert.equal(unitText("1/s"), "1/s");
  assert.equal(number(1.23456789e-7), "1.235e-7");
  assert.equal(number(44256), "44\u2009256");
  assert.equal(number(85796.6), "85\u2009797");
  assert.equal(number(9876.54321), "9876.54");
  assert.equal(number(NaN), "–");
  assert.deepEqual(prefixed(0, "m"), { factor: 1, unit: "m" });
});

test("symbols have subscripts, names do not", () => {
  assert.deepEqual(subscripts("Fig. 7: u_x and ν_xy, E/E_0"), ["Fig. 7: u", "x", " and ν", "xy", ", E/E", "0", ""]);
  for (const name of ["tip_load", "near_end.displacement.x", "a.b_c", "u_xyzw", "_x", "u_x_2"]) assert.deepEqual(subscripts(name), [name]);
});

test("principal values of a rotated tensor", () => {
  // diag(3, 1, -2) turned by 30 degrees about z: xx = 3 cos² + sin², yy = 3 sin² + cos², xy = 2 sin cos.
  const [c, s] = [Math.cos(Math.PI / 6), Math.sin(Math.PI / 6)];
  const tensor = Float64Array.of(3 * c * c + s * s, 3 * s * s + c * c, -2, 2 * s * c, 0, 0);
  principal(tensor).forEach((value, i) => assert.ok(Math.abs(value - [3, 1, -2][i]) < 1e-12));
  assert.deepEqual(principal(Float64Array.of(5, 5, 5, 0, 0, 0)), [5, 5, 5]);
});

test("von Mises stress of uniaxial tension is the tension, of shear √3 times the shear", () => {
  const field = { kind: "symmetric-tensor", components: ["xx", "yy", "zz", "xy", "yz", "xz"], data: [0, 7, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0] };
  const values = scalars("stress", field, "von Mises");
  assert.equal(values.length, 2);
  assert.ok(Math.abs(values[0] - 7) < 1e-6);
  assert.ok(Math.abs(values[1] - 2 * Math.sqrt(3)) < 1e-6);
  // The components go by their names, not by their order.
  const turned = { ...field, components: ["yz", "xz", "xy", "yy", "zz", "xx"], data: [0, 0, 3, 0, 0, 5] };
  assert.deepEqual([...scalars("stress", turned, "greatest principal")].map((v) => v.toFixed(5)), [((5 + Math.sqrt(61)) / 2).toFixed(5)]);
});

test("signed fields get a symmetric diverging map, others viridis over their range", () => {
  assert.deepEqual([mapFor({ min: -1, max: 4 }).min, mapFor({ min: -1, max: 4 }).name], [-4, "blue-white-red"]);
  assert.deepEqual([mapFor({ min: -0.01, max: 4 }).min, mapFor({ min: -0.01, max: 4 }).name], [-0.01, "viridis"]);
});

function sampleMesh() {
  const { mesh } = makeSample();
  return { points: decode(mesh.points), quads: decode(mesh.quads), quadCell: decode(mesh.quad_cell),
    lattice: { ...mesh.lattice, pointIndex: decode(mesh.lattice.point_index), cellIndex: decode(mesh.lattice.cell_index) } };
}

test("a box of cells has the creases of a box and every edge of its faces once", () => {
  const { points, quads } = sampleMesh();
  const [nx, ny, nz] = CELLS;
  // Creases: 4 (nx + ny + nz) lattice edges. All edges of a closed surface of quads: two per quad.
  assert.equal(edges(points, quads, true).length / 2, 4 * (nx + ny + nz));
  assert.equal(quads.length / 4, 2 * (nx * ny + ny * nz + nz * nx));
  assert.equal(edges(points, quads, false).length / 2, 2 * (quads.length / 4));
});

test("a surface that lies any way has creases where its quads meet at an angle", () => {
  const { points, quads } = sampleMesh();
  const [nx, ny, nz] = CELLS;
  assert.equal(creases(points, quads).length / 2, 4 * (nx + ny + nz));
  // Two quads that meet at 30 degrees are one smooth surface, at 60 degrees two; the border of both is drawn.
  for (const [angle, inner] of [[30, 0], [60, 1]]) {
    const [c, s] = [Math.cos((angle * Math.PI) / 180), Math.sin((angle * Math.PI) / 180)];
    const folded = Float32Array.of(-1, 0, 0, -1, 1, 0, 0, 1, 0, 0, 0, 0, c, 0, s, c, 1, s);
    assert.equal(creases(folded, Int32Array.of(0, 3, 2, 1, 3, 4, 5, 2)).length / 2, 6 + inner);
  }
});

test("points of the true surface replace those of the cells, and so do their values", () => {
  const values = Float32Array.of(1, 2, 3, 4, 5, 6);
  assert.deepEqual([...replaced(values, 2, Int32Array.of(2, 0), Float32Array.of(7, 8, 9, 10))], [9, 10, 3, 4, 7, 8]);
  assert.deepEqual([...values], [1, 2, 3, 4, 5, 6]);
});

test("both parts of a cut body are closed, and share the cut", () => {
  const mesh = sampleMesh();
  const [nx, ny, nz] = CELLS;
  const position = 10 * SPACING;
  for (const [flip, length] of [[false, 10], [true, ny - 10]]) {
    const part = visible(mesh, { axis: 1, position, flip });
    assert.equal(part.quads.length / 4, 2 * (nx * length + length * nz + nz * nx));
    assert.equal(part.quadCell.length, part.quads.length / 4);
    assert.equal(edges(mesh.points, part.quads, true).length / 2, 4 * (nx + length + nz));
  }
  // Without the lattice the same cut leaves the body open: the cap of nx nz quads is missing.
  const hollow = visible({ ...mesh, lattice: null }, { axis: 1, position, flip: false });
  assert.equal(hollow.quads.length / 4, 2 * (nx * 10 + 10 * nz) + nz * nx);
});
