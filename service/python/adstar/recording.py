"""Recordings of the bus, made by ``adstar record``."""

import os
import warnings
from collections.abc import Sequence
from typing import Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _core, asked


class RecordingWarning(UserWarning):
    """A recording that is not whole: still being made, cut off, with a part lost, or with samples of other types."""


def read_recording(
    path: Union[str, "os.PathLike[str]"],
    topics: Optional[Sequence[str]] = None,
    spacecraft: Optional[Sequence[str]] = None,
) -> dict[str, NDArray[np.void]]:
    """A recording by topic: structured arrays with the columns and the rows of ``adstar export --to csv``.

        recording = adstar.read_recording("runs/bus")
        recording["motion"]["momentum_inertial_x_n_m_s"]
        pandas.DataFrame(recording["command_status"])

    path: the directory that ``adstar record`` made.
    topics: "motion" (attitude and momentum of a step in one row), "attitude_state", "momentum_state",
        "wheel_state", "pointing_state", "body_state", "joint_state", "fleet_state", "command_status"; all when left
        out. Those without rows are not in the answer.
    spacecraft: of these alone; fleet_state tells of all.

    Names are text, counts uint64, everything else float64; NaN is a number that was not said. q_w comes first.
    OSError (RecordingError): there is no recording, or it cannot be read. ValueError: a topic or spacecraft that
    there is not; TypeError: no list of names. RecordingWarning: the recording is not whole. No message is
    changed; files that were left with a log beside them take it in, where they may be written.
    """
    tables, said = _core.read_recording(
        asked.path("path", path),
        None if topics is None else set(asked.names("topics", topics, "motion")),
        None if spacecraft is None else set(asked.names("spacecraft", spacecraft, "sat1")),
    )
    for warning in said:
        warnings.warn(warning, RecordingWarning, stacklevel=2)
    return tables
