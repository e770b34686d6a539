"""Cases: the same keys, checks and words as the input file."""

import dataclasses
import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

import koshi
from conftest import beam

ROOT = Path(__file__).parents[2]
PROGRAM = Path(koshi.__file__).parents[2] / "koshi"


def test_dataclasses_have_the_keys_of_the_input():
    schema = json.loads(subprocess.run([PROGRAM, "schema"], capture_output=True, text=True, check=True).stdout)
    tables = {"lattice": koshi.Lattice, "body": koshi.Body, "material": koshi.Material, "region": koshi.Region, "crack": koshi.Crack,
              "boundary": koshi.Boundary, "load": koshi.Load, "analysis": koshi.Analysis, "probe": koshi.Probe,
              "output": koshi.Output, "selection": koshi.Selection, "macroscopic": koshi.Macroscopic}  # fmt: skip
    assert set(schema["properties"]) == {f.name for f in dataclasses.fields(koshi.Case)}
    for name, cls in tables.items():
        table = schema["properties"][name]
        table = table.get("items", table.get("additionalProperties") or table)
        fields = dataclasses.fields(cls)
        assert set(table["properties"]) == {f.name for f in fields}, name
        required = {f.name for f in fields if f.default is dataclasses.MISSING}
        assert set(table.get("required", [])) == required, name


@pytest.mark.parametrize("file", sorted(ROOT.glob("examples/*/case.toml")), ids=lambda f: f.parent.name)
def test_loading_and_writing_keep_every_example(file):
    case = koshi.load(file)
    # In SI units with every default, and equal to what the program makes of the file.
    text = case.to_toml()
    again = file.parent / "case.toml"
    assert text == koshi.case._koshi.read_case(str(again), []).resolved_toml()


def test_overrides():
    case = koshi.load(ROOT / "examples/02_cantilever_paper/case.toml", ["lattice.spacing='0.1 cm'", "analysis.tolerance=1e-3"])
    assert case.lattice.spacing == pytest.approx(1e-3, rel=1e-12)
    assert case.analysis.tolerance == 1e-3


def test_numpy_values_and_tuples_are_values(case):
    case.load[0].force = np.array([0.0, 0.0, 4.0])
    case.lattice.spacing = np.float64(1e-3)
    assert "force = [0.0, 0.0, 4.0]" in case.to_toml().replace("[0, 0, 4]", "[0.0, 0.0, 4.0]")


@pytest.mark.parametrize(
    "change, message",
    [
        ({"lattice": koshi.Lattice("1 N")}, r"^lattice.spacing: error: "),
        ({"lattice": koshi.Lattice("1 mm", cell="cube-IV")}, r'^lattice.cell: error: .*"cube-I"'),
        ({"boundary": [koshi.Boundary(face="x-mid", fix=["x"])]}, r"^boundary\[0\].face: error: "),
        ({"body": koshi.Body(size=(0.002, 0.002, 0.0035), material="rock")}, r"^body.size\[2\]: error: "),
        ({"body": koshi.Body(size=(0.002, 0.002, 0.004), material="rick")}, r'^body.material: error: .*"rock"'),
        ({"material": {"rock": koshi.Material(1e9, 0.5, 2000)}}, r"^material.rock.poissons_ratio: error: "),
        ({"title": object()}, r"^title: error: the type object"),
    ],
)
def test_wrong_input_raises_with_its_key(change, message):
    with pytest.raises(koshi.InputError, match=message):
        koshi.Simulation(beam(**change))
    assert issubclass(koshi.InputError, ValueError) and issubclass(koshi.RunError, RuntimeError)


def test_wrong_file_raises_with_line_and_column(tmp_path):
    (tmp_path / "case.toml").write_text("[lattice]\nspacings = 1\n")
    with pytest.raises(koshi.InputError, match=r"case.toml:2:1: error: .*spacing"):
        koshi.load(tmp_path / "case.toml")


def test_calibrate_gives_the_paper_table():
    # Cube-II of Table 1: kn = 0.605 MN/m, kt = 0.134 MN/m.
    lattice = koshi.Lattice("0.2 cm", cell="cube-II", springs="plain")
    rock = koshi.Material("1112 MPa", 0.18, 2000)
    springs = koshi.calibrate(lattice, rock, size=("0.8 cm", "0.8 cm", "1.6 cm"))["springs"]
    values = json.dumps(springs)
    found = [float(f"{v / 1e6:.3f}") for v in _numbers(springs)]
    assert 0.605 in found and 0.134 in found, values


def _numbers(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [n for v in value for n in _numbers(v)]
    return [value] if isinstance(value, (int, float)) else []
