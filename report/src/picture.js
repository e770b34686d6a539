// What a Scene shows of a Body: keeps the two in step with a state of plain values.
import { boxEdges, creases, edges, visible } from "./mesh.js";
import { Scene } from "./scene.js";

export class Picture {
  /**
   * @param {Body} body
   * @param {HTMLElement} container
   * @param {boolean} interactive
   */
  constructor(body, container, interactive) {
    this.body = body;
    this.scene = new Scene(container, interactive);
    this.outlines = {};
    this.shown = {};
  }

  // The edges of the undeformed body.
  outline(surface) {
    const { body } = this;
    const points = body.points(surface);
    this.outlines[surface] ??= body.linesPossible ? { points, pairs: lines(surface, points, body.mesh.quads, true) } : boxEdges(body.bounds);
    return this.outlines[surface];
  }

  /**
   * Draws a state: {surface: "true"|"cells", sample, field, choice, limits: {min, max}|null, scale, cut, lines:
   * "edges"|"cells"|"none", outline}.
   * Only what differs from the last state is rebuilt.
   */
  draw(state) {
    const { body, scene } = this;
    const differs = (...keys) => keys.some((key) => this.shown[key] !== state[key]);
    const { surface } = state;
    if (differs("surface", "cut", "lines")) {
      this.part = visible(body.mesh, state.cut);
      const wanted = body.linesPossible && state.lines !== "none";
      const pairs = wanted ? lines(surface, body.points(surface), this.part.quads, state.lines === "edges") : null;
      scene.setBody(body.positions(state.sample, state.scale, surface), this.part.quads, pairs);
    } else if (differs("sample", "scale")) {
      scene.setPositions(body.positions(state.sample, state.scale, surface));
    }
    if (differs("surface", "outline")) {
      const { points, pairs } = this.outline(surface);
      scene.setOutline(state.outline ? points : null, pairs);
    }
    if (differs("surface", "cut", "sample", "field", "choice", "limits")) this.colour(state);
    this.shown = { ...state };
    scene.render();
  }

  colour({ surface, field, choice, sample, limits }) {
    const values = this.body.values(field, choice, sample, surface);
    const perQuad = this.body.field(field, sample).on === "cells";
    const shown = perQuad ? Float32Array.from(this.part.quadCell, (cell) => values[cell]) : values;
    this.scene.setColours(shown, perQuad, { ...this.body.map(field, choice), ...limits });
  }

  /** Value, nearest point or cell, and place under a spot of the picture; null beside the body. */
  probe(x, y) {
    const hit = this.scene.pick(x, y);
    if (!hit) return null;
    const { surface, sample, field, choice, scale } = this.shown;
    const { quads, quadCell } = this.part;
    const corners = [0, 1, 2, 3].map((i) => quads[4 * hit.quad + i]);
    const position = this.body.positions(sample, scale, surface);
    const distance = (point) => Math.hypot(...hit.position.map((value, axis) => value - position[3 * point + axis]));
    const nearest = corners.reduce((best, point) => (distance(point) < distance(best) ? point : best));
    const perQuad = this.body.field(field, sample).on === "cells";
    const values = this.body.values(field, choice, sample, surface);
    return { value: values[perQuad ? quadCell[hit.quad] : nearest], place: [...this.body.points(surface).slice(3 * nearest, 3 * nearest + 3)] };
  }
}

// Lines upon a surface: its edges, or those of all quads.
function lines(surface, points, quads, edgesOnly) {
  return surface === "true" && edgesOnly ? creases(points, quads) : edges(points, quads, edgesOnly);
}
