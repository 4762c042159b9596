"""The types of what is handed over: what is of another is a TypeError that says which parameter it is, what it was and
what to give instead. Values are checked where they are used, in ``_core``."""

import math
import operator
import os
import reprlib
from collections.abc import Iterable
from typing import Any, Optional, SupportsFloat, SupportsIndex

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[Any]  #: integers or floats of any width
REAL = "biuf"  #: NumPy's kinds of real numbers, and of truth


def wrong_type(name: str, given: object, expected: str, example: str, place: str = "") -> TypeError:
    shown = " ".join(reprlib.repr(given).split())
    got = "None" if given is None else f"{shown} ({type(given).__name__})"
    return TypeError(f"{name}: got {got}{place}, expected {expected}; try {example}")


def real(given: object) -> Optional[float]:
    """None of what is no real number. float() would read text too, and whatever NumPy has: time spans in their own
    unit, text, the real part of complex numbers."""
    if isinstance(given, (np.generic, np.ndarray)) and given.dtype.kind not in REAL:
        return None
    if isinstance(given, (SupportsFloat, SupportsIndex)):
        try:
            return float(given)
        except OverflowError:  # an int beyond any double: out of range, and said to be
            return math.inf
        except (TypeError, ValueError):
            pass
    return None


def seconds(name: str, given: object) -> float:
    number = real(given)
    if number is None:
        raise wrong_type(name, given, "seconds, a number", "0.1")
    return number


def seconds_if(name: str, given: object) -> Optional[float]:
    return None if given is None else seconds(name, given)


def text(name: str, given: object, example: str) -> str:
    if isinstance(given, str):
        return given
    raise wrong_type(name, given, "text", repr(example))


def text_if(name: str, given: object, example: str) -> Optional[str]:
    return None if given is None else text(name, given, example)


def path(name: str, given: object) -> str:
    if isinstance(given, (str, os.PathLike)):
        plain = os.fspath(given)
        if isinstance(plain, str):
            return plain
    raise wrong_type(name, given, "a path, as text or a pathlib.Path", "'scene.toml'")


def names(name: str, given: object, example: str) -> list[str]:
    """One text is no list, though it can be iterated over."""
    if isinstance(given, (str, bytes)) or not isinstance(given, Iterable):
        raise wrong_type(name, given, "a list of names", f"['{given if isinstance(given, str) else example}']")
    return [text(f"{name}[{i}]", each, example) for i, each in enumerate(given)]


def numbers(name: str, given: object, example: str) -> Numbers:
    """Not of text or of complex numbers, though NumPy would make some of them."""
    try:
        array: Numbers = np.asarray(given)
    except (TypeError, ValueError, OverflowError):  # rows of several lengths, for one
        raise wrong_type(name, given, "numbers", example) from None
    if array.dtype.kind == "O":
        return _each_real(name, array, example)
    if array.dtype.kind not in REAL:
        raise wrong_type(name, given, "numbers", example)
    return array


def _each_real(name: str, objects: NDArray[np.object_], example: str) -> Numbers:
    doubles = np.empty(objects.shape)
    for place in np.ndindex(objects.shape):
        number = real(objects[place])
        if number is None:
            where = f" at {list(place)}" if place else ""
            raise wrong_type(name, objects[place], "numbers", example, where)
        doubles[place] = number
    return doubles


def numbers_if(name: str, given: object, example: str) -> Optional[Numbers]:
    return None if given is None else numbers(name, given, example)


def count(name: str, given: object, most: int) -> int:
    """1 to most; ValueError for others."""
    try:
        number = operator.index(given)  # type: ignore[arg-type]
    except TypeError:
        raise wrong_type(name, given, f"a whole number, 1 to {most}", "1") from None
    if not 1 <= number <= most:
        raise ValueError(f"{name}: got {number}, expected 1 to {most}; try 1")
    return number
