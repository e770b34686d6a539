// The small cross of axes in the picture's corner.
const SVG = "http://www.w3.org/2000/svg";
const SIZE = 72;
const ARM = 24;
const COLOURS = ["var(--axis-x)", "var(--axis-y)", "var(--axis-z)"];

/** Draws the directions of x, y and z over `view` and keeps them in step with the scene's camera. */
export function triad(view, scene) {
  const picture = document.createElementNS(SVG, "svg");
  picture.setAttribute("viewBox", `${-SIZE / 2} ${-SIZE / 2} ${SIZE} ${SIZE}`);
  picture.setAttribute("class", "triad");
  picture.setAttribute("aria-hidden", "true");
  const arms = ["x", "y", "z"].map((name, axis) => {
    const line = document.createElementNS(SVG, "line");
    const text = document.createElementNS(SVG, "text");
    line.setAttribute("stroke", COLOURS[axis]);
    text.setAttribute("fill", COLOURS[axis]);
    text.textContent = name;
    picture.append(line, text);
    return { line, text };
  });
  const update = () => scene.axes().forEach(([right, up], axis) => {
    arms[axis].line.setAttribute("x2", ARM * right);
    arms[axis].line.setAttribute("y2", -ARM * up);
    arms[axis].text.setAttribute("x", (ARM + 8) * right);
    arms[axis].text.setAttribute("y", -(ARM + 8) * up);
  });
  scene.camera.onModified(update);
  update();
  view.append(picture);
}
