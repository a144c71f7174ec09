"""The directory over the symbols: what `parentheses` looks up, made in one pass over them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import bit_count, kernel
from halfmesh.compact.parentheses import SAMPLING_BITS
from halfmesh.compact.topology import Arrays
from halfmesh.compact.words import DUAL, KIND, TREE, closes_of, falling, opens_of

__all__ = ["add_directory", "level_starts", "n_words", "sample_starts"]

NEVER = 2**31 - 1  # a depth that no search looks for


def n_words(n_symbols: int) -> int:
    """The words that hold so many symbols: whole blocks of eight."""
    return 8 * max(1, -(-n_symbols // 256))


def level_starts(n_blocks: int) -> NDArray[np.int64]:
    """Where each level of the minima begins, and the last one ends."""
    starts, n = [0], -(-n_blocks // 16)
    while True:
        groups = -(-n // 16)
        starts.append(starts[-1] + 16 * groups)
        if groups == 1:
            return np.array(starts, np.int64)
        n = groups


def sample_starts(n_opens: tuple[int, int]) -> NDArray[np.int64]:
    """Where the samples of each kind begin, and the last ones end."""
    lengths = [((n - 1) >> SAMPLING_BITS) + 2 for n in (*n_opens, sum(n_opens))]
    return np.array([0, *np.cumsum(lengths)], np.int64)


def add_directory(a: Arrays, n_symbols: int, n_opens: tuple[int, int]) -> None:
    """Fill in all that follows from the bits. Complexity: O(n)."""
    n_blocks = len(a.bits) // 8
    a.levels, a.sample_starts = level_starts(n_blocks), sample_starts(n_opens)
    n_supers = -(-n_blocks // 16)
    a.records = np.empty(16 * n_supers, np.int64)
    a.supers = np.empty(4 * n_supers, np.int32)
    a.minima = np.full(2 * int(a.levels[-1]), NEVER, np.int32)
    a.samples = np.empty(int(a.sample_starts[-1]), np.int32)
    _count.at(n_symbols)(a.bits, a.records, a.supers, a.minima, int(a.levels[-1]))
    _raise_minima.at(n_supers)(a.minima, a.levels)
    _sample.at(n_supers)(a.supers, a.samples, a.sample_starts)


@kernel
def _count(bits: Any, records: Any, supers: Any, minima: Any, dual: int) -> None:
    """Records and superblocks, and the lowest level of the minima, of which those of the dual tree begin at `dual`."""
    n_blocks = len(bits) // 8
    opens_tree, opens_dual, symbols = 0, 0, 0
    for b in range(n_blocks):
        s = b >> 4
        depth_tree, depth_dual = 2 * opens_tree - symbols, 2 * opens_dual - (256 * b - symbols)
        if b & 15 == 0:
            supers[4 * s], supers[4 * s + 1] = opens_tree, opens_dual
            supers[4 * s + 2], supers[4 * s + 3] = depth_tree, depth_dual
            before = symbols
        least_tree = depth_tree - _fall(bits, 8 * b, TREE)
        least_dual = depth_dual - _fall(bits, 8 * b, DUAL)
        minima[s], minima[dual + s] = min(minima[s], least_tree), min(minima[dual + s], least_dual)
        base, base_dual = supers[4 * s + 2] - 4096, supers[4 * s + 3] - 4096
        record = (depth_tree - base) | (least_tree - base) << 13
        record |= (depth_dual - base_dual) << 26 | (least_dual - base_dual) << 39
        records[b] = record + ((symbols - before - 2048) << 52)
        for w in range(8 * b, 8 * b + 8):
            opens_tree += bit_count(opens_of(bits[w], TREE))
            opens_dual += bit_count(opens_of(bits[w], DUAL))
            symbols += bit_count(bits[w] & KIND)
    s = (n_blocks - 1) >> 4
    base, base_dual = supers[4 * s + 2] - 4096, supers[4 * s + 3] - 4096
    for b in range(n_blocks, len(records)):  # nothing is found in these
        depth_tree, depth_dual = 2 * opens_tree - symbols, 2 * opens_dual - (256 * n_blocks - symbols)
        record = (depth_tree - base) | 8191 << 13 | (depth_dual - base_dual) << 26 | 8191 << 39
        records[b] = record + ((symbols - before - 2048) << 52)


@kernel
def _fall(bits: Any, first: int, flip: int) -> int:
    """How far the depth of one kind falls in a block below what it is at its begin."""
    lowest, depth = 0, 0
    for w in range(first, first + 8):
        opens, closes = opens_of(bits[w], flip), closes_of(bits[w], flip)
        n = bit_count(closes)
        while n > depth - lowest and falling(closes, opens, depth - lowest + 1) >= 0:
            lowest -= 1
        depth += bit_count(opens) - n
    return -lowest


@kernel
def _raise_minima(minima: Any, levels: Any) -> None:
    """Every level from the one below it."""
    n_levels = len(levels) - 1
    for base in range(0, 2 * levels[n_levels], levels[n_levels]):
        for level in range(1, n_levels):
            for first in range(levels[level - 1], levels[level], 16):
                at = base + levels[level] + (first - levels[level - 1]) // 16
                for k in range(base + first, base + first + 16):
                    minima[at] = min(minima[at], minima[k])


@kernel
def _sample(supers: Any, samples: Any, starts: Any) -> None:
    """For every 4096-th opening parenthesis the last superblock that has no more before it."""
    last = len(supers) // 4 - 1
    for kind in range(3):
        s = 0
        for k in range(starts[kind], starts[kind + 1] - 1):
            n = (k - starts[kind]) << SAMPLING_BITS
            while s < last and _opens(supers, s + 1, kind) <= n:
                s += 1
            samples[k] = s
        samples[starts[kind + 1] - 1] = last


@kernel
def _opens(supers: Any, s: int, kind: int) -> int:
    if kind == 2:
        return supers[4 * s] + supers[4 * s + 1]  # type: ignore[no-any-return]
    return supers[4 * s + kind]  # type: ignore[no-any-return]
