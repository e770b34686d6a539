"""What the pictures of the examples are drawn with: runs, views of the report page, figures of one size."""
import io
import subprocess
import sys

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
from PIL import Image

from gallery import EXAMPLES, ROOT

WIDTH, HEIGHT = 1200, 750
LIMIT = 195_000  # bytes
# Windows in which the stage of the report's view has the shape of a picture, and of half a picture.
WHOLE, HALF = ["--width", "1500", "--height", "704"], ["--width", "1000", "--height", "940"]
THEORY = {"color": "black", "linestyle": (0, (5, 4)), "linewidth": 1.4}
BLUE, RED, GREEN = "#1f5f99", "#b3403a", "#3d8f5f"

plt.rcParams.update({"font.size": 15, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
                     "grid.color": "#e3e7ec", "lines.linewidth": 2.2, "legend.frameon": False, "font.family": "DejaVu Sans"})


class Maker:
    def __init__(self, build, directory):
        self.build, self.directory = build, directory
        sys.path.insert(0, str(build / "python"))
        self.koshi = __import__("koshi")

    def simulation(self, example, *overrides):
        return self.koshi.Simulation(EXAMPLES / example / "case.toml", overrides=overrides)

    def run(self, example, *overrides):
        """Output directory of a run; one for each example."""
        out = self.directory / example
        command = [self.build / "koshi", "run", EXAMPLES / example / "case.toml", "--out", out, "--quiet"]
        subprocess.run(command + [part for o in overrides for part in ("--set", o)], check=True)
        return out

    def bodies(self, example, *views, look="oblique", keys=(), overrides=(), page=HALF):
        """The report's views of a run, one for each list of controls, seen along an axis, with some keys pressed."""
        out = self.run(example, *overrides)
        subprocess.run([self.build / "koshi", "report", out], check=True, stdout=subprocess.DEVNULL)
        return [self.view(out, controls, look, keys, page) for controls in views]

    def body(self, example, controls, **options):
        return fitted(*self.bodies(example, controls, page=WHOLE, **options))

    @staticmethod
    def view(out, controls, look, keys, page):
        options = [part for c in controls for part in ("--select", c)] + ["--look", look]
        options += [part for key in keys for part in ("--press", key)]
        subprocess.run(["node", ROOT / "report/scripts/screenshot.mjs", out / "report.html", out / "body.png", "--only", ".stage",
                        *page, *options], check=True)
        return Image.open(out / "body.png").convert("RGB")


def fitted(image, width=WIDTH, height=HEIGHT):
    """Scaled to the size, on white."""
    factor = min(width / image.width, height / image.height)
    image = image.resize((round(image.width * factor), round(image.height * factor)), Image.Resampling.LANCZOS)
    page = Image.new("RGB", (width, height), "white")
    page.paste(image, ((width - image.width) // 2, (height - image.height) // 2))
    return page


def side_by_side(left, right):
    page = Image.new("RGB", (WIDTH, HEIGHT), "white")
    for x, image in ((0, left), (WIDTH // 2, right)):
        page.paste(fitted(image, WIDTH // 2 - 8, HEIGHT), (x + 4, 0))
    return page


def figure(columns=1, width=WIDTH, **options):
    return plt.subplots(1, columns, figsize=(width / 100, HEIGHT / 100), dpi=100, layout="constrained", **options)


def drawn(fig):
    buffer = io.BytesIO()
    fig.savefig(buffer, dpi=100)
    plt.close(fig)
    return Image.open(buffer).convert("RGB")
