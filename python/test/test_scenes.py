"""Hashes are those of the program."""

import pickle
from pathlib import Path

import pytest
from conftest import hash_of, native

import kinesphere as ks


@pytest.mark.parametrize("name", ks.scene_names())
@pytest.mark.parametrize("threads", [1, 2])
def test_a_scene_has_the_hash_of_the_program(name: str, threads: int) -> None:
    bodies, seconds = 80, 1.0
    expected = native(
        "run", name, "--bodies", str(bodies), "--seconds", str(seconds), "--seed", "7", "--hash-only"
    )
    if expected is None:
        pytest.skip("KINESPHERE_PROGRAM does not say where the program is")
    scene = ks.Scene(name, bodies=bodies, seconds=seconds, seed=7)
    world, motion = ks.World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    assert hash_of(world.run(scene.end_time, motion, scene, threads=threads)) == expected
    assert len(scene) == bodies and scene.end_time == seconds


def test_bouncing_with_the_masses_of_a_scene_is_the_scene() -> None:
    scene = ks.Scene("paper1", bodies=60, seconds=1.0)
    hashes = set()
    responses: list[ks.Scene | ks.Bouncing] = [scene, ks.Bouncing(scene.masses, scene.restitution)]
    for respond in responses:
        world, motion = ks.World(**scene.definition), scene.motion()
        world.add_motion(motion, scene.radii)
        hashes.add(hash_of(world.run(1.0, motion, respond)))
    assert len(hashes) == 1


@pytest.mark.parametrize("name", ["crossing", "falling"])
def test_a_scene_file_is_read_as_the_program_reads_it(name: str) -> None:
    file = Path(__file__).parents[2] / "examples" / "scenes" / f"{name}.json"
    scene = pickle.loads(pickle.dumps(ks.read_scene(file)))
    assert scene.name == name
    world, motion = ks.World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    expected = native("run", str(file), "--hash-only")
    if expected is not None:
        assert hash_of(world.run(scene.end_time, motion, scene)) == expected


@pytest.mark.parametrize(
    "text, culprit",
    [
        ("{", "file"), ("[1]", "file"), ('{"seed": 1, "seed": 2}', "file"), ('{"seconds": NaN}', "file"),
        ("[" * 100000, "file"), ('{"colour": 1}', "colour"), ('{"radius": [1, 2, 3]}', "radius"),
        ('{"motion": "brownian"}', "motion"), ('{"bodies": -1}', "bodies"), ('{"box": [[0, 0, 0]]}', "box"),
        ('{"gravity": 9.81}', "gravity"), ('{"periodic": "x"}', "periodic"), ('{"packing": 2}', "packing"),
    ],
)  # fmt: skip
def test_what_is_no_scene_file_is_refused(text: str, culprit: str, tmp_path: Path) -> None:
    (tmp_path / "scene.json").write_text(text)
    with pytest.raises(ks.InvalidValue) as refused:
        ks.read_scene(tmp_path / "scene.json")
    assert refused.value.argument == culprit and culprit in str(refused.value)


def test_what_is_no_scene_is_refused() -> None:
    with pytest.raises(ks.InvalidValue, match='name must be one of scene_names\\(\\), but is "nobody"'):
        ks.Scene("nobody")
    with pytest.raises(ks.InvalidValue, match="packing"):
        ks.Scene("paper1", packing=2.0)
