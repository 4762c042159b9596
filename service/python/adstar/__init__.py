"""Attitude propagation for satellites: the core of adstar, in NumPy.

    import adstar
    scene = adstar.load_scene("configs/scenes/paper_free.toml")
    motion = scene.propagate(duration_s=100, every_s=0.1)
    motion.q_IB, motion.momentum_inertial_n_m_s

Conventions, everywhere in here:

- I is the inertial frame, B the body's. ``q_IB`` maps body vectors to inertial ones, v_I = R_IB v_B, and its
  numbers are w, x, y, z: scalar FIRST (Hamilton). For ``scipy.spatial.transform.Rotation.from_quat`` and other code
  that wants the scalar last, take ``q_IB_xyzw``. q and -q are the same attitude.
- ``angular_velocity_body_rad_s`` is that of B relative to I, in B. Names carry frame and unit; SI and radians.
- Time is whole nanoseconds inside: t = n h. Arrays have a row an instant, the first is the start.

What is computed is what ``adstar propagate`` computes, to the last bit. The propagation library is described in
include/adstar/notation.md, scenes in service/scene/README.md, recordings in service/pages/recording.md.
"""

from ._core import RecordingError, SceneError, __version__
from .body import Body
from .motion import Motion
from .recording import RecordingWarning, read_recording
from .scene import Accuracy, Scene, Spacecraft, TorqueTable, load_scene, parse_scene
from .schemes import Scheme, schemes
from .unresolved import UnresolvedWarning

__all__ = [
    "Accuracy",
    "Body",
    "Motion",
    "RecordingError",
    "RecordingWarning",
    "Scene",
    "SceneError",
    "Scheme",
    "Spacecraft",
    "TorqueTable",
    "UnresolvedWarning",
    "__version__",
    "load_scene",
    "parse_scene",
    "read_recording",
    "schemes",
]
