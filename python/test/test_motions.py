"""Ready-made motions, maps of several, frames of a game."""

import copy
from typing import Any

import numpy as np
import pytest
from conftest import hash_of, pair

import kinesphere as ks
from kinesphere import EventKind

rng = np.random.default_rng(11)
positions = rng.uniform(5, 45, (40, 3))
velocities = rng.uniform(-3, 3, (40, 3))
box = ((0, 0, 0), (50, 50, 50))


@pytest.mark.parametrize(
    "make",
    [
        lambda: ks.Ballistic(positions, velocities, gravity=(0, 0, -1)),
        lambda: ks.RandomForces(positions, velocities, 5.0, seed=3),
        lambda: ks.SteeredMotion(positions, velocities, np.full(40, 2.0)),
        lambda: ks.VelocityField(ks.Circulation(ks.Box(*box), 4.0), positions, velocities, 6.0),
    ],
    ids=["ballistic", "random forces", "steered", "velocity field"],
)
def test_motions_serve_runs_loops_and_probes_alike(make) -> None:  # type: ignore[no-untyped-def]
    hashes = set()
    for way in range(3):
        motion = make()
        assert len(motion) == 40 and 39 in motion and 40 not in motion and -1 not in motion
        world = ks.World(box=box)
        if way == 0:
            world.add_motion(motion, radii=1.5)
        else:
            world.add(**motion.definitions(0.0), radii=1.5)
        probe = motion if way < 2 else lambda ids, t: motion(ids, t)
        hashes.add(hash_of(world.run(3.0, probe)))
    assert len(hashes) == 1
    assert len(motion.states(3.0)[0]) == 40 and motion.states(3.0, [4, 5])[1].shape == (2, 3)


def test_copies_go_their_own_way() -> None:
    motion = ks.RandomForces(positions, velocities, 5.0)
    other = copy.copy(motion)
    assert isinstance(other, ks.RandomForces)
    motion.set_velocity(0, 1.0, (0, 0, 0))
    assert motion.origin(0)[0] == 1.0 and other.origin(0)[0] == 0.0
    assert not np.array_equal(motion.states(2.0)[0], other.states(2.0)[0])


def test_bodies_come_go_and_move_to_another_motion() -> None:
    motion = ks.SteeredMotion(positions, velocities, 2.0)
    number = motion.add(1.0, (0, 0, 0), (1, 0, 0), 3.0)
    motion.steer(number, 1.0, (0, 3, 0))
    motion.teleport(0, 1.0, (9, 9, 9), (0, 0, 0))
    assert motion.states(1.0, 0)[0].tolist() == [[9, 9, 9]]
    other = ks.SteeredMotion([], start_time=0.0)
    arrived = other.read_body(motion.write_body(number))
    assert arrived == 0 and np.array_equal(other.states(5.0)[0][0], motion.states(5.0, number)[0][0])
    motion.remove(number)
    assert number not in motion
    with pytest.raises(ks.BodyError, match="stale|removed"):
        motion.states(5.0, number)


def test_many_bodies_are_changed_at_once_or_none() -> None:
    motion = ks.SteeredMotion(positions, velocities, 2.0)
    motion.set_velocity(np.arange(40), 1.0, -velocities)
    assert np.array_equal(motion.states(1.0)[1], -velocities)
    before = motion.states(2.0)
    for numbers, t in (([0, 1, 0, 40], 1.5), ([0, -1], 1.5), ([3, 4], 0.5)):
        with pytest.raises((ks.BodyError, ks.InvalidValue)):
            motion.set_velocity(numbers, t, np.ones((len(numbers), 3)))
        with pytest.raises((ks.BodyError, ks.InvalidValue)):
            motion.teleport(numbers, t, np.ones((len(numbers), 3)), np.zeros((len(numbers), 3)))
    assert all(np.array_equal(a, b) for a, b in zip(before, motion.states(2.0)))
    motion.teleport([4, 2], 2.0, [(1, 2), (3, 4)], np.zeros((2, 2)))
    assert motion.states(2.0, [2, 4])[0].tolist() == [[3, 4, 0], [1, 2, 0]]
    with pytest.raises(ks.InvalidValue, match=r"velocities must have shape .* with n = 2"):
        motion.set_velocity([0, 1], 3.0, (1, 2, 3))


def test_wrong_bodies_and_times_of_a_motion_are_named() -> None:
    motion = ks.Ballistic(positions)
    for wrong in (40, -1, 2**40):
        with pytest.raises(ks.BodyError) as caught:
            motion.states(0.0, [wrong])
        assert caught.value.code == "unknown_body"
    with pytest.raises(ks.InvalidValue, match="time|before"):
        motion.states(-1.0)
    with pytest.raises(ks.InvalidValue):
        motion.states(float("nan"))
    with pytest.raises(ks.InvalidValue, match="acceleration"):
        ks.SteeredMotion(positions, acceleration_limits=1.0).steer(0, 0.0, (5, 0, 0))
    with pytest.raises(ks.InvalidValue, match="acceleration_limit"):
        ks.RandomForces(positions, acceleration_limits=-1.0)


def test_a_map_adds_bodies_with_masses_and_contacts() -> None:
    motion = ks.Ballistic([(0, 0, 0), (5, 0, 0)], [(1, 0, 0), (0, 0, 0)])
    world, bodies = ks.World(), ks.BodyMap()
    bodies.add(world, motion, 0, mass=2.0, contacts="impacts")
    bodies.add(world, motion, 1, mass=3.0, contacts="impacts")
    (hit,) = world.run(9.0, bodies)  # and no contact_end
    assert (hit.first_mass, hit.second_mass) == (2.0, 3.0)
    world, bodies = ks.World(), ks.BodyMap()
    bodies.add_all(world, motion, mass=4.0)
    assert [event.first_mass for event in world.run(9.0, bodies)] == [4.0, 4.0]
    with pytest.raises(ks.InvalidValue, match="add_all: contacts must be"):
        bodies.add_all(world, motion, contacts="some")  # type: ignore[arg-type]


def test_a_map_has_several_motions() -> None:
    targets = ks.SteeredMotion([(30, 0, 0), (60, 0, 0)])
    bullets = ks.Ballistic([])
    world, bodies = ks.World(contacts="impacts"), ks.BodyMap()
    ids = bodies.add_all(world, targets, radii=[1.0, 2.0])
    bullet = bodies.add(world, bullets, bullets.add(0.0, (0, 0, 0), (300, 0, 0)), radius=0.02)
    assert bodies.find(bullet) == (bullets, 0) and bodies.find(77) is None and ids.tolist() == [0, 1]
    for event in world.events(1.0, bodies):
        assert event.kind == EventKind.contact_begin and event.first == 0 and event.second == bullet
        bodies.remove(world, bullet)
        bodies.set_velocity(world, 0, (0, 1, 0))
        bodies.teleport(world, 1, (90, 0, 0), (0, 0, 0))
    assert len(world) == 2 and targets.states(1.0)[1][0].tolist() == [0, 1, 0] and len(bullets) == 1
    fresh = bodies.add(world, bullets, bullets.add(1.0, (0, 0, 0), (1, 0, 0)))
    del targets, bullets
    world.run(5.0, bodies, ks.Bouncing())
    assert fresh in world
    with pytest.raises(ks.BodyError):
        bodies.set_velocity(world, bullet, (0, 0, 0))


class Game:
    """Steered targets and a bullet in each frame, with what a game keeps beside its world."""

    def __init__(self) -> None:
        self.world, self.bodies = ks.World(contact_tolerance=1e-4), ks.BodyMap()
        places = [(3.0 * (k % 8) - 12, 3.0 * (k // 8) - 12, 0) for k in range(64)]
        self.ships = ks.SteeredMotion(places, acceleration_limits=5.0)
        self.bullets = ks.Ballistic([])
        self.ids = self.bodies.add_all(self.world, self.ships, radii=0.6, category=1)
        self.flying: list[ks.BodyId] = []
        self.hits = 0
        self.hash = ks.EventHash()

    def play_frame(self, frame: int, aim: float) -> None:
        now = self.world.time
        self.ships.steer(frame % 64, now, (4 * np.sin(frame), 4 * np.cos(frame), 0))
        number = self.bullets.add(now, (-30, 10 * aim, 0), (300, 0, 0))
        self.flying.append(self.bodies.add(self.world, self.bullets, number, radius=0.02, category=2, mask=1))
        if len(self.flying) > 12:
            self.bodies.remove(self.world, self.flying.pop(0))
        for event in self.world.events((frame + 1) / 60, self.bodies):
            self.hash.add(event)
            if event.kind == EventKind.contact_begin and event.second in self.flying:
                self.bodies.remove(self.world, event.second)
                self.flying.remove(event.second)
                self.hits += 1


def test_a_game_goes_back_eight_frames_in_each_frame() -> None:
    frames, delay = 60, 8
    in_time = Game()
    for frame in range(frames):
        in_time.play_frame(frame, np.sin(0.7 * frame))
    game = Game()
    past: list[Game] = []
    for frame in range(frames + delay):
        known = frame - delay
        if known >= 0:
            game, past = past[0], []
        for again in range(known if known >= 0 else frame, min(frame + 1, frames)):
            if again > known:
                past.append(copy.deepcopy(game))
            game.play_frame(again, np.sin(0.7 * again) if again <= known else 1.0)
    assert in_time.hits > 20 and game.hits == in_time.hits
    assert game.hash == in_time.hash and game.world.save() == in_time.world.save()
    later = copy.deepcopy(game)
    assert later.bodies.find(later.ids[3]) == (later.ships, 3), "the map knows the copies of the motions"
    later.bodies.set_velocity(later.world, later.ids[3], (9, 0, 0))
    now = game.world.time
    assert later.ships.states(now)[1][3].tolist() == [9, 0, 0]
    assert game.ships.states(now)[1][3].tolist() != [9, 0, 0]


def test_frames_of_a_game() -> None:
    places = np.array([[0.0, 0, 10], [0.0, 0, 30]])
    speeds, gravity, dt = np.zeros((2, 3)), np.array([0, 0, -10.0]), 1 / 60
    for limits in (np.inf, 10.2):
        frames = ks.FrameMotion(places, speeds, limits, interval=dt)
        world, bodies = ks.World(contacts="impacts"), ks.BodyMap()
        ids = bodies.add_all(world, frames, radii=0.5)
        floor = world.add_static(ks.HalfSpace((0, 0, 1), 0))
        at, speed = places, speeds.copy()
        hits = []
        for _ in range(120):
            speed = speed + gravity * dt
            bodies.push(world, frames, at + speed * dt)
            for event in world.events(frames.latest_time, bodies):
                assert event.kind == EventKind.contact_begin and event.second == floor
                hits.append(event.time)
                speed[event.first] = -event.first_velocity
                bodies.set_velocity(world, event.first, speed[event.first])
            at = frames.latest()
        assert len(hits) == 1 and hits[0] == pytest.approx(np.sqrt(2 * 9.5 / 10), abs=0.02)
        assert frames.violation_count == 0 and frames.violations() == []
    bodies.push(world, frames, at + 5)
    assert [violation[0] for violation in frames.violations()] == [0, 1]
    assert world.body(ids[0]).velocity == pytest.approx(np.full(3, 5 / dt))
    with pytest.raises(ks.InvalidValue, match="positions"):
        bodies.push(world, frames, at[:1])


def test_frames_of_unequal_length_have_times() -> None:
    places, time = np.array([[0.0, 0, 0], [4.0, 0, 0]]), 0.0
    frames = ks.FrameMotion(places)
    world, bodies = ks.World(contacts="impacts"), ks.BodyMap()
    bodies.add_all(world, frames, radii=0.5)
    begins: list[ks.Event] = []
    for frame in range(60):
        dt = 0.03 if frame % 2 == 0 else 0.01
        time += dt
        places[0, 0] += 3.0 * dt
        bodies.push(world, frames, places, time)
        assert frames.latest_time == time and not frames.has_equal_frames
        begins += world.events(time, bodies)
    assert begins[0].time == pytest.approx(1.0, abs=1e-6)
    assert begins[0].approach_speed == pytest.approx(3.0)
    with pytest.raises(ks.InvalidValue, match="time must bring the next frame after the latest one"):
        bodies.push(world, frames, places, time)
    limited = ks.FrameMotion([(0, 0, 0)], acceleration_limits=1.0, interval=0.5)
    limited.push([(0.1, 0, 0)], 0.4)
    limited.push([(0.1, 0, 0)])
    assert (limited.previous_time, limited.latest_time) == (0.4, 0.9)


def about_z(angle: float) -> tuple[float, float, float, float]:
    return (float(np.cos(angle / 2)), 0.0, 0.0, float(np.sin(angle / 2)))


@pytest.mark.parametrize("limit", [0.0, 1.0])
def test_a_box_turns_from_frame_to_frame(limit: float) -> None:
    frames = ks.FrameMotion([(0, 0, 0), (0, 1.5, 0)], interval=1.0, rotations=[about_z(0), about_z(0)])
    world, bodies = ks.World(contacts="impacts"), ks.BodyMap()
    box = [ks.Hull([(x, y, 0) for x in (-1.8, 1.8) for y in (-0.1, 0.1)], 0.1)]
    car = bodies.add_rigid_body(
        world, frames, 0, box, angular_acceleration_limit=limit, largest_angular_speed=9.0
    )
    bodies.add(world, frames, 1, 0.3)
    world.set_rotation_probe(bodies.rotations)
    bodies.push(world, frames, frames.latest(), rotations=[about_z(np.pi / 2), about_z(0)])
    (begin,) = world.events(1.0, bodies)
    assert begin.approach_speed == pytest.approx(1.5 * np.pi / 2 * np.cos(np.arcsin(0.5 / 1.5)), rel=0.01)
    assert begin.time == pytest.approx(1 - np.arcsin(0.5 / 1.5) / (np.pi / 2), abs=1e-4)
    orientations, spins = bodies.rotations([car], 0.5)
    assert orientations[0] == pytest.approx(about_z(np.pi / 4))
    assert spins[0] == pytest.approx((0, 0, np.pi / 2))
    turned = frames.latest_rotations()
    assert turned is not None and turned[0] == pytest.approx(about_z(np.pi / 2))
    with pytest.raises(ks.InvalidValue, match="rotations must have one entry per body, 2, but is 0"):
        bodies.push(world, frames, frames.latest())
    with pytest.raises(ks.InvalidValue, match=r"rotations must be quaternions .* of shape \(n, 4\)"):
        bodies.push(world, frames, frames.latest(), rotations=[(1, 0, 0)])
    assert frames.add(1.0, (0, 0, 9), (0, 0, 0), orientation=about_z(1.0)) == 2
    assert ks.FrameMotion([(0, 0, 0)]).latest_rotations() is None


def test_a_jump_of_a_frame_meets_what_is_on_its_way() -> None:
    places = np.array([[0.0, 0, 0], [-5.0, 0, 0]])
    frames = ks.FrameMotion(places, interval=1.0)
    world = ks.World()
    world.add_motion(frames, radii=1.0)
    frames.push(world, places)
    assert len(world.run(1.0, frames)) == 0
    places[1, 0] = 5.0
    with pytest.raises(ks.InvalidValue, match=r"body 1 give it a new velocity.*push\(world, positions\)"):
        frames.push(places)
    frames.push(world, places)
    begin = world.advance(2.0, frames)
    assert begin is not None and begin.kind == EventKind.contact_begin
    assert begin.time == pytest.approx(1.3, abs=1e-6)
    with pytest.raises(ks.InvalidValue, match="latest frame"):
        frames.push(world, places)


def test_the_entry_of_a_removed_body_moves_no_other() -> None:
    frames = ks.FrameMotion([(0, 0, 0), (40, 0, 0)], interval=1.0)
    world, bodies = ks.World(), ks.BodyMap()
    ids = bodies.add_all(world, frames)
    places = frames.latest()
    bodies.remove(world, ids[1])
    with pytest.raises(ks.BodyError, match="positions of body 1 must be NaN") as caught:
        bodies.push(world, frames, places)
    assert caught.value.code == "stale_body"
    places[1] = np.nan
    bodies.push(world, frames, places)
    assert len(world.run(1.0, bodies)) == 0
    assert frames.add(1.0, (-40, 0, 0), (0, 0, 0)) == 1
    spawned = bodies.add(world, frames, 1)
    with pytest.raises(ks.InvalidValue, match="positions of body 1 must be finite"):
        bodies.push(world, frames, places)
    bodies.push(world, frames, frames.latest())
    assert len(world.run(2.0, bodies)) == 0
    assert world.body(spawned).position.tolist() == [-40, 0, 0]


def test_recorded_tracks() -> None:
    times = np.linspace(0, 4, 9)
    motion = ks.RecordedTracks(
        [(times, np.stack([times, 0 * times], axis=1)), ([0, 4], [[4, 0.5, 0], [0, 0.5, 0]])]
    )
    world = ks.World()
    world.add_motion(motion, radii=0.3)
    begin = world.advance(4.0, motion)
    assert begin is not None and begin.time == pytest.approx(2 - np.sqrt(0.36 - 0.25) / 2, abs=1e-5)
    with pytest.raises(ks.StateError) as caught:
        motion.set_velocity(0, 1.0, (0, 0, 0))
    assert caught.value.code == "unsupported"
    with pytest.raises(ks.InvalidValue):
        ks.RecordedTracks([([0.0], [[0, 0, 0]])])
    with pytest.raises(ks.InvalidValue, match="pairs"):
        ks.RecordedTracks([([0.0, 1.0],)])  # type: ignore[list-item]


def test_recorded_tracks_outside_of_their_samples() -> None:
    samples = [([0, 1, 2], [[0, 0, 0], [3, 0, 0], [4, 0, 0]])]
    places, velocities = ks.RecordedTracks(samples).states(4.0)
    assert velocities[0][0] > 0 and places[0][0] == pytest.approx(4 + 2 * velocities[0][0])
    stays = ks.RecordedTracks(samples, outside="stay")
    for time, x in ((9.0, 4), (-9.0, 0)):
        places, velocities = stays.states(time)
        assert places[0] == pytest.approx([x, 0, 0], abs=1e-12)
        assert velocities[0] == pytest.approx([0, 0, 0], abs=1e-12)
    vanishes = copy.copy(ks.RecordedTracks(samples, outside="vanish"))
    assert vanishes.span(0) == (0.0, 2.0)
    assert vanishes.states(2.0)[0][0][0] == pytest.approx(4)
    with pytest.raises(
        ks.InvalidValue, match="must not lie after its last sample, because it has vanished"
    ) as error:
        vanishes.states(2.5)
    assert error.value.code == "out_of_range"
    with pytest.raises(ks.InvalidValue, match="'go-on', 'stay' or 'vanish'"):
        ks.RecordedTracks(samples, outside="leave")  # type: ignore[arg-type]
    pair = ks.RecordedTracks([*samples, ([0, 2], [[9, 0, 0], [6, 0, 0]])], outside="vanish")
    world = ks.World()
    world.add_motion(pair, radii=0.5)
    assert len(world.run(2.0, pair)) == 0
    with pytest.raises(ks.InvalidValue, match="has vanished"):
        world.run(9.0, pair)


def test_a_motion_is_added_where_its_numbers_are_ids() -> None:
    world, motion = pair()
    with pytest.raises(ks.InvalidValue, match="without bodies"):
        world.add_motion(motion)
    world.remove(world.bodies())
    with pytest.raises(ks.InvalidValue, match="never had bodies"):
        world.add_motion(motion)
    assert len(world) == 0


def test_bodies_of_a_motion_have_traits_as_those_of_add() -> None:
    motion = ks.Ballistic(positions, velocities)
    world = ks.World()
    categories = np.where(np.arange(40) < 20, 1, 2)
    world.add_motion(
        motion, np.linspace(1, 2, 40), categories=categories, masks=2, group=-3, solid=False,
        sensor_classes=7, user_data=np.arange(40), masses=3.0, contacts="impacts",
    )  # fmt: skip
    last = world.body(39)
    assert (last.category, last.mask, last.group, last.solid) == (2, 2, -3, False)
    assert (last.sensor_class, last.user_data, last.radius) == (7, 39, 2.0) and world.body(0).category == 1
    with pytest.raises(
        ks.InvalidValue, match="add_motion: user_data must be one number, or one for each of 40"
    ):
        ks.World().add_motion(motion, user_data=[1, 2])


def straight_on(ids: Any, t: float, since: Any, places: Any, speeds: Any) -> tuple[Any, Any]:
    assert (
        ids.shape == (len(since),)
        and since.shape == (len(ids), 1)
        and places.shape == speeds.shape == (len(ids), 3)
    )
    return places + speeds * (t - since), speeds


@pytest.mark.parametrize("threads", [1, 2])
def test_a_mover_of_numpy_is_answered_as_a_motion_is(threads: int) -> None:
    scene = ks.Scene("gas", bodies=200, seconds=2.0)
    world, motion = ks.World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    expected = hash_of(world.run(2.0, motion, scene))
    start = scene.motion().definitions(0.0)
    world = ks.World(**scene.definition)
    world.add(**start, radii=scene.radii)
    mover = ks.MotionSource(straight_on, start["positions"], start["velocities"])
    probed = copy.copy(mover)
    assert hash_of(world.run(2.0, mover, scene, threads=threads)) == expected
    assert np.array_equal(mover(np.arange(200), 2.0)[0], motion.states(2.0)[0])
    # Compares with a loop that passes its changes to the motion.
    world = ks.World(**scene.definition)
    world.add(**start, radii=scene.radii)
    hash = ks.EventHash()
    for event in world.events(0.5, probed):
        hash.add(event)
        one, other = event.first, event.second
        first, second = ks.bounce(event, scene.masses[one], scene.masses[other] if other is not None else 1.0)
        probed.set_origin(one, event.time, event.first_position, first)
        world.set_velocity(one, first)
        if other is not None and second is not None:
            probed.set_origin([other], event.time, [event.second_position], [second])
            world.set_velocity(other, second)
    again, motion = ks.World(**scene.definition), scene.motion()
    again.add_motion(motion, scene.radii)
    assert str(hash) == hash_of(again.run(0.5, motion, scene))


def test_a_mover_is_called_once_for_each_instant() -> None:
    scene = ks.Scene("gas", bodies=500, seconds=2.0)
    start = scene.motion().definitions(0.0)
    world = ks.World(**scene.definition)
    world.add(**start, radii=scene.radii)
    times, asked = [], 0

    def counted(ids: Any, t: float, since: Any, positions: Any, velocities: Any) -> tuple[Any, Any]:
        nonlocal asked
        times.append(t)
        asked += len(ids)
        return straight_on(ids, t, since, positions, velocities)

    world.run(2.0, ks.MotionSource(counted, start["positions"], start["velocities"]), scene)
    # But for spot checks, which may come where windows start.
    assert len(times) - len(set(times)) <= 8 and asked > 1.5 * len(times) > 100


def test_wrong_movers_are_named() -> None:
    with pytest.raises(TypeError, match="function must be a function"):
        ks.MotionSource(5, positions)  # type: ignore[arg-type]
    with pytest.raises(ks.InvalidValue, match="velocities must have shape"):
        ks.MotionSource(straight_on, positions, velocities[1:])
    mover = ks.MotionSource(straight_on, positions, velocities)
    world = ks.World()
    world.add(positions, velocities)
    newcomer = world.add((60, 0, 0), (-1, 0, 0), acceleration_limits=50.0)
    with pytest.raises(ks.BodyError, match="does not of body 40"):
        world.run(1.0, mover, ks.Bouncing())
    mover.set_origin(newcomer, 0.0, (60, 0, 0), (-1, 0, 0))
    world.run(1.0, mover, ks.Bouncing())
    assert len(mover) == 41
    with pytest.raises(ks.InvalidValue, match="bodies"):
        mover.set_origin(2**31, 0.0, (0, 0, 0), (0, 0, 0))
    with pytest.raises(ks.InvalidValue):
        mover.set_origin([1, 2], 0.0, [(0, 0, 0)], [(0, 0, 0)])
    broken = ks.MotionSource(
        lambda ids, t, since, places, speeds: (places, speeds[:, :1]), positions, velocities
    )
    world = ks.World()
    world.add(positions, velocities, acceleration_limits=1.0)
    with pytest.raises(ks.InvalidValue, match="velocities of the probe must have shape"):
        world.run(5.0, broken, ks.Bouncing())
