"""Closest approaches in a recording of pedestrians, and what looking at its frames alone would have missed.

Usage: walkers.py RECORDING [picture.png], where RECORDING is an obsmat file of UCY: rows of frame, id, x,
z, y, velocities.
"""

import sys

import matplotlib
import numpy as np
from scipy.spatial import cKDTree

import kinesphere as ks

matplotlib.use("Agg")
import matplotlib.pyplot as plt

distance = 0.4
frame, walker, x, y = np.loadtxt(sys.argv[1])[:, [0, 1, 2, 4]].T
found = ks.tracks(frame / 25, x, y, None, walker.astype(int), distance)

# The equivalent check, frame by frame.
seen = set()
for now in np.unique(frame):
    who, here = walker[frame == now], np.stack([x[frame == now], y[frame == now]], axis=1)
    for a, b in cKDTree(here).query_pairs(distance):
        seen.add((min(who[a], who[b]), max(who[a], who[b])))
pairs = set(zip(found["first"].tolist(), found["second"].tolist()))
print(
    f"{len(found)} approaches of {len(pairs)} pairs below {distance} m; {len(seen)} pairs are seen in frames"
)
print(f"the closest: {found['closest_distance'].min():.3f} m, on curves through {len(frame)} samples")
assert seen <= pairs

plt.plot(x, y, ",", color="lightgrey")
missed = np.array([pair not in seen for pair in zip(found["first"].tolist(), found["second"].tolist())])
for which, colour, name in (
    (~missed, "tab:blue", "seen in a frame too"),
    (missed, "tab:red", "between frames only"),
):
    plt.plot(*found["first_position"][which, :2].T, ".", color=colour, label=name)
plt.axis("equal")
plt.legend()
plt.savefig(sys.argv[2] if len(sys.argv) > 2 else "walkers.png")
