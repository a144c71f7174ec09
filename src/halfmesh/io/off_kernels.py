"""The compiled part of reading OFF text: rows of vertices, rows of faces.

Both kernels can stop and go on, because a number that only Python can decide (see `numbers`) takes a place in a list of
limited length. `state` carries everything from one call to the next, and out:

=========  =========================================================
POSITION   byte where to go on
ROW        vertex or face to go on with
N_OPEN     how many places `undecided` holds: (byte, place of the value)
CODE       DONE, AGAIN (decide and call again), or what is wrong
WHERE      byte of what is wrong
SEEN       bit c is set if column c held a number with a point or an exponent
CORNER     corners written
=========  =========================================================
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel
from halfmesh.io.numbers import INTEGER, UNDECIDED, is_blank, is_end, leading_digits, mantissa, number, scaled
from halfmesh.io.source import skip_gaps

__all__ = ["read_faces", "read_vertices", "whole"]

POSITION, ROW, N_OPEN, CODE, WHERE, SEEN, CORNER = 0, 1, 2, 3, 4, 5, 6
N_STATE = 7

DONE, AGAIN, FILE_ENDS, LINE_ENDS, LINE_GOES_ON, NOT_WHOLE, NO_SUCH_VERTEX, SMALL_FACE = 0, 1, 2, 3, 4, 5, 6, 7

MOST_EXTRAS = 4
LAST_BIT = 60
HASH = 35
TOO_LARGE = 10**9


@kernel
def whole(b: Any, i: int, end: int) -> tuple[int, int, bool]:
    """Read any integer at ``b[i]``: its value, where it ends, and whether it is one."""
    negative = b[i] == 45
    if negative or b[i] == 43:
        i += 1
    start = i
    value = 0
    while i < end:
        d = b[i] - 48
        if d < 0 or d > 9:
            break
        if value < TOO_LARGE:
            value = value * 10 + d
        i += 1
    good = i > start and (i >= end or is_end(b[i]))
    return (-value if negative else value), i, good


@kernel
def read_vertices(
    b: Any, end: int, last: int, width: int, by_lines: bool, powers: Any, values: Any, undecided: Any, state: Any
) -> None:
    """Read rows of `width` numbers up to row `last`; ``by_lines``: one row is one line."""
    i = state[POSITION]
    row = state[ROW]
    n_open = 0
    seen = state[SEEN]
    code = DONE
    where = i
    while row < last and code == DONE:
        if n_open + width > len(undecided) // 2:
            code = AGAIN
            break
        while is_end(b[i]) and b[i] != HASH and i < end:
            i += 1
        if b[i] == HASH:
            i = skip_gaps(b, i, end)
        where = i
        if i >= end:
            code = FILE_ENDS
            break
        place = row * width
        for c in range(width):
            if by_lines:
                while i < end and is_blank(b[i]):
                    i += 1
                if i >= end or is_end(b[i]):
                    code = LINE_ENDS
                    break
            else:
                i = skip_gaps(b, i, end)
                if i >= end:
                    code = FILE_ENDS
                    break
            start = i
            negative = b[i] == 45
            w, e, after, kind = mantissa(b, i + negative)
            value, sure = scaled(w, e, False, powers)
            stop = b[after]
            if sure and is_end(stop) and stop != HASH and after > i + negative:
                value = -value if negative else value
                i = after
            else:
                value, i, kind = number(b, i, end, powers)
            values[place + c] = value
            if kind != INTEGER:
                seen |= 1 << min(c, LAST_BIT)
                if kind == UNDECIDED:
                    undecided[2 * n_open] = start
                    undecided[2 * n_open + 1] = place + c
                    n_open += 1
        if by_lines and code == DONE:
            while i < end and is_blank(b[i]):
                i += 1
            if i < end and not is_end(b[i]):
                code = LINE_GOES_ON
        row += code == DONE
    state[POSITION] = i
    state[ROW] = row
    state[N_OPEN] = n_open
    state[CODE] = code
    state[WHERE] = where
    state[SEEN] = seen


@kernel
def read_faces(
    b: Any,
    end: int,
    last: int,
    n_vertices: int,
    by_lines: bool,
    most: int,
    powers: Any,
    corners: Any,
    degrees: Any,
    extras: Any,
    n_extras: Any,
    undecided: Any,
    state: Any,
) -> None:
    """Read faces up to face `last`: a degree, that many indices, and up to `most` more numbers until the line ends.

    With ``most == 0`` another face may follow on the same line.
    """
    i = state[POSITION]
    face = state[ROW]
    corner = state[CORNER]
    n_open = 0
    seen = state[SEEN]
    code = DONE
    where = i
    while face < last and code == DONE:
        if n_open + MOST_EXTRAS > len(undecided) // 2:
            code = AGAIN
            break
        while is_end(b[i]) and b[i] != HASH and i < end:
            i += 1
        if b[i] == HASH:
            i = skip_gaps(b, i, end)
        where = i
        if i >= end:
            code = FILE_ENDS
            break
        degree = 1
        n = 0
        while n <= degree:  # the degree is read like an index: one place to call `whole`, so that it is inlined
            while i < end and is_blank(b[i]):
                i += 1
            if i < end and is_end(b[i]) and not by_lines:
                i = skip_gaps(b, i, end)
            if i >= end:
                code = FILE_ENDS
                break
            if is_end(b[i]):
                code = LINE_ENDS
                break
            start = i
            v, after = leading_digits(b, i)
            good = after > i and is_end(b[after])
            if good:
                i = after
            else:
                v, i, good = whole(b, i, end)
            if not good:
                code = NOT_WHOLE
                where = start
                break
            if n == 0:
                degree = v
                if v < 3:
                    code = SMALL_FACE
                    break
            elif v < 0 or v >= n_vertices:
                code = NO_SUCH_VERTEX
                where = start
                break
            else:
                corners[corner] = v
                corner += 1
            n += 1
        if code != DONE:
            break
        degrees[face] = degree
        n = 0
        while i < end and is_blank(b[i]):
            i += 1
        while most > 0 and i < end and not is_end(b[i]):
            if n == most:
                code = LINE_GOES_ON
                where = i
                break
            place = MOST_EXTRAS * face + n
            start = i
            value, i, kind = number(b, i, end, powers)
            extras[place] = value
            if kind != INTEGER:
                seen |= 1
                if kind == UNDECIDED:
                    undecided[2 * n_open] = start
                    undecided[2 * n_open + 1] = place
                    n_open += 1
            n += 1
            while i < end and is_blank(b[i]):
                i += 1
        n_extras[face] = n
        face += code == DONE
    state[POSITION] = i
    state[ROW] = face
    state[N_OPEN] = n_open
    state[CODE] = code
    state[WHERE] = where
    state[SEEN] = seen
    state[CORNER] = corner
