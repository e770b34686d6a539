"""The examples run, and what they assert holds."""

import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = sorted((Path(__file__).parents[1] / "examples").glob("*.py"))


def test_there_are_examples():
    assert len(EXAMPLES) == 3


@pytest.mark.parametrize("script", EXAMPLES, ids=lambda s: s.stem)
def test_example(script, tmp_path):
    picture = [tmp_path / "picture.png"] if script.stem == "cantilever" else []
    result = subprocess.run([sys.executable, script, *picture], capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr
    assert result.stdout.count("\n") == 1
    assert all(p.stat().st_size > 10_000 for p in picture)
