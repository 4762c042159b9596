"""The example, at low cost: what it draws is what `adstar reproduce paper` draws."""

import importlib.util
import sys

import numpy as np
import pytest

from programs import SOURCE, adstar as program

pytest.importorskip("matplotlib")


@pytest.fixture(name="example", scope="module")
def loaded_example():
    path = SOURCE / "service" / "python" / "examples" / "reproduce_paper_figures.py"
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_draws_three_figures(example, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["example", "--duration-s", "10", "--output", str(tmp_path / "figures")])
    example.main()
    files = sorted((tmp_path / "figures").iterdir())
    assert capsys.readouterr().out.split() == [str(file) for file in files]
    assert [file.name for file in files] == ["figure_1.png", "figure_2.png", "figure_3.png"]
    assert all(file.read_bytes().startswith(b"\x89PNG") for file in files)


def test_they_show_what_the_program_computes(example, tmp_path):
    program("reproduce", "paper", "--duration", "10s", "--output", tmp_path)
    omega, group, drift = (
        np.genfromtxt(tmp_path / f"figure_{n}.csv", delimiter=",", names=True) for n in (1, 2, 3)
    )
    motions = example.propagate(0.1, 10)
    ours = motions[example.OURS]
    lines = example.rotation_group(ours).axes
    for k, axis in enumerate("xyz"):
        np.testing.assert_array_equal(ours.angular_velocity_body_rad_s[:, k], omega[f"omega_body_{axis}_rad_s"])
        np.testing.assert_allclose(lines[0].lines[k].get_ydata(), group[f"r_rt_{axis}_minus_1"], atol=5e-16)
        for scheme, motion in motions.items():
            H_I = motion.momentum_inertial_n_m_s[:, k]
            np.testing.assert_array_equal(H_I - H_I[0], drift[f"{scheme}_momentum_drift_inertial_{axis}_n_m_s"])
    np.testing.assert_allclose(lines[1].lines[0].get_ydata(), group["det_r_minus_1"], atol=1e-15)


def test_they_show_what_the_paper_claims(example):
    motions = example.propagate(0.1, 10)
    drift = {scheme: np.ptp(motion.momentum_inertial_n_m_s, axis=0).max() for scheme, motion in motions.items()}
    assert drift["coadjoint_rk4"] == 0 < drift["rkmk4"] < drift["lie_newmark"]
