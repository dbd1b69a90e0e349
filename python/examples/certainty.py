"""How many probes certainty takes: the more room bodies have, the fewer. Usage: certainty.py [picture.png]"""

import sys

import matplotlib

import kinesphere as ks

matplotlib.use("Agg")
import matplotlib.pyplot as plt

packings = [0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1]
asked, contacts = [], []
for packing in packings:
    scene = ks.Scene("paper1", bodies=500, packing=packing, seconds=4.0)
    world, motion = ks.World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    events = world.run(scene.end_time, motion, scene)
    asked.append(world.counters.probes / (len(scene) * scene.end_time))
    contacts.append(len(events) / (len(scene) * scene.end_time))
    print(
        f"packing {packing:6}: {contacts[-1]:7.3f} contacts and {asked[-1]:6.2f} probes per body and second"
    )

plt.loglog(packings, asked, "o-", label="probes")
plt.loglog(packings, contacts, "s-", label="contacts, those with walls too")
plt.axhline(60, color="grey", linestyle=":", label="looking 60 times a second, and certain of nothing")
plt.xlabel("part of the box that bodies fill")
plt.ylabel("per body and second")
plt.legend()
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "certainty.png")
