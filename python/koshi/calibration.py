"""Springs from elastic constants, without a body."""

from __future__ import annotations

import json

from . import _koshi
from .case import Case, _definition
from .tables import Body, Lattice, Material, Vector


def calibrate(lattice: Lattice, material: Material, size: Vector | None = None) -> dict:
    """Springs of a material and what they really give: the content of `koshi calibrate --json`, SI units.

    size: of a box of cells [m], which matters to plain springs only; default: the unit cell inside the bulk.
    Raises InputError.
    """
    body = Body(size=size if size is not None else [lattice.spacing] * 3, material="material")
    definition = _definition(Case(lattice, body, {"material": material}))
    return json.loads(_koshi.calibrate(definition, size is not None))
