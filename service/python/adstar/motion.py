"""The motion of one spacecraft, a row an instant."""

from dataclasses import dataclass, field
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from . import _core

Floats = NDArray[np.float64]
Table = NDArray[np.void]  #: a structured array: table["speed_rad_s"], pandas.DataFrame(table)


@dataclass(frozen=True, eq=False, repr=False)
class Motion:
    """The motion of one spacecraft: n instants, the first is the start. Frames and signs: ``help(adstar)``.

    The columns of ``adstar propagate``, and the residuals that telemetry carries. The motions of a run share
    ``step`` and ``time_s``, which are read-only: to change them, take a copy, ``motion.time_s.copy()``.
    """

    spacecraft: str
    scheme: str
    step_s: float
    step: NDArray[np.uint64]  #: (n,) steps since the start
    time_s: Floats  #: (n,) simulation time, step * step_s
    q_IB: Floats  #: (n, 4) w, x, y, z, unit: body to inertial, scalar first
    angular_velocity_body_rad_s: Floats  #: (n, 3) of B relative to I, in B; of linked bodies the hub's
    momentum_inertial_n_m_s: Floats  #: (n, 3) H_I about the centre of mass, wheels included
    momentum_body_n_m_s: Floats  #: (n, 3) R_IB^T H_I
    rotational_energy_j: Floats  #: (n,) of body and wheels
    work_j: Floats  #: (n,) of all torques since the start
    energy_residual_j: Floats  #: (n,) E - E_0 - W: zero in the exact flow; a sign of accuracy, no bound
    momentum_residual_inertial_n_m_s: Floats  #: (n, 3) H_I - H_0 - impulse: summation faults only
    wheels: Optional[Table] = field(default=None)  #: a row an instant and wheel; None: there are none
    pointing: Optional[Table] = field(default=None)  #: against orbit and target; None: there are none
    bodies: Optional[Table] = field(default=None)  #: a row an instant and linked body; None: one body
    joints: Optional[Table] = field(default=None)  #: a row an instant and joint; None: one body

    @property
    def q_IB_xyzw(self) -> Floats:
        """(n, 4) q_IB with the scalar LAST: what ``scipy.spatial.transform.Rotation.from_quat`` takes."""
        return self.q_IB[:, [1, 2, 3, 0]]

    @property
    def R_IB(self) -> Floats:
        """(n, 3, 3) rotation matrices, v_I = R_IB v_B, as the core makes them of q_IB."""
        return _core.rotation_matrices(self.q_IB)

    def __len__(self) -> int:
        return len(self.step)

    def __repr__(self) -> str:
        tables = [name for name in SIDE_TABLES if getattr(self, name) is not None]
        beside = f", with {', '.join(tables)}" if tables else ""
        return (
            f"<adstar.Motion of '{self.spacecraft}': {len(self)} rows to {self.time_s[-1]:g} s, "
            f"{self.scheme}, h = {self.step_s:g} s{beside}>"
        )


#: What is told beside the motion, where there is something to tell.
SIDE_TABLES = ("wheels", "pointing", "bodies", "joints")


def motions(run: dict[str, Any], names: list[str]) -> dict[str, Motion]:
    """What _core.Scene.propagate() hands over, by spacecraft."""
    shared = {key: run[key] for key in ("scheme", "step_s", "step", "time_s")}
    return {name: Motion(spacecraft=name, **shared, **arrays) for name, arrays in zip(names, run["motions"])}
