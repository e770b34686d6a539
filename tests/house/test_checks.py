"""The checks of scripts/ accept a sound tree and name file, line and rule of a broken one."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
from check_includes import ARROWS, PAGE  # noqa: E402


def run(script, files):
    """Exit code and output of a check on a tree with these files (path -> text)."""
    with tempfile.TemporaryDirectory() as folder:
        for path, text in files.items():
            file = Path(folder, path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        result = subprocess.run([sys.executable, SCRIPTS / script, folder], capture_output=True, text=True)
        return result.returncode, result.stdout


DRAWING = "```\n" + " - ".join(ARROWS) + "\n```\n"
TABLE = "".join(f"| {room} | {', '.join(lower) or 'nothing'} |\n" for room, lower in ARROWS.items())

SOUND = {
    PAGE: DRAWING + "| room | stands on |\n|---|---|\n" + TABLE,
    "include/koshi/error.h": "#include <string>\n",
    "include/koshi/lattice.h": '#include "koshi/error.h"\n',
    "src/base/communicator.cpp": '#include <mpi.h>\n#include "koshi/error.h"\n',
    "src/lattice/box.h": '#include "koshi/lattice.h"\n',
    "src/model/model.h": '#include "lattice/box.h"\n',
    "src/mechanics/force.h": '#include "model/model.h"\n',
    "src/dynamics/step.cpp": '#include "mechanics/force.h"\n#include "lattice/box.h"\n',
    "src/statics/solve.h": "#include <petscksp.h>\n",
    "src/io/checkpoint.cpp": "#include <hdf5.h>\n#include <mpi.h>\n#include <vtkNew.h>\n#include <toml++/toml.h>\n",
    "src/driver/run.cpp": '#include "statics/solve.h"\n',
    "apps/koshi/options.h": "#include <CLI/CLI.hpp>\n",
    "apps/koshi/main.cpp": '#include "options.h"\n',
}

# (file, text, line, part of the message)
BROKEN = [
    ("src/lattice/box.h", '#include "koshi/lattice.h"\n#include "model/model.h"\n', 2, "lattice must not include model"),
    ("src/statics/solve.h", '#include "dynamics/step.h"\n', 1, "statics must not include dynamics"),
    ("src/io/checkpoint.cpp", '#include "mechanics/force.h"\n', 1, "io must not include mechanics"),
    ("src/base/clock.cpp", '#include "koshi/lattice.h"\n', 1, "base must not include lattice"),
    ("src/mechanics/force.h", "\n\n#include <mpi.h>\n", 3, "MPI may be included only in"),
    ("src/io/vti.cpp", "#include <mpi.h>\n", 1, "MPI may be included only in"),
    ("src/driver/run.cpp", "#include <petscvec.h>\n", 1, "PETSc may be included only in"),
    ("src/driver/run.cpp", "# include <vtkNew.h>\n", 1, "VTK may be included only in"),
    ("src/model/model.h", "#include <toml++/toml.h>\n", 1, "toml++ may be included only in"),
    ("src/driver/run.cpp", "#include <H5Cpp.h>\n", 1, "HDF5 may be included only in"),
    ("src/model/model.h", "#include <udunits2.h>\n", 1, "UDUNITS may be included only in"),
    ("src/driver/run.cpp", "#include <CLI/CLI.hpp>\n", 1, "CLI11 may be included only in"),
    ("include/koshi/error.h", "#include <fmt/format.h>\n", 1, "public headers include only the standard library"),
    ("include/koshi/lattice.h", '#include "lattice/box.h"\n', 1, "public headers must not include private ones"),
    ("include/koshi/error.h", '#include "koshi/lattice.h"\n', 1, "base must not include lattice"),
    ("include/koshi/surprise.h", "", 1, "no room"),
    ("src/cellar/wine.h", "", 1, "no room"),
    ("src/lattice/box.h", '#include "box_detail.h"\n', 1, "neither a public header"),
]


class Includes(unittest.TestCase):
    def test_sound_tree_passes(self):
        code, output = run("check_includes.py", SOUND)
        self.assertEqual((code, output), (0, "check_includes: 17 includes, 0 broken\n"))

    def test_each_broken_include_is_named(self):
        extra = {"src/dynamics/step.h": "", "src/lattice/box_detail.h": ""}
        for file, text, line, message in BROKEN:
            with self.subTest(file=file, text=text):
                code, output = run("check_includes.py", SOUND | extra | {file: text})
                self.assertEqual(code, 1)
                self.assertRegex(output, rf"^{file}:{line}: .*{re.escape(message)}")
                self.assertIn(" 1 broken", output)

    def test_page_must_show_the_arrows(self):
        for page, message in [
            (SOUND[PAGE].replace("| base | nothing |\n", ""), "needs the row | base | nothing |"),
            (SOUND[PAGE].replace("| io | model |", "| io | mechanics |"), "needs the row | io | model |"),
            (SOUND[PAGE] + "| cellar | base |\n", "the table has a room cellar"),
            (SOUND[PAGE].replace("lattice -", "-", 1), "the drawing lacks the room lattice"),
        ]:
            with self.subTest(message=message):
                code, output = run("check_includes.py", SOUND | {PAGE: page})
                self.assertEqual(code, 1)
                self.assertIn(f"{PAGE}:1: ", output)
                self.assertIn(message, output)
                self.assertIn(" 1 broken", output)

    def test_empty_tree_fails(self):
        self.assertEqual(run("check_includes.py", {})[0], 1)


class Size(unittest.TestCase):
    def test_limit(self):
        for lines, code, message in [(400, 0, ""), (401, 0, ":401: longer"), (450, 0, ""), (451, 1, ":451: error")]:
            with self.subTest(lines=lines):
                result = run("check_size.py", {"src/base/long.cpp": "\n" * lines})
                self.assertEqual(result[0], code)
                self.assertIn(message, result[1])

    def test_empty_tree_fails(self):
        self.assertEqual(run("check_size.py", {})[0], 1)


class Packages(unittest.TestCase):
    def test_every_package_has_a_reason_and_stands_in_a_group(self):
        groups = {}
        for number, line in enumerate((SCRIPTS.parent / "packages.txt").read_text().splitlines(), 1):
            if group := re.match(r"# Group (\w+): ", line):
                names = groups.setdefault(group[1], [])
            elif line and not line.startswith("#"):
                self.assertRegex(line, r"^[a-z0-9.+-]+ +# \S", f"packages.txt:{number}")
                names.append(line.split()[0])
        self.assertEqual(list(groups), ["run", "page", "test", "docs"])
        everything = [name for names in groups.values() for name in names]
        self.assertEqual(len(everything), len(set(everything)))
        self.assertGreater(len(everything), 40)
        # What only tests and documentation need stays out of what the demo installs.
        for heavy in ("chromium", "doxygen", "mkdocs", "python3-matplotlib", "clang-14"):
            self.assertNotIn(heavy, groups["run"] + groups["page"])

    def test_setup_knows_its_groups(self):
        result = subprocess.run([SCRIPTS / "setup.sh", "cellar"], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (2, "setup: packages.txt has no group cellar\n"))


if __name__ == "__main__":
    unittest.main()
