// The section with the body in three dimensions and its controls.
import { Body } from "./body.js";
import { colourBar } from "./colour_bar.js";
import { element, section, select } from "./dom.js";
import { labelled, number, prefixed, quantity } from "./format.js";
import { layersBelow } from "./mesh.js";
import { Picture } from "./picture.js";
import { canDraw } from "./scene.js";
import { swing } from "./swing.js";
import { colourOf, onTheme } from "./theme.js";
import { triad } from "./triad.js";

const AXES = ["x", "y", "z"];
const TURN = 7.5;  // degrees for one press of an arrow key
const CUT_STEPS = 200;
const PLAY_INTERVAL = 400;  // ms between samples

/** The section, or null when the data hold no mesh. `start` is to be called once it is on the page. */
export function viewer(block) {
  if (!block) return null;
  const body = new Body(block);
  const names = body.fieldNames();
  const first = names.includes("displacement") ? "displacement" : names[0];
  const state = { surface: body.surfaces[0], sample: body.swings ? 0 : body.samples.length - 1, field: first, choice: body.choices(first)[0], limits: null,
    scale: body.startScale(), cut: null, lines: body.smooth ? "none" : "edges", outline: body.hasDisplacement() };

  const view = element("div", { class: "view", id: "view", tabindex: "0", role: "application",
    "aria-label": "The body in three dimensions. Arrow keys turn it, plus and minus zoom, 0 shows it whole." });
  const readout = element("output", { class: "readout", "aria-live": "polite" });
  const key = element("div", { class: "key", id: "key" });
  let picture;
  const drawTimes = (factor) => picture?.draw({ ...state, scale: factor * state.scale });
  const draw = () => {
    drawTimes(1);
    key.replaceChildren(colourBar(`${state.field}${body.choices(state.field).length > 1 ? `, ${state.choice}` : ""}`,
      body.field(state.field).unit, { ...body.map(state.field, state.choice), ...state.limits }));
  };
  const change = (values) => { Object.assign(state, values); readout.textContent = ""; draw(); };

  const panel = element("div", { class: "panel", role: "group", "aria-label": "Controls of the view" },
    fieldControls(body, state, change), sampleControls(body, state, change, drawTimes), deformationControls(body, state, change),
    cutControls(body, change, (axis) => picture?.scene.looksAlong(axis)), viewControls(body, change, () => picture));
  const node = section("body", body.title,
    element("div", { class: "viewer" },
      element("figure", { class: "stage" }, element("div", { class: "frame" }, view, readout), key,
        body.note ? element("p", { class: "note", id: "mesh-note", text: body.note }) : null),
      panel));

  const start = () => {
    if (!canDraw()) {
      view.append(element("p", { class: "note", text: "This browser offers no WebGL 2, which the view in three dimensions needs." }));
      draw();
      return;
    }
    picture = new Picture(body, view, true);
    draw();
    picture.scene.view("oblique");
    onTheme(() => { picture.scene.setLineColours(colourOf("--ink"), colourOf("--muted")); picture.scene.render(); });
    triad(view, picture.scene);
    listen(view, picture, (hit) => {
      const place = hit && hit.place.map((value) => quantity(value, body.unit, 4)).join(", ");
      readout.textContent = hit ? `${state.choice} = ${quantity(hit.value, body.field(state.field).unit)} at (${place})` : "";
    });
  };
  return { node, start, body };
}

function fieldControls(body, state, change) {
  const options = (choices) => choices.map((choice) => element("option", { value: choice, text: choice }));
  const field = select("Field", body.fieldNames().map((name) => [name, name]), { id: "field" });
  const component = select("Component", [], { id: "component" });
  component.list.replaceChildren(...options(body.choices(state.field)));
  field.list.value = state.field;
  component.row.hidden = body.choices(state.field).length < 2;

  const from = element("input", { type: "number", step: "any", id: "range-min", "aria-label": "Lower end of the colour range" });
  const to = element("input", { type: "number", step: "any", id: "range-max", "aria-label": "Upper end of the colour range" });
  const unit = element("span", { class: "unit" });
  const reset = element("button", { type: "button", text: "auto", on: { click: () => { change({ limits: null }); show(); } } });
  const limits = element("div", { class: "control", role: "group", "aria-label": "Colour range" },
    element("span", {}, "Range", unit), element("div", { class: "inline" }, from, "…", to, reset));
  let factor = 1;
  const show = () => {
    const map = body.map(state.field, state.choice);
    limits.hidden = Boolean(map.categories);
    if (map.categories) return;
    const shown = prefixed(Math.max(Math.abs(map.min), Math.abs(map.max)), body.field(state.field).unit);
    factor = shown.factor;
    unit.textContent = labelled("", shown.unit);
    from.value = Number(((state.limits ?? map).min / factor).toPrecision(4));
    to.value = Number(((state.limits ?? map).max / factor).toPrecision(4));
  };
  const setLimits = () => {
    const [min, max] = [from.valueAsNumber * factor, to.valueAsNumber * factor];
    if (min < max) change({ limits: { min, max } });
  };
  for (const input of [from, to]) input.addEventListener("change", setLimits);
  field.list.addEventListener("change", () => {
    const choices = body.choices(field.list.value);
    component.list.replaceChildren(...options(choices));
    component.row.hidden = choices.length < 2;
    change({ field: field.list.value, choice: choices[0], limits: null });
    show();
  });
  component.list.addEventListener("change", () => { change({ choice: component.list.value, limits: null }); show(); });
  show();
  return element("fieldset", {}, element("legend", { text: "Colour" }), field.row, component.row, limits);
}

function sampleControls(body, state, change, drawTimes) {
  if (body.samples.length < 2 && !body.swings) return null;
  const name = element("output", { class: "value", for: "sample", text: body.sampleName(state.sample) });
  const slider = element("input", { type: "range", id: "sample", min: 0, max: body.samples.length - 1, step: 1, value: state.sample });
  const show = (sample) => {
    slider.value = sample;
    name.textContent = body.sampleName(sample);
    slider.setAttribute("aria-valuetext", body.sampleName(sample));
    change({ sample });
  };
  const play = body.swings ? swing(drawTimes) : playButton(body, state, show);
  slider.addEventListener("input", () => show(slider.valueAsNumber));
  const kind = body.swings ? "Mode" : "Sample";
  return element("fieldset", {}, element("legend", { text: kind }),
    element("div", { class: "inline" }, play, element("label", { class: "wide" }, element("span", { class: "hidden", text: kind }), slider), name));
}

function playButton(body, state, show) {
  let timer = null;
  const play = element("button", { type: "button", text: "▶", "aria-label": "Play the samples", on: { click: () => {
    if (timer) { clearInterval(timer); timer = null; }
    else timer = setInterval(() => show((state.sample + 1) % body.samples.length), PLAY_INTERVAL);
    play.textContent = timer ? "❚❚" : "▶";
    play.setAttribute("aria-label", timer ? "Stop" : "Play the samples");
  } } });
  return play;
}

function deformationControls(body, state, change) {
  if (!body.hasDisplacement()) return null;
  const start = state.scale;
  const slider = element("input", { type: "range", id: "scale", min: 0, max: 3 * start, step: start / 50, value: start });
  const box = element("input", { type: "number", id: "scale-number", min: 0, step: "any", value: start, "aria-label": "Deformation scale as a number" });
  const show = (scale) => {
    slider.value = scale;
    box.value = Number(scale.toPrecision(4));
    change({ scale });
  };
  slider.addEventListener("input", () => show(slider.valueAsNumber));
  box.addEventListener("change", () => { if (box.valueAsNumber >= 0) show(box.valueAsNumber); });
  const button = (text, scale, title) => element("button", { type: "button", text, title, on: { click: () => show(scale) } });
  const outline = element("input", { type: "checkbox", id: "outline", checked: true, title: "Edges of the undeformed body" });
  outline.addEventListener("change", () => change({ outline: outline.checked }));
  // A shape has no size of its own, so its true scale means nothing.
  const truth = body.swings ? null : button("true", 1, "True scale");
  return element("fieldset", {}, element("legend", { text: body.swings ? "Largest displacement [m]" : "Deformation, times" }),
    element("div", { class: "inline" }, element("label", { class: "wide" }, element("span", { class: "hidden", text: "Deformation scale" }), slider), box),
    element("div", { class: "inline" }, button("none", 0, "Undeformed"), truth, button("auto", start, "Start value"),
      element("label", { class: "check" }, outline, "outline")));
}

function cutControls(body, change, looksAlong) {
  const axis = select("Plane", [["", "none"], ...AXES.map((name) => [name, `across ${name}`])], { id: "cut" });
  const slider = element("input", { type: "range", id: "cut-position", min: 0, max: CUT_STEPS, step: 1, value: CUT_STEPS / 2 });
  const value = element("output", { class: "value", for: "cut-position" });
  const flip = element("input", { type: "checkbox", id: "cut-flip" });
  const position = element("div", { hidden: true },
    element("div", { class: "inline" }, element("label", { class: "wide" }, element("span", { class: "hidden", text: "Position of the cut" }), slider), value),
    element("label", { class: "check" }, flip, "keep the upper side"));
  const { lattice } = body.mesh;
  const show = () => {
    const across = AXES.indexOf(axis.list.value);
    position.hidden = across < 0;
    if (across < 0) return change({ cut: null });
    const [min, max] = [body.bounds.min[across], body.bounds.max[across]];
    let at = min + ((max - min) * slider.valueAsNumber) / CUT_STEPS;
    if (lattice) at = lattice.origin[across] + lattice.spacing * layersBelow(lattice, across, at);
    value.textContent = `${axis.list.value} = ${quantity(Math.abs(at) < 1e-12 * (max - min) ? 0 : at, body.unit, 4)}`;
    change({ cut: { axis: across, position: at, flip: flip.checked } });
  };
  // A new cut takes away the side the reader is on, or the bared face would be hidden.
  axis.list.addEventListener("input", () => { flip.checked = looksAlong(AXES.indexOf(axis.list.value)) > 0; });
  for (const control of [axis.list, slider, flip]) control.addEventListener("input", show);
  return element("fieldset", {}, element("legend", { text: "Cut" }), axis.row, position);
}

function viewControls(body, change, picture) {
  const look = (name) => () => { picture()?.scene.view(name); picture()?.scene.render(); };
  const save = () => picture() && element("a", { href: picture().scene.capture(), download: "body.png" }).click();
  const button = (text, click, title) => element("button", { type: "button", text, title, on: { click } });
  const lines = select("Lines", [["edges", "edges of the body"], ["cells", "all cells"], ["none", "none"]], { id: "lines" });
  lines.row.hidden = !body.linesPossible || body.smooth;
  const surface = select("Surface", [["true", "as it is"], ["cells", "cells"]], { id: "surface" });
  surface.row.hidden = body.surfaces.length < 2;
  surface.list.addEventListener("change", () => change({ surface: surface.list.value }));
  lines.list.addEventListener("change", () => change({ lines: lines.list.value }));
  return element("fieldset", {}, element("legend", { text: "View" }), surface.row, lines.row,
    element("div", { class: "inline" }, ...["x", "y", "z", "oblique"].map((name) => button(name, look(name), `Look along ${name}`)),
      button("save PNG", save)),
    element("p", { class: "hint", text: "Drag to turn, shift and drag to move, click a spot for its value. The wheel zooms once the picture has been clicked." }));
}

// Keyboard, wheel and click on the picture, and its size.
function listen(view, picture, onProbe) {
  const { scene } = picture;
  const keys = { ArrowLeft: () => scene.rotate(-TURN, 0), ArrowRight: () => scene.rotate(TURN, 0), ArrowUp: () => scene.rotate(0, TURN),
    ArrowDown: () => scene.rotate(0, -TURN), "+": () => scene.zoom(1.15), "-": () => scene.zoom(1 / 1.15), 0: () => scene.view("oblique") };
  view.addEventListener("keydown", (event) => {
    if (!(event.key in keys) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
    scene.render();
  });
  // Until the picture has the focus the wheel belongs to the page.
  view.addEventListener("wheel", (event) => { if (document.activeElement !== view) event.stopImmediatePropagation(); }, { capture: true });
  let pressed = null;
  view.addEventListener("pointerdown", (event) => { view.focus({ preventScroll: true }); pressed = [event.clientX, event.clientY]; });
  view.addEventListener("pointerup", (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 3) return;
    const { left, top } = view.getBoundingClientRect();
    onProbe(picture.probe(event.clientX - left, event.clientY - top));
  });
  new ResizeObserver(() => { scene.resize(); scene.render(); }).observe(view);
}
