// The surface of the body as quadrilaterals: its edges, and what remains of it behind a cut.

/** The mesh of the data block, decoded; `lattice` is null when the block has none. */
export function readMesh(block, decode) {
  const lattice = block.lattice && {
    ...block.lattice,
    pointIndex: decode(block.lattice.point_index),
    cellIndex: decode(block.lattice.cell_index),
  };
  return {
    points: Float32Array.from(decode(block.points)),
    quads: decode(block.quads),
    quadCell: block.quad_cell ? decode(block.quad_cell) : null,
    lattice: lattice ?? null,
  };
}

/** A copy of values, `width` for each point, in which some points have others. */
export function replaced(values, width, points, others) {
  const copy = values.slice();
  points.forEach((point, i) => copy.set(others.subarray(width * i, width * (i + 1)), width * point));
  return copy;
}

/** {min: [x, y, z], max: [x, y, z]} of points stored x, y, z, x, y, z, … */
export function bounds(points) {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; ++i) {
    const axis = i % 3;
    if (points[i] < min[axis]) min[axis] = points[i];
    if (points[i] > max[axis]) max[axis] = points[i];
  }
  return { min, max };
}

// The cross product of a quad's diagonals: its normal, as long as twice its area.
function doubleArea(points, quads, q) {
  const [a, b, c, d] = [quads[4 * q], quads[4 * q + 1], quads[4 * q + 2], quads[4 * q + 3]];
  const p = [0, 1, 2].map((i) => points[3 * c + i] - points[3 * a + i]);
  const r = [0, 1, 2].map((i) => points[3 * d + i] - points[3 * b + i]);
  return [p[1] * r[2] - p[2] * r[1], p[2] * r[0] - p[0] * r[2], p[0] * r[1] - p[1] * r[0]];
}

// Which of the six lattice directions a quad faces, 0..5: the largest component of the cross product of its diagonals.
function facing(points, quads, q) {
  const normal = doubleArea(points, quads, q);
  const sizes = normal.map(Math.abs);
  const axis = sizes.indexOf(Math.max(...sizes));
  return 2 * axis + (normal[axis] > 0 ? 1 : 0);
}

/**
 * Edges of quads, each once, as pairs of point indices.
 * @param {boolean} creasesOnly leave out edges between two quads that face the same way
 */
export function edges(points, quads, creasesOnly) {
  const count = points.length / 3;
  // One sortable key per side of a quad: the edge's two points, then the facing; equal edges become neighbours.
  const keys = new Float64Array(quads.length);
  for (let q = 0; q < quads.length / 4; ++q) {
    const direction = facing(points, quads, q);
    for (let side = 0; side < 4; ++side) {
      const a = quads[4 * q + side];
      const b = quads[4 * q + ((side + 1) % 4)];
      keys[4 * q + side] = (Math.min(a, b) * count + Math.max(a, b)) * 8 + direction;
    }
  }
  keys.sort();
  const pairs = [];
  for (let i = 0; i < keys.length; ) {
    const edge = Math.floor(keys[i] / 8);
    let next = i + 1;
    while (next < keys.length && Math.floor(keys[next] / 8) === edge) ++next;
    const smooth = next - i === 2 && keys[i] === keys[i + 1];
    if (!creasesOnly || !smooth) pairs.push(Math.floor(edge / count), edge % count);
    i = next;
  }
  return Int32Array.from(pairs);
}

// Quads that meet at less than this angle belong to one smooth surface.
const SMOOTH = Math.cos((40 * Math.PI) / 180);
// Smaller quads, as parts of their mean, are slivers that face anywhere.
const SLIVER = 0.05;

/**
 * Edges of a surface whose quads lie any way, as pairs of point indices: where two quads meet at an angle, and where
 * the surface ends.
 */
export function creases(points, quads) {
  const count = points.length / 3;
  const areas = Array.from({ length: quads.length / 4 }, (_, q) => doubleArea(points, quads, q));
  const sizes = areas.map((area) => Math.hypot(...area));
  const least = (SLIVER * sizes.reduce((sum, size) => sum + size, 0)) / sizes.length;
  const alone = new Map();  // sides met once so far: the quad
  const pairs = [];
  for (let q = 0; q < areas.length; ++q)
    for (let side = 0; side < 4; ++side) {
      const [a, b] = [quads[4 * q + side], quads[4 * q + ((side + 1) % 4)]];
      const key = Math.min(a, b) * count + Math.max(a, b);
      const other = alone.get(key);
      if (other === undefined) { alone.set(key, q); continue; }
      alone.delete(key);
      if (sizes[q] < least || sizes[other] < least) continue;
      const cosine = areas[q].reduce((sum, value, axis) => sum + value * areas[other][axis], 0) / (sizes[q] * sizes[other]);
      if (cosine < SMOOTH) pairs.push(a, b);
    }
  for (const key of alone.keys()) pairs.push(Math.floor(key / count), key % count);
  return Int32Array.from(pairs);
}

/** The twelve edges of a box, as {points, pairs}. */
export function boxEdges({ min, max }) {
  const points = [];
  for (let corner = 0; corner < 8; ++corner)
    for (let axis = 0; axis < 3; ++axis) points.push((corner >> axis) & 1 ? max[axis] : min[axis]);
  const pairs = [];
  for (let corner = 0; corner < 8; ++corner)
    for (let axis = 0; axis < 3; ++axis) if (!((corner >> axis) & 1)) pairs.push(corner, corner | (1 << axis));
  return { points: Float32Array.from(points), pairs: Int32Array.from(pairs) };
}

/**
 * The quads on the kept side of a plane across an axis of the undeformed body. With the lattice's cells at hand the
 * plane lies between two layers of cells, and the cells it bares close the body; without them the body is seen hollow.
 * @param {object} mesh from `readMesh`
 * @param {{axis: number, position: number, flip: boolean}|null} cut position [m]; kept below it, or above with `flip`
 * @returns {{quads: Int32Array, quadCell: Int32Array|null}}
 */
export function visible(mesh, cut) {
  if (!cut) return mesh;
  const keep = mesh.lattice ? keepByCell(mesh, cut) : keepByCentre(mesh, cut);
  const quads = [];
  const cells = [];
  for (let q = 0; q < mesh.quads.length / 4; ++q) {
    if (!keep(q)) continue;
    for (let i = 0; i < 4; ++i) quads.push(mesh.quads[4 * q + i]);
    if (mesh.quadCell) cells.push(mesh.quadCell[q]);
  }
  if (mesh.lattice) addCap(mesh, cut, quads, cells);
  return { quads: Int32Array.from(quads), quadCell: mesh.quadCell && Int32Array.from(cells) };
}

function keepByCentre({ points, quads }, { axis, position, flip }) {
  return (q) => {
    let sum = 0;
    for (let i = 0; i < 4; ++i) sum += points[3 * quads[4 * q + i] + axis];
    return sum / 4 <= position !== flip;
  };
}

function layerOfCell({ cells }, index, axis) {
  const below = [1, cells[0], cells[0] * cells[1]][axis];
  return Math.floor(index / below) % cells[axis];
}

/** The cell border nearest to a position: number of layers below it. */
export function layersBelow(lattice, axis, position) {
  const layers = Math.round((position - lattice.origin[axis]) / lattice.spacing);
  return Math.min(lattice.cells[axis], Math.max(0, layers));
}

function keepByCell({ lattice, quadCell }, { axis, position, flip }) {
  const layers = layersBelow(lattice, axis, position);
  return (q) => layerOfCell(lattice, lattice.cellIndex[quadCell[q]], axis) < layers !== flip;
}

// Cells beside the plane on the kept side show their face where the cell beyond is solid too; elsewhere the surface
// already has that face.
function addCap({ lattice }, { axis, position, flip }, quads, cells) {
  const layers = layersBelow(lattice, axis, position);
  const [nx, ny, nz] = lattice.cells;
  const stride = [1, nx, nx * ny];
  const step = flip ? -stride[axis] : stride[axis];
  const bared = flip ? layers : layers - 1;
  if (layers <= 0 || layers >= lattice.cells[axis]) return;

  const solid = new Uint8Array(nx * ny * nz);
  for (const index of lattice.cellIndex) solid[index] = 1;
  const pointAt = new Int32Array((nx + 1) * (ny + 1) * (nz + 1)).fill(-1);
  lattice.pointIndex.forEach((index, point) => (pointAt[index] = point));

  const nodeStride = [1, nx + 1, (nx + 1) * (ny + 1)];
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3].map((other) => nodeStride[other]);
  lattice.cellIndex.forEach((index, cell) => {
    if (layerOfCell(lattice, index, axis) !== bared || !solid[index + step]) return;
    const ijk = [0, 1, 2].map((other) => layerOfCell(lattice, index, other));
    ijk[axis] = layers;
    const corner = ijk[0] + nodeStride[1] * ijk[1] + nodeStride[2] * ijk[2];
    const face = [corner, corner + u, corner + u + v, corner + v].map((node) => pointAt[node]);
    if (face.includes(-1)) return;
    quads.push(...(flip ? face.reverse() : face));
    cells.push(cell);
  });
}
