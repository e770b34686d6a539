#!/usr/bin/python3
"""The numbers of the examples: checks them, and writes them into the READMEs.

    scripts/gallery.py check  [EXAMPLE...] [--koshi build/release/koshi]   run, compare with expected.py and README.md
    scripts/gallery.py tables [EXAMPLE...] [--koshi build/release/koshi]   run, and write the table of README.md anew
    scripts/gallery.py files                                               every example is whole and has its page

`expected.py` of an example yields a row for each number: quantity [unit], reference value, Koshi's value, tolerance. The
reference is computed there from its formula; the README shows all four.
"""
import argparse
import csv
import json
import math
import pathlib
import re
import runpy
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXAMPLES = ROOT / "examples"
HEAD = "| quantity | reference | Koshi | within |\n|---|---|---|---|\n"
TABLE = re.compile(re.escape(HEAD) + r"(?:\|.*\|\n)*")


class Results:
    """Output directory of a run."""

    def __init__(self, directory):
        self._directory = directory
        self.summary = json.loads((directory / "summary.json").read_text())
        self.modes = self.summary.get("modes", [])
        if self.modes:
            return  # they have no history
        with open(directory / "history.csv", newline="") as file:
            head, *rows = csv.reader(file)
        self._history = {name: [float(row[i]) for row in rows] for i, name in enumerate(head)}

    def probe(self, path):
        """Value at the end: "tip.displacement.x"."""
        name, quantity, component = path.split(".")
        names = ("xx", "yy", "zz", "yz", "xz", "xy") if len(component) == 2 else ("x", "y", "z")
        return self.summary["probes"][name][quantity][names.index(component)]

    @property
    def time(self):
        return self._history["time [s]"]

    def history(self, path):
        """Values over time of a probe, "tip.displacement.x", or of "elastic energy" and the like."""
        return next(values for name, values in self._history.items() if name.rsplit(" [", 1)[0] == path)

    def at(self, path, time):
        """Value at a time [s], by straight lines between the rows."""
        values = self.history(path)
        after = next(i for i, t in enumerate(self.time) if t >= time * (1 - 1e-12))
        before = max(after - 1, 0)
        span = self.time[after] - self.time[before]
        return values[before] + (values[after] - values[before]) * ((time - self.time[before]) / span if span else 1)

    def crack(self):
        """Cells of cracks.vtp: (time, x, y, z) of each, when it cracked through [s] and the centre of its cut [m]."""
        root = xml.etree.ElementTree.parse(self._directory / "cracks.vtp").getroot()
        arrays = {array.get("Name"): array.text.split() for array in root.iter("DataArray")}
        points = [[float(x) for x in arrays["Points"][i:i + 3]] for i in range(0, len(arrays["Points"]), 3)]
        cells, begin = [], 0
        for time, end in zip(arrays["time"], map(int, arrays["offsets"])):
            corners = [points[int(c)] for c in arrays["connectivity"][begin:end]]
            cells.append((float(time), *(sum(axis) / len(corners) for axis in zip(*corners))))
            begin = end
        return cells

    def rises(self, path, level, after=0):
        """Times [s] later than `after` at which the values rise through a level."""
        values, time = self.history(path), self.time
        return [time[i] + (level - values[i]) / (values[i + 1] - values[i]) * (time[i + 1] - time[i])
                for i in range(len(values) - 1) if time[i] > after and values[i] < level <= values[i + 1]]


class Runs:
    """Runs an example's case, once for each set of overrides."""

    def __init__(self, example, koshi, directory):
        self.case, self.koshi, self.directory, self.count = EXAMPLES / example / "case.toml", koshi, directory, 0

    def __call__(self, *overrides):
        return Results(self._run("run", "output.fields=['material']", *overrides))

    def homogenize(self, *overrides):
        """The object of stiffness.json."""
        return json.loads((self._run("homogenize", *overrides) / "stiffness.json").read_text())

    def _run(self, verb, *overrides):
        self.count += 1
        out = self.directory / str(self.count)
        command = [self.koshi, verb, self.case, "--out", out, "--quiet"]
        for override in overrides:
            command += ["--set", override]
        subprocess.run(command, check=True)
        return out


def rows_of(example, koshi):
    with tempfile.TemporaryDirectory() as directory:
        expected = runpy.run_path(str(EXAMPLES / example / "expected.py"))
        return list(expected["values"](Runs(example, koshi, pathlib.Path(directory))))


def text(value):
    return f"{value:.5g}"


def table(rows):
    return HEAD + "".join(f"| {quantity} | {text(reference)} | {text(found)} | {100 * tolerance:g} % |\n"
                          for quantity, reference, found, tolerance in rows)


def check(example, koshi):
    """Messages about what is wrong, and the number of values compared."""
    rows = rows_of(example, koshi)
    wrong = []
    for quantity, reference, found, tolerance in rows:
        difference = found / reference - 1
        print(f"{example}: {quantity}: {text(found)}, reference {text(reference)}, {100 * difference:+.3f} %")
        if not abs(difference) <= tolerance:
            wrong.append(f"{quantity} is {found:.8g}, {100 * difference:+.3f} % from {reference:.8g}; "
                         f"allowed: {100 * tolerance:g} %")
    written = TABLE.search((EXAMPLES / example / "README.md").read_text())
    lines = written.group().splitlines()[2:] if written else []
    for line, right in zip(lines, table(rows).splitlines()[2:]):
        # Koshi's value may differ in its last digit from one processor to another.
        (*shown, found, within), (*right_shown, right_found, right_within) = (s.split("|")[1:-1] for s in (line, right))
        if [*shown, within] != [*right_shown, right_within] or not math.isclose(float(found), float(right_found), rel_tol=2e-4):
            wrong.append(f"README.md has {line!r}, right is {right!r}; run scripts/gallery.py tables {example}")
    if not rows or len(lines) != len(rows):
        wrong.append(f"README.md shows {len(lines)} numbers, expected.py yields {len(rows)}")
    return wrong, len(rows)


def write_table(example, koshi):
    readme = EXAMPLES / example / "README.md"
    content, count = TABLE.subn(lambda _: table(rows_of(example, koshi)), readme.read_text())
    if count != 1:
        sys.exit(f"{readme}: {count} tables of numbers, there must be one, headed\n{HEAD}")
    readme.write_text(content)


def check_files():
    """Every example has a case, numbers, a page and a picture, and is linked where the examples are listed."""
    wrong, count = [], 0
    index, navigation = (EXAMPLES / "README.md").read_text(), (ROOT / "mkdocs.yml").read_text()
    for example in sorted(path for path in EXAMPLES.iterdir() if path.is_dir()):
        count += 1
        for name in ("case.toml", "README.md", "expected.py", "picture.png"):
            if not (example / name).exists():
                wrong.append(f"examples/{example.name} has no {name}")
        link = f"{example.name}/README.md"
        for listing, title in ((index, "examples/README.md"), (navigation, "mkdocs.yml")):
            if link not in listing:
                wrong.append(f"{title} does not list {link}")
        # A PNG begins with 16 bytes of signature and chunk head, then width and height.
        picture = (example / "picture.png").read_bytes() if (example / "picture.png").exists() else b""
        if picture and (struct.unpack(">II", picture[16:24]) != (1200, 750) or len(picture) > 200_000):
            wrong.append(f"examples/{example.name}/picture.png is not 1200 x 750 in at most 200 kB; "
                         "run scripts/gallery_pictures.py")
    if count < 8:
        wrong.append(f"{count} examples; the gallery has at least eight")
    return wrong, count


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("action", choices=["check", "tables", "files"])
    parser.add_argument("examples", nargs="*", default=sorted(p.parent.name for p in EXAMPLES.glob("*/case.toml")))
    parser.add_argument("--koshi", default=ROOT / "build/release/koshi", type=pathlib.Path)
    arguments = parser.parse_args()
    koshi = arguments.koshi.resolve()
    failed = 0
    if arguments.action == "files":
        wrong, count = check_files()
        print("\n".join([*(f"error: {message}" for message in wrong), f"{count} examples checked"]))
        return 1 if wrong else 0
    for example in arguments.examples:
        if arguments.action == "tables":
            write_table(example, koshi)
            continue
        wrong, count = check(example, koshi)
        for message in wrong:
            print(f"{example}: error: {message}", file=sys.stderr)
        print(f"{example}: {count} values checked")
        failed += bool(wrong)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
