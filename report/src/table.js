// Tables: a fitting prefix for each unit, numbers to six digits, the full value as a tooltip.
import { element, subscripted } from "./dom.js";
import { labelled, magnitudeOf, number, prefixed, quantity, unitText } from "./format.js";

// Values this much smaller than others of their unit are rounding errors of zero; the tooltip has them in full.
const NOISE = 1e-9;
// Texts of more characters may break into lines.
const SENTENCE = 40;

/**
 * @param {object} table {title?, columns: [{name, unit?, decimals?}], rows: [[…]], heat?, note?}; cells are numbers, texts, {value, unit}
 *                       or null
 * @returns {HTMLElement|null} null when there is no row
 */
export function table(block) {
  if (!block?.rows?.length) return null;
  const numbers = block.columns.map((_, i) => block.rows.map((row) => row[i]).filter((value) => typeof value === "number"));
  const columns = block.columns.map(({ name, unit, decimals }, i) => {
    // Columns of the same unit share a prefix, so that they can be compared.
    const magnitude = magnitudeOf(numbers.filter((_, other) => block.columns[other].unit === unit).flat());
    return { name, decimals, numeric: numbers[i].length > 0, noise: unit ? NOISE * magnitude : 0, ...prefixed(magnitude, unit) };
  });
  const head = columns.map(({ name, unit, numeric }) =>
    element("th", { scope: "col", class: numeric ? "number" : null }, ...subscripted(labelled(name, unit))));
  const strength = block.heat ? magnitudeOf(numbers.flat()) : 0;
  const body = block.rows.map((row) => element("tr", {}, ...row.map((value, i) => cell(value, columns[i], strength))));
  return element("div", { class: block.broad || columns.length > 8 ? "table broad" : "table" },
    block.title ? element("h3", {}, ...subscripted(block.title)) : null,
    element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": block.title ?? "Table" },
      element("table", {}, element("thead", {}, element("tr", {}, ...head)), element("tbody", {}, ...body))),
    block.note ? element("p", { class: "note" }, ...subscripted(block.note)) : null);
}

/** Several tables beside each other; null when there is no row in any. */
export function tables(blocks) {
  const shown = (blocks ?? []).map(table).filter(Boolean);
  return shown.length ? element("div", { class: "tables" }, ...shown) : null;
}

// `strength`: the number that gets the fullest colour; 0: none does.
function cell(value, column, strength) {
  const { factor, numeric } = column;
  if (value?.unit) {
    const text = Array.isArray(value.value) ? vector(value.value, value.unit) : quantity(value.value, value.unit);
    return element("td", { title: String(value.value), dataset: { value: value.value }, text });
  }
  if (typeof value !== "number") {
    const kind = numeric ? "number" : value?.length > SENTENCE ? "sentence" : null;
    return element("td", { class: kind }, ...subscripted(value ?? "–"));
  }
  return element("td", { class: "number", title: String(value), dataset: { value }, style: strength ? heat(value / strength) : null, text: shown(value, column) });
}

// A shade from none at 0 to the fullest at 1 and -1, of two colours.
function heat(part) {
  const colour = part < 0 ? "var(--curve-2)" : "var(--curve-1)";
  return `background-color: color-mix(in srgb, ${colour} ${Math.round(60 * Math.sqrt(Math.abs(part)))}%, transparent)`;
}

// "(9.8, 0, 0) N"
function vector(values, unit) {
  const { factor, unit: text } = prefixed(magnitudeOf(values), unit);
  return `(${values.map((value) => number(value / factor)).join(", ")})\u00a0${unitText(text)}`;
}

function shown(value, { factor, decimals, noise }) {
  if (decimals !== undefined) return (value / factor).toFixed(decimals).replace(/^-(?=[0.]*$)/, "");
  return value !== 0 && Math.abs(value) < noise ? "≈ 0" : number(value / factor);
}
