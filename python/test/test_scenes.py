"""Hashes are those of the program."""

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


def test_what_is_no_scene_is_refused() -> None:
    with pytest.raises(ks.InvalidValue, match='name must be one of scene_names\\(\\), but is "nobody"'):
        ks.Scene("nobody")
    with pytest.raises(ks.InvalidValue, match="packing"):
        ks.Scene("paper1", packing=2.0)
