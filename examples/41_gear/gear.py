#!/usr/bin/python3
"""Writes gear.stl: a spur gear of 12 straight-sided teeth, in mm, its axis along z.

    examples/41_gear/gear.py [examples/41_gear/gear.stl]
"""
import math
import pathlib
import sys

TEETH, ROOT, TIP, THICKNESS = 12, 23.0, 30.0, 10.0
# Half angles of a tooth at its root and its tip, of the pitch.
AT_ROOT, AT_TIP = 0.28, 0.14


def outline():
    """Corners of the gear, counter-clockwise; tooth 0 points along x."""
    corners = []
    pitch = 2 * math.pi / TEETH
    for tooth in range(TEETH):
        for radius, share in ((ROOT, -AT_ROOT), (TIP, -AT_TIP), (TIP, AT_TIP), (ROOT, AT_ROOT)):
            angle = pitch * (tooth + share)
            corners.append((radius * math.cos(angle), radius * math.sin(angle)))
    return corners


def triangles():
    corners = outline()
    for i, (x, y) in enumerate(corners):
        u, v = corners[(i + 1) % len(corners)]
        low, high = 0.0, THICKNESS
        yield (x, y, low), (u, v, low), (u, v, high)
        yield (x, y, low), (u, v, high), (x, y, high)
        # Seen from the axis every corner is in sight.
        yield (0.0, 0.0, high), (x, y, high), (u, v, high)
        yield (0.0, 0.0, low), (u, v, low), (x, y, low)


def main():
    out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).with_name("gear.stl"))
    lines = ["solid gear"]
    for triangle in triangles():
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + " ".join(f"{c:.6g}" for c in corner) for corner in triangle]
        lines += ["endloop", "endfacet"]
    out.write_text("\n".join(lines + ["endsolid gear"]) + "\n")


if __name__ == "__main__":
    main()
