// A field of one sample: values per point or per cell, and the scalars one can look at.
import { decode } from "./data.js";

// Components of a symmetric tensor as the formulas below take them; the data may name them in another order.
const TENSOR = ["xx", "yy", "zz", "xy", "yz", "xz"];

// What can be computed from the components of one point or cell, by kind of field.
const DERIVED = {
  vector: { magnitude: (v) => Math.hypot(...v) },
  "symmetric-tensor": {
    mean: (t) => (t[0] + t[1] + t[2]) / 3,
    "greatest principal": (t) => principal(t)[0],
    "least principal": (t) => principal(t)[2],
  },
  stress: { "von Mises": vonMises },
};

function vonMises([xx, yy, zz, xy, yz, xz]) {
  const normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2;
  return Math.sqrt(normal / 2 + 3 * (xy * xy + yz * yz + xz * xz));
}

/**
 * Eigenvalues of a symmetric 3x3 tensor, greatest first (trigonometric solution, O. K. Smith 1961,
 * doi:10.1145/355578.366316).
 */
export function principal([xx, yy, zz, xy, yz, xz]) {
  const mean = (xx + yy + zz) / 3;
  const [a, b, c] = [xx - mean, yy - mean, zz - mean];
  const p = Math.sqrt((a * a + b * b + c * c + 2 * (xy * xy + yz * yz + xz * xz)) / 6);
  if (p === 0) return [mean, mean, mean];
  const determinant = a * b * c + 2 * xy * yz * xz - a * yz * yz - b * xz * xz - c * xy * xy;
  const angle = Math.acos(Math.min(1, Math.max(-1, determinant / (2 * p ** 3)))) / 3;
  const first = mean + 2 * p * Math.cos(angle);
  const third = mean + 2 * p * Math.cos(angle + (2 * Math.PI) / 3);
  return [first, 3 * mean - first - third, third];
}

function derived(name, { kind }) {
  return { ...(name === "stress" && kind === "symmetric-tensor" ? DERIVED.stress : {}), ...DERIVED[kind] };
}

/** Names of the scalars that can be shown of a field; the first is the one to start with. */
export function choices(name, field) {
  return [...Object.keys(derived(name, field)), ...(field.components ?? ["value"])];
}

/**
 * One scalar of a field, a value per point or cell.
 * @param {string} name   the field's name
 * @param {object} field  {kind, components, data}
 * @param {string} choice one of `choices(name, field)`
 * @returns {Float32Array}
 */
export function scalars(name, field, choice) {
  const values = decode(field.data);
  const components = field.components ?? ["value"];
  const width = components.length;
  const result = new Float32Array(values.length / width);
  const own = components.indexOf(choice);
  if (own >= 0) return result.map((_, k) => values[k * width + own]);

  const compute = derived(name, field)[choice];
  if (!compute) throw new Error(`field "${name}" has no "${choice}"`);
  const order = (field.kind === "symmetric-tensor" ? TENSOR : components).map((component) => components.indexOf(component));
  const one = new Float64Array(width);
  return result.map((_, k) => {
    order.forEach((from, to) => (one[to] = values[k * width + from]));
    return compute(one);
  });
}

/** {min, max} of the finite values; {0, 0} when there are none. */
export function range(values) {
  let [min, max] = [Infinity, -Infinity];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < min) min = value;
    if (value > max) max = value;
  }
  return min <= max ? { min, max } : { min: 0, max: 0 };
}
