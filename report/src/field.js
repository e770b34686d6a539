// A field of one sample: values per point or per cell, and the scalars one can look at.
import { decode } from "./data.js";

const DERIVED = {
  vector: [["magnitude", magnitude]],
  "symmetric-tensor": [
    ["mean", (v, i) => (v[i] + v[i + 1] + v[i + 2]) / 3],
    ["greatest principal", (v, i) => principal(v, i)[0]],
    ["least principal", (v, i) => principal(v, i)[2]],
  ],
};

function magnitude(v, i) {
  return Math.hypot(v[i], v[i + 1], v[i + 2]);
}

// Components in the order xx, yy, zz, xy, yz, xz.
function vonMises(v, i) {
  const [xx, yy, zz, xy, yz, xz] = v.subarray(i, i + 6);
  const normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2;
  return Math.sqrt(normal / 2 + 3 * (xy * xy + yz * yz + xz * xz));
}

/**
 * Eigenvalues of a symmetric 3x3 tensor, greatest first (trigonometric solution, O. K. Smith 1961,
 * doi:10.1145/355578.366316).
 */
export function principal(v, i) {
  const [xx, yy, zz, xy, yz, xz] = v.subarray(i, i + 6);
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

/** What can be shown of a field: [{id, label}], the first being the one to start with. */
export function choices(name, field) {
  const derived = [...(DERIVED[field.kind] ?? [])];
  if (field.kind === "symmetric-tensor" && name === "stress") derived.unshift(["von Mises", vonMises]);
  const own = field.components ?? ["value"];
  return [...derived.map(([id]) => id), ...own];
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
  const own = components.indexOf(choice);
  const derived = choice === "von Mises" ? vonMises : DERIVED[field.kind]?.find(([id]) => id === choice)?.[1];
  if (own < 0 && !derived) throw new Error(`field "${name}" has no "${choice}"`);
  const result = new Float32Array(values.length / width);
  for (let k = 0; k < result.length; ++k) result[k] = own >= 0 ? values[k * width + own] : derived(values, k * width);
  return result;
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
