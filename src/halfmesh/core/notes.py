"""Notes: what an operator says about the attributes of the elements it makes, joins and moves.

An operator is purely topological. But it knows that the new vertex lies between two others, that one face is part of
another, that two vertices have become one; and the attributes that no kernel handles by itself follow from that, by
the policy of each, when the kernel returns. A note is a run of ints in ``t.notes``, with a weight for each source at
the same place in ``t.weights``::

    relation, kind, element, n, source_1 ... source_n

============  ==================================================================================================
``BETWEEN``   the element is new, and lies among the sources: weights are affine, they add up to 1
``PART``      the element is a part of its one source, which the weight measures: the parts make up the whole
``UNION``     the element is now what the sources were, itself among them
``COPY``      the element takes the place of its one source
``WEDGE``     a corner at an end of an edge that was contracted: sources are the corners at this end and at the other
              on the edge's left side, and on its right; it follows the side that it shared its value with, if any
``CYCLE``     the element and its sources exchange values in a ring: it takes the first source's, that the second's, and
              so on, and the last source takes the element's
============  ==================================================================================================

The notes of an operator are in the order in which its values are to be moved, and speak of the values before it.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import apart, grown, inline_kernel, kernel
from halfmesh.core.topology import HAS_NOTES, NEWS, NOTES_SIZE, NOTING, REPLACED

__all__ = [
    "BETWEEN",
    "COPY",
    "CORNERS",
    "CYCLE",
    "EDGES",
    "FACES",
    "PART",
    "UNION",
    "VERTICES",
    "WEDGE",
    "add_source",
    "begin_note",
    "is_noting",
    "note_between",
    "note_copy",
    "note_part",
    "note_union",
    "note_wedge",
    "noted_elements",
]

BETWEEN, PART, UNION, COPY, WEDGE, CYCLE = range(6)
VERTICES, CORNERS, EDGES, FACES = 1, 2, 4, 8  # kinds, as bits of counts[NOTING]


@inline_kernel
def is_noting(t: Any, kind: int) -> bool:
    """Whether any attribute of this kind of element follows by notes."""
    return t.counts[NOTING] & kind != 0  # type: ignore[no-any-return]


@kernel
def begin_note(t: Any, relation: int, kind: int, element: int, n: int) -> None:
    """Begin a note with `n` sources, to be added one by one."""
    apart()
    place = t.counts[NOTES_SIZE]
    if place + n + 4 > len(t.notes):
        t.notes = grown(t.notes, 2 * (place + n) + 64)
        t.weights = grown(t.weights, len(t.notes))
        t.counts[NEWS] |= REPLACED
    t.notes[place] = relation
    t.notes[place + 1] = kind
    t.notes[place + 2] = element
    t.notes[place + 3] = n
    t.counts[NOTES_SIZE] = place + 4
    t.counts[NEWS] |= HAS_NOTES


@kernel
def add_source(t: Any, source: int, weight: float) -> None:
    """Add a source to the note that was begun."""
    place = t.counts[NOTES_SIZE]
    t.notes[place] = source
    t.weights[place] = weight
    t.counts[NOTES_SIZE] = place + 1


@kernel
def note_between(t: Any, kind: int, element: int, a: int, b: int, weight: float) -> None:
    """The new element lies at `weight` on the way from `a` (0) to `b` (1)."""
    if t.counts[NOTING] & kind != 0:
        begin_note(t, BETWEEN, kind, element, 2)
        add_source(t, a, 1.0 - weight)
        add_source(t, b, weight)


@kernel
def note_part(t: Any, kind: int, element: int, whole: int, weight: float) -> None:
    """The element is this part of the whole; where it is the whole itself, that shrinks: say so last."""
    if t.counts[NOTING] & kind != 0:
        begin_note(t, PART, kind, element, 1)
        add_source(t, whole, weight)


@kernel
def note_union(t: Any, kind: int, element: int, other: int, weight: float) -> None:
    """The element is now both; `weight` is the other's, on the way from this (0) to the other (1)."""
    if t.counts[NOTING] & kind != 0:
        begin_note(t, UNION, kind, element, 2)
        add_source(t, element, 1.0 - weight)
        add_source(t, other, weight)


@kernel
def note_copy(t: Any, kind: int, element: int, source: int) -> None:
    """The element takes over the value of another."""
    if t.counts[NOTING] & kind != 0:
        begin_note(t, COPY, kind, element, 1)
        add_source(t, source, 1.0)


@kernel
def note_wedge(t: Any, corner: int, here: int, there: int, here_too: int, there_too: int, weight: float) -> None:
    """The corner is at one end of an edge that was contracted: see the table above.

    `here` and `there` are the corners of the face on one side of the edge, at this end and at the other; `here_too`
    and `there_too` those of the face on its other side; `weight` says how far the vertex has moved to the other end.
    """
    if t.counts[NOTING] & CORNERS != 0:
        begin_note(t, WEDGE, CORNERS, corner, 4)
        add_source(t, here, 1.0 - weight)
        add_source(t, there, weight)
        add_source(t, here_too, 1.0 - weight)
        add_source(t, there_too, weight)


@kernel
def noted_elements(notes: Any, size: int, kind: int, below: int, out: Any) -> int:
    """The elements of a kind, of those before `below`, whose values the notes are going to change; how many."""
    place = n = 0
    while place < size:
        of_kind, n_sources = notes[place + 1] == kind, notes[place + 3]
        if of_kind and notes[place + 2] < below:
            out[n] = notes[place + 2]
            n += 1
        if of_kind and notes[place] == CYCLE:
            for i in range(place + 4, place + 4 + n_sources):
                if notes[i] < below:
                    out[n] = notes[i]
                    n += 1
        place += 4 + n_sources
    return n
