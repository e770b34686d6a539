// Pictures of the body side by side, each with its own colours: drawn once, off the page.
import { colourBar } from "./colour_bar.js";
import { element, subscripted } from "./dom.js";
import { Picture } from "./picture.js";
import { canDraw } from "./scene.js";
import { colourOf } from "./theme.js";

const WIDTH = 720;
const HEIGHT = 560;

/** {node, start}: a card with a picture for each panel of the figure. */
export function figure({ title, note, view, panels }, body) {
  const scaleOf = ({ scale = body.startScale() }) => scale;
  const scales = [...new Set(panels.map(scaleOf))];
  const places = panels.map(({ caption }) => ({ image: element("img", { alt: caption, width: WIDTH, height: HEIGHT }), key: element("div", {}), caption }));
  const node = element("figure", { class: "card wide" }, element("h3", {}, ...subscripted(title)),
    element("div", { class: "panels" }, ...places.map(({ image, key, caption }) =>
      element("div", {}, image, key, element("p", { class: "caption" }, ...subscripted(caption))))),
    element("p", { class: "note" }, ...subscripted([`Displacements drawn ${scales.join(", ")} times as large.`, note].filter(Boolean).join(" "))));

  const start = () => {
    if (!canDraw()) return;
    const stage = element("div", { class: "off-page", style: `width:${WIDTH}px;height:${HEIGHT}px` });
    document.body.append(stage);
    const picture = new Picture(body, stage, false);
    picture.scene.setLineColours(colourOf("--figure-line"), colourOf("--figure-line"));
    panels.forEach((panel, i) => {
      const { field, component, sample = 0 } = panel;
      const state = { surface: body.surfaces[0], sample, field, choice: component, limits: null, scale: scaleOf(panel), cut: null, lines: "edges", outline: true };
      picture.draw(state);
      picture.scene.view(view ?? "oblique");
      places[i].image.src = picture.scene.capture();
      places[i].key.replaceChildren(colourBar(`${field}, ${component}`, body.field(field, sample).unit, body.map(field, component)));
    });
    picture.scene.delete();
    stage.remove();
  };
  return { node, start };
}
