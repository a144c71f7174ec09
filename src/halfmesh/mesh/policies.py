"""How the value of an attribute follows when elements are made, joined and moved: the formulas, one table.

=============  ===========================  ==================================  ==============================
policy         a new element between        two elements become one             a part of an element
=============  ===========================  ==================================  ==============================
``lerp``       weighted by the parameter    weighted by the parameter           keeps the value
``normalize``  the same, then to length 1   the same, then to length 1          keeps the value
``mean``       the mean                     the mean                            keeps the value
``copy``       the first's                  that of the one that stays          keeps the value
``first``      the lowest index's           the lowest index's                  keeps the value
``nearest``    the one of largest weight    the one of largest weight           keeps the value
``min, max``   the least, the greatest      the least, the greatest             keeps the value
``sum``        0                            the sum                             its share: the total is kept
a function     ``f(values, weights)``       ``f(values, weights)``              keeps the value
=============  ===========================  ==================================  ==============================

Where elements only change places their values do too, whatever the policy.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.core.notes import BETWEEN, COPY, CYCLE, PART, UNION, WEDGE

__all__ = ["LERP", "POLICIES", "Policy", "checked_policy", "default_policy", "replay", "replay_notes"]

Policy = str | Callable[[NDArray[Any], NDArray[np.float64]], Any]

LERP, NORMALIZE, MEAN, TAKE, FIRST, NEAREST, MIN, MAX, SUM = range(9)
POLICIES = {
    "lerp": LERP,
    "normalize": NORMALIZE,
    "mean": MEAN,
    "copy": TAKE,
    "first": FIRST,
    "nearest": NEAREST,
    "min": MIN,
    "max": MAX,
    "sum": SUM,
}
_CHOOSING = (TAKE, FIRST, NEAREST)  # one source is taken whole: any dtype will do
_ORDERED = (NORMALIZE, MIN, MAX)


def default_policy(dtype: np.dtype[Any]) -> str:
    """Floats are interpolated; integers, labels and all else are copied."""
    return "lerp" if dtype.kind in "fc" else "copy"


def checked_policy(policy: Policy, dtype: np.dtype[Any]) -> Policy:
    """The policy, if there is one of the name and it makes sense for the dtype."""
    if callable(policy):
        return policy
    if policy not in POLICIES:
        raise ValueError(f"no policy {policy!r}; there are {', '.join(POLICIES)}, or a function f(values, weights)")
    code = POLICIES[policy]
    calculable = code in _CHOOSING or dtype.kind in ("fiub" if code in _ORDERED else "fiubc")
    if not calculable or (code == NORMALIZE and dtype.kind != "f"):
        raise ValueError(
            f"values of dtype {dtype} can't follow by {policy!r}; 'copy', 'first' and 'nearest' always can"
        )
    return policy


def replay(
    values: NDArray[Any], policy: Policy, kind: int, notes: NDArray[np.int32], weights: NDArray[np.float64]
) -> None:
    """Let the values of one attribute follow the notes about elements of its kind."""
    if not values.size:
        return
    if callable(policy):
        _replay_by_function(values, policy, kind, notes, weights)
        return
    code = POLICIES[policy]
    rows = values.reshape(len(values), -1)
    run: Any = replay_notes.at(len(notes) // 4)
    if code in _CHOOSING:  # as bytes: one compiled form for all dtypes
        rows = rows.view(np.uint8)
    elif rows.dtype.kind == "c":
        rows = rows.view(rows.real.dtype)
    elif rows.dtype.kind == "b":
        rows = rows.view(np.uint8)
    elif rows.dtype.kind == "f" and rows.dtype.itemsize not in (4, 8):
        run = replay_notes.interpreted  # compiled code knows neither half nor long double
    run(rows, notes, weights, len(notes), kind, code, rows.dtype.kind != "f")


# -- compiled ------------------------------------------------------------------------------------------------------


@kernel
def replay_notes(values: Any, notes: Any, weights: Any, size: int, kind: int, policy: int, rounds: bool) -> None:
    """Let rows of values follow the notes about elements of a kind, by one of the policies that are formulas."""
    place = parts = 0  # where the parts of one whole begin
    whole = -1
    while place < size:
        relation, element, n = notes[place], notes[place + 2], notes[place + 3]
        if notes[place + 1] == kind:
            first = place + 4
            if relation == COPY:
                _take(values, element, notes[first])
            elif relation == CYCLE:
                _exchange(values, element, notes, first, n)
            elif relation == PART:
                if notes[first] != whole:
                    whole, parts = notes[first], place
                if policy == SUM and rounds and element == whole:
                    _keep_rest(values, element, notes, parts, place)
                elif policy == SUM:
                    _share(values, element, notes[first], weights[first], rounds)
                elif element != notes[first]:
                    _take(values, element, notes[first])
            elif relation == WEDGE:
                if _is_same(values, element, notes[first]):
                    _combine(values, element, notes, weights, first, 2, policy, rounds)
                elif _is_same(values, element, notes[first + 2]):
                    _combine(values, element, notes, weights, first + 2, 2, policy, rounds)
            elif relation == BETWEEN and policy == SUM:
                for j in range(values.shape[1]):
                    values[element, j] = 0
            else:
                _combine(values, element, notes, weights, first, n, policy, rounds)
        if notes[place + 1] != kind or relation != PART or element == whole:
            whole = -1
        place += 4 + n


@kernel
def _take(values: Any, element: int, source: int) -> None:
    for j in range(values.shape[1]):
        values[element, j] = values[source, j]


@kernel
def _exchange(values: Any, element: int, notes: Any, first: int, n: int) -> None:
    """Pass the values on around a ring, each to the one before."""
    for j in range(values.shape[1]):
        held, at = values[element, j], element
        for i in range(first, first + n):
            values[at, j] = values[notes[i], j]
            at = notes[i]
        values[at, j] = held


@kernel
def _is_same(values: Any, a: int, b: int) -> bool:
    for j in range(values.shape[1]):  # noqa: SIM110 - Numba takes no generators
        if values[a, j] != values[b, j]:
            return False
    return True


@kernel
def _share(values: Any, element: int, whole: int, weight: float, rounds: bool) -> None:
    for j in range(values.shape[1]):
        x = values[whole, j] * weight
        values[element, j] = math.floor(x) if rounds else x


@kernel
def _keep_rest(values: Any, whole: int, notes: Any, begin: int, end: int) -> None:
    """What the other parts have left of it, which were noted one after the other: whole numbers add up, too."""
    for place in range(begin, end, 5):
        for j in range(values.shape[1]):
            values[whole, j] -= values[notes[place + 2], j]


@kernel
def _combine(
    values: Any, element: int, notes: Any, weights: Any, first: int, n: int, policy: int, rounds: bool
) -> None:
    """The element's value from those of its sources, of which it may be one itself."""
    if policy in (TAKE, FIRST, NEAREST):
        _take(values, element, notes[_chosen(notes, weights, first, n, policy)])
    elif policy == SUM:
        for j in range(values.shape[1]):
            total = values[notes[first], j]
            for i in range(first + 1, first + n):
                total += values[notes[i], j]
            values[element, j] = total
    elif policy in (MIN, MAX):
        for j in range(values.shape[1]):
            best = values[notes[first], j]
            for i in range(first + 1, first + n):
                x = values[notes[i], j]
                if (x < best) == (policy == MIN):
                    best = x
            values[element, j] = best
    else:
        _mix(values, element, notes, weights, first, n, policy, rounds)


@kernel
def _chosen(notes: Any, weights: Any, first: int, n: int, policy: int) -> int:
    """The place of the source that is taken whole."""
    best = first
    for i in range(first + 1, first + n):
        if policy == FIRST and notes[i] < notes[best]:
            best = i
        if policy == NEAREST and weights[i] > weights[best]:
            best = i
    return best


@kernel
def _mix(values: Any, element: int, notes: Any, weights: Any, first: int, n: int, policy: int, rounds: bool) -> None:
    square = 0.0
    for j in range(values.shape[1]):
        x = 0.0
        for i in range(first, first + n):
            w = 1.0 / n if policy == MEAN else weights[i]
            if w != 0.0:  # what has no weight has no say, be it infinite or NaN
                x += w * values[notes[i], j]
        values[element, j] = math.floor(x + 0.5) if rounds else x
        square += x * x
    if policy == NORMALIZE and square > 0.0:
        scale = 1.0 / math.sqrt(square)
        for j in range(values.shape[1]):
            values[element, j] *= scale


# -- the user's own formula ----------------------------------------------------------------------------------------


def _replay_by_function(values: Any, function: Callable[..., Any], kind: int, notes: Any, weights: Any) -> None:
    place = 0
    while place < len(notes):
        relation, of, element, n = (int(x) for x in notes[place : place + 4])
        sources, shares = notes[place + 4 : place + 4 + n], weights[place + 4 : place + 4 + n]
        place += 4 + n
        if of != kind:
            continue
        if relation in (COPY, PART):
            values[element] = values[sources[0]]
        elif relation == CYCLE:
            values[[element, *sources]] = values[[*sources, element]]
        elif relation in (BETWEEN, UNION):
            values[element] = function(values[sources], shares.copy())
        else:
            for side in (slice(0, 2), slice(2, 4)):
                if np.array_equal(values[element], values[sources[side][0]]):
                    values[element] = function(values[sources[side]], shares[side].copy())
                    break
