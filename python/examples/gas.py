"""A gas of hard spheres: its pressure, measured from its collisions, against the Carnahan-Starling equation.

Each contact is at its exact time, so the virial is a plain sum over events. Usage: gas.py [picture.png]
"""

import sys

import matplotlib
import numpy as np

import kinesphere as ks

matplotlib.use("Agg")
import matplotlib.pyplot as plt

packings, measured = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4], []
for packing in packings:
    scene = ks.Scene("periodic_gas", bodies=500, packing=packing, seconds=4.0)
    world, motion = ks.World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    world.run(1.0, motion, scene)  # until the start is forgotten
    events = world.run(scene.end_time, motion, scene)
    # The velocity that each contact gives the first body, along the vector between the two centres.
    first, second, masses = events["first"], events["second"], scene.masses
    kick = 2 * masses[second] / (masses[first] + masses[second]) * events["approach_speed"]
    distance = np.linalg.norm(events["second_position"] - events["first_position"], axis=1)
    energy = np.sum(masses * np.sum(motion.states(scene.end_time)[1] ** 2, axis=1)) / 2
    measured.append(1 + np.sum(masses[first] * kick * distance) / (2 * energy * (scene.end_time - 1.0)))

eta = np.linspace(0, 0.42, 100)
plt.plot(eta, (1 + eta + eta**2 - eta**3) / (1 - eta) ** 3, label="Carnahan and Starling 1969")
plt.plot(packings, measured, "o", label="from contacts")
plt.xlabel("packing fraction")
plt.ylabel("pressure / (density temperature)")
plt.legend()
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "gas.png")
for packing, z in zip(packings, measured):
    expected = (1 + packing + packing**2 - packing**3) / (1 - packing) ** 3
    print(f"packing {packing:.2f}: {z:.3f}, expected {expected:.3f}, {100 * (z / expected - 1):+.1f} %")
    assert abs(z / expected - 1) < 0.05
