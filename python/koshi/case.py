"""A whole case: its tables, the reading of a file, and what the program takes. What is wrong raises `InputError` when
the case is used.
"""

from __future__ import annotations

import os
import tomllib
from dataclasses import dataclass, field, fields, is_dataclass, replace
from typing import Mapping, Sequence

import numpy as np

from . import _koshi
from .tables import (
    Analysis,
    Body,
    Boundary,
    Crack,
    Lattice,
    Load,
    Macroscopic,
    Material,
    Output,
    Probe,
    Region,
    Selection,
)


@dataclass
class Case:
    """A whole input."""

    lattice: Lattice
    """unit cell, spacing and springs"""
    body: Body
    """the box of cells"""
    material: dict[str, Material]
    """by name"""
    region: list[Region] = field(default_factory=list)
    """shapes of another material, later ones win"""
    crack: list[Crack] = field(default_factory=list)
    """cracks from the start"""
    selection: list[Selection] = field(default_factory=list)
    """selections by name"""
    boundary: list[Boundary] = field(default_factory=list)
    """prescribed motions"""
    load: list[Load] = field(default_factory=list)
    """forces"""
    macroscopic: Macroscopic | None = None
    """mean strain and stress of a periodic body, default none"""
    analysis: Analysis = field(default_factory=Analysis)
    """what is computed"""
    probe: list[Probe] = field(default_factory=list)
    """values reported by name"""
    output: Output = field(default_factory=Output)
    """what is written"""
    title: str | None = None
    """for people"""

    def to_toml(self) -> str:
        """The whole input as TOML, every default written out, in SI units. Raises InputError."""
        return _definition(self).resolved_toml()


def load(file: str | os.PathLike, overrides: Sequence[str] = ()) -> Case:
    """The case of an input file, in SI units with every default filled in.

    overrides: "section.key=value", as for `koshi run --set`. Raises InputError with file, line and column.
    """
    values = tomllib.loads(_koshi.read_case(os.fspath(file), list(overrides)).resolved_toml())
    tables = {"lattice": Lattice, "body": Body, "analysis": Analysis, "output": Output}
    lists = {"region": Region, "crack": Crack, "selection": Selection, "boundary": Boundary, "load": Load, "probe": Probe}
    parts: dict = {"material": {name: Material(**m) for name, m in values["material"].items()}}
    parts |= {name: cls(**values[name]) for name, cls in tables.items()}
    if "macroscopic" in values:
        parts["macroscopic"] = Macroscopic(**values["macroscopic"])
    parts |= {name: [cls(**entry) for entry in values.get(name, [])] for name, cls in lists.items()}
    if parts["body"].materials is not None:
        parts["body"].materials = {int(value): name for value, name in parts["body"].materials.items()}
    return Case(**parts, title=values.get("title"))


def _plain(value):
    """Dataclasses, arrays, paths and tuples as dict, list, text and numbers; what is None or empty is left out."""
    if is_dataclass(value):
        value = {f.name: getattr(value, f.name) for f in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): _plain(v) for key, v in value.items() if v is not None and not _is_empty(v)}
    if isinstance(value, (np.ndarray, np.generic)):
        return _plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    return os.fspath(value) if isinstance(value, os.PathLike) else value


def _is_empty(value) -> bool:
    return isinstance(value, (list, tuple, dict)) and len(value) == 0


def _definition(case: Case | str | os.PathLike, overrides: Sequence[str] = ()) -> _koshi.Definition:
    if isinstance(case, (str, os.PathLike)):
        return _koshi.read_case(os.fspath(case), list(overrides))
    image, factor, strength = case.body.image, case.body.factor, case.body.strength
    grains = case.body.grain_boundary
    labels = grains.get("labels") if grains else None
    # The reader sees a file's name in place of an array.
    named: dict = {}
    if isinstance(image, np.ndarray):
        _check_array("body.image", image, "biu", "whole numbers or bool")
        if case.body.scan is not None:
            raise InputError("body.scan: error: scan is for files; cut, turn and sort an array with numpy")
        named["image"] = "array.npy"
    if isinstance(factor, np.ndarray):
        _check_array("body.factor", factor, "biuf", "numbers")
        named["factor"] = "array.npy"
    if isinstance(strength, np.ndarray):
        _check_array("body.strength", strength, "biuf", "numbers")
        named["strength"] = "array.npy"
    if isinstance(labels, np.ndarray):
        _check_array("body.grain_boundary.labels", labels, "biu", "whole numbers")
        named["grain_boundary"] = {**(grains or {}), "labels": "array.npy"}
    case = replace(case, body=replace(case.body, **named))
    definition = _koshi.read_values(_plain(case), list(overrides))
    if "image" in named:
        definition.set_cells(np.ascontiguousarray(image, dtype=np.int64))
    if "factor" in named:
        definition.set_factors(np.ascontiguousarray(factor, dtype=np.float32))
    if "strength" in named:
        definition.set_strengths(np.ascontiguousarray(strength, dtype=np.float32))
    if "grain_boundary" in named:
        definition.set_grain_labels(np.ascontiguousarray(labels, dtype=np.int64))
    return definition


def _check_array(key: str, array: np.ndarray, kinds: str, expected: str) -> None:
    if array.dtype.kind not in kinds or array.ndim != 3:
        raise InputError(
            f"{key}: error: the array has the type {array.dtype} and the shape {array.shape}; expected {expected} "
            "and three axes, [z][y][x]"
        )


InputError = _koshi.InputError
RunError = _koshi.RunError
