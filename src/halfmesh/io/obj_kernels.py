"""The compiled part of reading OBJ: what is in the file, and then all of it.

`survey` counts the lines of each kind, so that every part of the text knows how many vertices come before it (negative
indices count backwards) and where its rows go. `read_lines` can stop and go on like its fellows in `off_kernels`.

=============  =================================================================
POSITION       byte where to go on
VERTEX ...     rows read so far, counted from the beginning of the file
CORNER, EDGE   corners and wire edges written by this part
N_POINTS       vertices named by ``p`` lines
N_OPEN         how many places `undecided` holds: (byte, 4 * place + which array)
CODE, WHERE    DONE, AGAIN (decide and call again), or what is wrong, and its byte
SEEN           HAS_TEXTURE, HAS_NORMALS, DOTTED (a colour has a point or exponent)
N_TEXTURE      most components of a texture coordinate
=============  =================================================================
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel
from halfmesh.io.numbers import INTEGER, UNDECIDED, is_blank, is_end, leading_digits, mantissa, number, scaled

__all__ = ["index", "line_kind", "read_lines", "resolved", "survey"]

POSITION, VERTEX, TEXTURE, NORMAL, FACE, EVENT, CORNER, EDGE, N_POINTS = 0, 1, 2, 3, 4, 5, 6, 7, 8
N_OPEN, CODE, WHERE, SEEN, N_TEXTURE = 9, 10, 11, 12, 13
N_STATE = 14

EMPTY, V, VT, VN, F, L, P, OTHER = 0, 1, 2, 3, 4, 5, 6, 7  # kinds of lines
N_KINDS = 8

DONE, AGAIN, FEW_NUMBERS, MANY_NUMBERS, BAD_CORNER, NO_VERTEX, NO_TEXTURE, NO_NORMAL, SMALL_FACE = (
    0,
    1,
    2,
    3,
    4,
    5,
    6,
    7,
    8,
)
HAS_TEXTURE, HAS_NORMALS, DOTTED = 1, 2, 4

POINTS, EXTRAS, TEXTURES, NORMALS = 0, 1, 2, 3  # the arrays that `undecided` refers to
MOST_NUMBERS = 7  # of a vertex: x y z and r g b a
TOO_LARGE = 10**9
HASH = 35


@kernel
def line_kind(c: int, d: int, e: int) -> int:
    """The kind of a line that begins with these three bytes. No array goes in: see `leading_digits`."""
    if is_end(c):
        return EMPTY
    if is_end(d):
        if c == 118:
            return V
        if c == 102:
            return F
        if c == 108:
            return L
        return P if c == 112 else OTHER
    if c == 118 and is_end(e):
        if d == 116:
            return VT
        if d == 110:
            return VN
    return OTHER


@kernel
def survey(b: Any, i: int, end: int, counts: Any) -> None:
    """Count the lines of each kind."""
    while i < end:
        while is_blank(b[i]):
            i += 1
        counts[line_kind(b[i], b[i + 1], b[i + 2])] += 1
        while i < end and b[i] != 10 and b[i] != 13:
            i += 1
        i += 1


@kernel
def index(b: Any, i: int) -> tuple[int, int, bool]:
    """Read any integer, which may end before a slash: its value, where it ends, whether there is one."""
    negative = b[i] == 45
    if negative or b[i] == 43:
        i += 1
    start = i
    value = 0
    d = b[i] - 48
    while 0 <= d <= 9:
        if value < TOO_LARGE:
            value = value * 10 + d
        i += 1
        d = b[i] - 48
    return (-value if negative else value), i, i > start


@kernel
def resolved(i: int, before: int, total: int) -> int:
    """From 1-based or relative to 0-based; -1 if there is no such element."""
    if i < 0:
        return before + i if before + i >= 0 else -1
    return i - 1 if i <= total else -1


@kernel
def read_lines(
    b: Any,
    end: int,
    totals: Any,
    powers: Any,
    points: Any,
    extras: Any,
    n_extras: Any,
    textures: Any,
    normals: Any,
    corners: Any,
    corner_textures: Any,
    corner_normals: Any,
    degrees: Any,
    edges: Any,
    events: Any,
    undecided: Any,
    state: Any,
) -> None:
    """Read lines up to byte `end`."""
    i = state[POSITION]
    vertex = state[VERTEX]
    texture = state[TEXTURE]
    normal = state[NORMAL]
    face = state[FACE]
    event = state[EVENT]
    corner = state[CORNER]
    edge = state[EDGE]
    n_points = state[N_POINTS]
    seen = state[SEEN]
    n_texture = state[N_TEXTURE]
    n_vertices = totals[V]
    n_textures = totals[VT]
    n_normals = totals[VN]
    n_open = 0
    code = DONE
    where = i
    while i < end and code == DONE:
        if n_open + MOST_NUMBERS > len(undecided) // 2:
            code = AGAIN
            break
        where = i
        while is_blank(b[i]):
            i += 1
        kind = line_kind(b[i], b[i + 1], b[i + 2])
        if kind == OTHER:
            events[2 * event] = face
            events[2 * event + 1] = i
            event += 1
        elif kind != EMPTY:
            i += 2 if VT <= kind <= VN else 1
        if V <= kind <= VN:
            least = 3
            most = 3
            if kind == V:
                most = MOST_NUMBERS
            elif kind == VT:
                least = 1
            n = 0
            while True:
                while i < end and is_blank(b[i]):
                    i += 1
                if i >= end or is_end(b[i]):
                    break
                if n == most:
                    code = MANY_NUMBERS
                    break
                start = i
                negative = b[i] == 45
                w, e, after, form = mantissa(b, i + negative)
                value, sure = scaled(w, e, False, powers)
                stop = b[after]
                if sure and is_end(stop) and stop != HASH and after > i + negative:
                    value = -value if negative else value
                    i = after
                else:
                    value, i, form = number(b, i, end, powers)
                if kind == V:
                    if n < 3:
                        place = 3 * vertex + n
                        points[place] = value
                        place = 4 * place + POINTS
                    else:
                        place = 4 * vertex + n - 3
                        extras[place] = value
                        place = 4 * place + EXTRAS
                        if form != INTEGER:
                            seen |= DOTTED
                elif kind == VT:
                    place = 3 * texture + n
                    textures[place] = value
                    place = 4 * place + TEXTURES
                else:
                    place = 3 * normal + n
                    normals[place] = value
                    place = 4 * place + NORMALS
                if form == UNDECIDED:
                    undecided[2 * n_open] = start
                    undecided[2 * n_open + 1] = place
                    n_open += 1
                n += 1
            if code != DONE:
                break
            if n < least:
                code = FEW_NUMBERS
                break
            if kind == V:
                if n == 5:
                    code = MANY_NUMBERS
                    break
                n_extras[vertex] = n - 3
                vertex += 1
            elif kind == VT:
                n_texture = max(n_texture, n)
                for j in range(n, 3):
                    textures[3 * texture + j] = 0.0
                texture += 1
            else:
                normal += 1
        elif F <= kind <= P:
            n = 0
            last = -1
            while True:
                while i < end and is_blank(b[i]):
                    i += 1
                if i >= end or is_end(b[i]):
                    break
                start = i
                t = 0
                vn = 0
                v, after = leading_digits(b, i)
                good = after > i and after < i + 8
                if good:
                    i = after
                else:
                    v, i, good = index(b, i)
                if good and i < end and b[i] == 47:
                    i += 1
                    if i < end and b[i] != 47 and not is_end(b[i]):
                        t, i, good = index(b, i)
                    if good and i < end and b[i] == 47:
                        i += 1
                        if i < end and not is_end(b[i]):
                            vn, i, good = index(b, i)
                if not good or (i < end and not is_end(b[i])):
                    code = BAD_CORNER
                    where = start
                    break
                v = resolved(v, vertex, n_vertices)
                if v < 0:
                    code = NO_VERTEX
                    where = start
                    break
                n += 1
                if kind == P:
                    n_points += 1
                elif kind == L:
                    if n > 1:
                        edges[2 * edge] = last
                        edges[2 * edge + 1] = v
                        edge += 1
                    last = v
                else:
                    if t != 0 and n_textures > 0:
                        if not seen & HAS_TEXTURE:
                            seen |= HAS_TEXTURE
                            for j in range(corner):
                                corner_textures[j] = -1
                        t = resolved(t, texture, n_textures)
                        if t < 0:
                            code = NO_TEXTURE
                            where = start
                            break
                    else:
                        t = -1
                    if seen & HAS_TEXTURE:
                        corner_textures[corner] = t
                    if vn != 0 and n_normals > 0:
                        if not seen & HAS_NORMALS:
                            seen |= HAS_NORMALS
                            for j in range(corner):
                                corner_normals[j] = -1
                        vn = resolved(vn, normal, n_normals)
                        if vn < 0:
                            code = NO_NORMAL
                            where = start
                            break
                    else:
                        vn = -1
                    if seen & HAS_NORMALS:
                        corner_normals[corner] = vn
                    corners[corner] = v
                    corner += 1
            if code != DONE:
                break
            if kind == F:
                if n < 3:
                    code = SMALL_FACE
                    break
                degrees[face] = n
                face += 1
        while i < end and b[i] != 10 and b[i] != 13:
            i += 1
        i += 1
    state[POSITION] = i
    state[VERTEX] = vertex
    state[TEXTURE] = texture
    state[NORMAL] = normal
    state[FACE] = face
    state[EVENT] = event
    state[CORNER] = corner
    state[EDGE] = edge
    state[N_POINTS] = n_points
    state[N_OPEN] = n_open
    state[CODE] = code
    state[WHERE] = where
    state[SEEN] = seen
    state[N_TEXTURE] = n_texture
