"""Balanced parentheses of two kinds in one sequence: matching, counting, and finding the n-th.

`depth` is how many parentheses of a kind are open. The partner of one is where the depth first (or last) is what it was.
A search goes through the words of the block it begins in; then over the blocks of this superblock, by the least depth
that each record tells; then over groups of 16 superblocks, of 16 groups and so on, up and down again, by `minima`.

=============  ================  ====================================================================================
column         one per           holds
=============  ================  ====================================================================================
``bits``       32 symbols        the symbols, see `words`
``records``    256 (a block)     since the superblock's begin: opening ones of the tree, of the dual tree, and tree
                                 symbols, 12 bits each; by how much the depths fall in it below its begin, 9 bits each
``supers``     4096              opening ones of the tree, of the dual tree, tree symbols before it; none
``minima``     4096, 4096 * 16,  the least depth in it, by levels, all of the tree and then all of the dual tree
               4096 * 256 ...
``samples``    4096 opening      the superblock of every 4096-th: of the tree, of the dual tree, of both together
=============  ================  ====================================================================================
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import apart, bit_count, rule
from halfmesh.compact.words import (
    DUAL,
    KIND,
    bit_of,
    closes_of,
    falling,
    masked_from,
    nth_bit,
    opens_of,
    rising,
    symbol_of,
)

__all__ = [
    "SAMPLING_BITS",
    "block_depth",
    "closing",
    "depth_at",
    "is_opening",
    "is_tree",
    "match",
    "opening",
    "openings_before",
    "opens_before",
    "select",
]

SAMPLING_BITS = 12  # of every 4096-th opening parenthesis it is kept in which superblock it is


@rule
def is_tree(t: Any, i: Any) -> Any:
    """1 if symbol `i` is of the tree, 0 if it is of the dual tree."""
    return (t.bits[i >> 5] >> bit_of(i)) & 1


@rule
def is_opening(t: Any, i: Any) -> Any:
    """1 if symbol `i` is an opening parenthesis, 0 if it is a closing one."""
    return (t.bits[i >> 5] >> (bit_of(i) + 4)) & 1


@rule
def match(t: Any, i: Any) -> Any:
    """The partner of symbol `i`."""
    symbol = t.bits[i >> 5] >> bit_of(i)
    kind = 1 - (symbol & 1)
    if symbol & 16:
        return closing(t, i, kind)
    return opening(t, i, kind)


# -- to the right ------------------------------------------------------------------------------------------------------


@rule
def closing(t: Any, i: Any, kind: Any) -> Any:
    """The partner of an opening parenthesis; `kind` is 0 for the tree, 1 for the dual tree."""
    found = _closing_in_block(t, i + 1, 1, kind * DUAL)
    if found < 0:
        found = _closing_behind(t, (i + 1) >> 8, -found, kind)
    return found


@rule
def _closing_in_block(t: Any, i: Any, depth: Any, flip: Any) -> Any:
    """Where, from symbol `i` to the end of its block, the depth falls by so much; minus what is left if nowhere."""
    w = i >> 5
    opens = masked_from(opens_of(t.bits[w], flip), i)
    closes = masked_from(closes_of(t.bits[w], flip), i)
    while True:
        falls = bit_count(closes)
        if falls >= depth:
            bit = falling(closes, opens, depth)
            if bit >= 0:
                return 32 * w + symbol_of(bit)
        depth += bit_count(opens) - falls
        w += 1
        if w & 7 == 0:
            return -depth
        opens, closes = opens_of(t.bits[w], flip), closes_of(t.bits[w], flip)


@rule
def _closing_behind(t: Any, b: Any, depth: Any, kind: Any) -> Any:
    """Where, behind block `b`, the depth falls by so much."""
    apart()
    n = len(t.records)
    b += 1
    goal = block_depth(t, b, kind) - depth
    while b & 15 != 0 and b < n:
        if _least_depth(t, b, kind) <= goal:
            return _closing_in(t, b, goal, kind)
        b += 1
    s = _first_super(t, b >> 4, goal, kind)
    for b in range(16 * s, n):
        if _least_depth(t, b, kind) <= goal:
            return _closing_in(t, b, goal, kind)
    return 0


@rule
def _closing_in(t: Any, b: Any, goal: Any, kind: Any) -> Any:
    return _closing_in_block(t, b << 8, block_depth(t, b, kind) - goal, kind * DUAL)


@rule
def _first_super(t: Any, s: Any, goal: Any, kind: Any) -> Any:
    """The first superblock from `s` on in which the depth falls as low as `goal`."""
    n_levels = len(t.levels) - 1
    base = kind * t.levels[n_levels]
    level, i = 0, s
    while level < n_levels:
        end = min((i | 15) + 1, t.levels[level + 1] - t.levels[level])
        at = base + t.levels[level]
        while i < end and t.minima[at + i] > goal:
            i += 1
        if i < end:
            break
        level += 1
        i = ((i - 1) >> 4) + 1
    while level > 0:
        level -= 1
        i *= 16
        at = base + t.levels[level]
        end = min(i + 15, t.levels[level + 1] - t.levels[level] - 1)
        while i < end and t.minima[at + i] > goal:
            i += 1
    return i


# -- to the left -------------------------------------------------------------------------------------------------------


@rule
def opening(t: Any, i: Any, kind: Any) -> Any:
    """The innermost opening parenthesis before symbol `i` that is open there; -1 if there is none.

    For a closing parenthesis of the kind that is its partner.
    """
    if i == 0:
        return -1
    found = _opening_in_block(t, i - 1, 1, kind * DUAL)
    if found < 0:
        found = _opening_before(t, (i - 1) >> 8, -found, kind)
    return found


@rule
def _opening_in_block(t: Any, i: Any, depth: Any, flip: Any) -> Any:
    """The last symbol, from `i` to the begin of its block, before which it is less deep by so much."""
    w = i >> 5
    mask = (2 << bit_of(i)) - 1
    opens = opens_of(t.bits[w], flip) & mask
    closes = closes_of(t.bits[w], flip) & mask
    while True:
        falls = bit_count(opens)
        if falls >= depth:
            bit = rising(opens, closes, depth)
            if bit >= 0:
                return 32 * w + symbol_of(bit)
        depth += bit_count(closes) - falls
        if w & 7 == 0:
            return -depth
        w -= 1
        opens, closes = opens_of(t.bits[w], flip), closes_of(t.bits[w], flip)


@rule
def _opening_before(t: Any, b: Any, depth: Any, kind: Any) -> Any:
    """The last symbol before block `b` before which it is less deep by so much; -1 if that is less than nothing."""
    apart()
    goal = block_depth(t, b, kind) - depth
    if goal < 0:
        return -1
    while b & 15 != 0:
        b -= 1
        if _least_depth(t, b, kind) <= goal:
            return _opening_in(t, b, goal, kind)
    b = 16 * _last_super(t, (b >> 4) - 1, goal, kind) + 16
    while b > 0:
        b -= 1
        if _least_depth(t, b, kind) <= goal:
            return _opening_in(t, b, goal, kind)
    return -1


@rule
def _opening_in(t: Any, b: Any, goal: Any, kind: Any) -> Any:
    return _opening_in_block(t, (b << 8) + 255, block_depth(t, b + 1, kind) - goal, kind * DUAL)


@rule
def _last_super(t: Any, s: Any, goal: Any, kind: Any) -> Any:
    """The last superblock up to `s` in which the depth falls as low as `goal`."""
    n_levels = len(t.levels) - 1
    base = kind * t.levels[n_levels]
    level, i = 0, s
    while level < n_levels and i >= 0:
        end = i & -16
        at = base + t.levels[level]
        while i >= end and t.minima[at + i] > goal:
            i -= 1
        if i >= end:
            break
        level += 1
        i = (end >> 4) - 1
    while level > 0:
        level -= 1
        at = base + t.levels[level]
        end = 16 * i
        i = min(16 * i + 15, t.levels[level + 1] - t.levels[level] - 1)
        while i > end and t.minima[at + i] > goal:
            i -= 1
    return i


# -- counting ----------------------------------------------------------------------------------------------------------


@rule
def block_depth(t: Any, b: Any, kind: Any) -> Any:
    """How many parentheses of a kind are open where block `b` begins."""
    record, s = t.records[b], 4 * (b >> 4)
    opens = t.supers[s + kind] + ((record >> (12 * kind)) & 4095)
    symbols = t.supers[s + 2] + ((record >> 24) & 4095)
    return 2 * opens - (256 * b - symbols if kind else symbols)


@rule
def _least_depth(t: Any, b: Any, kind: Any) -> Any:
    """How few parentheses of a kind are open somewhere in block `b`, begin and end included."""
    return block_depth(t, b, kind) - ((t.records[b] >> (36 + 9 * kind)) & 511)


@rule
def opens_before(t: Any, i: Any, kind: Any) -> Any:
    """How many opening parentheses of a kind there are before symbol `i`."""
    b, w = i >> 8, i >> 5
    n = t.supers[4 * (b >> 4) + kind] + ((t.records[b] >> (12 * kind)) & 4095)
    flip = kind * DUAL
    for k in range(w & -8, w):
        n += bit_count(opens_of(t.bits[k], flip))
    return n + bit_count(opens_of(t.bits[w], flip) & ((1 << bit_of(i)) - 1))


@rule
def openings_before(t: Any, i: Any) -> Any:
    """How many opening parentheses, of both kinds, there are before symbol `i`."""
    return opens_before(t, i, 0) + opens_before(t, i, 1)


@rule
def depth_at(t: Any, i: Any, kind: Any) -> Any:
    """How many parentheses of a kind are open before symbol `i`."""
    b, w = i >> 8, i >> 5
    depth = block_depth(t, b, kind)
    flip = kind * DUAL
    for k in range(w & -8, w):
        depth += bit_count(opens_of(t.bits[k], flip)) - bit_count(closes_of(t.bits[k], flip))
    mask = (1 << bit_of(i)) - 1
    return depth + bit_count(opens_of(t.bits[w], flip) & mask) - bit_count(closes_of(t.bits[w], flip) & mask)


# -- the n-th ----------------------------------------------------------------------------------------------------------


@rule
def select(t: Any, n: Any, kind: Any) -> Any:
    """The n-th opening parenthesis of a kind, counted from 0; there are more than `n`. Kind 2 is both."""
    s = _super_of(t, n, kind)
    n -= _opens_before_super(t, s, kind)
    b, end = 16 * s, min(16 * s + 16, len(t.records)) - 1
    while b < end and _opens_of_record(t.records[b + 1], kind) <= n:
        b += 1
    n -= _opens_of_record(t.records[b], kind)
    w = 8 * b
    while True:
        opens = _opens_of_kind(t.bits[w], kind)
        inside = bit_count(opens)
        if n < inside or w & 7 == 7:
            return 32 * w + symbol_of(nth_bit(opens, n))
        n -= inside
        w += 1


@rule
def _super_of(t: Any, n: Any, kind: Any) -> Any:
    """The superblock of the n-th opening parenthesis of a kind."""
    k = t.sample_starts[kind] + (n >> SAMPLING_BITS)
    low, high = t.samples[k], t.samples[k + 1]
    while low < high:
        middle = (low + high + 1) >> 1
        if _opens_before_super(t, middle, kind) <= n:
            low = middle
        else:
            high = middle - 1
    return low


@rule
def _opens_before_super(t: Any, s: Any, kind: Any) -> Any:
    if kind == 2:
        return t.supers[4 * s] + t.supers[4 * s + 1]
    return t.supers[4 * s + kind]


@rule
def _opens_of_record(record: Any, kind: Any) -> Any:
    if kind == 2:
        return (record & 4095) + ((record >> 12) & 4095)
    return (record >> (12 * kind)) & 4095


@rule
def _opens_of_kind(word: Any, kind: Any) -> Any:
    if kind == 2:
        return (word >> 4) & KIND
    return opens_of(word, kind * DUAL)
