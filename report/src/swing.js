// Shapes of vibration swing: displacements go to and fro like a cosine, slowly enough to follow whatever the frequency.
import { element } from "./dom.js";

const PERIOD = 1600;  // ms

/** A button that starts and stops the swing. `draw(factor)` shows the shape with its displacements times -1 … 1. */
export function swing(draw) {
  let frame = null;
  const button = element("button", { type: "button" });
  const label = () => {
    button.textContent = frame ? "❚❚" : "▶";
    button.setAttribute("aria-label", frame ? "Stop" : "Let it swing");
  };
  button.addEventListener("click", () => {
    if (frame) {
      cancelAnimationFrame(frame);
      frame = null;
      draw(1);
    } else {
      const start = performance.now();
      const next = (now) => {
        draw(Math.cos((2 * Math.PI * (now - start)) / PERIOD));
        frame = requestAnimationFrame(next);
      };
      frame = requestAnimationFrame(next);
    }
    label();
  });
  label();
  return button;
}
