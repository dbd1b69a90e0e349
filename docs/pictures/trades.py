"""Fluids, grains, packings, flocks and planetesimals, for the pages of physicists."""

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


def panel(left, side):
    """Where a place of a plane as wide as `side` is in a square panel."""
    scale = SIDE / side
    return lambda place: (left + scale * place[0], TOP - 12 + SIDE - scale * place[1])


def discs(drawing, left, centres, side, inks):
    """Discs of diameter 1 in a square panel that repeats; inks[k] is the class of a disc."""
    scale, at = SIDE / side, panel(left, side)
    for ink in sorted(set(inks)):
        places = [at(place % side) for place, each in zip(centres, inks, strict=True) if each == ink]
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


class Chart:
    """The axes of a chart in a square panel."""

    def __init__(self, drawing, left, across, up, words, marks):
        self.drawing, self.left, self.across, self.up = drawing, left, across, up
        for x in marks[0]:
            drawing.text(self.at(x, up[0])[0], TOP + SIDE - 18, f"{x:g}", "quiet small", "middle")
        for y in marks[1]:
            drawing.text(left + 6, self.at(across[0], y)[1] + 5, f"{y:g}", "quiet small")
        drawing.text(left + SIDE - 8, TOP + 12, words, "quiet small", "end")

    def at(self, x, y):
        part = (x - self.across[0]) / (self.across[1] - self.across[0])
        rise = (y - self.up[0]) / (self.up[1] - self.up[0])
        return self.left + 34 + (SIDE - 48) * part, TOP - 12 + SIDE - 36 - (SIDE - 70) * rise

    def curve(self, xs, ys, class_, **more):
        self.drawing.curve([self.at(x, y) for x, y in zip(xs, ys, strict=True)], class_, **more)

    def dots(self, xs, ys, ink):
        self.drawing.dots([self.at(x, y) for x, y in zip(xs, ys, strict=True)], 4.0, ink)


def discs_in_order():
    """Hard discs, dense and thin, and how many others each has at each distance."""
    count, bins, reach = 400, 60, 4.0
    drawing, lefts = frame(
        "Hard discs: a liquid and a crystal",
        "Discs that fill 0.72 of the plane order themselves; the radial distribution function g tells it.",
        ("0.72 of the plane filled", "distance of centres, in diameters"),
    )
    chart = Chart(drawing, lefts[1], (0, reach), (0, 6), "g", ((1, 2, 3), (1, 3, 5)))
    for packing, ink in ((0.3, "probe"), (0.72, "body")):
        side, world, _, motion = gas(count, packing, 1.0, 3)
        samples = []
        for time in range(1, 41):
            world.run(float(time), motion, ks.Bouncing(), events="none")
            if time > 20:
                centres = motion.states(float(time))[0][:, :2]
                box = ((0, 0), (side, side))
                samples.append(ks.radial_distribution(centres, box, reach, bins, dimensions=2))
        middles = (np.arange(bins) + 0.5) * reach / bins
        chart.curve(middles, np.mean(samples, axis=0), f"{ink}-line", stroke_width=2.5)
        if packing > 0.5:
            discs(drawing, lefts[0], centres, side, ["body"] * count)
    drawing.text(*chart.at(1.2, 5.0), "0.72", "body small")
    drawing.text(*chart.at(1.15, 2.2), "0.3", "probe small")
    return drawing


def atmosphere():
    """Discs under gravity, and how many there are at each height."""
    count, side, radius, layers, width = 400, 12.0, 0.02, 12, 0.5
    drawing, lefts = frame(
        "An atmosphere of 400 discs",
        "Under gravity the discs become fewer with the height as Boltzmann's factor says.",
        ("one moment", "height; line: Boltzmann"),
    )
    starts = [(0.6 * (k % 20) + 0.3, 0.2 + 0.25 * (k // 20)) for k in range(count)]
    velocities = random_velocities(count, 2.0, 5)
    air = ks.GameWorld(
        dimensions=2, box=((0, 0), (side, 60)), periodic="x", gravity=(0, -1), respond=ks.Bouncing()
    )
    air.add(starts, velocities, radius)
    air.step(60.0)
    inside, kinetic, moments = np.zeros(layers), 0.0, 100
    for _ in range(moments):
        air.step(0.5)
        heights = air.positions[:, 1] - radius
        for height in heights[heights < layers * width]:
            inside[int(height / width)] += 1 / moments
        kinetic += math.fsum((air.velocities**2).ravel()) / (2 * count * moments)
    at = panel(lefts[0], side)
    drawing.dots([at(place) for place in air.positions if place[1] < side], 2.2, "body")
    chart = Chart(drawing, lefts[1], (0, 6), (0, 120), "discs in a layer of 0.5", ((1, 3, 5), (50, 100)))
    heights = (np.arange(layers) + 0.5) * width
    factor = np.array([math.exp(-k * width / kinetic) for k in range(layers + 1)])
    chart.curve(heights, count * (factor[:-1] - factor[1:]), "quiet-line", stroke_width=2.5)
    chart.dots(heights, inside, "probe")
    return drawing


def packing():
    """Discs of two sizes that grow until none can move."""
    count, side = 200, 20.0
    drawing, lefts = frame(
        "200 discs grow until they jam",
        "Discs of two sizes fly, bounce off each other and grow, until none can move any more.",
        ("", ""),
    )
    sizes = np.where(np.arange(count) % 2, 1.0, 1.4)
    radii = 0.5 * sizes
    box = ((0, 0), (side, side))
    centres = ks.place_spheres(0.8 * radii, box, periodic=True, gap=1e-3, seed=2, dimensions=2)[:, :2]
    motion = ks.Ballistic(centres, random_velocities(count, 1.0, 7))
    world = ks.World(dimensions=2, box=box, periodic=True, contacts="impacts")
    ids = world.add_motion(motion, 0.8 * radii)
    rate = 0.004
    world.set_radius_rate(ids, rate * sizes)
    area = math.pi * math.fsum(sizes**2) / side**2

    def size():
        """The radius of a disc of size 1."""
        return 0.4 + rate * world.time

    def show(left):
        for ink, which in (("body", sizes == 1.0), ("probe", sizes == 1.4)):
            scale = SIDE / side
            radius = scale * size() * (1.0 if ink == "body" else 1.4)
            places = motion.states(world.time)[0][which, :2] % side
            drawing.dots([panel(left, side)(place) for place in places], radius, ink)

    show(lefts[0])
    time, begun = 0.0, size()
    while True:
        # Each contact adds the energy of the growth, so the discs are slowed down now and then.
        time += 0.25 if size() < 0.5 else 0.02
        world.run(time, motion, ks.Bouncing(), events="none")
        velocities = motion.states(time)[1][:, :2]
        energy = math.fsum((velocities**2).ravel()) / (2 * count)
        if energy > 1.5:
            break
        velocities /= math.sqrt(energy)
        motion.set_velocity(np.arange(count), time, velocities)
        world.set_velocity(ids, velocities)
    show(lefts[1])
    for left, filled in zip(lefts, (area * begun**2, area * size() ** 2), strict=True):
        drawing.text(left + SIDE / 2, TOP + SIDE + 12, f"{filled:.2f} of the plane", "quiet small", "middle")
    return drawing


def flock():
    """Birds that take the mean direction of those within a distance of 1, with little and with much noise."""
    count, side, speed, steps = 300, 10.0, 0.1, 150
    drawing, lefts = frame(
        "300 birds that follow their neighbours",
        "With little noise all birds fly alike in dense flocks; with much of it each flies as it likes.",
        ("little noise", "much noise"),
    )
    for left, noise in zip(lefts, (0.35, 1.2), strict=True):
        rng = np.random.default_rng(2)
        unit = lambda vectors: vectors / np.sqrt((vectors**2).sum(axis=1))[:, None]
        heading = unit(random_velocities(count, 1.0, 3))
        motion = ks.Ballistic(rng.uniform(0, side, (count, 2)), speed * heading)
        world = ks.World(box=((0, 0), (side, side)), periodic=True, dimensions=2)
        world.set_sensor(0, [1.0])
        ids = world.add_motion(motion, radii=0.0, solid=False)
        near = np.eye(count, dtype=bool)
        for step in range(1, steps + 1):
            events = world.run(step, motion)
            near[events["first"], events["second"]] = events["kind"] == ks.EventKind.sensor_enter
            near[events["second"], events["first"]] = events["kind"] == ks.EventKind.sensor_enter
            noises = unit(rng.uniform(-1, 1, (count, 2)))
            means = np.array([[math.fsum(column) for column in heading[each].T] for each in near])
            heading = unit(unit(means) + noise * noises)
            motion.set_velocity(np.arange(count), world.time, speed * heading)
            world.set_velocity(ids, speed * heading)
        places = motion.states(world.time)[0][:, :2] % side
        heads = [panel(left, side)(place) for place in places]
        drawing.tails(heads, [(-9 * u, 9 * v) for u, v in heading], "body")
        drawing.dots(heads, 2.4, "probe")
    return drawing


def heap():
    """Grains that fall between two walls and come to rest."""
    count, width, tall = 220, 10.0, 18.0
    drawing, lefts = frame(
        "220 grains come to rest",
        "Grains fall into a box, lose energy at each contact, and come to rest in a heap without overlap.",
        ("after 0.6 s", "after 2.5 s"),
    )
    radii = np.random.default_rng(4).uniform(0.22, 0.36, count)
    starts = np.array([(0.45 + 0.9 * (k % 11), 0.5 + 0.85 * (k // 11)) for k in range(count)])
    grains = ks.GameWorld(
        dimensions=2,
        box=((0, 0), (width, 60)),
        gravity=(0, -9.81),
        respond=ks.Bouncing(restitution=0.5, resting_speed=0.3),
        contact_tolerance=1e-4,
    )
    grains.add(starts, random_velocities(count, 0.5, 9), radii)
    scale = SIDE / tall
    for left, time in zip(lefts, (0.6, 2.5), strict=True):
        grains.step(time - grains.time)
        right = left + (SIDE - scale * width) / 2
        floor = TOP - 12 + SIDE - 2
        drawing.rect(right, floor - scale * 15, scale * width, scale * 15, "quiet-line")
        for (x, y, _), radius in zip(grains.positions, radii, strict=True):
            drawing.circle(right + scale * x, floor - scale * y, scale * radius, "body-area")
    return drawing


def piston():
    """A plate that pushes a gas of discs together, and the energy of the gas against its area."""
    count, side, radius, speed = 250, 10.0, 0.03, 0.01
    drawing, lefts = frame(
        "A piston compresses 250 discs",
        "Slowly compressed to half its area, the gas has twice its temperature, as an adiabatic change says.",
        ("half way", "height; line: adiabatic"),
    )
    rng = np.random.default_rng(6)
    starts = np.vstack([rng.uniform(radius, side - radius, (count, 2)), [(side / 2, side)]])
    velocities = np.vstack([random_velocities(count, 1.0, 8), [(0, -speed)]])
    motion = ks.Ballistic(starts, velocities)
    world = ks.World(dimensions=2, box=((0, 0), (side, side)), contacts="impacts")
    bodies = ks.BodyMap()
    for k in range(count):
        bodies.add(world, motion, k, radius)
    bodies.add_moving_shape(world, motion, count, ks.Box((-6, 0), (6, 1)), mass=math.inf)
    heights, warm = [], []
    free = lambda height: (height - 2 * radius) / (side - 2 * radius)
    for time in np.linspace(0, side / 2 / speed, 21):
        world.run(float(time), bodies, ks.Bouncing(), events="none")
        states = motion.states(float(time))
        heights.append(side - speed * time)
        warm.append(math.fsum((states[1][:count, :2] ** 2).ravel()) / (2 * count))
        if len(heights) == 11:
            scale = SIDE / (side + 1)
            at = lambda x, y: (lefts[0] + scale * (x + 0.5), TOP - 12 + SIDE - scale * (y + 0.2))
            drawing.dots([at(x, y) for x, y in states[0][:count, :2]], 2.0, "body")
            drawing.rect(*at(0, heights[-1] + 1), scale * side, scale, "probe-area")
            drawing.rect(*at(0, side), scale * side, scale * side, "quiet-line")
    chart = Chart(drawing, lefts[1], (side, side / 2), (0.8, 2.2), "temperature", ((9, 7), (1, 2)))
    chart.curve(heights, [warm[0] / free(height) for height in heights], "quiet-line", stroke_width=2.5)
    chart.dots(heights, warm, "probe")
    return drawing


def orbits():
    """Planetesimals on ellipses that cross the circular orbit of a planet, and how often they hit it."""
    count, a, e, tilt, radius, periods = 200, 1.3, 0.4, 0.3, 0.05, 60
    drawing, lefts = frame(
        "Planetesimals that cross the orbit of a planet",
        "200 ellipses of one size, shape and inclination, and the number of hits beside Opik's probability.",
        ("a moment, from above", "periods; line: expected hits"),
    )
    rng = np.random.default_rng(1)
    angles = rng.uniform(0, 2 * math.pi, (count, 3))
    wide, rate = math.sqrt(1 - e * e), a**-1.5

    def frame_of(node, periapsis):
        turn = lambda angle: (
            math.cos(node) * math.cos(angle) - math.sin(node) * math.sin(angle) * math.cos(tilt),
            math.sin(node) * math.cos(angle) + math.cos(node) * math.sin(angle) * math.cos(tilt),
            math.sin(angle) * math.sin(tilt),
        )
        return np.array([turn(periapsis), turn(periapsis + math.pi / 2)])

    frames = np.array([frame_of(node, periapsis) for node, periapsis, _ in angles])

    def states(ids, time):
        """Positions and velocities; the planet is body 0."""
        positions, velocities = np.empty((len(ids), 3)), np.empty((len(ids), 3))
        for place, body in enumerate(ids):
            if body == 0:
                positions[place] = math.cos(time), math.sin(time), 0
                velocities[place] = -math.sin(time), math.cos(time), 0
                continue
            mean = math.remainder(angles[body - 1, 2] + rate * time, 2 * math.pi)
            E = mean + e * math.sin(mean)
            for _ in range(5):
                E -= (E - e * math.sin(E) - mean) / (1 - e * math.cos(E))
            along, across = frames[body - 1]
            speed = a * rate / (1 - e * math.cos(E))
            positions[place] = a * ((math.cos(E) - e) * along + wide * math.sin(E) * across)
            velocities[place] = speed * (wide * math.cos(E) * across - math.sin(E) * along)
        return positions, velocities

    world = ks.World()
    starts = states(range(count + 1), 0.0)
    limits = np.full(count + 1, (a - a * e) ** -2 * (1 + 1e-9))
    limits[0] = 1 + 1e-9
    kinds = np.where(np.arange(count + 1) == 0, 2, 1)
    world.add(
        *starts,
        np.where(kinds == 2, radius, 0.0),
        acceleration_limits=limits,
        categories=kinds,
        masks=3 - kinds,
    )
    period = 2 * math.pi * a**1.5
    events = world.run(periods * period, states)
    hits = events.of_kind(ks.EventKind.contact_begin)["time"] / period
    scale = SIDE / 4.2
    centre = (lefts[0] + SIDE / 2, TOP - 12 + SIDE / 2)
    at = lambda place: (centre[0] + scale * place[0], centre[1] - scale * place[1])
    drawing.circle(*centre, scale, "quiet-line")
    drawing.circle(*centre, 6.0, "open-area")
    now = states(range(count + 1), 0.0)[0]
    drawing.dots([at(place) for place in now[1:]], 1.8, "body")
    drawing.circle(*at(now[0]), scale * radius, "probe-area")
    U = math.sqrt(3 - 1 / a - 2 * math.sqrt(a * (1 - e * e)) * math.cos(tilt))
    radial = math.sqrt(2 - 1 / a - a * (1 - e * e))
    each = count * radius**2 * U / (math.pi * math.sin(tilt) * radial)
    chart = Chart(drawing, lefts[1], (0, periods), (0, 1.3 * each * periods), "hits", ((20, 40), (20, 40)))
    chart.curve((0, periods), (0, each * periods), "quiet-line", stroke_width=2.5)
    steps = [(0.0, 0)] + [(time, n + k) for n, time in enumerate(hits) for k in (0, 1)]
    chart.curve(*zip(*steps, strict=True), "probe-line", stroke_width=2.0)
    return drawing


DRAWINGS = {
    "well": well,
    "chain": chain,
    "cooling": cooling,
    "discs": discs_in_order,
    "atmosphere": atmosphere,
    "packing": packing,
    "flock": flock,
    "heap": heap,
    "piston": piston,
    "orbits": orbits,
}
