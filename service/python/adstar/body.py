"""One rigid body, a step at a time: for control loops of your own, and to see what a scheme does in one step."""

import warnings
from typing import NoReturn, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, asked
from .unresolved import UnresolvedWarning

Floats = NDArray[np.float64]


class Body(_core.Body):
    """A rigid body that one scheme steps. Frames and signs: ``help(adstar)``.

        body = adstar.Body((0.9144, 1.098, 1.66), angular_velocity_body_rad_s=(0.1, 0.2, 0.3))
        for _ in range(1000):
            body.step(0.01, torque_body_n_m=-0.05 * body.angular_velocity_body_rad_s)

    inertia_body_kg_m2: principal moments (3,), or the tensor (3, 3), about the centre of mass.
    q_IB: w, x, y, z, scalar first, body to inertial, of any length but zero.
    angular_velocity_body_rad_s: (3,).
    scheme: one of adstar.schemes(). ValueError for what cannot be, TypeError for what is of another type.

    Where it is now: time_s; q_IB (4,), angular_velocity_body_rad_s, momentum_inertial_n_m_s,
    momentum_body_n_m_s, momentum_residual_inertial_n_m_s (3,); rotational_energy_j, work_j, energy_residual_j.
    Each is worked out anew when it is asked for, and none can be set.
    """

    def __init__(
        self,
        inertia_body_kg_m2: ArrayLike,
        q_IB: ArrayLike = (1.0, 0.0, 0.0, 0.0),
        angular_velocity_body_rad_s: ArrayLike = (0.0, 0.0, 0.0),
        scheme: str = "coadjoint_rk4",
    ) -> None:
        super().__init__(
            asked.numbers("inertia_body_kg_m2", inertia_body_kg_m2, "(0.9144, 1.098, 1.66)"),
            asked.numbers("q_IB", q_IB, "(1.0, 0.0, 0.0, 0.0)"),
            asked.numbers("angular_velocity_body_rad_s", angular_velocity_body_rad_s, "(0.1, 0.2, 0.3)"),
            asked.text("scheme", scheme, "coadjoint_rk4"),
        )

    def __reduce__(self) -> NoReturn:
        raise TypeError(
            "a Body is neither pickled nor copied; make another of its inertia, q_IB, angular_velocity_body_rad_s and "
            "scheme, whose clock and accounts begin anew"
        )

    @property
    def q_IB_xyzw(self) -> Floats:
        """(4,) q_IB with the scalar LAST."""
        return self.q_IB[[1, 2, 3, 0]]

    def step(  # type: ignore[override]
        self,
        h_s: float,
        torque_body_n_m: Optional[ArrayLike] = None,
        torque_inertial_n_m: Optional[ArrayLike] = None,
    ) -> None:
        """One step of h_s [s], whole nanoseconds, under torques (3,) [N m] that do not change in their frame.

        A turn too large for the scheme is split into parts, as everywhere; UnresolvedWarning when that is not
        enough. ValueError, TypeError: as of Body itself, and when its clock has run for 73 years; nothing is changed.
        """
        body = asked.numbers_if("torque_body_n_m", torque_body_n_m, "(0.0, 0.0, 0.01)")
        inertial = asked.numbers_if("torque_inertial_n_m", torque_inertial_n_m, "(0.0, 0.0, 0.01)")
        if not super().step(asked.seconds("h_s", h_s), body, inertial):
            warnings.warn(
                f"{self.scheme} could not follow the step to {self.time_s:g} s; take a shorter h_s",
                UnresolvedWarning,
                stacklevel=2,
            )

    def __repr__(self) -> str:
        omega = np.linalg.norm(self.angular_velocity_body_rad_s)
        return f"<adstar.Body at {self.time_s:g} s: {self.scheme}, {omega:g} rad/s>"
