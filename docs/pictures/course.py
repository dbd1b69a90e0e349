"""Bodies on paths that are functions of time, in a world that does not know them."""

import math

import numpy as np

from kinesphere import World


class Course:
    """A world in the plane, with bodies on given paths; each path gives place and velocity at a time."""

    def __init__(self, paths, radii, limits, **world):
        self.paths, self.radii = paths, radii
        self.world = World(dimensions=2, **world)
        self.ids = [
            self.world.add(*path(0.0), radii=radius, acceleration_limits=limit)
            for path, radius, limit in zip(paths, radii, limits)
        ]
        self.probes = []  # pairs of a body's index and a time

    def probe(self, ids, time):
        bodies = [self.ids.index(body) for body in ids]
        self.probes += [(body, time) for body in bodies]
        states = [self.paths[body](time) for body in bodies]
        return np.array([place for place, _ in states]), np.array([velocity for _, velocity in states])

    def advance(self, until):
        return [event for event in self.world.events(until, self.probe)]


def still(x, y):
    return lambda time: ([x, y, 0.0], [0.0, 0.0, 0.0])


def weaving(x, speed, height, rate, phase=0.0, y=0.0):
    """Straight on along x, and a sine in y of acceleration height * rate^2 at most."""
    return lambda t: (
        [x + speed * t, y + height * math.sin(rate * t + phase), 0.0],
        [speed, height * rate * math.cos(rate * t + phase), 0.0],
    )
