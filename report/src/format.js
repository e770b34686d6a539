// Numbers and units as text.

const PREFIXES = [
  [1e-9, "n"],
  [1e-6, "µ"],
  [1e-3, "m"],
  [1, ""],
  [1e3, "k"],
  [1e6, "M"],
  [1e9, "G"],
  [1e12, "T"],
];

// Units that take a prefix on their first symbol: "N/m" -> "MN/m", but not "kg/m^3", "m^2" or "1".
const PREFIXABLE = /^(m|Pa|N|J|s|Hz|rad|W|B)([ /].*)?$/;

/**
 * A unit prefix fit for numbers as large as `magnitude`.
 * @param {number} magnitude largest absolute value to be shown
 * @param {string} unit      SI unit, "1" or "" for none
 * @returns {{factor: number, unit: string}} value / factor carries the returned unit
 */
export function prefixed(magnitude, unit) {
  const plain = { factor: 1, unit: unit ?? "" };
  if (!PREFIXABLE.test(unit ?? "") || !(magnitude > 0) || !Number.isFinite(magnitude)) return plain;
  const long = /^(s|rad)\b/.test(unit);  // kiloseconds and kiloradians help nobody
  const usable = PREFIXES.filter(([factor]) => !(long && factor > 1));
  const fitting = usable.filter(([factor]) => magnitude / factor >= 1 - 1e-9);
  const [factor, symbol] = fitting.at(-1) ?? usable[0];
  return { factor, unit: symbol + unit };
}

/** Largest absolute finite value, 0 for none. */
export function magnitudeOf(values) {
  let largest = 0;
  for (const value of values) if (Number.isFinite(value)) largest = Math.max(largest, Math.abs(value));
  return largest;
}

/**
 * A text split at the subscripts of symbols: odd parts are subscripts. "u_x" is a symbol, "tip_load" a name.
 */
export function subscripts(text) {
  return text.split(/(?<=(?<![\p{L}\d_.])\p{L})_(\p{L}{1,3}|\d)(?![\p{L}\d_])/u);
}

/**
 * A number with at most `digits` significant digits, no trailing zeros; whole from ten thousand on; scientific, with
 * fewer digits, below 1e-4 and from 1e7 on.
 */
export function number(value, digits = 6) {
  if (typeof value !== "number") return String(value ?? "");
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "–" : value > 0 ? "∞" : "-∞";
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return grouped(value);
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e7) return value.toExponential(Math.min(digits, 4) - 1).replace(/\.?0+e/, "e").replace("e+", "e");
  const rounded = size < 1e4 ? Number(value.toPrecision(digits)) : Math.round(value);
  return Number.isInteger(rounded) ? grouped(rounded) : String(rounded);
}

// Thin spaces between thousands, from five digits on.
function grouped(value) {
  const text = String(value);
  return Math.abs(value) < 1e4 ? text : text.replace(/\B(?=(\d{3})+$)/g, "\u2009");
}

const SUPERSCRIPTS = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

/** A unit with real superscripts and a dot between factors; "" for the dimensionless "1". */
export function unitText(unit) {
  if (!unit || unit === "1") return "";
  return unit.replace(/(?<=[a-z])\^?(-?\d+)/gi, (_, power) => [...power].map((c) => SUPERSCRIPTS[c]).join("")).replaceAll(" ", "·");
}

/** "label [unit]", or the label alone. */
export function labelled(label, unit) {
  const text = unitText(unit);
  return text ? `${label} [${text}]` : label;
}

/** A value with its unit and a fitting prefix: "1.112 GPa"; a list as "18 × 78 × 18 mm". */
export function quantity(value, unit, digits = 6) {
  if (Array.isArray(value)) {
    const shown = prefixed(magnitudeOf(value), unit);
    return `${value.map((one) => number(one / shown.factor, digits)).join(" × ")}\u00a0${unitText(shown.unit)}`;
  }
  if (typeof value !== "number") return [String(value ?? ""), unitText(unit)].filter(Boolean).join(" ");
  const shown = prefixed(Math.abs(value), unit);
  return [number(value / shown.factor, digits), unitText(shown.unit)].filter(Boolean).join("\u00a0");
}
