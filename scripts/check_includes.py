#!/usr/bin/python3
"""Checks who includes whom (docs/development/architecture.md).

usage: check_includes.py [ROOT]

Prints `file:line: rule` for each include that breaks a rule, and where the page's drawing and table show other rooms or
arrows than ARROWS; exits 1 if there is any of it.
"""

import re
import sys
from pathlib import Path

PAGE = "docs/development/architecture.md"

# Room -> rooms it stands on. Includes are allowed downwards, through any number of arrows. The page draws them.
ARROWS = {
    "base": [],
    "lattice": ["base"],
    "material": ["lattice"],
    "model": ["material"],
    "mechanics": ["model"],
    "calibration": ["mechanics"],
    "failure": ["mechanics"],
    "dynamics": ["failure"],
    "statics": ["mechanics"],
    "io": ["model"],
    "report": ["calibration", "io"],
    "modes": ["statics"],
    "homogenize": ["statics"],
    "driver": ["dynamics", "modes", "homogenize", "report"],
    "study": ["driver"],
    "apps": ["study"],
    "python": ["driver"],
}

# Public header -> the room it belongs to. A new file of include/koshi is entered here.
PUBLIC = {
    "communicator.h": "base",
    "error.h": "base",
    "vector3.h": "base",
    "lattice.h": "lattice",
    "grid.h": "lattice",
    "field.h": "lattice",
    "scan.h": "model",
    "springs.h": "material",
    "calibration.h": "material",
    "directional.h": "material",
    "fracture.h": "material",
    "scatter.h": "material",
    "spring_lattice.h": "model",
    "definition.h": "model",
    "model.h": "model",
    "state.h": "model",
    "dynamics.h": "dynamics",
    "statics.h": "statics",
    "modes.h": "modes",
    "homogenize.h": "homogenize",
    "input.h": "io",
    "output.h": "io",
    "run.h": "driver",
}

# Pattern of a library's headers -> (name, where they may be included: path prefixes).
# Checkpoints are written by parallel HDF5, which takes the communicator's MPI handle.
LIBRARIES = {
    r"mpi\.h": ("MPI", ["src/base/communicator.", "src/lattice/halo.", "src/io/checkpoint"]),
    r"petsc.*": ("PETSc", ["src/statics/"]),
    r"vtk.*": ("VTK", ["src/io/"]),
    r"(hdf5|H5).*": ("HDF5", ["src/io/"]),
    r"(zlib|bzlib|expat|tiffio)\.h": ("zlib, bzip2, expat and libtiff", ["src/io/"]),
    r"toml\+\+/.*": ("toml++", ["src/io/"]),
    r"muParser.*": ("muParser", ["src/model/formula."]),
    r"udunits2\.h": ("UDUNITS", ["src/io/"]),
    r"nlohmann/.*": ("JSON", ["src/io/", "src/calibration/", "src/driver/", "src/report/", "src/study/", "apps/"]),
    r"CLI/.*": ("CLI11", ["apps/"]),
    r"pybind11/.*": ("pybind11", ["python/"]),
}

INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')


def below(room):
    """The room itself and every room under it."""
    rooms = {room}
    for lower in ARROWS[room]:
        rooms |= below(lower)
    return rooms


def room_of(path):
    """Room of a file given relative to the root, None for files outside the rooms (tests, bench)."""
    parts = path.parts
    if parts[0] == "src":
        return parts[1]
    if parts[:2] == ("include", "koshi"):
        return PUBLIC.get(parts[2])
    return parts[0] if parts[0] in ARROWS else None


def broken_rule(root, path, bracket, target):
    """The rule that this include breaks, or None."""
    room = room_of(path)

    # Libraries: each has its place.
    for pattern, (library, places) in LIBRARIES.items():
        if re.fullmatch(pattern, target):
            if not any(path.as_posix().startswith(place) for place in places):
                return f"{library} may be included only in {', '.join(places)}"
    if path.parts[0] == "include" and bracket == "<" and re.search(r"[./]", target):
        return "public headers include only the standard library and each other"
    if bracket == "<":
        return None

    # Our own headers: they exist, and they belong to this room or one below.
    file = Path("include" if target.startswith("koshi/") else "src") / target
    beside = path.parent / target
    if not (root / file).is_file():
        if room in ("apps", "python") and (root / beside).is_file():
            return None
        return f'"{target}" is neither a public header "koshi/file.h" nor a private one "room/file.h"'
    if path.parts[0] == "include" and file.parts[0] == "src":
        return "public headers must not include private ones"
    target_room = room_of(file)
    if target_room and target_room not in below(room):
        return f"{room} must not include {target_room} (allowed: {', '.join(sorted(below(room)))})"
    return None


def page_problems(root):
    """Where the page's drawing and table of the rooms differ from ARROWS, as text."""
    page = (root / PAGE).read_text() if (root / PAGE).is_file() else ""
    drawing = re.search(r"```\n(.*?)```", page, re.DOTALL)
    drawn = set(re.findall(r"\w+", drawing[1])) if drawing else set()
    rows = dict(re.findall(r"^\| (\w+) \| ([\w, ]+) \|$", page, re.MULTILINE))
    problems = []
    for room, lower in ARROWS.items():
        wanted = ", ".join(lower) or "nothing"
        if rows.get(room) != wanted:
            problems.append(f"{PAGE}:1: the table of rooms needs the row | {room} | {wanted} |")
        if room not in drawn:
            problems.append(f"{PAGE}:1: the drawing lacks the room {room}")
    problems += [f"{PAGE}:1: the table has a room {room}, ARROWS has not" for room in rows.keys() - ARROWS.keys() - {"room"}]
    return problems


def check(root):
    """All violations below `root` as text, and the number of includes looked at."""
    problems, count = page_problems(root), 0
    files = [f for top in ("include", "src", "apps", "python") for f in sorted((root / top).rglob("*.*"))]
    for file in files:
        if file.suffix not in (".h", ".cpp"):
            continue
        path = file.relative_to(root)
        room = room_of(path)
        if room not in ARROWS:
            problems.append(f"{path}:1: no room; enter it in scripts/check_includes.py")
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if match := INCLUDE.match(line):
                count += 1
                if rule := broken_rule(root, path, *match.groups()):
                    problems.append(f"{path}:{number}: {rule}")
    return problems, count


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    problems, count = check(root)
    print("\n".join(problems + [f"check_includes: {count} includes, {len(problems)} broken"]))
    return 1 if problems or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
