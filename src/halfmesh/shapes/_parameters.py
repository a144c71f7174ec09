"""Checks of what the makers of shapes are asked for."""

from __future__ import annotations

import math
import operator
from typing import Any

MOST_CORNERS = 2**31 - 2


def whole(name: str, value: Any, least: int) -> int:
    """The value as an int that is at least `least`, or a ValueError that says so."""
    try:
        number = operator.index(value)
    except TypeError:
        number = least - 1
    if number < least:
        raise ValueError(f"{name} must be an integer, at least {least}, not {value!r}")
    return number


def positive(name: str, value: Any) -> float:
    """The value as a positive finite float, or a ValueError that says so."""
    number = real(name, value)
    if number <= 0:
        raise ValueError(f"{name} must be positive, not {value!r}")
    return number


def real(name: str, value: Any) -> float:
    """The value as a finite float, or a ValueError that says so."""
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"{name} must be a finite number, not {value!r}")
    return number


def holdable(n_corners: int, what: str) -> None:
    """Refuse, before anything is allocated, what int32 indices can't count."""
    if n_corners > MOST_CORNERS:
        raise ValueError(f"{what} would have {n_corners:,} face corners, more than 2^31 - 2")
