"""Every promise of docs/guide/promises.md names a test that exists."""

import re
from pathlib import Path

root = Path(__file__).parents[2]
page = (root / "docs/guide/promises.md").read_text(encoding="utf-8")
tests = set()
for file in (root / "tests").rglob("*.cpp"):
    tests |= {".".join(names) for names in re.findall(r"\bTEST(?:_F|_P)?\((\w+),\s*(\w+)\)", file.read_text())}
for file in (root / "tests").rglob("CMakeLists.txt"):
    tests |= set(re.findall(r"add_test\(NAME ([\w.]+)", file.read_text()))

# The last cell of each row of a table of promises.
count = 0
for table in re.findall(r"\| promise \| test \|\n\|[-|]+\|\n((?:\|.*\n)+)", page):
    for row in table.splitlines():
        named = re.findall(r"`([\w.]+)`", row.rstrip(" |").rsplit("|", 1)[1])
        assert named, f"no test stands for: {row}"
        for name in named:
            assert name in tests, f"there is no test {name}"
            count += 1
assert count >= 10, count
