"""From decimal text to float64, with the bits that Python's ``float()`` gives.

A decimal number is ``w * 10**e`` with an integer `w`. Where `w` and the power of ten are both exact in float64, one
multiplication or division rounds once, and that is the answer. Everywhere else the product is formed in *double-double*
(a sum of two float64, about 106 bits) and rounded; the rest says how far the next rounding boundary is, and if the
boundary is nearer than the error bound, or the number is out of the ordinary (``nan``, ``inf``, beyond 10**120), the
kernel doesn't guess: it notes the place as *undecided* and Python decides with ``float()``.

Only float64 and small ints are used, so that compiled and interpreted code do the very same arithmetic.

Accepted is what ``float()`` accepts in ASCII, without underscores: ``1``, ``+.5``, ``2.``, ``1e-3``, ``nan``, ``-inf``,
``Infinity``. Refused: hexadecimal, decimal commas, ``1_000``, ``1d5``, ``1.#IND``.
"""

from __future__ import annotations

import functools
import re
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel

__all__ = [
    "DECIMAL",
    "INTEGER",
    "UNDECIDED",
    "is_blank",
    "is_end",
    "number",
    "number_from_text",
    "powers_of_ten",
]

INTEGER, DECIMAL, UNDECIDED = 0, 1, 2

REACH = 120  # powers of ten in the table, both ways
EXACT = 22  # 10**22 is the largest power of ten that float64 holds exactly
FULL = 10**17  # once w is this large, one more digit is taken and no other: w < 10**18 fits in an int64
ROOM_FOR_SEVEN = 10**11
INTEGERS = 2**53
SPLITTER = 134217729.0  # 2**27 + 1 cuts a float64 into two halves of 26 bits
ERROR = 2.0**-98  # of a product of two double-doubles, relative; the sum of all roundings is below 2**-102

_NUMBER = re.compile(rb"[+-]?(?:(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|nan|inf|infinity)\Z", re.IGNORECASE)


@functools.cache
def powers_of_ten() -> NDArray[np.float64]:
    """``10**e`` for ``-REACH <= e <= REACH`` as pairs (high part, rest); flat, 2 * (2 * REACH + 1) numbers."""
    table = np.empty(2 * (2 * REACH + 1))
    for e in range(-REACH, REACH + 1):
        exact = Fraction(10) ** e
        high = float(exact)
        table[2 * (e + REACH)] = high
        table[2 * (e + REACH) + 1] = float(exact - Fraction(high))
    return table


def number_from_text(token: bytes) -> float | None:
    """What ``float()`` makes of a token, None if it is not a number.

    Examples
    --------
    >>> number_from_text(b"-1e400"), number_from_text(b"1_0"), number_from_text(b"0x1p3")
    (-inf, None, None)
    """
    if _NUMBER.match(token) is None:
        return None
    return float(token)


@kernel
def is_blank(c: int) -> bool:
    """Space, tab, vertical tab, form feed: what separates numbers within a line."""
    return c == 32 or (9 <= c <= 12 and c != 10)


@kernel
def is_end(c: int) -> bool:
    """A token ends before white space and before a comment."""
    return c == 32 or (9 <= c <= 13) or c == 35


@kernel
def leading_digits(b: Any, i: int) -> tuple[int, int]:
    """The digits at ``b[i]``, eight at most: their value and where they end.

    Written out, not for beauty: each digit has a branch of its own to be predicted by, and without a loop or a call
    Numba leaves out the counting of references, two locked instructions for each array: 4 ns an index instead of 13.
    Behind the text there must be something that is no digit.
    """
    value = b[i] - 48
    if value < 0 or value > 9:
        return 0, i
    d = b[i + 1] - 48
    if d < 0 or d > 9:
        return value, i + 1
    value = value * 10 + d
    d = b[i + 2] - 48
    if d < 0 or d > 9:
        return value, i + 2
    value = value * 10 + d
    d = b[i + 3] - 48
    if d < 0 or d > 9:
        return value, i + 3
    value = value * 10 + d
    d = b[i + 4] - 48
    if d < 0 or d > 9:
        return value, i + 4
    value = value * 10 + d
    d = b[i + 5] - 48
    if d < 0 or d > 9:
        return value, i + 5
    value = value * 10 + d
    d = b[i + 6] - 48
    if d < 0 or d > 9:
        return value, i + 6
    value = value * 10 + d
    d = b[i + 7] - 48
    if d < 0 or d > 9:
        return value, i + 7
    value = value * 10 + d
    return value, i + 8


@kernel
def mantissa(b: Any, i: int) -> tuple[int, int, int, int]:
    """The common number ``w * 10**e`` without sign and exponent at ``b[i]``: w, e, where it ends, INTEGER or DECIMAL.

    At most 8 digits before the point and 10 behind it, or 17 in all if there is one before the point. If there is
    anything else it ends within the token. Loops of fixed length are written out by the compiler.
    """
    w = 0
    start = i
    for _ in range(8):
        d = b[i] - 48
        if d < 0 or d > 9:
            break
        w = w * 10 + d
        i += 1
    if b[i] != 46:
        return w, 0, i, INTEGER
    i += 1
    point = i
    for _ in range(10):
        d = b[i] - 48
        if d < 0 or d > 9:
            break
        w = w * 10 + d
        i += 1
    if w < ROOM_FOR_SEVEN:
        for _ in range(7):
            d = b[i] - 48
            if d < 0 or d > 9:
                break
            w = w * 10 + d
            i += 1
    if i == start + 1:
        return 0, 0, start, DECIMAL
    return w, point - i, i, DECIMAL


@kernel
def times(a: float, a_rest: float, b: float, b_rest: float) -> tuple[float, float]:
    """The product of two double-doubles, as one; Dekker's algorithm."""
    product = a * b
    cut = SPLITTER * a
    a_high = cut - (cut - a)
    a_low = a - a_high
    cut = SPLITTER * b
    b_high = cut - (cut - b)
    b_low = b - b_high
    rest = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    rest += a * b_rest + a_rest * b
    high = product + rest
    return high, rest - (high - product)


@kernel
def scaled(w: int, e: int, cut_off: bool, powers: Any) -> tuple[float, bool]:
    """``w * 10**e`` as ``float()`` rounds it, and whether that is sure; ``cut_off``: up to 1 must be added to `w`."""
    value = float(w)
    if w == 0:
        return value, True
    if w <= INTEGERS and -EXACT <= e <= EXACT and not cut_off:
        if e < 0:
            return value / powers[2 * (REACH - e)], True
        return value * powers[2 * (REACH + e)], True
    if e < -REACH or e > REACH:
        return 0.0, False
    rest = float(w - int(value))
    power = powers[2 * (REACH + e)]
    slack = 0.0
    if cut_off:
        rest += 0.5
        slack = 0.5 * power
    value, rest = times(value, rest, power, powers[2 * (REACH + e) + 1])
    slack += value * ERROR
    return value, value + (rest + slack) == value and value + (rest - slack) == value


@kernel
def number(b: Any, i: int, end: int, powers: Any) -> tuple[float, int, int]:
    """Read any number at ``b[i]``: its value, where the token ends, and INTEGER, DECIMAL or UNDECIDED."""
    c = b[i]
    negative = c == 45
    if negative or c == 43:
        i += 1
    w = 0
    e = 0
    cut_off = False
    start = i
    while i < end:
        d = b[i] - 48
        if d < 0 or d > 9:
            break
        if w < FULL:
            w = w * 10 + d
        else:
            e += 1
            cut_off |= d != 0
        i += 1
    n_digits = i - start
    kind = INTEGER
    if i < end and b[i] == 46:
        kind = DECIMAL
        i += 1
        start = i
        while i < end:
            d = b[i] - 48
            if d < 0 or d > 9:
                break
            if w < FULL:
                w = w * 10 + d
                e -= 1
            else:
                cut_off |= d != 0
            i += 1
        n_digits += i - start
    if n_digits > 0 and i < end and (b[i] | 32) == 101:
        kind = DECIMAL
        i += 1
        down = i < end and b[i] == 45
        if i < end and (down or b[i] == 43):
            i += 1
        start = i
        exponent = 0
        while i < end:
            d = b[i] - 48
            if d < 0 or d > 9:
                break
            if exponent < 100000:
                exponent = exponent * 10 + d
            i += 1
        if i == start:
            n_digits = 0
        e += -exponent if down else exponent
    if n_digits == 0 or (i < end and (b[i] == 35 or not is_end(b[i]))):  # 1.#IND is no 1 with a comment
        while i < end and not is_end(b[i]):
            i += 1
        return 0.0, i, UNDECIDED
    value, sure = scaled(w, e, cut_off, powers)
    return (-value if negative else value), i, (kind if sure else UNDECIDED)
