#!/usr/bin/python3
"""Rewrites the figures of docs/validation: runs every study of scripts/ and the paper's two analyses.

    scripts/validation.py [--koshi build/release/koshi] [STUDY...]     such as "paper" or "convergence"

A study NAME_study.py writes its page itself, or prints tables; those take the place of the tables with the same head in
docs/validation/NAME.md. Costs per step need an idle machine. All studies together take about a quarter of an hour.
"""
import argparse
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs/validation"
TABLE = re.compile(r"^(\|.*\|)\n(\|[-|: ]+\|)\n((?:\|.*\|\n)+)", re.MULTILINE)

PAPER_HEAD = """# The paper's values

Made by `koshi paper` through `scripts/validation.py`: stepping in time, as the paper does. What the paper leaves open, and
how it is read here: [theory, chapter 5](../theory/05_paper_analyses.md). The command fails when a value leaves its
tolerance. Tests hold the springs (`Calibrate.UniaxialSpringsOfThePaper`, `Calibrate.CantileverSpringsOfThePaper`) and the
cantilever at rest (`Section9.PlainSpringsOfThePaper`).

"""


def splice(page, printed):
    """Puts printed tables in the place of those with the same head."""
    text = page.read_text(encoding="utf-8")
    tables = list(TABLE.finditer(printed))
    if not tables:
        raise SystemExit(f"validation: the study of {page.name} printed no table")
    for table in tables:
        head = table.group(1)
        places = [place for place in TABLE.finditer(text) if place.group(1) == head]
        if len(places) != 1:
            raise SystemExit(f"validation: {page.name} has {len(places)} tables with the head {head}")
        text = text[: places[0].start()] + table.group(0) + text[places[0].end() :]
    page.write_text(text, encoding="utf-8")


def paper(koshi):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([koshi, "paper", "--quiet", "--out", f"{folder}/paper"], check=True, stdout=subprocess.DEVNULL)
        text = pathlib.Path(folder, "paper/paper.md").read_text(encoding="utf-8")
    (PAGES / "paper.md").write_text(PAPER_HEAD + text.partition("\n\n")[2], encoding="utf-8")


def study(script, koshi):
    printed = subprocess.run([script, "--koshi", koshi], check=True, stdout=subprocess.PIPE, text=True).stdout
    if printed.strip():
        splice(PAGES / f"{script.stem.removesuffix('_study')}.md", printed)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--koshi", default=ROOT / "build/release/koshi", type=pathlib.Path)
    arguments.add_argument("studies", nargs="*", metavar="STUDY")
    options = arguments.parse_args()
    koshi = options.koshi.resolve()
    studies = {s.stem.removesuffix("_study"): s for s in sorted((ROOT / "scripts").glob("*_study.py"))}
    for name in options.studies or ["paper", *studies]:
        print(f"validation: {name}", flush=True)
        if name == "paper":
            paper(koshi)
        elif name in studies:
            study(studies[name], koshi)
        else:
            raise SystemExit(f'validation: no study "{name}"; there are paper, {", ".join(studies)}')


if __name__ == "__main__":
    main()
