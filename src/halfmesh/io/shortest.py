"""From float64 to the shortest decimal text that reads back as the same number.

The number, scaled by a power of ten to 17 digits before the point, is held as a double-double: an integer and a
fraction that are exact to 1e-9. All decimals within half a unit in the last place of the float64 read back as it; among
them the one with the most trailing zeros is the shortest, and of several the nearest is taken. Where 1e-9 is too coarse
to tell (ties, boundaries), and for nan, inf and exponents beyond 10**80, nothing is written and Python's ``repr``
decides.

The text is that of ``repr``, without the ``.0`` behind integers.
"""

from __future__ import annotations

import math
from typing import Any

from halfmesh._jit import kernel
from halfmesh.io.numbers import REACH, times

__all__ = ["MOST_BYTES", "UNWRITTEN", "number_to_text", "write_integer", "write_number"]

UNWRITTEN = -1
MOST_BYTES = 26  # -2.2250738585072014e-308 has 24, and two for a ".0"

LOG10_OF_2 = 0.30102999566398120
LARGEST = 1e80
SMALLEST = 1e-80
INTEGERS = 9007199254740992.0
HALF_UNIT = 2.0**-54
TOP = 1e17
TOLERANCE = 1e-9


def number_to_text(x: float, dotted: bool = False) -> str:
    """The same text, by way of ``repr``.

    Examples
    --------
    >>> number_to_text(0.1), number_to_text(2.0), number_to_text(2.0, dotted=True), number_to_text(1e-7)
    ('0.1', '2', '2.0', '1e-07')
    """
    text = repr(float(x))
    return text if dotted else text.removesuffix(".0")


@kernel
def write_integer(x: int, out: Any, at: int) -> int:
    """Write `x` at ``out[at]``; where the text ends."""
    if x < 0:
        out[at] = 45
        at += 1
        x = -x
    n = 1
    limit = 10
    while n < 18 and x >= limit:
        n += 1
        limit *= 10
    write_digits(x, n, out, at)
    return at + n


@kernel
def write_digits(x: int, n: int, out: Any, at: int) -> None:
    """Write the last `n` digits of `x`, which is not negative."""
    for i in range(n):
        rest = x // 10
        out[at + n - 1 - i] = 48 + x - 10 * rest
        x = rest


@kernel
def write_number(x: float, dotted: bool, out: Any, at: int, powers: Any) -> int:
    """Write `x` at ``out[at]``; where the text ends, or UNWRITTEN. ``dotted``: integers end with ``.0``."""
    if math.copysign(1.0, x) < 0.0:
        out[at] = 45
        at += 1
        x = -x
    if x < INTEGERS and x == math.floor(x):
        at = write_integer(int(x), out, at)
        if dotted:
            out[at] = 46
            out[at + 1] = 48
            at += 2
        return at
    if not (SMALLEST < x < LARGEST):
        return UNWRITTEN
    digits, e = shortest_digits(x, powers)
    if digits < 0:
        return UNWRITTEN
    n = 1
    limit = 10
    while n < 18 and digits >= limit:
        n += 1
        limit *= 10
    point = n + e  # digits before the decimal point
    if point > 16 or point < -3:
        return write_scientific(digits, n, point - 1, out, at)
    if point <= 0:
        out[at] = 48
        out[at + 1] = 46
        at += 2
        for _ in range(-point):
            out[at] = 48
            at += 1
        write_digits(digits, n, out, at)
        return at + n
    if point >= n:  # beyond 2**53, but written without an exponent
        write_digits(digits, n, out, at)
        at += n
        for _ in range(point - n):
            out[at] = 48
            at += 1
        if dotted:
            out[at] = 46
            out[at + 1] = 48
            at += 2
        return at
    write_digits(digits, n, out, at + 1)
    for i in range(at, at + point):
        out[i] = out[i + 1]
    out[at + point] = 46
    return at + n + 1


@kernel
def write_scientific(digits: int, n: int, e: int, out: Any, at: int) -> int:
    """One digit, a point if more follow, the exponent with its sign and at least two digits."""
    write_digits(digits, n, out, at + 1)
    out[at] = out[at + 1]
    out[at + 1] = 46
    at += n + 1 if n > 1 else 1
    out[at] = 101
    out[at + 1] = 45 if e < 0 else 43
    at += 2
    e = abs(e)
    if e < 10:
        out[at] = 48
        at += 1
    return write_integer(e, out, at)


@kernel
def shortest_digits(x: float, powers: Any) -> tuple[int, int]:
    """Digits and exponent of the shortest decimal for an ordinary positive `x`; digits -1: too close to tell."""
    mantissa, binary = math.frexp(x)
    e = 16 - math.floor((binary - 1) * LOG10_OF_2)
    high, rest = times(x, 0.0, powers[2 * (REACH + e)], powers[2 * (REACH + e) + 1])
    if high >= TOP:
        e -= 1
        high, rest = times(x, 0.0, powers[2 * (REACH + e)], powers[2 * (REACH + e) + 1])
    below = math.floor(rest)
    whole = int(high) + int(below)
    fraction = rest - below
    half = x / mantissa * HALF_UNIT * powers[2 * (REACH + e)]
    if mantissa == 0.5:  # the next float64 below is nearer than the next above
        half *= 0.5
    last = whole % 100
    down = last + fraction
    up = 100.0 - down
    nearest = min(down, up)
    if nearest < half - TOLERANCE:
        digits = (whole - last + (100 if up < down else 0)) // 100
        e -= 2
        while digits % 10000 == 0:
            digits //= 10000
            e -= 4
        while digits % 10 == 0:
            digits //= 10
            e -= 1
        return digits, -e
    if nearest < half + TOLERANCE or mantissa == 0.5:
        return -1, 0
    last = whole % 10
    down = last + fraction
    up = 10.0 - down
    nearest = min(down, up)
    if nearest < half + TOLERANCE:
        if nearest > half - TOLERANCE or abs(down - up) < TOLERANCE:
            return -1, 0
        return (whole - last + (10 if up < down else 0)) // 10, 1 - e
    if abs(fraction - 0.5) < TOLERANCE:
        return -1, 0
    return whole + (1 if fraction > 0.5 else 0), -e
