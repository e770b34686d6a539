"""Both READMEs show the same valid case, the same numbers and the same links. Usage: test_readme.py PROGRAM"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

cases, numbers, links = [], [], []
for name in ("README.md", "README.ja.md"):
    readme = (Path(__file__).parents[2] / name).read_text(encoding="utf-8")
    cases += re.findall(r"```toml\n(.*?)```", readme, re.DOTALL)
    rows = re.findall(r"^\|.*\|$", readme, re.MULTILINE)
    numbers.append([re.findall(r"\d+\.\d+", row) for row in rows])
    links.append(sorted(set(re.findall(r"\]\(([^)]+)\)", readme)) - {"README.md", "README.ja.md"}))
assert len(cases) == 2 and cases[0] == cases[1], cases
assert numbers[0] == numbers[1] and sum(map(len, numbers[0])) >= 15, numbers
assert links[0] == links[1] and len(links[0]) >= 10, links

with tempfile.TemporaryDirectory() as folder:
    case = Path(folder, "beam.toml")
    case.write_text(cases[0])
    result = subprocess.run([sys.argv[1], "check", case], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    # 18 x 78 x 18 mm at 2 mm
    assert "9 x 39 x 9" in result.stdout, result.stdout
