#!/usr/bin/python3
"""A crack that should run at 22.5 degrees to the lattice does so and takes its fracture energy: test_crack_direction.py SCRIPTS KOSHI"""
import pathlib
import sys

sys.path.insert(0, sys.argv[1])
from fracture_cases_study import direction

turn, length, energy, cells = direction(pathlib.Path(sys.argv[2]), 22.5, 4, 30)
print(f"off by {turn:+.1f} degrees, {length:.0f} mm long, {energy:.3f} G_f, {cells} cells")
# A straight crack of 40 mm cuts 40 mm/4 mm (cos + sin 22.5) = 13 cells.
assert abs(turn) < 5 and 40 < length < 60 and abs(energy - 1) < 0.1 and cells >= 13
