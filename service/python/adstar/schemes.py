"""Which integration schemes there are."""

from dataclasses import dataclass
from typing import Optional

from . import _core


@dataclass(frozen=True)
class Scheme:
    """What a scheme says of itself; its source is in include/adstar/schemes.md."""

    name: str
    order: Optional[int]  #: None: closed form, its only error is round-off
    exact_momentum: bool  #: H_I changes by the impulse alone; a free body's never, to the last bit
    exact_energy: bool  #: a free body's energy is kept to round-off
    free_only: bool  #: knows no torque
    carries_wheels: bool  #: steps bodies with wheels
    links_bodies: bool  #: steps bodies on joints


def schemes() -> dict[str, Scheme]:
    """All schemes by name, the default first."""
    return {scheme["name"]: Scheme(**scheme) for scheme in _core.schemes()}
