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


#: float() takes most of them.
NO_NUMBERS_OF_NUMPY = [
    (np.timedelta64(10, "ns"), r"numpy.timedelta64\(10,'ns'\) \(timedelta64\)"),
    (np.timedelta64("NaT", "s"), r"numpy.timedelta64\('NaT','s'\) \(timedelta64\)"),
    (np.datetime64("2026-01-01"), r"numpy.datetime64\('2026-01-01'\) \(datetime64\)"),
    (np.datetime64(10, "ns"), r"numpy.datetim.* \(datetime64\)"),
    (np.str_("10"), r"'10' \(str_\)"),
    (np.bytes_(b"10"), r"b'10' \(bytes_\)"),
    (np.void(b"1"), r"void\(.* \(void\)"),
    (np.complex64(10), r"\(10\+0j\) \(complex64\)"),
    (np.complex128(10), r"\(10\+0j\) \(complex128\)"),
    (np.array("10"), r"array\('10', dtype='<U2'\) \(ndarray\)"),
    (np.array(b"10"), r"array\(b'10', dtype='\|S2'\) \(ndarray\)"),
    (np.array(10, dtype="m8[ns]"), r"array\(10, .* \(ndarray\)"),
    (np.array("10", dtype=object), r"array\('10', dtype=object\) \(ndarray\)"),
    (np.array(10.0, dtype=object), r"array\(10.0, dtype=object\) \(ndarray\)"),
]


@pytest.mark.parametrize(("given", "got"), NO_NUMBERS_OF_NUMPY)
@pytest.mark.parametrize("name", ["duration_s", "every_s", "step_s"])
def test_what_numpy_has_besides_numbers_is_no_time_of_a_run(name, given, got):
    with pytest.raises(TypeError, match=f"^{name}: got {got}, expected seconds, a number; try 0.1$"):
        adstar.parse_scene(FREE).propagate(**{"duration_s": 10, name: given})


@pytest.mark.parametrize(("given", "got"), NO_NUMBERS_OF_NUMPY)
def test_what_numpy_has_besides_numbers_is_no_time_of_a_step(given, got):
    with pytest.raises(TypeError, match=f"^h_s: got {got}, expected seconds, a number; try 0.1$"):
        adstar.Body(INERTIA).step(given)


@pytest.mark.parametrize("given", [np.timedelta64(2, "ns"), np.str_("2"), np.float32(2), np.array(2, dtype=object)])
def test_what_numpy_has_besides_integers_is_no_count(given):
    with pytest.raises(TypeError, match="^threads: got .*, expected a whole number, 1 to 256; try 1$"):
        adstar.parse_scene(FREE).propagate_all(1, threads=given)


@pytest.mark.parametrize(
    ("given", "got"),
    [
        (np.array(["0", "0", "1"]), r"array\(.* \(ndarray\)"),
        (np.array([0, 0, 1], dtype="m8[ns]"), r"array\(.* \(ndarray\)"),
        (np.array([0, 0, 1], dtype=complex), r"array\(.* \(ndarray\)"),
        ([0, fractions.Fraction(1), "2"], r"'2' \(str\) at \[2\]"),
        ([0, b"1", fractions.Fraction(2)], r"b'1' \(bytes\) at \[1\]"),
        ([0.0, np.timedelta64(1, "ns"), 2], r"numpy.timedelta64\(1,'ns'\) \(timedelta64\) at \[1\]"),
        (np.array([0, 1, np.complex64(2)], dtype=object), r"\(2\+0j\) \(complex64\) at \[2\]"),
        ([None, 1, 2], r"None at \[0\]"),
        (np.array("1", dtype=object), r"'1' \(str\)"),
    ],
)
def test_every_one_of_some_numbers_must_be_one(given, got):
    with pytest.raises(TypeError, match=f"^angular_velocity_body_rad_s: got {got}, expected numbers; try "):
        adstar.Body(INERTIA, angular_velocity_body_rad_s=given)


def test_of_a_table_of_objects_it_is_said_where():
    torque = table(torque_n_m=np.array([[0, 0, "1"]], dtype=object))
    with pytest.raises(TypeError, match=r"^torque_n_m: got '1' \(str\) at \[0, 2\], expected numbers; try "):
        adstar.parse_scene(FREE).propagate(1, torque=torque)


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
    "second",
    [
        *(1, True, fractions.Fraction(1), decimal.Decimal("1.0"), np.array(1.0), np.array(1, dtype=np.uint8)),
        *(kind(1) for kind in (np.float16, np.float32, np.float64, np.longdouble, np.int64, np.uint8, np.bool_)),
    ],
    ids=lambda second: f"{type(second).__name__} {second}",
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
    with pytest.raises(ValueError, match=r"angular_velocity_body_rad_s: got inf at \[2\], expected finite numbers"):
        adstar.Body(INERTIA, angular_velocity_body_rad_s=(0, 0, 10**400))
