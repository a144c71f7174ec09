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

__all__ = [
    "MOST_BYTES",
    "UNWRITTEN",
    "few_digits",
    "n_digits",
    "number_to_text",
    "put_eight",
    "quotient",
    "scale_of",
    "shortest_digits",
    "ten_to",
    "write_integer",
    "write_number",
]

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
    n = n_digits(x)
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
    mantissa, binary = math.frexp(x)
    e = scale_of(binary)
    if x * powers[2 * (REACH + e)] >= TOP:
        e -= 1
    digits, e = shortest_digits(x, mantissa, e, powers[2 * (REACH + e)], powers[2 * (REACH + e) + 1])
    if digits < 0:
        return UNWRITTEN
    n = n_digits(digits)
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
def scale_of(binary: int) -> int:
    """The power of ten that brings ``mantissa * 2**binary`` to 17 digits before the point, or to one more."""
    return 16 - math.floor((binary - 1) * LOG10_OF_2)


@kernel
def shortest_digits(x: float, mantissa: float, e: int, power: float, power_rest: float) -> tuple[int, int]:
    """Digits and exponent of the shortest decimal for an ordinary positive `x`; digits -1: too close to tell.

    ``power + power_rest`` is ``10**e``; it brings `x` to 17 digits before the point; `mantissa` is that of ``frexp``.
    No array goes in, so that no references are counted.
    """
    high, rest = times(x, 0.0, power, power_rest)
    below = math.floor(rest)
    whole = int(high) + int(below)
    fraction = rest - below
    half = x / mantissa * HALF_UNIT * power
    if mantissa == 0.5:  # the next float64 below is nearer than the next above
        half *= 0.5
    hundreds = quotient(whole, 100, 0.01)
    last = whole - 100 * hundreds
    down = last + fraction
    up = 100.0 - down
    nearest = min(down, up)
    if nearest < half - TOLERANCE:
        digits = hundreds + (up < down)
        e -= 2
        fewer = int(digits * 1e-4 + 0.5)
        while fewer * 10000 == digits:
            digits = fewer
            e -= 4
            fewer = int(digits * 1e-4 + 0.5)
        fewer = int(digits * 0.1 + 0.5)
        while fewer * 10 == digits:
            digits = fewer
            e -= 1
            fewer = int(digits * 0.1 + 0.5)
        return digits, -e
    if nearest < half + TOLERANCE or mantissa == 0.5:
        return -1, 0
    tens = quotient(last, 10, 0.1)
    last -= 10 * tens
    down = last + fraction
    up = 10.0 - down
    nearest = min(down, up)
    if nearest < half + TOLERANCE:
        if nearest > half - TOLERANCE or abs(down - up) < TOLERANCE:
            return -1, 0
        return 10 * hundreds + tens + (up < down), 1 - e
    if abs(fraction - 0.5) < TOLERANCE:
        return -1, 0
    return whole + (1 if fraction > 0.5 else 0), -e


@kernel
def n_digits(x: int) -> int:
    """How many decimal digits `x` has, which is not negative and below 10**18."""
    n = 1
    limit = 10
    while n < 18 and x >= limit:
        n += 1
        limit *= 10
    return n


# -- without loops and calls, for the hot path: see `numbers.leading_digits` ----------------------------------------


@kernel
def few_digits(x: int) -> int:
    """How many decimal digits `x` has, which is not negative and below 10**8; without a branch."""
    few = 1 + (x >= 10) + (x >= 100) + (x >= 1000) + (x >= 10000)
    return few + (x >= 100000) + (x >= 1000000) + (x >= 10000000)


@kernel
def ten_to(k: int) -> int:
    """``10**k`` for k from 0 to 17; without a branch."""
    small = (1 + 9 * (k & 1)) * (1 + 99 * ((k >> 1) & 1)) * (1 + 9999 * ((k >> 2) & 1))
    return small * (1 + 99999999 * ((k >> 3) & 1)) * (1 + 9999999999999999 * ((k >> 4) & 1))


@kernel
def put_eight(out: Any, at: int, x: int) -> None:
    """Write all eight digits of `x` below 10**8: the caller shifts what it wants to the left and overwrites the rest.

    Divisions by constants are a multiplication and a shift, exact for numbers so small; Numba's own take three times
    as long, as they round towards minus infinity.
    """
    high = (x * 109951163) >> 40
    low = x - 10000 * high
    a = (high * 5243) >> 19
    b = high - 100 * a
    c = (low * 5243) >> 19
    d = low - 100 * c
    first = (a * 103) >> 10
    out[at] = 48 + first
    out[at + 1] = 48 + a - 10 * first
    first = (b * 103) >> 10
    out[at + 2] = 48 + first
    out[at + 3] = 48 + b - 10 * first
    first = (c * 103) >> 10
    out[at + 4] = 48 + first
    out[at + 5] = 48 + c - 10 * first
    first = (d * 103) >> 10
    out[at + 6] = 48 + first
    out[at + 7] = 48 + d - 10 * first


@kernel
def quotient(x: int, unit: int, inverse: float) -> int:
    """``x // unit`` for x from 0 to 10**17, by way of float64 and put right."""
    q = int(x * inverse)
    rest = x - q * unit
    if rest < 0:
        return q - 1
    return q + 1 if rest >= unit else q
