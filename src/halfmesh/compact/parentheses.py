"""Balanced parentheses of two kinds in one sequence: matching, counting, and finding the n-th.

`depth` is how many parentheses of a kind are open. The partner of one is where the depth is first, or was last, what it
is there. A search goes through the words of the block it begins in; then over the blocks of this superblock, by
the least depth that each record tells; then over groups of 16 superblocks, of 16 groups and so on, up and down again,
by `minima`.

=============  =============  ========================================================================================
column         one per        holds
=============  =============  ========================================================================================
``bits``       32 symbols     the symbols, see `words`
``records``    block: 256     relative to where the superblock begins, for the tree and for the dual tree: the depth
                              where the block begins, and the least in it, each 13 bits and 4096 too large; in the
                              highest 12 bits, 2048 too small, how many symbols are of the tree
``supers``     superblock:    where it begins: opening parentheses before it, of the tree and of the dual tree; the
               16 blocks      depths of both
``minima``     superblock     the least depth in it; then of groups of 16, of 16 groups ...; each level filled up to
                              a multiple of 16; all of the tree, then all of the dual tree
``samples``    4096 opening   the superblock of every 4096-th: of the tree, of the dual tree, of both together
=============  =============  ========================================================================================
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import apart, bit_count, bit_length, rule
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
    """Where, behind block `b`, the depth falls by so much from what it is at its end."""
    apart()
    goal = block_depth(t, b + 1, kind) - depth
    found = 0
    if (b + 1) & 15 != 0:
        found = _low_blocks(t, b >> 4, goal, kind) & -(2 << (b & 15))
    s = b >> 4
    if found == 0:
        s = _first_super(t, s + 1, goal, kind)
        found = _low_blocks(t, s, goal, kind)
    return _closing_in(t, 16 * s + _lowest(found), goal, kind)


@rule
def _closing_in(t: Any, b: Any, goal: Any, kind: Any) -> Any:
    return _closing_in_block(t, b << 8, block_depth(t, b, kind) - goal, kind * DUAL)


@rule
def _first_super(t: Any, s: Any, goal: Any, kind: Any) -> Any:
    """The first superblock from `s` on in which the depth falls as low as `goal`."""
    n_levels = len(t.levels) - 1
    base = kind * t.levels[n_levels]
    level, i, found = 0, s, 0
    while level < n_levels and i < t.levels[level + 1] - t.levels[level]:
        found = _low_minima(t, base + t.levels[level] + (i & -16), goal) & -(1 << (i & 15))
        if found != 0:
            break
        level += 1
        i = (i >> 4) + 1
    i = (i & -16) + _lowest(found)
    while level > 0:
        level -= 1
        i = 16 * i + _lowest(_low_minima(t, base + t.levels[level] + 16 * i, goal))
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
    s = b >> 4
    found = _low_blocks(t, s, goal, kind) & ((1 << (b & 15)) - 1)
    if found == 0:
        s = _last_super(t, s - 1, goal, kind)
        found = _low_blocks(t, s, goal, kind)
    return _opening_in(t, 16 * s + _highest(found), goal, kind)


@rule
def _opening_in(t: Any, b: Any, goal: Any, kind: Any) -> Any:
    return _opening_in_block(t, (b << 8) + 255, block_depth(t, b + 1, kind) - goal, kind * DUAL)


@rule
def _last_super(t: Any, s: Any, goal: Any, kind: Any) -> Any:
    """The last superblock up to `s` in which the depth falls as low as `goal`."""
    n_levels = len(t.levels) - 1
    base = kind * t.levels[n_levels]
    level, i, found = 0, s, 0
    while level < n_levels and i >= 0:
        found = _low_minima(t, base + t.levels[level] + (i & -16), goal) & ((2 << (i & 15)) - 1)
        if found != 0:
            break
        level += 1
        i = (i >> 4) - 1
    i = (i & -16) + _highest(found)
    while level > 0:
        level -= 1
        i = 16 * i + _highest(_low_minima(t, base + t.levels[level] + 16 * i, goal))
    return i


# -- sixteen at once ---------------------------------------------------------------------------------------------------


@rule
def _low_blocks(t: Any, s: Any, goal: Any, kind: Any) -> Any:
    """The blocks of a superblock in which the depth falls as low as `goal`, as bits."""
    limit = goal - t.supers[4 * s + 2 + kind] + 4096
    found = 0
    for k in range(16):
        found |= (1 if (t.records[16 * s + k] >> (26 * kind + 13)) & 8191 <= limit else 0) << k
    return found


@rule
def _low_minima(t: Any, first: Any, goal: Any) -> Any:
    """Which of the sixteen minima from `first` on are as low as `goal`, as bits."""
    found = 0
    for k in range(16):
        found |= (1 if t.minima[first + k] <= goal else 0) << k
    return found


@rule
def _lowest(found: Any) -> Any:
    """The place of the lowest 1, 0 if there is none."""
    return max(bit_length(found & -found) - 1, 0)


@rule
def _highest(found: Any) -> Any:
    """The place of the highest 1, 0 if there is none."""
    return max(bit_length(found) - 1, 0)


# -- counting ----------------------------------------------------------------------------------------------------------


@rule
def block_depth(t: Any, b: Any, kind: Any) -> Any:
    """How many parentheses of a kind are open where block `b` begins."""
    return t.supers[4 * (b >> 4) + 2 + kind] + ((t.records[b] >> (26 * kind)) & 8191) - 4096


@rule
def opens_of_record(record: Any, b: Any, kind: Any) -> Any:
    """How many opening parentheses of a kind there are before block `b` in its superblock. Kind 2 is both."""
    depth, depth_dual, tree = (record & 8191) - 4096, ((record >> 26) & 8191) - 4096, (record >> 52) + 2048
    if kind == 0:
        return (depth + tree) >> 1
    if kind == 1:
        return (depth_dual + 256 * (b & 15) - tree) >> 1
    return (depth + depth_dual + 256 * (b & 15)) >> 1


@rule
def opens_before(t: Any, i: Any, kind: Any) -> Any:
    """How many opening parentheses of a kind there are before symbol `i`."""
    b, w = i >> 8, i >> 5
    n = t.supers[4 * (b >> 4) + kind] + opens_of_record(t.records[b], b, kind)
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
    b, half = 16 * s, 8
    while half > 0:
        if opens_of_record(t.records[b + half], b + half, kind) <= n:
            b += half
        half >>= 1
    n -= opens_of_record(t.records[b], b, kind)
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
def _opens_of_kind(word: Any, kind: Any) -> Any:
    if kind == 2:
        return (word >> 4) & KIND
    return opens_of(word, kind * DUAL)
