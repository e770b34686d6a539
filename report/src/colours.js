// Colour maps: viridis where values have one sign, a diverging map symmetric about zero where they have both.
import { interpolateRdBu, interpolateViridis, schemeTableau10 } from "d3-scale-chromatic";

const SEQUENTIAL = { name: "viridis", colour: interpolateViridis };
const DIVERGING = { name: "blue-white-red", colour: (t) => interpolateRdBu(1 - t) };

// A field counts as signed when its smaller side reaches this fraction of the larger one; less is noise about zero.
const SIGNED_FRACTION = 0.05;

/** The map and limits for values between min and max. */
export function mapFor({ min, max }) {
  const signed = min < 0 && max > 0 && Math.min(-min, max) > SIGNED_FRACTION * Math.max(-min, max);
  const limit = Math.max(-min, max);
  return signed ? { ...DIVERGING, min: -limit, max: limit } : { ...SEQUENTIAL, min, max };
}

/** Colours of `count` equal steps over a map, as [r, g, b] in 0..1. */
export function steps(map, count) {
  return Array.from({ length: count }, (_, i) => components(map.colour(i / (count - 1))));
}

/** Colour of category `code` (0, 1, 2, …), as a CSS colour. */
export function categoryColour(code) {
  return schemeTableau10[((code % 10) + 10) % 10];
}

/** [r, g, b] in 0..1 of a CSS colour "#rrggbb" or "rgb(r, g, b)". */
export function components(css) {
  const numbers = css.startsWith("#") ? [1, 3, 5].map((i) => parseInt(css.slice(i, i + 2), 16)) : css.match(/[\d.]+/g);
  return numbers.slice(0, 3).map((value) => Number(value) / 255);
}
