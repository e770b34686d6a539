// Tables: a fitting prefix for each unit, numbers to six digits, the full value as a tooltip.
import { element, subscripted } from "./dom.js";
import { labelled, magnitudeOf, number, prefixed, quantity } from "./format.js";

/**
 * @param {object} table {title?, columns: [{name, unit?}], rows: [[…]], note?}; cells are numbers, texts, {value, unit} or null
 * @returns {HTMLElement|null} null when there is no row
 */
export function table(block) {
  if (!block?.rows?.length) return null;
  const numbers = block.columns.map((_, i) => block.rows.map((row) => row[i]).filter((value) => typeof value === "number"));
  const columns = block.columns.map(({ name, unit }, i) => {
    // Columns of the same unit share a prefix, so that they can be compared.
    const alike = numbers.filter((_, other) => block.columns[other].unit === unit).flat();
    return { name, numeric: numbers[i].length > 0, ...prefixed(magnitudeOf(alike), unit) };
  });
  const head = columns.map(({ name, unit, numeric }) =>
    element("th", { scope: "col", class: numeric ? "number" : null }, ...subscripted(labelled(name, unit))));
  const body = block.rows.map((row) => element("tr", {}, ...row.map((value, i) => cell(value, columns[i]))));
  return element("div", { class: columns.length > 8 ? "table broad" : "table" },
    block.title ? element("h3", { text: block.title }) : null,
    element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": block.title ?? "Table" },
      element("table", {}, element("thead", {}, element("tr", {}, ...head)), element("tbody", {}, ...body))),
    block.note ? element("p", { class: "note", text: block.note }) : null);
}

function cell(value, { factor, numeric }) {
  if (value?.unit) return element("td", { title: String(value.value), dataset: { value: value.value }, text: quantity(value.value, value.unit) });
  if (typeof value !== "number") return element("td", { class: numeric ? "number" : null, text: value ?? "–" });
  return element("td", { class: "number", title: String(value), dataset: { value }, text: number(value / factor) });
}
