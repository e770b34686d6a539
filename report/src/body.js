// The body as the page knows it: mesh, samples, and the scalars and shapes one can ask for. No drawing here.
import { categoryColour, mapFor } from "./colours.js";
import { decode } from "./data.js";
import { choices, range, scalars } from "./field.js";
import { quantity } from "./format.js";
import { bounds, readMesh, replaced } from "./mesh.js";

// Above this many quads only the bounding box is outlined, and no lines are drawn upon the surface.
const MOST_QUADS_WITH_LINES = 300_000;

// The start value of the deformation scale shows the largest displacement as this part of the body's diagonal.
const VISIBLE_PART = 0.1;

export class Body {
  /** @param {object} block the data block's `mesh` */
  constructor(block) {
    this.mesh = readMesh(block, decode);
    this.bounds = bounds(this.mesh.points);
    this.moved = block.true_surface ? decode(block.true_surface.point) : null;
    // What can be shown, the first at the start.
    this.surfaces = this.moved ? ["true", "cells"] : ["cells"];
    this.truePoints = this.moved && replaced(this.mesh.points, 3, this.moved, decode(block.true_surface.at));
    this.linesPossible = this.mesh.quads.length / 4 <= MOST_QUADS_WITH_LINES;
    this.samples = block.samples;
    this.note = block.note;
    this.title = block.title ?? "Deformed body";
    this.unit = block.unit ?? "m";
    this.smooth = Boolean(block.smooth);
    this.swings = Boolean(block.swings);
    this.cache = new Map();
  }

  /** Names of the fields all samples have. */
  fieldNames() {
    return Object.keys(this.samples[0].fields).filter((name) => this.samples.every(({ fields }) => name in fields));
  }

  field(name, sample = 0) {
    return this.samples[sample].fields[name];
  }

  choices(name) {
    return choices(name, this.field(name));
  }

  /** Undeformed positions of the points [m]; surface: "cells" or "true". */
  points(surface) {
    return surface === "true" ? this.truePoints : this.mesh.points;
  }

  // Numbers of a field; on the true surface points have values of their own.
  numbers(name, sample, surface) {
    return this.remember(`${name}/${sample}/${surface}`, () => {
      const { data, on_true_surface: there, components = ["value"] } = this.field(name, sample);
      return surface === "true" && there ? replaced(decode(data), components.length, this.moved, decode(there)) : decode(data);
    });
  }

  /** One scalar of a field in a sample, a value per point or cell. */
  values(name, choice, sample, surface) {
    return this.remember(`${name}/${choice}/${sample}/${surface}`, () =>
      scalars(name, { ...this.field(name, sample), data: this.numbers(name, sample, surface) }, choice));
  }

  /** Colour map of a scalar: the same over all samples and surfaces, so that they can be compared. */
  map(name, choice) {
    const { kind, categories } = this.field(name);
    if (kind === "category")
      return { categories: Object.entries(categories).map(([code, text]) => [Number(code), categoryColour(Number(code) - 1), text]) };
    return this.remember(`${name}/${choice}`, () => {
      const ranges = this.samples.flatMap((_, sample) =>
        this.surfaces.map((surface) => range(this.values(name, choice, sample, surface))));
      return mapFor({ min: Math.min(...ranges.map((r) => r.min)), max: Math.max(...ranges.map((r) => r.max)) });
    });
  }

  hasDisplacement() {
    return this.fieldNames().includes("displacement");
  }

  /** Positions of the points with displacements enlarged `scale` times [m]. */
  positions(sample, scale, surface) {
    if (!this.hasDisplacement()) return this.points(surface);
    const u = this.numbers("displacement", sample, surface);
    return this.points(surface).map((x, i) => x + scale * u[i]);
  }

  /** Start value of the deformation scale: 1, 2 or 5 times a power of ten; at least 1 unless shapes have no size. */
  startScale() {
    if (!this.hasDisplacement()) return 1;
    const largest = Math.max(...this.samples.map((_, sample) => range(this.values("displacement", "magnitude", sample, this.surfaces[0])).max));
    const { min, max } = this.bounds;
    const wanted = (VISIBLE_PART * Math.hypot(...max.map((value, axis) => value - min[axis]))) / largest;
    if (!(wanted > (this.swings ? 0 : 1)) || !Number.isFinite(wanted)) return 1;
    const power = 10 ** Math.floor(Math.log10(wanted));
    return power * [5, 2, 1].find((digit) => digit * power <= wanted);
  }

  /** What a sample is called: its label, or its time. */
  sampleName(sample) {
    const { label, time } = this.samples[sample];
    return label ?? (time === undefined ? `sample ${sample + 1}` : `t = ${quantity(time, "s", 4)}`);
  }

  remember(key, compute) {
    if (!this.cache.has(key)) this.cache.set(key, compute());
    return this.cache.get(key);
  }
}
