"""What is of another type is told which parameter it is."""

import datetime
import decimal
import fractions
import pathlib

import numpy as np
import pytest

import adstar
from test_body import INERTIA
from test_scene import FREE

PUSH = adstar.TorqueTable([0], [[0, 0, 1]])


def table(**other):
    return adstar.TorqueTable(**{"time_s": [0], "torque_n_m": [[0, 0, 1]], **other})


@pytest.mark.parametrize("asks", ["propagate", "propagate_all"])
@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (dict(duration_s="10"), r"duration_s: got '10' \(str\), expected seconds, a number; try 0.1"),
        (dict(duration_s=b"10"), r"duration_s: got b'10' \(bytes\), expected seconds"),
        (dict(duration_s=[1, 2]), r"duration_s: got \[1, 2\] \(list\), expected seconds"),
        (dict(duration_s=np.ones(2)), r"duration_s: got array\(\[1., 1.\]\) \(ndarray\), expected seconds"),
        (dict(duration_s=1j), r"duration_s: got 1j \(complex\), expected seconds"),
        (dict(duration_s=datetime.timedelta(1)), r"duration_s: got datetime.timedelta.* expected seconds"),
        (dict(duration_s=1, every_s="1s"), r"every_s: got '1s' \(str\), expected seconds"),
        (dict(duration_s=1, step_s="10ms"), r"step_s: got '10ms' \(str\), expected seconds"),
        (dict(duration_s=1, scheme=4), r"scheme: got 4 \(int\), expected text; try 'coadjoint_rk4'"),
        (dict(duration_s=1, scheme=["rkmk4"]), r"scheme: got \['rkmk4'\] \(list\), expected text"),
        (dict(duration_s=1, scheme=adstar.schemes()["rkmk4"]), r"scheme: got Scheme\(.* expected text"),
    ],
)
def test_of_a_run(asks, asked, said):
    with pytest.raises(TypeError, match=f"^{said}"):
        getattr(adstar.parse_scene(FREE), asks)(**asked)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (dict(spacecraft="sat1"), r"spacecraft: got 'sat1' \(str\), expected a list of names; try \['sat1'\]"),
        (dict(spacecraft=1), r"spacecraft: got 1 \(int\), expected a list of names; try \['sat1'\]"),
        (dict(spacecraft=["sat1", 2]), r"spacecraft\[1\]: got 2 \(int\), expected text; try 'sat1'"),
        (dict(threads=1.5), r"threads: got 1.5 \(float\), expected a whole number, 1 to 256; try 1"),
        (dict(threads="2"), r"threads: got '2' \(str\), expected a whole number"),
        (dict(torque=PUSH), r"torque: got TorqueTable\(.*, expected tables by spacecraft; try {'sat1': adstar.Torque"),
        (dict(torque={"sat1": [0, 0, 1]}), r"torque: got \[0, 0, 1\] \(list\), expected an adstar.TorqueTable; try "),
    ],
)
def test_of_a_fleet(asked, said):
    with pytest.raises(TypeError, match=f"^{said}"):
        adstar.parse_scene(FREE).propagate_all(1, **asked)


def test_of_a_name():
    scene = adstar.parse_scene(FREE)
    for asks in (lambda: scene.spacecraft(1), lambda: scene.propagate(1, spacecraft=1)):
        with pytest.raises(TypeError, match=r"^spacecraft: got 1 \(int\), expected text; try 'sat1'"):
            asks()


@pytest.mark.parametrize("threads", [0, -1, 257, 10**30])
def test_threads_out_of_range_are_no_matter_of_type(threads):
    with pytest.raises(ValueError, match=f"threads: got {threads}, expected 1 to 256; try 1"):
        adstar.parse_scene(FREE).propagate_all(1, threads=threads)


@pytest.mark.parametrize(
    ("torque", "said"),
    [
        ([0, 0, 1], r"torque: got \[0, 0, 1\] \(list\), expected an adstar.TorqueTable"),
        (table(time_s=None), "time_s: got None, expected numbers"),
        (table(time_s=["0"]), r"time_s: got \['0'\] \(list\), expected numbers"),
        (table(torque_n_m=[[0, 0, 1j]]), "torque_n_m: got .*, expected numbers"),
        (table(torque_n_m=[[0, 0], [1]]), "torque_n_m: got .*, expected numbers"),
        (table(frame=None), "frame: got None, expected text; try 'body'"),
        (table(interpolation=1), r"interpolation: got 1 \(int\), expected text; try 'hold'"),
        (table(after_end=0), r"after_end: got 0 \(int\), expected text; try 'zero'"),
    ],
)
def test_of_a_torque(torque, said):
    with pytest.raises(TypeError, match=f"^{said}"):
        adstar.parse_scene(FREE).propagate(1, torque=torque)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (dict(inertia_body_kg_m2=None), "inertia_body_kg_m2: got None, expected numbers; try "),
        (dict(inertia_body_kg_m2="1 2 3"), r"inertia_body_kg_m2: got '1 2 3' \(str\), expected numbers"),
        (dict(q_IB=["1", "0", "0", "0"]), r"q_IB: got \['1', '0', '0', '0'\] \(list\), expected numbers"),
        (dict(q_IB=(1, 0, 0, 0j)), r"q_IB: got \(1, 0, 0, 0j\) \(tuple\), expected numbers"),
        (dict(angular_velocity_body_rad_s={1: 2}), "angular_velocity_body_rad_s: got {1: 2}"),
        (dict(scheme=None), "scheme: got None, expected text; try 'coadjoint_rk4'"),
    ],
)
def test_of_a_body(asked, said):
    with pytest.raises(TypeError, match=f"^{said}"):
        adstar.Body(**{"inertia_body_kg_m2": INERTIA, **asked})


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (dict(h_s="0.1"), r"h_s: got '0.1' \(str\), expected seconds"),
        (dict(h_s=None), "h_s: got None, expected seconds"),
        (dict(h_s=0.1, torque_body_n_m="x"), r"torque_body_n_m: got 'x' \(str\), expected numbers"),
        (dict(h_s=0.1, torque_inertial_n_m=[None, "x", 0]), "torque_inertial_n_m: got .*, expected numbers"),
    ],
)
def test_of_a_step(asked, said):
    body = adstar.Body(INERTIA)
    with pytest.raises(TypeError, match=f"^{said}"):
        body.step(**asked)
    assert body.time_s == 0


def test_of_accuracy():
    scene = adstar.parse_scene(FREE)
    for asked, said in ((dict(duration_s="1"), "duration_s: got '1'"), (dict(scheme=1), "scheme: got 1"),
                        (dict(step_s=[]), r"step_s: got \[\]")):  # fmt: skip
        with pytest.raises(TypeError, match=f"^{said}"):
            scene.accuracy(**asked)


def test_of_files():
    with pytest.raises(TypeError, match=r"^path: got 3 \(int\), expected a path"):
        adstar.load_scene(3)
    with pytest.raises(TypeError, match=r"^path: got b'x.toml' \(bytes\), expected a path"):
        adstar.load_scene(b"x.toml")
    with pytest.raises(TypeError, match="^path: got None, expected a path"):
        adstar.read_recording(None)
    with pytest.raises(TypeError, match=r"^text: got PosixPath\('x.toml'\).*, expected text"):
        adstar.parse_scene(pathlib.Path("x.toml"))
    assert adstar.parse_scene(FREE, pathlib.Path("x.toml")).file == "x.toml"


def test_of_a_recording():
    with pytest.raises(TypeError, match=r"^topics: got 'motion' \(str\), expected a list of names; try \['motion'\]"):
        adstar.read_recording("runs", topics="motion")
    with pytest.raises(TypeError, match=r"^spacecraft\[0\]: got 1 \(int\), expected text; try 'sat1'"):
        adstar.read_recording("runs", spacecraft=[1])


@pytest.mark.parametrize(
    "second", [1, True, np.int64(1), np.float32(1), np.array(1.0), fractions.Fraction(1), decimal.Decimal("1.0")]
)
def test_whatever_is_a_number_is_one(second):
    assert adstar.parse_scene(FREE).propagate(second, second).time_s[-1] == 1


@pytest.mark.parametrize("rates", [range(3), np.arange(3, dtype=np.uint8), [fractions.Fraction(k) for k in range(3)]])
def test_whatever_is_numbers_is_some(rates):
    np.testing.assert_allclose(adstar.Body(INERTIA, angular_velocity_body_rad_s=rates).momentum_body_n_m_s,
                               [0, INERTIA[1], 2 * INERTIA[2]], rtol=1e-15)  # fmt: skip


def test_a_number_beyond_any_double_is_out_of_range():
    with pytest.raises(ValueError, match="duration_s: got inf, expected seconds"):
        adstar.parse_scene(FREE).propagate(10**400)
