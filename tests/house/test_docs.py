"""What the documentation shows is what the program does. Usage: test_docs.py PROGRAM [PYTHON_MODULE_DIRECTORY]

A page is read from top to bottom: a block with a title is a file, the commands of a `sh` block run beside it, and a
`text` block right after must match what they print: "..." stands for anything, numbers agree to four digits. Commands
that build or look at something (cmake, ParaView) are left to the reader. TOML without a title is a piece of a case: it
must fit the schema.
"""

import ast
import json
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import jsonschema

ROOT = Path(__file__).parents[2]
PROGRAM = Path(sys.argv[1]).resolve()
MODULE = Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
BLOCK = re.compile(r"^```(\w+)(?: title=\"([^\"]+)\")?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?")
RUN = ("koshi ", "/usr/bin/python3 ", "head ", "tail ", "ls ", "cat ", "for ")
ENVIRONMENT = os.environ | {"PATH": f"{PROGRAM.parent}:{os.environ['PATH']}", "PYTHONPATH": str(MODULE or "")}


def pattern(expected):
    """The text as a regular expression whose groups are its numbers, and the numbers."""
    numbers = []
    parts = []
    for piece in re.split(r"(\.\.\.)", expected.strip()):
        if piece == "...":
            parts.append(r".*?")
            continue
        at = 0
        for number in NUMBER.finditer(piece):
            parts.append(re.escape(piece[at : number.start()]) + f"({NUMBER.pattern})")
            numbers.append(float(number.group()))
            at = number.end()
        parts.append(re.escape(piece[at:]))
    # The width of columns is no matter.
    return re.sub(r"(\\?\s)+", r"\\s+", "".join(parts)), numbers


def compare(page, commands, expected, output):
    expression, numbers = pattern(expected)
    match = re.fullmatch(expression, output.strip(), re.DOTALL)
    assert match, f"{page}: {commands}\nprints\n{output}\ninstead of\n{expected}"
    for shown, printed in zip(numbers, match.groups(), strict=True):
        assert abs(float(printed) - shown) <= 1e-4 * abs(shown), f"{page}: {commands}: {printed} instead of {shown}\n{output}"
    return len(numbers)


def run(line, folder):
    """What a command of a page prints; messages of wrong input stand in the page too."""
    result = subprocess.run(["bash", "-c", line], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True)
    if result.returncode == 0:
        return result.stdout
    assert result.returncode == 2, f"{line}\n{result.stdout}{result.stderr}"
    return result.stdout + result.stderr


def uses_module(line, folder):
    """Whether a command runs a script of the page that needs the Python module."""
    script = re.search(r"python3 (\w+\.py)", line)
    return script and "import koshi" in (folder / script.group(1)).read_text()


def read_page(page, folder, counts):
    blocks = list(BLOCK.finditer(page.read_text(encoding="utf-8")))
    for block, following in zip(blocks, blocks[1:] + [None]):
        language, title, text = block.groups()
        if title:
            (folder / title).write_text(text, encoding="utf-8")
            counts["files"] += 1
        if language != "sh":
            continue
        lines = [line for line in text.replace("\\\n", " ").splitlines() if line.startswith(RUN)]
        if MODULE is None:
            lines = [line for line in lines if not uses_module(line, folder)]
        output = "".join(run(line, folder) for line in lines)
        counts["commands"] += len(lines)
        between = page.read_text(encoding="utf-8")[block.end() : following.start()] if following else " "
        if lines and following and following.group(1) == "text" and not between.strip():
            counts["numbers"] += compare(page.name, lines, following.group(3), output)


def keys(value, path=""):
    """Paths of the values of a summary, the user's names replaced."""
    if not isinstance(value, dict) or not value:
        return {path}
    names = {"springs": "<material>", "probes": "<name>", "probes.<name>": "<quantity>"}
    return set().union(*(keys(v, f"{path}.{names.get(path, k)}".lstrip(".")) for k, v in value.items()))


def compare_keys(folder):
    """The page of the output directory lists the keys that summaries have, and no others."""
    page = (ROOT / "docs/formats/output.md").read_text(encoding="utf-8")
    section = page[page.index("## summary.json\n") :].split("\n## ")[0]
    listed = set(re.findall(r"`([\w.<>]+)`", section)) - {"null", "face", "body"}
    there = set().union(*(keys(json.loads((folder / f"out/{run}/summary.json").read_text())) for run in ("paper", "exact", "smooth")))
    there = {key for key in there if not re.search(r"\.(face|body)\.k[nt]$", key)}
    assert listed == there, listed ^ there


def compare_mode_keys(folder):
    """The same for searches for modes: their section lists what they have besides title, body, springs and performance."""
    run("koshi run exact.toml --out modes --quiet --set 'analysis={type=\"modes\",count=1}' --set 'load=[]' --set 'boundary=[]'", folder)
    summary = json.loads((folder / "modes/summary.json").read_text(encoding="utf-8"))
    page = (ROOT / "docs/formats/output.md").read_text(encoding="utf-8")
    section = page[page.index("## summary.json of modes\n") :].split("\n## ")[0]
    row = next(line for line in section.splitlines() if line.startswith("| `modes`"))
    assert set(re.findall(r"`(\w+)`", row)) - {"modes"} == set(summary["modes"][0]), row
    there = {key for key in keys(summary) if key.startswith(("analysis", "performance"))}
    # The performance of all runs stands in the first table of summary.json.
    every = page[page.index("## summary.json\n") :].split("\nStatic analyses")[0]
    listed = set(re.findall(r"`(analysis[\w.]+|performance[\w.]+)`", section)) | set(re.findall(r"`(performance\.\w+)`", every))
    assert listed == there, listed ^ there
    assert set(summary) == {"title", "version", "body", "springs", "performance", "analysis", "modes"}, set(summary)


def test_pages():
    counts = {"files": 0, "commands": 0, "numbers": 0}
    tutorial = [ROOT / "docs/tutorial" / f"{name}.md" for name in ("cantilever", "exact-springs", "block", "python")]
    guide = [[page] for page in sorted((ROOT / "docs/guide").glob("*.md"))]
    for pages in [[ROOT / "docs/start.md"], tutorial, *guide]:
        with tempfile.TemporaryDirectory() as folder:
            for page in pages:
                read_page(page, Path(folder), counts)
            if pages is tutorial:
                compare_keys(Path(folder))
                compare_mode_keys(Path(folder))
    print(counts)
    assert counts["files"] >= 7 and counts["commands"] >= 15 and counts["numbers"] >= 60, counts


def pieces():
    for page in [*sorted((ROOT / "docs").rglob("*.md")), ROOT / "README.md", ROOT / "README.ja.md"]:
        for language, title, text in BLOCK.findall(page.read_text(encoding="utf-8")):
            if language == "toml":
                yield page.relative_to(ROOT), title, text


def test_schema():
    """The schema is one, takes the examples and the pieces of cases in the pages, and refuses what is not right."""
    schema = json.loads(subprocess.run([PROGRAM, "schema"], capture_output=True, text=True, check=True).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    whole = jsonschema.Draft202012Validator(schema)
    piece = jsonschema.Draft202012Validator(loose(schema))
    cases = sorted(ROOT.glob("examples/*/case.toml"))
    assert len(cases) >= 4, cases
    for case in cases:
        whole.validate(tomllib.loads(case.read_text(encoding="utf-8")))
    count = 0
    for page, title, text in pieces():
        values = tomllib.loads(text)
        try:
            (whole if "lattice" in values and "body" in values and title else piece).validate(values)
        except jsonschema.ValidationError as error:
            raise AssertionError(f"{page}: {error.json_path}: {error.message}\n{text}") from None
        count += 1
    assert count >= 8, count
    right = tomllib.loads(cases[0].read_text(encoding="utf-8"))
    for broken in (
        right | {"colour": "red"},
        right | {"lattice": {}},
        right | {"lattice": right["lattice"] | {"spacing": -1}},
        right | {"lattice": right["lattice"] | {"cell": "cube-IV"}},
        right | {"analysis": {"damping": {"factor": 1}}},
        right | {"probe": [{"face": "z-max"}]},
        right | {"probe": [{"name": "a"}]},
        right | {"probe": [{"name": "a", "face": "z-max", "point": [0, 0, 0]}]},
        right | {"load": [{"force": [0, 0, 1]}]},
        right | {"load": [{"face": "z-max", "acceleration": [0, 0, 1]}]},
    ):
        assert not whole.is_valid(broken), broken


def loose(schema):
    """The schema without what is required: a piece of a case need not be whole."""
    if isinstance(schema, dict):
        return {key: loose(value) for key, value in schema.items() if key not in ("required", "allOf")}
    return schema


def test_python_reference():
    """The reference of the Python module has all that the module offers."""
    tree = ast.parse((ROOT / "python/koshi/__init__.py").read_text(encoding="utf-8"))
    offered = next(ast.literal_eval(n.value) for n in tree.body if isinstance(n, ast.Assign) and n.targets[0].id == "__all__")
    page = (ROOT / "docs/reference/python.md").read_text(encoding="utf-8")
    missing = [name for name in offered if f"koshi.{name}\n" not in page and f"`koshi.{name}`" not in page]
    assert len(offered) > 15 and not missing, missing


def test_validation():
    """Every test that the validation pages name exists."""
    sources = "".join(p.read_text(encoding="utf-8") for p in (ROOT / "tests").rglob("*.cpp"))
    registered = (ROOT / "tests/house/CMakeLists.txt").read_text(encoding="utf-8")
    there = {".".join(names) for names in re.findall(r"^TEST(?:_P|_F)?\((\w+), (\w+)\)", sources, re.MULTILINE)}
    there |= set(re.findall(r"add_test\(NAME (\S+)", registered))
    pages = "".join(p.read_text(encoding="utf-8") for p in (ROOT / "docs/validation").glob("*.md"))
    named = set(re.findall(r"`((?:[A-Z]\w+|docs)\.\w+)`", pages))
    assert len(named) > 20 and named <= there, named - there


def test_equations():
    """Every equation that a page or a comment refers to is there, once."""
    text = "".join(p.read_text(encoding="utf-8") for p in ROOT.glob("docs/theory/*.md"))
    # A table has its number at the start of the line below.
    tags = re.findall(r"\\tag\{([^}]+)\}", text) + re.findall(r"^\((\d+\.\d+)\) ", text, re.MULTILINE)
    assert len(tags) == len(set(tags)) >= 25, sorted(tags)
    own = {tag for tag in tags if not tag.startswith("N")}
    chapters = {tag.split(".")[0] for tag in own}
    count = 0
    files = [*ROOT.glob("docs/**/*.md"), *ROOT.glob("docs/theory/*.py")]
    for folder in ("src", "include", "tests", "apps", "bench"):
        files += [*ROOT.glob(f"{folder}/**/*.h"), *ROOT.glob(f"{folder}/**/*.cpp")]
    for file in files:
        for line in file.read_text(encoding="utf-8").splitlines():
            # In C++ only what a comment says, so that no number passes for an equation.
            said = line if file.suffix in (".md", ".py") else line.partition("//")[2]
            for chapter, number in re.findall(r"\((\d{1,2})\.([1-9]\d?)\)", said):
                if chapter in chapters:
                    assert f"{chapter}.{number}" in own, f"{file.relative_to(ROOT)}: no equation ({chapter}.{number})"
                    count += 1
    assert count >= 30, count


if __name__ == "__main__":
    for test in (test_equations, test_validation, test_python_reference, test_schema, test_pages):
        test()
        print(f"{test.__name__}: ok")
