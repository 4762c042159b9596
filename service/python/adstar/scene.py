"""Scenes: what a TOML file says, and its propagation."""

import os
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, asked
from .memory import available_bytes
from .motion import Motion, motions
from .unresolved import UnresolvedWarning

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Spacecraft:
    """One spacecraft of a scene, as it is at the start."""

    name: str
    inertia_body_kg_m2: Floats  #: (3, 3) about the centre of mass, wheels locked
    q_IB: Floats  #: (4,) w, x, y, z: body to inertial, scalar first
    angular_velocity_body_rad_s: Floats  #: (3,)
    momentum_inertial_n_m_s: Floats  #: (3,) wheels included
    rotational_energy_j: float
    torques: tuple[str, ...]  #: the models that the scene names: "constant", "gravity_gradient", ...
    wheels: tuple[str, ...]  #: their names
    actuators: tuple[str, ...]  #: their names; nobody commands them here


@dataclass(frozen=True, eq=False)
class TorqueTable:
    """A torque over time, on top of those that the scene names. Its knots are edges: a step that holds one is
    split there, so they may lie anywhere.

    time_s: (n,) simulation time, rising; rounded to the nanosecond. Before the first the torque is zero.
    torque_n_m: (n, 3), a row a time.
    frame: "body" or "inertial".
    interpolation: "hold" (each until the next) or "linear".
    after_end: after the last time "zero", or "hold" the last torque.
    """

    time_s: ArrayLike
    torque_n_m: ArrayLike
    frame: str = "body"
    interpolation: str = "hold"
    after_end: str = "zero"


@dataclass(frozen=True)
class Accuracy:
    """How far a scheme strays from the truth: the largest errors of any spacecraft at up to ten instants."""

    scheme: str
    step_s: float
    duration_s: float
    attitude_error_rad: float  #: angle to the true attitude
    momentum_error_relative: float  #: of H_I
    energy_error_relative: float
    resolved: bool  #: False: some step could not be followed, and the errors are to be expected
    truth: str  #: how the reference was had
    truth_uncertainty_rad: float  #: errors below it mean nothing


class Scene:
    """A validated scene. Made by load_scene() or parse_scene(); it never changes.

    It can be pickled, so worker processes may have it: as its text, and read anew from that. Tables of the scene are
    read anew too, beside where its file was.
    """

    def __init__(self, core: _core.Scene, file: str) -> None:
        self._core = core
        self._file = file

    def __reduce__(self) -> tuple[Callable[[str, str], "Scene"], tuple[str, str]]:
        return parse_scene, (self._core.text, self._file)

    @property
    def file(self) -> str:
        """Where it was read from, or what its text is called."""
        return self._file

    @property
    def step_s(self) -> float:
        return self._core.step_s

    @property
    def duration_s(self) -> Optional[float]:
        """None: endless."""
        return self._core.duration_s

    @property
    def scheme(self) -> str:
        return self._core.scheme

    @property
    def names(self) -> list[str]:
        """Of the spacecraft, in the order of the file."""
        return self._core.names

    def spacecraft(self, name: Optional[str] = None) -> Spacecraft:
        """The one of that name; the only one there is when no name is given. ValueError when there is none."""
        return Spacecraft(**self._core.described(self._core.index_of(self._one(name))))

    def propagate(
        self,
        duration_s: Optional[float] = None,
        every_s: Optional[float] = None,
        *,
        scheme: Optional[str] = None,
        step_s: Optional[float] = None,
        spacecraft: Optional[str] = None,
        torque: Optional[TorqueTable] = None,
    ) -> Motion:
        """The motion of one spacecraft from the start of the scene: the bits that ``adstar propagate`` prints.

        duration_s: how long [s], whole steps; the scene's when left out.
        every_s: a row that often [s], whole steps; every step when left out. The last step has a row always.
        scheme, step_s: instead of the scene's; adstar.schemes() has the names.
        spacecraft: its name; may be left out when there is but one.
        torque: on it, on top of what the scene names.

        Actuators rest: nobody commands them here. A row takes 152 bytes a spacecraft, 16 for its time, and some 100 to
        200 for each row of a table beside it. The GIL is released, and Ctrl-C ends it.

        ValueError: something asked for cannot be; it says what to ask for. TypeError: it is of another type.
        MemoryError: the rows do not fit in the memory that is free; nothing was run, and it says which every_s does,
        or that none does.
        UnresolvedWarning: the scheme could not follow the motion.
        """
        name = self._one(spacecraft)
        added = {} if torque is None else {name: torque}
        return self._propagated([name], duration_s, every_s, scheme, step_s, added, 1)[name]

    def propagate_all(
        self,
        duration_s: Optional[float] = None,
        every_s: Optional[float] = None,
        *,
        scheme: Optional[str] = None,
        step_s: Optional[float] = None,
        spacecraft: Optional[Sequence[str]] = None,
        torque: Optional[Mapping[str, TorqueTable]] = None,
        threads: int = 1,
    ) -> dict[str, Motion]:
        """The motions of several spacecraft, by name: all of the scene's, or those in ``spacecraft``.

        torque: by the name of the spacecraft that it acts on. threads: for large fleets; the bits are the same.
        All else is as in propagate().
        """
        names = self.names if spacecraft is None else asked.names("spacecraft", spacecraft, self.names[0])
        if not names or len(set(names)) < len(names):
            raise ValueError(f"spacecraft: got {names!r}, expected names, each once; try {self.names[:2]}")
        added = {} if torque is None else torque
        if not isinstance(added, Mapping):
            example = f"{{'{names[0]}': adstar.TorqueTable(...)}}"
            raise asked.wrong_type("torque", torque, "tables by spacecraft", example)
        return self._propagated(names, duration_s, every_s, scheme, step_s, added, threads)

    def accuracy(
        self,
        duration_s: Optional[float] = None,
        *,
        scheme: Optional[str] = None,
        step_s: Optional[float] = None,
    ) -> Accuracy:
        """How far a scheme and step stray from the truth on this scene, as ``adstar trade`` measures it.

        The truth of a free body is the closed form, of a forced one an order-8 run refined until it agrees with
        itself, both in long double; that takes longer than the run that is judged.
        """
        return Accuracy(
            **self._core.accuracy(
                asked.seconds_if("duration_s", duration_s),
                asked.text_if("scheme", scheme, "coadjoint_rk4"),
                asked.seconds_if("step_s", step_s),
            )
        )

    def _propagated(
        self,
        names: list[str],
        duration_s: Optional[float],
        every_s: Optional[float],
        scheme: Optional[str],
        step_s: Optional[float],
        torque: Mapping[str, TorqueTable],
        threads: int,
    ) -> dict[str, Motion]:
        places = {name: index for index, name in enumerate(self.names)}
        chosen = {name: places[name] if name in places else self._core.index_of(name) for name in names}
        torques = []
        for name, table in torque.items():
            if name not in chosen:
                raise ValueError(f"torque: got one on '{name}', which is not among those propagated; leave it out")
            torques.append(_added(chosen[name], table))
        run = self._core.propagate(
            list(chosen.values()),
            asked.seconds_if("duration_s", duration_s),
            asked.seconds_if("every_s", every_s),
            asked.text_if("scheme", scheme, "coadjoint_rk4"),
            asked.seconds_if("step_s", step_s),
            torques,
            asked.count("threads", threads, 256),
            available_bytes,
        )
        if run["warning"]:
            warnings.warn(run["warning"], UnresolvedWarning, stacklevel=3)
        return motions(run, names)

    def _one(self, name: Optional[str]) -> str:
        if name is not None:
            return asked.text("spacecraft", name, self.names[0])
        names = self.names
        if len(names) > 1:
            some = ", ".join(names[:10]) + (", ..." if len(names) > 10 else "")
            raise ValueError(
                f"the scene has {len(names)} spacecraft ({some}): say which, spacecraft='{names[0]}', or take "
                "propagate_all()"
            )
        return names[0]

    def __repr__(self) -> str:
        count = len(self.names)
        return (
            f"<adstar.Scene '{self._file}': {count} spacecraft, {self.scheme}, h = {self.step_s:g} s, "
            f"{'endless' if self.duration_s is None else f'{self.duration_s:g} s'}>"
        )


def _added(spacecraft: int, table: TorqueTable) -> _core.AddedTorque:
    if not isinstance(table, TorqueTable):
        example = "adstar.TorqueTable([0.0], [[0.0, 0.0, 0.01]])"
        raise asked.wrong_type("torque", table, "an adstar.TorqueTable", example)
    return _core.AddedTorque(
        spacecraft,
        asked.numbers("time_s", table.time_s, "[0.0]"),
        asked.numbers("torque_n_m", table.torque_n_m, "[[0.0, 0.0, 0.01]]"),
        asked.text("frame", table.frame, "body"),
        asked.text("interpolation", table.interpolation, "hold"),
        asked.text("after_end", table.after_end, "zero"),
    )


def load_scene(path: Union[str, "os.PathLike[str]"]) -> Scene:
    """Reads and validates a scene (service/scene/README.md has every key). Tables are looked up beside it.

    SceneError (a ValueError): every complaint at once, a line each, with line, column and remedy.
    """
    file = asked.path("path", path)
    return Scene(_core.Scene.load(file), file)


def parse_scene(text: str, file: str = "scene.toml") -> Scene:
    """The same from TOML in a string, for studies that vary a number. ``file`` is what complaints call it; tables
    are looked up beside it."""
    file = asked.path("file", file)
    return Scene(_core.Scene.parse(asked.text("text", text, "[simulation]"), file), file)
