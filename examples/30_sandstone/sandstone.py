"""A made-up sandstone: sandstone.npy, or the file named as the first argument, with as many voxels an edge as the second says.

Balls of quartz overlap at random places of a box that repeats itself; a film of clay lies on what is left of them, the rest is pore.
"""
import sys

import numpy as np

GRAINS, RADIUS, FILM = 60, 0.178, 0.012  # number, and lengths over the edge of the box


def sandstone(n):
    """Voxels [z][y][x]: 0 pore, 1 quartz, 2 clay."""
    random = np.random.RandomState(7)
    places, x = random.random_sample((GRAINS, 3)), (np.arange(n) + 0.5) / n
    distance = np.full((n, n, n), 9.0)
    for place in places:
        # The shortest way to the grain or to one of its copies in the boxes around.
        z2, y2, x2 = (((x - c + 0.5) % 1 - 0.5) ** 2 for c in place)
        distance = np.minimum(distance, z2[:, None, None] + y2[None, :, None] + x2[None, None, :])
    distance = np.sqrt(distance)
    return np.select([distance < RADIUS, distance < RADIUS + FILM], [1, 2], 0).astype(np.uint8)


if __name__ == "__main__":
    file, n = (sys.argv[1:] + ["sandstone.npy", "48"][len(sys.argv) - 1 :])[:2]
    np.save(file, sandstone(int(n)))
