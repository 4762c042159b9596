"""Propagation: the bits of `adstar propagate`, as arrays."""

import os
import signal
import threading

import numpy as np
import pytest

import adstar
from programs import SCENES, adstar as program, assert_same_bits, assert_same_table, rows_of
from test_scene import FREE

#: Of Motion's arrays: the columns of the CSV.
COLUMNS = {
    "q_IB": ["q_w", "q_x", "q_y", "q_z"],
    "angular_velocity_body_rad_s": [f"omega_body_{axis}_rad_s" for axis in "xyz"],
    "momentum_inertial_n_m_s": [f"momentum_inertial_{axis}_n_m_s" for axis in "xyz"],
    "momentum_body_n_m_s": [f"momentum_body_{axis}_n_m_s" for axis in "xyz"],
    "rotational_energy_j": ["rotational_energy_j"],
    "work_j": ["work_j"],
}


def assert_same_motion(motion, columns):
    """Of one spacecraft among the rows of a CSV."""
    own = [i for i, name in enumerate(columns["spacecraft"]) if name == motion.spacecraft]
    assert len(own) == len(motion)
    of = {name: [texts[i] for i in own] for name, texts in columns.items()}
    assert_same_bits(motion.step, of["step"])
    assert_same_bits(motion.time_s, of["time_s"])
    for name, each in COLUMNS.items():
        array = getattr(motion, name).reshape(len(motion), -1)
        for k, column in enumerate(each):
            assert_same_bits(array[:, k], of[column])


@pytest.mark.parametrize(
    ("scene", "duration", "every"),
    [
        ("paper_free", 20, 0.1),
        ("paper_forced", 20, 0.1),
        ("profile_table", 40, 0.5),
        ("damped", 10, 1),
        ("pair", 1, 0.3),
        ("space", 600, 60),
    ],
)
def test_has_the_bits_that_the_program_prints(scene, duration, every):
    path = SCENES / f"{scene}.toml"
    loaded = adstar.load_scene(path)
    motion = loaded.propagate(duration, every)
    printed = rows_of(program("propagate", path, "--duration", f"{duration}s", "--every", f"{every}s"))
    assert_same_motion(motion, printed)
    assert motion.time_s[-1] == duration and motion.scheme == loaded.scheme


def test_has_them_with_another_scheme_and_step():
    path = SCENES / "paper_forced.toml"
    motion = adstar.load_scene(path).propagate(10, 1, scheme="splitting_mclachlan84", step_s=0.05)
    printed = program(
        "propagate", path, "--duration", "10s", "--every", "1s", "--scheme", "splitting_mclachlan84", "--step", "50ms"
    )
    assert_same_motion(motion, rows_of(printed))


def test_has_them_for_a_fleet_and_for_one_of_it_alone():
    path = SCENES.parent.parent / "tests" / "cli" / "scenes" / "mixed.toml"
    printed = rows_of(program("propagate", path, "--duration", "1s", "--every", "500ms"))
    scene = adstar.load_scene(path)
    for motion in scene.propagate_all(1, 0.5, threads=2).values():
        assert_same_motion(motion, printed)
    assert_same_motion(scene.propagate(1, 0.5, spacecraft=scene.names[-1]), printed)


@pytest.mark.parametrize(
    ("scene", "duration", "tables"),
    [("wheels", 5, ["wheels"]), ("space", 60, ["pointing"]), ("panels", 2, ["bodies", "joints"])],
)
def test_tells_beside_the_motion_what_the_program_writes_beside_it(scene, duration, tables, tmp_path):
    path = SCENES / f"{scene}.toml"
    step_s = adstar.load_scene(path).step_s
    motion = adstar.load_scene(path).propagate(duration, 10 * step_s)
    beside = [word for name in tables for word in (f"--{name}", tmp_path / name)]
    program("propagate", path, "--duration", f"{duration}s", "--every", f"{10 * step_s * 1e3:.0f}ms", *beside)
    for name in ("wheels", "pointing", "bodies", "joints"):
        table = getattr(motion, name)
        if name in tables:
            assert_same_table(table, rows_of((tmp_path / name).read_text()))
        else:
            assert table is None, name


#: Of every kind, in an order that helps nobody: a free one, wheels, linked bodies, and one of wheels and a target.
MIXED = """
[simulation]
step = "10ms"

[[spacecraft]]
name = "plain"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]

[[spacecraft]]
name = "long-name-with-wheels"
inertia_body_kg_m2 = [85.0, 72.0, 68.9]
wheel = [
  { name = "x", spin_inertia_kg_m2 = 0.01, axis_body = [1.0, 0.0, 0.0], speed_rad_s = 100.0 },
  { name = "wheel_of_y", spin_inertia_kg_m2 = 0.01, axis_body = [0.0, 1.0, 0.0], speed_rad_s = -50.0 },
]

[[spacecraft]]
name = "linked"
mass_kg = 80.0
inertia_body_kg_m2 = [8.0, 9.0, 7.0]

[[spacecraft.chain]]
name = "link{}"
count = 2
from = "hub"
first_point_from_body_m = [0.5, 0.0, 0.0]
mass_kg = 3.0
inertia_body_kg_m2 = [0.01, 0.09, 0.09]
kind = "revolute"
axis_body = [0.0, 0.0, 1.0]
point_from_body_m = [0.3, 0.0, 0.0]
point_to_body_m = [-0.3, 0.0, 0.0]
rate = 0.05

[[spacecraft]]
name = "w"
inertia_body_kg_m2 = [85.0, 72.0, 68.9]
angular_velocity_body_rad_s = [0.1, 0.2, 0.3]
pointing = { frame = "inertial", attitude_body_to_frame = { w = 1.0, x = 0.0, y = 0.0, z = 0.0 } }
wheel = [{ name = "only", spin_inertia_kg_m2 = 0.01, axis_body = [1.0, 0.0, 0.0], speed_rad_s = 10.0 }]
"""
TABLES = {
    "plain": [],
    "long-name-with-wheels": ["wheels"],
    "linked": ["bodies", "joints"],
    "w": ["wheels", "pointing"],
}


def own_rows(columns, name):
    own = [i for i, spacecraft in enumerate(columns["spacecraft"]) if spacecraft == name]
    return {column: [texts[i] for i in own] for column, texts in columns.items()}


@pytest.mark.parametrize("chosen", [None, ["w", "linked", "plain", "long-name-with-wheels"], ["w"]])
def test_of_a_fleet_each_has_the_side_tables_that_are_its_own(chosen, tmp_path):
    path = tmp_path / "mixed.toml"
    path.write_text(MIXED)
    beside = [word for name in ("wheels", "pointing", "bodies", "joints") for word in (f"--{name}", tmp_path / name)]
    program("propagate", path, "--duration", "250ms", "--every", "100ms", *beside)
    motions = adstar.load_scene(path).propagate_all(0.25, 0.1, spacecraft=chosen)
    assert list(motions) == (chosen or list(TABLES))
    for name, motion in motions.items():
        for table in ("wheels", "pointing", "bodies", "joints"):
            if table in TABLES[name]:
                assert_same_table(getattr(motion, table), own_rows(rows_of((tmp_path / table).read_text()), name))
            else:
                assert getattr(motion, table) is None, (name, table)


def test_of_a_fleet_no_table_is_a_view_that_keeps_the_others_in_memory():
    motions = adstar.parse_scene(MIXED).propagate_all(0.1)
    assert all(motions[name].wheels.base is None for name in ("w", "long-name-with-wheels"))
    assert len(motions["long-name-with-wheels"].wheels) == 2 * len(motions["w"].wheels) == 22


def test_a_row_is_a_step_unless_asked_otherwise_and_the_last_is_always_there():
    scene = adstar.parse_scene(FREE)
    np.testing.assert_array_equal(scene.propagate(0.05).step, range(6))
    np.testing.assert_array_equal(scene.propagate(0.05, 0.02).step, [0, 2, 4, 5])
    np.testing.assert_array_equal(scene.propagate(0.05, 1).step, [0, 5])


@pytest.mark.parametrize("duration_s", [0.3, 0.1 + 0.2, 3 * 0.1, 1e-2])
def test_a_time_is_the_decimal_that_was_written_or_worked_out(duration_s):
    assert adstar.parse_scene(FREE).propagate(duration_s, duration_s).time_s[-1] == pytest.approx(duration_s, rel=1e-15)


def test_a_long_time_is_the_decimal_that_was_written():
    scene = adstar.parse_scene(FREE)
    said = "duration_s=123456789.123 is not whole steps of 7ns; try duration_s=123456789.122999997 or "
    with pytest.raises(ValueError, match=said):
        scene.propagate(123456789.123, step_s=7e-9)


def test_a_torque_from_python_is_a_table_of_the_scene():
    with_table = adstar.load_scene(SCENES / "profile_table.toml")
    knots = np.loadtxt(SCENES / "slew_profile.csv", delimiter=",", skiprows=2)
    text = (SCENES / "profile_table.toml").read_text()
    without = adstar.parse_scene(text[: text.index("[[spacecraft.torque]]")])
    torque = adstar.TorqueTable(knots[:, 0], knots[:, 1:])
    theirs, ours = with_table.propagate(40, 1), without.propagate(40, 1, torque=torque)
    for name in COLUMNS:
        np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name))
    assert np.ptp(ours.momentum_inertial_n_m_s[:, 2]) > 0.4


def test_an_inertial_torque_changes_the_momentum_by_its_impulse():
    scene = adstar.parse_scene(FREE)
    ramp = adstar.TorqueTable([0, 2], [[0, 0, 0], [0, 0.1, 0]], frame="inertial", interpolation="linear")
    motion = scene.propagate(3, 0.5, torque=ramp)
    change = motion.momentum_inertial_n_m_s - motion.momentum_inertial_n_m_s[0]
    np.testing.assert_allclose(change[:, 1], [0, 0.00625, 0.025, 0.05625, 0.1, 0.1, 0.1], atol=1e-15)
    np.testing.assert_allclose(motion.momentum_residual_inertial_n_m_s, 0, atol=1e-15)
    held = adstar.TorqueTable([0], [[0, 0.1, 0]], frame="inertial", after_end="hold")
    last = scene.propagate(3, 3, torque=held).momentum_inertial_n_m_s
    np.testing.assert_allclose((last[1] - last[0])[1], 0.3, atol=1e-15)


@pytest.mark.parametrize(
    ("table", "said"),
    [
        (([], np.empty((0, 3))), r"time_s: got an array of shape \(0,\)"),
        (([0, 1], [[0, 0, 1]]), r"torque_n_m: got an array of shape \(1, 3\), expected shape \(2, 3\)"),
        (([0, 0], [[0, 0, 1]] * 2), r"time_s\[1\]: got 0, expected a time after the 0 before it"),
        (([0, np.inf], [[0, 0, 1]] * 2), r"time_s\[1\]: got inf"),
        (([0], [[0, np.nan, 1]]), r"torque_n_m\[0, 1\]: got nan, expected a finite number"),
        (([0], [[0, 0, 1]], "inertia"), 'frame: got "inertia", expected body, inertial; try inertial'),
    ],
)
def test_a_torque_that_cannot_be_says_where(table, said):
    with pytest.raises(ValueError, match=said):
        adstar.parse_scene(FREE).propagate(1, torque=adstar.TorqueTable(*table))


def test_a_torque_on_linked_bodies_or_on_nobody_is_refused():
    push = adstar.TorqueTable([0], [[0, 0, 1]])
    with pytest.raises(ValueError, match="is made of linked bodies"):
        adstar.load_scene(SCENES / "panels.toml").propagate(1, torque=push)
    with pytest.raises(ValueError, match="on 'sat2', which is not among those propagated"):
        adstar.parse_scene(FREE).propagate_all(1, torque={"sat2": push})
    with pytest.raises(ValueError, match="free_exact', which knows no torque, and the scene's 'sat1' has one"):
        adstar.parse_scene(FREE).propagate(1, scheme="free_exact", torque=push)


def test_the_order_of_a_quaternion_is_in_its_name():
    motion = adstar.parse_scene(FREE).propagate(1)
    np.testing.assert_array_equal(motion.q_IB_xyzw[:, 3], motion.q_IB[:, 0])
    np.testing.assert_array_equal(motion.q_IB_xyzw[:, :3], motion.q_IB[:, 1:])


def test_rotation_matrices_map_body_to_inertial():
    motion = adstar.load_scene(SCENES / "paper_forced.toml").propagate(5)
    H_I = np.einsum("nij,nj->ni", motion.R_IB, motion.momentum_body_n_m_s)
    np.testing.assert_allclose(H_I, motion.momentum_inertial_n_m_s, atol=1e-14)
    # Against the textbook's formula for one, scalar first.
    w, x, y, z = motion.q_IB[-1]
    np.testing.assert_allclose(motion.R_IB[-1][0], [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)])


def test_warns_of_what_the_scheme_cannot_follow():
    path = SCENES.parent.parent / "tests" / "cli" / "scenes" / "too_fast.toml"
    with pytest.warns(adstar.UnresolvedWarning, match="take a shorter step_s, or raise simulation.substep_limit"):
        adstar.load_scene(path).propagate_all()


def test_ctrl_c_ends_a_long_run_and_other_threads_go_on_meanwhile():
    scene = adstar.parse_scene(FREE)
    # Another thread needs the GIL to send it: a run that kept it would go on for hours.
    interrupt = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    interrupt.start()
    with pytest.raises(KeyboardInterrupt):
        scene.propagate(1e9, 1e9)
    interrupt.join()
    assert len(scene.propagate(1)) == 101


def test_accuracy_is_what_the_trade_measures():
    scene = adstar.load_scene(SCENES / "paper_free.toml")
    coarse, fine = (scene.accuracy(10, step_s=step) for step in (0.2, 0.1))
    assert fine.scheme == "coadjoint_rk4" and fine.resolved and fine.truth_uncertainty_rad < 1e-12
    assert 12 < coarse.attitude_error_rad / fine.attitude_error_rad < 20  # order 4
    assert fine.momentum_error_relative < 1e-15
    assert scene.accuracy(10, step_s=0.1, scheme="lie_newmark").momentum_error_relative > 1e-6
    with pytest.raises(ValueError, match="looked at every 30ms, which is not whole steps of 150ms; try duration_s=3"):
        scene.accuracy(0.3, step_s=0.15)
