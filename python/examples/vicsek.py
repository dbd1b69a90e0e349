"""The flocks of Vicsek and others (1995): order against noise, with neighbours that no step of time can miss.

Birds in a periodic plane fly straight on for one unit of time. Each then takes the mean direction of all that are
within a distance of 1, itself included, and a random error. A sensor tells who comes within that distance and who
leaves it, so nobody is searched for. Usage: vicsek.py [picture.png], which needs matplotlib
"""

import sys

import numpy as np
import numpy.typing as npt

import kinesphere as ks

Doubles = npt.NDArray[np.float64]

birds, side, speed, radius = 200, 5.7, 0.03, 1.0
steps, measured = 160, 80
noises = [0.1, 1.5, 2.5, 3.5, 5.0]


def order_at(noise: float) -> float:
    """The mean length of the mean direction of all birds: 1 if all fly alike, near 0 if each flies as it likes."""
    rng = np.random.default_rng(1)
    heading = rng.uniform(-np.pi, np.pi, birds)

    def velocities() -> Doubles:
        return np.stack([speed * np.cos(heading), speed * np.sin(heading)], axis=1)

    motion = ks.Ballistic(rng.uniform(0, side, (birds, 2)), velocities())
    world = ks.World(box=((0, 0), (side, side)), periodic=True, dimensions=2)
    world.set_sensor(0, [radius])
    ids = world.add_motion(motion, radii=0.0, solid=False)
    near = np.eye(birds, dtype=bool)
    order = []
    for step in range(1, steps + 1):
        events = world.run(step, motion)
        begins = events["kind"] == ks.EventKind.sensor_enter
        # Where a pair comes and goes in one step, its last event counts.
        near[events["first"], events["second"]] = begins
        near[events["second"], events["first"]] = begins
        heading = np.angle(near @ np.exp(1j * heading)) + noise * rng.uniform(-0.5, 0.5, birds)
        motion.set_velocity(ids, world.time, velocities())
        world.set_velocity(ids, velocities())
        order.append(abs(np.mean(np.exp(1j * heading))))
    return float(np.mean(order[-measured:]))


orders = [order_at(noise) for noise in noises]
# What the errors would leave of the order if all neighbours flew in one direction before.
most = [np.sin(noise / 2) / (noise / 2) for noise in noises]
for noise, order, bound in zip(noises, orders, most):
    print(f"noise {noise:.1f}: order {order:.3f} of {bound:.3f} {'#' * round(40 * order)}")
    assert order < bound + 0.02
assert orders[0] > 0.95 and orders[-1] < 0.4 and all(a > b for a, b in zip(orders, orders[1:]))

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    plt.plot(noises, orders, "o-")
    plt.xlabel("noise (radians)")
    plt.ylabel("order")
    plt.savefig(sys.argv[1])
