"""One body, a step at a time."""

import copy
import pickle

import numpy as np
import pytest

import adstar
from adstar import _core
from test_scene import FREE

INERTIA = (0.9144, 1.098, 1.66)
OMEGA = (0.45549, 0.82623, 0.03476)
ARRAYS = ("q_IB", "angular_velocity_body_rad_s", "momentum_inertial_n_m_s", "momentum_body_n_m_s", "work_j",
          "rotational_energy_j", "energy_residual_j", "momentum_residual_inertial_n_m_s")  # fmt: skip
CONSTANT = FREE + """
[[spacecraft.torque]]
model = "constant"
frame = "body"
torque_n_m = [0.01, -0.02, 0.03]
"""


@pytest.mark.parametrize("scheme", adstar.schemes())
def test_steps_as_a_scene_does(scheme):
    motion = adstar.parse_scene(FREE).propagate(1, scheme=scheme)
    body = adstar.Body(INERTIA, angular_velocity_body_rad_s=OMEGA, scheme=scheme)
    for row in range(len(motion)):
        for name in ARRAYS:
            np.testing.assert_array_equal(getattr(body, name), getattr(motion, name)[row], err_msg=name)
        assert body.time_s == motion.time_s[row]
        body.step(0.01)


def test_steps_as_a_scene_does_under_a_torque():
    motion = adstar.parse_scene(CONSTANT).propagate(1, 1)
    body = adstar.Body(np.diag(INERTIA), angular_velocity_body_rad_s=OMEGA)
    for _ in range(100):
        body.step(0.01, torque_body_n_m=[0.01, -0.02, 0.03])
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(body, name), getattr(motion, name)[1], err_msg=name)


def test_a_torque_holds_for_its_step_alone():
    body = adstar.Body(INERTIA)
    body.step(1, torque_inertial_n_m=(0, 0, 0.1))
    body.step(1)
    np.testing.assert_allclose(body.momentum_inertial_n_m_s, [0, 0, 0.1], atol=1e-16)


def test_a_rate_fed_back_brings_it_to_rest():
    body = adstar.Body(INERTIA, angular_velocity_body_rad_s=OMEGA)
    start = body.rotational_energy_j
    for _ in range(1000):
        body.step(0.1, torque_body_n_m=-0.1 * body.angular_velocity_body_rad_s)
    assert body.rotational_energy_j < 1e-4 * start
    assert abs(body.energy_residual_j) < 1e-6 * start


def test_begins_at_the_attitude_given_whatever_its_length():
    body = adstar.Body(INERTIA, q_IB=(2, 0, 0, 2), angular_velocity_body_rad_s=(1, 0, 0))
    np.testing.assert_allclose(body.q_IB, [np.sqrt(0.5), 0, 0, np.sqrt(0.5)], rtol=1e-15)
    np.testing.assert_allclose(body.q_IB_xyzw, [0, 0, np.sqrt(0.5), np.sqrt(0.5)], rtol=1e-15, atol=1e-16)
    # A quarter turn about z: what is x in the body is y inertially.
    np.testing.assert_allclose(body.momentum_inertial_n_m_s, [0, 0.9144, 0], atol=1e-15)


def test_begins_as_a_scene_does():
    turned = FREE + "attitude_body_to_inertial = { w = 0.2, x = -0.3, y = 0.4, z = 0.5 }"
    motion = adstar.parse_scene(turned).propagate(0.01)
    body = adstar.Body(INERTIA, (0.2, -0.3, 0.4, 0.5), OMEGA)
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(body, name), getattr(motion, name)[0], err_msg=name)


@pytest.mark.parametrize(
    ("how", "said"),
    [
        (dict(inertia_body_kg_m2=(1, 1, 3)), "inertia_body_kg_m2: got "),
        (dict(inertia_body_kg_m2=(1, 2)), r"inertia_body_kg_m2: got an array of shape \(2,\)"),
        (dict(inertia_body_kg_m2=[[1, 1, 0], [0, 1, 0], [0, 0, 1]]), "not symmetric"),
        (dict(q_IB=(0, 0, 0, 0)), "q_IB: got a quaternion of norm 0"),
        (dict(q_IB=(1, 0, 0)), "q_IB: got an array of shape"),
        (dict(angular_velocity_body_rad_s=(np.nan, 0, 0)), "angular_velocity_body_rad_s: got nan"),
        (dict(angular_velocity_body_rad_s=(1e200, 0, 0)), "beyond the range of double"),
        (dict(scheme="rk4"), "scheme: got 'rk4', expected one of"),
    ],
)
def test_a_body_that_cannot_be_says_why(how, said):
    with pytest.raises(ValueError, match=said):
        adstar.Body(**{"inertia_body_kg_m2": INERTIA, **how})


def test_a_refused_step_changes_nothing():
    body = adstar.Body(INERTIA, angular_velocity_body_rad_s=OMEGA, scheme="free_exact")
    before = body.q_IB
    for wrong in (dict(h_s=0), dict(h_s=1, torque_body_n_m=(0, 0, 1)), dict(h_s=1, torque_body_n_m=(0, 0, np.inf))):
        with pytest.raises(ValueError):
            body.step(**wrong)
    np.testing.assert_array_equal(body.q_IB, before)
    assert body.time_s == 0
    body.step(1)
    assert body.time_s == 1


def test_its_clock_ends_before_it_would_run_over():
    body = adstar.Body(INERTIA)
    body.step(2e9)
    said = r"h_s: got 400000000, expected at most the 305843009\.213693952 that this body's clock has left; try "
    with pytest.raises(ValueError, match=said):
        body.step(4e8)
    assert body.time_s == 2e9
    body.step(3e8)
    assert body.time_s == 2.3e9


@pytest.mark.parametrize("copies", [pickle.dumps, copy.copy, copy.deepcopy])
def test_a_body_that_is_pickled_or_copied_says_what_to_do_instead(copies):
    with pytest.raises(TypeError, match="a Body is neither pickled nor copied; make another of its inertia, q_IB"):
        copies(adstar.Body(INERTIA))


@pytest.mark.parametrize("made", [adstar.Body, _core.Body])
def test_a_body_that_nobody_made_says_so(made):
    nothing = made.__new__(made)
    for use in (lambda: nothing.q_IB, lambda: nothing.time_s, lambda: _core.Body.step(nothing, 1, None, None)):
        with pytest.raises(TypeError, match=r"its __init__\(\) was not called"):
            use()
    del nothing


def test_warns_of_a_step_that_cannot_be_followed():
    body = adstar.Body(INERTIA, angular_velocity_body_rad_s=(1e6, 0, 0))
    with pytest.warns(adstar.UnresolvedWarning, match="could not follow the step to 10 s; take a shorter h_s"):
        body.step(10)
