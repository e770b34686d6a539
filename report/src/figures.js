// Pictures of the body side by side, each with its own colours: drawn once, off the page.
import { colourBar } from "./colour_bar.js";
import { element } from "./dom.js";
import { Picture } from "./picture.js";
import { canDraw } from "./scene.js";
import { colourOf } from "./theme.js";

const WIDTH = 720;
const HEIGHT = 560;

/** {node, start}: a card with a picture for each panel of the figure. */
export function figure({ title, note, view, panels }, body) {
  const places = panels.map(({ caption }) => ({ image: element("img", { alt: caption, width: WIDTH, height: HEIGHT }), key: element("div", {}), caption }));
  const node = element("figure", { class: "card wide" }, element("h3", { text: title }),
    element("div", { class: "panels" }, ...places.map(({ image, key, caption }) =>
      element("div", {}, image, key, element("p", { class: "caption", text: caption })))),
    note ? element("p", { class: "note", text: note }) : null);

  const start = () => {
    if (!canDraw()) return;
    const stage = element("div", { class: "off-page", style: `width:${WIDTH}px;height:${HEIGHT}px` });
    document.body.append(stage);
    const picture = new Picture(body, stage, false);
    picture.scene.setLineColours(colourOf("--figure-line"), colourOf("--figure-line"));
    panels.forEach(({ field, component, sample = 0, scale = body.startScale() }, i) => {
      const state = { sample, field, choice: component, limits: null, scale, cut: null, lines: "edges", outline: true };
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
