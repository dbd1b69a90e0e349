"""Hard spheres from a thin gas to a random close packing: how crowded each is, from two sides.

place_spheres() fills a periodic box. The pair correlation at contact g, how many more spheres touch one than chance
would have it, is then counted twice: from the gaps of the start, and from the rate at which the spheres collide once
they fly (Enskog). Beyond 0.49 a fluid at rest would freeze; these do not, and near 0.64 they jam.
"""

import numpy as np
from scipy.spatial import cKDTree

import kinesphere as ks

count, diameter, shell = 1000, 1.0, 0.02
collisions_each = 15


def correlations(packing: float) -> tuple[float, float]:
    """g from the pairs that are within a shell around contact, and g from collisions."""
    side = (count * np.pi / 6 / packing) ** (1 / 3)
    box = ((0, 0, 0), (side, side, side))
    centres = ks.place_spheres(np.full(count, diameter / 2), box, periodic=True, gap=1e-5)
    density = count / side**3
    pairs = len(cKDTree(centres % side, boxsize=side).query_pairs(diameter + shell))
    in_shell = 4 / 3 * np.pi * ((diameter + shell) ** 3 - diameter**3)
    by_gaps = 2 * pairs / count / (density * in_shell)

    motion = ks.Ballistic(centres, np.random.default_rng(1).normal(size=(count, 3)))
    world = ks.World(box=box, periodic=True, contacts="impacts")
    world.add_motion(motion, radii=diameter / 2)
    per_g = 4 * np.sqrt(np.pi) * density * diameter**2  # collisions of each in a unit of time, where g is 1
    duration = collisions_each / (per_g * carnahan_starling(packing))
    world.run(duration, motion, ks.Bouncing())  # until the start is forgotten
    events = world.run(2 * duration, motion, ks.Bouncing())
    return by_gaps, 2 * len(events) / count / duration / per_g


def carnahan_starling(packing: float) -> float:
    return (1 - packing / 2) / (1 - packing) ** 3


print("packing   g from gaps   from collisions   Carnahan-Starling")
for packing in [0.05, 0.15, 0.25, 0.35, 0.45, 0.5, 0.55, 0.6]:
    by_gaps, by_collisions = correlations(packing)
    expected = carnahan_starling(packing)
    print(f"{packing:7.2f} {by_gaps:13.2f} {by_collisions:17.2f} {expected:19.2f}")
    if packing < 0.5:
        assert abs(by_collisions / expected - 1) < 0.06
    else:
        assert by_collisions > 0.9 * expected
