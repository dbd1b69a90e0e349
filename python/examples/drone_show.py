"""A drone show, whose paths are polynomials: are two drones ever nearer than they may be?

A hundred drones fly from a square on the ground to a sphere in the air and on to a ring. The planner gives each leg as
a polynomial of degree 7 that begins and ends at rest. Drones follow their plans to 10 cm.
"""

import numpy as np

import kinesphere as ks

count, separation = 100, 1.0
random = np.random.default_rng(7)
k = np.arange(count)
square = 2.0 * np.stack([k % 10, k // 10, 0 * k], axis=1)
polar, turn = np.arccos(1 - 2 * (k + 0.5) / count), np.pi * (1 + 5**0.5) * k
sphere = [9, 9, 30] + 10 * np.stack(
    [np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], axis=1
)
ring = [9, 9, 30] + 25 * np.stack(
    [np.cos(2 * np.pi * k / count), 0 * k, np.sin(2 * np.pi * k / count)], axis=1
)
figures = [square, sphere, random.permutation(ring)]

# The way from 0 to 1 in a time from 0 to 1, without velocity, acceleration and jerk at the ends.
smooth = np.array([0, 0, 0, 0, 35, -84, 70, -20], dtype=float)
leg = 20.0
legs = len(figures) - 1
coefficients = np.zeros((count, legs, 3, len(smooth)))
for n, (here, there) in enumerate(zip(figures, figures[1:])):
    coefficients[:, n] = (there - here)[:, :, None] * (smooth / leg ** np.arange(len(smooth)))
    coefficients[:, n, :, 0] += here

paths = ks.PolynomialPaths(
    np.repeat(k, legs),
    np.tile(leg * np.arange(legs), count),
    np.tile(leg * np.arange(1, legs + 1), count),
    coefficients.reshape(-1, 3, len(smooth)),
    basis="monomial",
    errors=0.1,
)
found = paths.approaches(separation)
certain = found.approaches["is_certain"].sum()
print(f"{len(found)} pairs may come within {separation:g} m, {certain} of them surely")
for row in found.minima[np.argsort(found.minima["distance"])[:5]]:
    print(
        f"drones {row['first']:2} and {row['second']:2}: {row['distance']:.2f} m at {row['time']:.2f} s, {row['relative_speed']:.1f} m/s"
    )
