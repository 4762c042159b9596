#!/usr/bin/env python3
"""Figures 1 to 3 of Terze, Müller and Zlatar, from propagations of their free body.

The paper gives neither step nor duration, and draws no numbers for the drift; what its figures claim is the shape of
things: R stays a rotation, and the momentum drifts less than with RKMK4 and Lie-Newmark.

    PYTHONPATH=build/release/python python3 service/python/examples/reproduce_paper_figures.py --output figures
"""

import argparse
import pathlib

import matplotlib.pyplot as plt
import numpy as np

import adstar

# Krysl and Endres 2005.
SCENE = """
[simulation]
step = "100ms"

[[spacecraft]]
name = "paper"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]
"""
OURS = "coadjoint_rk4"
SCHEMES = {OURS: "proposed: coadjoint, RK4", "rkmk4": "RKMK, 4th order", "lie_newmark": "Lie-Newmark, 2nd order"}
AXES = "xyz"


def propagate(step_s: float, duration_s: float) -> dict[str, adstar.Motion]:
    """The paper's body by each of its schemes."""
    scene = adstar.parse_scene(SCENE)
    return {scheme: scene.propagate(duration_s, scheme=scheme, step_s=step_s) for scheme in SCHEMES}


def angular_velocity(motion: adstar.Motion) -> plt.Figure:
    figure, axes = plt.subplots(layout="constrained")
    for k, axis in enumerate(AXES):
        axes.plot(motion.time_s, motion.angular_velocity_body_rad_s[:, k], label=rf"$\omega_{axis}$")
    axes.set(title="Body angular velocity", xlabel="time [s]", ylabel=r"$\omega_B$ [rad/s]")
    axes.legend()
    return figure


def rotation_group(motion: adstar.Motion) -> plt.Figure:
    figure, (diagonal, determinant) = plt.subplots(2, sharex=True, layout="constrained")
    R = motion.R_IB
    for k, unit in enumerate(np.einsum("nij,nij->in", R, R)):
        diagonal.plot(motion.time_s, unit - 1, ".", markersize=2, label=rf"$(R R^T)_{{{k + 1}{k + 1}}}$")
    diagonal.set(title="The attitude stays on SO(3)", ylabel=r"diag $R R^T - 1$")
    diagonal.margins(y=0.4)
    diagonal.legend(loc="upper center", ncol=3, markerscale=4)
    determinant.plot(motion.time_s, np.linalg.det(R) - 1, ".", markersize=2)
    determinant.set(xlabel="time [s]", ylabel=r"det $R - 1$")
    return figure


def momentum_drift(motions: dict[str, adstar.Motion]) -> plt.Figure:
    none_at_all = 1e-18  # where a drift of zero is drawn
    figure, rows = plt.subplots(3, sharex=True, sharey=True, figsize=(6.4, 7.2), layout="constrained")
    for k, axes in enumerate(rows):
        for scheme, motion in motions.items():
            H_I = motion.momentum_inertial_n_m_s[:, k]
            axes.semilogy(motion.time_s, np.maximum(np.abs(H_I - H_I[0]), none_at_all), label=SCHEMES[scheme])
        axes.set_ylabel(rf"$|H_{AXES[k]} - H_{AXES[k]}(0)|$ [N m s]")
    rows[0].set_title("Drift of the inertial momentum (none at all is drawn at 1e-18)", fontsize="medium")
    rows[0].legend(loc="lower right", bbox_to_anchor=(0.99, 0.08), fontsize="small")
    rows[-1].set_xlabel("time [s]")
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw Figures 1 to 3 of Terze, Müller and Zlatar.")
    parser.add_argument("--step-s", type=float, default=0.1, help="of all three schemes (default: %(default)s)")
    parser.add_argument("--duration-s", type=float, default=100.0, help="how long (default: %(default)s)")
    parser.add_argument("--output", type=pathlib.Path, help="write PNG files there (default: show them)")
    options = parser.parse_args()
    motions = propagate(options.step_s, options.duration_s)
    figures = [angular_velocity(motions[OURS]), rotation_group(motions[OURS]), momentum_drift(motions)]
    if options.output is None:
        plt.show()
        return
    options.output.mkdir(parents=True, exist_ok=True)
    for number, figure in enumerate(figures, start=1):
        file = options.output / f"figure_{number}.png"
        figure.savefig(file, dpi=120)
        print(file)


if __name__ == "__main__":
    main()
