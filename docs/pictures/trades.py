"""Fluids and grains in the plane, for the pages of physicists."""

import math

import numpy as np
from drawing import Drawing
from lessons import HEIGHT, WIDTH

import kinesphere as ks

SIDE = 270.0
RADIUS = 0.5
TOP = 66.0


def frame(title, about, captions):
    """A drawing with two square panels that have captions. Returns it with the left border of each."""
    drawing = Drawing(WIDTH, HEIGHT, title, about)
    drawing.text(20, 34, title, "ink bold")
    lefts = (30.0, 340.0)
    for left, caption in zip(lefts, captions, strict=True):
        drawing.rect(left, TOP - 12, SIDE, SIDE, "frame-line")
        drawing.text(left + SIDE / 2, TOP + SIDE + 12, caption, "quiet small", "middle")
    return drawing, lefts


def discs(drawing, left, centres, side, inks):
    """Discs of diameter 1 in a square panel that repeats; inks[k] is the class of a disc."""
    scale = SIDE / side
    at = lambda place: (left + scale * (place[0] % side), TOP - 12 + SIDE - scale * (place[1] % side))
    for ink in sorted(set(inks)):
        places = [at(place) for place, each in zip(centres, inks, strict=True) if each == ink]
        drawing.dots(places, RADIUS * scale, ink)


def random_velocities(count, temperature, seed):
    """Velocities that are the same to the last bit on all machines, as the picture of a chaotic run needs them."""
    velocities = np.random.default_rng(seed).uniform(-1, 1, size=(count, 2)) * math.sqrt(3 * temperature)
    return velocities - [math.fsum(column) / count for column in velocities.T]


def flying(centres, velocities, side):
    """Discs in a box that repeats: their world, ids and motion."""
    motion = ks.Ballistic(centres, velocities)
    world = ks.World(dimensions=2, box=((0, 0), (side, side)), periodic=True, contacts="impacts")
    return world, world.add_motion(motion, RADIUS), motion


def gas(count, packing, temperature, seed):
    side = math.sqrt(count * math.pi / 4 / packing)
    radii, box = np.full(count, RADIUS), ((0, 0), (side, side))
    centres = ks.place_spheres(radii, box, periodic=True, gap=1e-4, seed=seed, dimensions=2)[:, :2]
    return side, *flying(centres, random_velocities(count, temperature, seed), side)


def well():
    """Discs in square wells, warm and cold."""
    count, packing = 300, 0.22
    drawing, lefts = frame(
        "300 discs in square wells",
        "At a high temperature the discs fill the box evenly; at a low one they condense into drops.",
        ("temperature 2", "temperature 0.4"),
    )
    for left, temperature in zip(lefts, (2.0, 0.4), strict=True):
        side, world, ids, motion = gas(count, packing, temperature, 3)
        potential = ks.StepPotential(world, [0.5], [-1.0])
        world.set_sensor(0, potential.distances)
        for time in range(1, 61):
            world.run(float(time), motion, potential, events="none")
            # A thermostat that scales all velocities.
            velocities = motion.states(float(time))[1][:, :2]
            velocities *= math.sqrt(2 * count * temperature / math.fsum((velocities**2).ravel()))
            motion.set_velocity(np.arange(count), float(time), velocities)
            world.set_velocity(ids, velocities)
        centres = motion.states(60.0)[0][:, :2]
        apart = centres[:, None] - centres[None]
        apart -= side * np.round(apart / side)
        near = np.sum(np.sum(apart**2, axis=2) < 1.5**2, axis=1) - 1
        inks = ["body" if count < 2 else "other" if count < 4 else "probe" for count in near]
        discs(drawing, left, centres, side, inks)
    return drawing


def cooling():
    """A gas of grains that lose a part of their energy at each contact, early and late."""
    count = 1000
    drawing, lefts = frame(
        "1,000 grains, restitution 0.8",
        "The grains lose energy at each contact. At first they fill the box evenly; later they move in clusters.",
        ("after 2 contacts each", "after 150"),
    )
    side, world, _, motion = gas(count, 0.25, 1.0, 5)
    contacts, time = 0, 0.0
    for left, wanted in zip(lefts, (2, 150), strict=True):
        while 2 * contacts < wanted * count:
            time += 0.5 * (1.0 + 0.1 * time)
            contacts += len(world.run(time, motion, ks.Bouncing(restitution=0.8, resting_speed=1e-4)))
        centres, velocities = (each[:, :2] for each in motion.states(time))
        speeds = np.linalg.norm(velocities, axis=1)
        fast, slow = np.quantile(speeds, (0.75, 0.25))
        inks = ["probe" if speed > fast else "body" if speed < slow else "other" for speed in speeds]
        discs(drawing, left, centres, side, inks)
    return drawing


def chain():
    """A chain of 64 beads, straight at first."""
    count, side = 64, 90.0
    drawing, lefts = frame(
        "A chain of 64 beads",
        "Two neighbours of the chain never part. It is straight at first, and coils up.",
        ("at the start", "after 1,500, twice as large"),
    )
    start = np.column_stack([8.0 + 1.15 * np.arange(count), 45.0 + 0.2 * (np.arange(count) % 2)])
    world, ids, motion = flying(start, random_velocities(count, 1.0, 7), side)
    bond = ks.StepPotential(world, [0.3], [0.0], outside=math.inf)
    world.set_sensor(0, bond.distances)
    for first, second in zip(ids[:-1], ids[1:], strict=True):
        world.set_pair_state(ks.BodyId(first), ks.BodyId(second), 1)
    for left, time, shown in zip(lefts, (0.0, 1500.0), (80.0, 40.0), strict=True):
        world.run(time, motion, {0: ks.Bouncing(), 1: bond}, events="none")
        centres = motion.states(time)[0][:, :2]
        middle = centres - centres.mean(axis=0) + shown / 2
        discs(drawing, left, middle, shown, ["body"] * count)
    return drawing


DRAWINGS = {"well": well, "chain": chain, "cooling": cooling}
