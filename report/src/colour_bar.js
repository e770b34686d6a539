// The key to the colours: a scale with ticks and unit, or the names of the categories.
import { ticks } from "d3-array";
import { element } from "./dom.js";
import { labelled, number, prefixed } from "./format.js";

const GRADIENT_STEPS = 32;

/** Ticks of a map in the unit shown: [{value, text, fraction along the bar}]. */
function scaleTicks(map, factor) {
  if (map.max === map.min) return [{ text: number(map.min / factor, 4), fraction: 0.5 }];
  const values = ticks(map.min / factor, map.max / factor, 6);
  return values.map((value) => ({ text: number(value, 4), fraction: (value * factor - map.min) / (map.max - map.min) }));
}

/**
 * @param {string} title what the colours mean
 * @param {string} unit  SI unit of the values
 * @param {object} map   {name, colour, min, max}, or {categories: [[code, colour, name], …]}
 */
export function colourBar(title, unit, map) {
  if (map.categories) {
    const swatch = ([, colour, name]) =>
      element("span", { class: "swatch" }, element("i", { style: `background:${colour}` }), name);
    return element("div", { class: "colour-bar" }, element("div", { class: "bar-title", text: title }),
      element("div", { class: "swatches" }, ...map.categories.map(swatch)));
  }
  const shown = prefixed(Math.max(Math.abs(map.min), Math.abs(map.max)), unit);
  const stops = Array.from({ length: GRADIENT_STEPS + 1 }, (_, i) => map.colour(i / GRADIENT_STEPS)).join(", ");
  const marks = scaleTicks(map, shown.factor).map(({ text, fraction }) =>
    element("span", { class: "tick", style: `left:${(100 * fraction).toFixed(3)}%`, text }));
  return element("div", { class: "colour-bar" }, element("div", { class: "bar-title", text: labelled(title, shown.unit) }),
    element("div", { class: "bar", role: "img", style: `background:linear-gradient(to right, ${stops})`,
      "aria-label": `Colour scale ${map.name} from ${number(map.min / shown.factor, 4)} to ${number(map.max / shown.factor, 4)} ${shown.unit}` }),
    element("div", { class: "ticks" }, ...marks));
}
