"""Scenes: what is in them, and what is said of those that are wrong."""

import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import adstar
from adstar import _core
from programs import PROGRAMS, SCENES, adstar as program

FREE = """
[simulation]
step = "10ms"

[[spacecraft]]
name = "sat1"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]
"""


def test_a_scene_says_what_its_file_says():
    scene = adstar.load_scene(SCENES / "wheels.toml")
    assert (scene.names, scene.step_s, scene.duration_s, scene.scheme) == (["sat1"], 0.01, None, "coadjoint_rk4")
    craft = scene.spacecraft()
    assert craft.wheels == ("wheel_x", "wheel_y", "wheel_z", "ring")
    assert craft.actuators == ("wheel_x", "wheel_y", "wheel_z")
    np.testing.assert_array_equal(craft.inertia_body_kg_m2, np.diag([85.0, 72.0, 68.9]))
    np.testing.assert_array_equal(craft.q_IB, [1, 0, 0, 0])


def test_momentum_at_the_start_is_inertia_times_rate():
    craft = adstar.parse_scene(FREE).spacecraft("sat1")
    np.testing.assert_allclose(
        craft.momentum_inertial_n_m_s, craft.inertia_body_kg_m2 @ craft.angular_velocity_body_rad_s, rtol=1e-15
    )


def test_every_complaint_of_the_loader_comes_with_its_place_and_remedy():
    wrong = FREE.replace("inertia_body_kg_m2", "inertia_body_kg_m").replace("10ms", "10mz")
    with pytest.raises(adstar.SceneError) as caught:
        adstar.parse_scene(wrong, "my.toml")
    first, *others = str(caught.value).splitlines()
    assert first.startswith("my.toml:3:8: simulation.step: got ")
    assert any(line.startswith("my.toml:7:1: ") and "try inertia_body_kg_m2" in line for line in others), others
    assert isinstance(caught.value, ValueError)


def test_a_scene_that_is_not_there_is_an_error_of_the_scene():
    with pytest.raises(adstar.SceneError, match="nowhere.toml"):
        adstar.load_scene("nowhere.toml")


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (dict(), "the scene is endless; say how long, for example duration_s=100"),
        (dict(duration_s=0.015), "duration_s=0.015 is not whole steps of 10ms; try duration_s=0.01 or 0.02"),
        (dict(duration_s=1, every_s=0.015), "every_s=0.015 is not whole steps of 10ms; try every_s=0.01 or 0.02"),
        (dict(duration_s=1, step_s=1 / 3), "step_s: got .* expected whole nanoseconds; try 0.333333333"),
        (dict(duration_s=-1), "duration_s: got -1.*expected seconds"),
        (dict(duration_s=float("nan")), "duration_s: got nan"),
        (dict(duration_s=1, scheme="rkmk"), "scheme: got 'rkmk', expected one of .*; try rkmk4"),
        (dict(duration_s=1, spacecraft="sat"), 'spacecraft: got "sat", expected one of sat1; try .sat1'),
    ],
)
def test_what_cannot_be_propagated_says_what_can(asked, said):
    with pytest.raises(ValueError, match=said):
        adstar.parse_scene(FREE).propagate(**asked)


def test_of_several_spacecraft_one_must_be_named():
    two = adstar.parse_scene(FREE + FREE[FREE.index("[[") :].replace("sat1", "sat2"))
    with pytest.raises(ValueError, match=r"2 spacecraft \(sat1, sat2\): say which, spacecraft='sat1'"):
        two.propagate(1)
    assert list(two.propagate_all(1)) == ["sat1", "sat2"]
    assert list(two.propagate_all(1, spacecraft=["sat2"])) == ["sat2"]
    for wrong in ([], ["sat1", "sat1"]):
        with pytest.raises(ValueError, match="expected names, each once"):
            two.propagate_all(1, spacecraft=wrong)


def assert_same_scene(scene, again):
    assert (again.file, again.names, again.scheme) == (scene.file, scene.names, scene.scheme)
    motion, motion_again = scene.propagate(40, 20), again.propagate(40, 20)
    np.testing.assert_array_equal(motion_again.q_IB, motion.q_IB)
    np.testing.assert_array_equal(motion_again.work_j, motion.work_j)


def test_a_scene_is_pickled_as_what_it_was_read_from():
    for scene in (adstar.load_scene(SCENES / "profile_table.toml"), adstar.parse_scene(FREE, "my.toml")):
        assert_same_scene(scene, pickle.loads(pickle.dumps(scene)))
        assert_same_scene(scene, copy.deepcopy(scene))


def test_a_pickled_scene_is_as_its_file_was_then(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(FREE)
    scene = adstar.load_scene(path)
    path.unlink()
    assert_same_scene(scene, pickle.loads(pickle.dumps(scene)))


def test_a_scene_is_had_by_worker_processes_and_motions_come_back():
    scene = adstar.parse_scene(FREE)
    with multiprocessing.get_context("spawn").Pool(1) as workers:
        (motion,) = workers.map(scene.propagate, [1])
    np.testing.assert_array_equal(motion.q_IB, scene.propagate(1).q_IB)


@pytest.mark.parametrize("made", [_core.Scene, _core.AddedTorque])
def test_an_object_that_nobody_made_says_so(made):
    nothing = made.__new__(made)
    with pytest.raises(TypeError, match=r"its __init__\(\) was not called"):
        if made is _core.Scene:
            nothing.names
        else:
            _core.Scene.parse(FREE, "x").propagate([0], 1, 1, None, None, [nothing], 1, lambda: 0)


def test_the_version_is_the_programs():
    assert program("--version").split() == ["adstar", adstar.__version__], PROGRAMS


def test_schemes_are_those_of_the_library():
    schemes = adstar.schemes()
    assert next(iter(schemes)) == "coadjoint_rk4"
    assert schemes["coadjoint_rk4"].order == 4 and schemes["coadjoint_rk4"].exact_momentum
    assert schemes["rkmk4"].order == 4 and not schemes["rkmk4"].exact_momentum
    assert schemes["free_exact"].order is None and schemes["free_exact"].free_only
    assert schemes["lie_newmark"].order == 2 and not schemes["lie_newmark"].carries_wheels
