// What a Scene shows of a Body: keeps the two in step with a state of plain values.
import { boxEdges, edges, visible } from "./mesh.js";
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
    const { points, quads } = body.mesh;
    this.outline = body.linesPossible ? { points, pairs: edges(points, quads, true) } : boxEdges(body.bounds);
    this.shown = {};
  }

  /**
   * Draws a state: {sample, field, choice, limits: {min, max}|null, scale, cut, lines: "edges"|"cells"|"none", outline}.
   * Only what differs from the last state is rebuilt.
   */
  draw(state) {
    const { body, scene } = this;
    const differs = (...keys) => keys.some((key) => this.shown[key] !== state[key]);
    if (differs("cut", "lines")) {
      this.part = visible(body.mesh, state.cut);
      const wanted = body.linesPossible && state.lines !== "none";
      const pairs = wanted ? edges(body.mesh.points, this.part.quads, state.lines === "edges") : null;
      scene.setBody(body.positions(state.sample, state.scale), this.part.quads, pairs);
    } else if (differs("sample", "scale")) {
      scene.setPositions(body.positions(state.sample, state.scale));
    }
    if (differs("outline")) scene.setOutline(state.outline ? this.outline.points : null, this.outline.pairs);
    if (differs("cut", "sample", "field", "choice", "limits")) this.colour(state);
    this.shown = { ...state };
    scene.render();
  }

  colour({ field, choice, sample, limits }) {
    const values = this.body.values(field, choice, sample);
    const perQuad = this.body.field(field, sample).on === "cells";
    const shown = perQuad ? Float32Array.from(this.part.quadCell, (cell) => values[cell]) : values;
    this.scene.setColours(shown, perQuad, { ...this.body.map(field, choice), ...limits });
  }

  /** Value, nearest point or cell, and place under a spot of the picture; null beside the body. */
  probe(x, y) {
    const hit = this.scene.pick(x, y);
    if (!hit) return null;
    const { sample, field, choice, scale } = this.shown;
    const { quads, quadCell } = this.part;
    const corners = [0, 1, 2, 3].map((i) => quads[4 * hit.quad + i]);
    const position = this.body.positions(sample, scale);
    const distance = (point) => Math.hypot(...hit.position.map((value, axis) => value - position[3 * point + axis]));
    const nearest = corners.reduce((best, point) => (distance(point) < distance(best) ? point : best));
    const perQuad = this.body.field(field, sample).on === "cells";
    const values = this.body.values(field, choice, sample);
    return { value: values[perQuad ? quadCell[hit.quad] : nearest], place: [...this.body.mesh.points.slice(3 * nearest, 3 * nearest + 3)] };
  }
}
