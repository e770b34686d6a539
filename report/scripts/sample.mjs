// A data block to look at and to test with: a cantilever of 9 x 39 x 9 cells after Euler and Bernoulli, loaded in three
// steps. Every number follows from the formulas below, so the tests know what the page must show.
import { encode } from "./encode.mjs";

export const CELLS = [9, 39, 9];
export const SPACING = 0.002;  // d [m]
export const E = 1.112e9;      // [Pa]
export const NU = 0.18;
export const LOAD = 9.8;       // [N] at the end of the last step
const SIDE = CELLS[0] * SPACING;
const LENGTH = CELLS[1] * SPACING;
const INERTIA = SIDE ** 4 / 12;
const STEPS = 3;
const ROWS = 120;

/** Deflection, slope and curvature of the axis at y [m] under the force P [N] at the end. */
export function axis(y, P) {
  const f = P / (6 * E * INERTIA);
  return { w: f * (3 * LENGTH * y * y - y ** 3), slope: f * (6 * LENGTH * y - 3 * y * y), curvature: f * (6 * LENGTH - 6 * y) };
}

/** Displacement at (x, y, z) [m]: plane sections that stay normal to the axis. */
export function displacement([x, y], P) {
  const { w, slope } = axis(y, P);
  return [w, -(x - SIDE / 2) * slope, 0];
}

// Stress in the order xx, yy, zz, xy, yz, xz [Pa]: bending and the parabola of shear.
function stress([x, y], P) {
  const s = x - SIDE / 2;
  return [0, -E * s * axis(y, P).curvature, 0, (P / (2 * INERTIA)) * ((SIDE / 2) ** 2 - s * s), 0, 0];
}

function grid([nx, ny, nz], visit) {
  for (let k = 0; k < nz; ++k) for (let j = 0; j < ny; ++j) for (let i = 0; i < nx; ++i) visit(i, j, k);
}

// All nodes, the quads of the surface and the cells behind them.
function mesh() {
  const [nx, ny, nz] = CELLS;
  const points = [];
  grid(CELLS.map((n) => n + 1), (i, j, k) => points.push(i * SPACING, j * SPACING, k * SPACING));
  const node = (ijk) => ijk[0] + (nx + 1) * (ijk[1] + (ny + 1) * ijk[2]);
  const quads = [];
  const quadCell = [];
  const centres = [];
  grid(CELLS, (i, j, k) => {
    const cell = centres.length;
    centres.push([i, j, k].map((index) => (index + 0.5) * SPACING));
    [i, j, k].forEach((index, across) => {
      for (const high of [0, 1]) {
        if (index !== (high ? CELLS[across] - 1 : 0)) continue;
        const [u, v] = [(across + 1) % 3, (across + 2) % 3];
        const corner = (du, dv) => { const c = [i, j, k]; c[across] += high; c[u] += du; c[v] += dv; return node(c); };
        const face = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        quads.push(...(high ? face : face.reverse()));
        quadCell.push(cell);
      }
    });
  });
  return { points, quads, quadCell, centres, ids: (n) => Int32Array.from({ length: n }, (_, i) => i) };
}

function samples({ points, centres }) {
  const places = Array.from({ length: points.length / 3 }, (_, i) => points.slice(3 * i, 3 * i + 3));
  const tensor = ["xx", "yy", "zz", "xy", "yz", "xz"];
  return Array.from({ length: STEPS }, (_, step) => {
    const P = (LOAD * (step + 1)) / STEPS;
    return { time: 0.05 * (step + 1), fields: {
      displacement: { kind: "vector", on: "points", unit: "m", components: ["x", "y", "z"],
        data: encode(Float32Array.from(places.flatMap((place) => displacement(place, P)))) },
      rotation: { kind: "vector", on: "points", unit: "rad", components: ["x", "y", "z"],
        data: encode(Float32Array.from(places.flatMap(([, y]) => [0, 0, -axis(y, P).slope])), true) },
      stress: { kind: "symmetric-tensor", on: "cells", unit: "Pa", components: tensor,
        data: encode(Float32Array.from(centres.flatMap((centre) => stress(centre, P)))) },
      material: { kind: "category", on: "cells", unit: "1", categories: { 1: "rock", 2: "soft rock" },
        data: encode(Float32Array.from(centres, ([, y]) => (y > LENGTH / 2 ? 2 : 1))) },
    } };
  });
}

function history() {
  const time = Float64Array.from({ length: ROWS }, (_, i) => (0.15 * i) / (ROWS - 1));
  const force = time.map((t) => (LOAD * t) / 0.15);
  const tip = force.map((P, i) => axis(LENGTH, P).w * (1 + 0.05 * Math.exp(-i / 15) * Math.sin(i / 2)));
  const strain = force.map((P, i) => (P * tip[i]) / 2);
  return { columns: [
    { name: "time", unit: "s", data: encode(time) },
    { name: "tip displacement x", unit: "m", data: encode(tip) },
    { name: "end force x", unit: "N", data: encode(force) },
    { name: "strain energy", unit: "J", data: encode(strain) },
    { name: "kinetic energy", unit: "J", data: encode(strain.map((e, i) => 0.06 * e * Math.exp(-i / 20) * Math.cos(i / 2) ** 2)) },
    { name: "unbalanced-force ratio", unit: "1", data: encode(time.map((_, i) => 0.3 * Math.exp(-i / 11) * (1.2 + Math.cos(i / 3)))) },
  ], plots: [
    { title: "Force against displacement", x: "tip displacement x", y: ["end force x"] },
    { title: "Energy", x: "time", y: ["strain energy", "kinetic energy"] },
    { title: "Unbalanced force", x: "time", y: ["unbalanced-force ratio"], log: true },
  ] };
}

// Deflection along the axis: theory, and lattices that are a few per cent off.
function deflection() {
  const y = Array.from({ length: CELLS[1] + 1 }, (_, j) => j * SPACING);
  const series = (name, factor, style) => ({ name, x: y, y: y.map((at) => factor * axis(at, LOAD).w), style });
  return { title: "Deflection of the axis", x: { label: "y", unit: "m" }, y: { label: "u_x", unit: "m" },
    series: [series("Cube-I", 1.002, "line+points"), series("Cube-II", 0.88, "line+points"), series("Cube-III", 0.943, "line+points"),
      series("Euler–Bernoulli", 1, "dashed")], note: "The curves of this sample are the theory's, scaled." };
}

/** The data block of the sample: docs/formats/report-data.md. */
export function makeSample() {
  const body = mesh();
  const nodes = body.points.length / 3;
  const tip = axis(LENGTH, LOAD).w;
  const numbers = (title, rows) => ({ title, columns: [{ name: "quantity" }, { name: "value" }], rows });
  const panel = (component) => ({ field: "displacement", component, sample: STEPS - 1, caption: `u_${component}` });
  return {
    format: "koshi-report/1",
    version: "0.1.0",
    title: "Cantilever (sample data)",
    subtitle: "Cube-III, shared springs, bending-exact, rotational kinematics; equilibrium",
    facts: [
      { label: "Body", value: CELLS.map((n) => n * SPACING), unit: "m" },
      { label: "Spacing", value: SPACING, unit: "m" },
      { label: "Cells", value: CELLS[0] * CELLS[1] * CELLS[2] },
      { label: "Nodes", value: nodes },
      { label: "Unknowns", value: 6 * nodes },
      { label: "Computed in", value: 0.83, unit: "s" },
    ],
    summary: { title: "Cantilever (sample data)", probes: { tip: { displacement: [tip, 0, 0] } } },
    case: 'title = "Cantilever (sample data)"\n\n[lattice]\ncell = "cube-III"\nspacing = 0.002 # m\n\n[material.rock]\nyoungs_modulus = 1.112e9 # Pa\npoissons_ratio = 0.18\n',
    materials: { columns: [{ name: "material" }, { name: "E", unit: "Pa" }, { name: "ν", unit: "1" }, { name: "density", unit: "kg/m^3" }, { name: "cells" }],
      rows: [["rock", E, NU, 2000, 1580], ["soft rock", 0.4 * E, 0.3, 1800, 1579]] },
    conditions: { columns: ["name", "where", "what", "value", "over time"].map((name) => ({ name })),
      rows: [["root", "y-min", "x, y, z", "fixed", ""], ["tip_load", "y-max", "force", { value: [LOAD, 0, 0], unit: "N" }, "constant"]] },
    springs: { columns: [{ name: "material" }, { name: "bonds" }, { name: "k_n", unit: "N/m" }, { name: "k_t", unit: "N/m" }],
      rows: [["rock", "edges", 474300, 335700], ["rock", "face diagonals", 321800, 99120], ["rock", "body diagonals", 338200, 212400]] },
    achieved: { columns: [{ name: "material" }, { name: "E asked", unit: "Pa" }, { name: "E achieved", unit: "Pa" }, { name: "deviation" },
        { name: "ν asked" }, { name: "ν achieved" }, { name: "deviation" }, { name: "Zener ratio" }],
      rows: [["rock", E, E * (1 + 2e-13), 2e-13, NU, NU, 0, 1], ["soft rock", 0.4 * E, 0.4 * E, 0, 0.3, 0.3 * (1 + 1e-13), 1e-13, 1]] },
    probes: [{ title: "Displacement", columns: [{ name: "probe" }, { name: "where" }, ...["x", "y", "z"].map((name) => ({ name, unit: "m" }))],
      rows: [["tip", "y-max, area-mean", tip, 0, 0], ["middle", "point", ...displacement([SIDE / 2, LENGTH / 2], LOAD)]] }],
    timing: [
      numbers("Analysis", [["iterations", { value: 8, unit: "1" }], ["ended by", "relative residual below tolerance"]]),
      numbers("Energy", [["elastic", { value: (LOAD * tip) / 2, unit: "J" }]]),
      numbers("Performance", [["wall time", { value: 0.83, unit: "s" }], ["peak memory", { value: 34.5e6, unit: "B" }]])],
    history: history(),
    convergence: { residuals: [1, 0.21, 0.013, 9.1e-4, 5.2e-5, 3.3e-6, 2.4e-7, 1.5e-8, 9e-10], tolerance: 1e-8 },
    mesh: {
      points: encode(Float32Array.from(body.points)),
      quads: encode(Int32Array.from(body.quads)),
      quad_cell: encode(Int32Array.from(body.quadCell)),
      lattice: { cells: CELLS, origin: [0, 0, 0], spacing: SPACING, point_index: encode(body.ids(nodes)), cell_index: encode(body.ids(body.centres.length)) },
      samples: samples(body),
      note: "Every 1st surface point is shown: this is where a decimation would be told.",
    },
    figures: [{ title: "Fig. 6: displacement on the deformed bar", panels: ["x", "y", "z"].map(panel) }],
    tables: [{ title: "Table 1: uniaxial compression", columns: ["cell", "E/E0 paper", "E/E0 Koshi", "ν/ν0 paper", "ν/ν0 Koshi"].map((name) => ({ name })),
      rows: [["Cube-I", 0.942, 0.9416, 0, 0], ["Cube-II", 1.151, 1.1517, 1.067, 1.0671], ["Cube-III", 1.03, 1.0301, 1.089, 1.0895]],
      note: "E0 = 1112 MPa, ν0 = 0.18." }],
    curves: [deflection()],
  };
}
