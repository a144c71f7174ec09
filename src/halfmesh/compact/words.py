"""Parentheses in one word: 32 symbols of two bits, searched without a loop over them.

A byte of a word holds four symbols: their KIND in the low half (1: tree edge), whether they OPEN in the high half::

    bit   7 6 5 4   3 2 1 0
          O O O O   K K K K      symbols 3 2 1 0 of this byte

So the byte is a lane in which the depth of nesting can be counted, eight lanes at once: it starts at 64 plus what is
to be undone, loses one for every parenthesis that undoes, and where it falls below 64, bit 6 of the lane is out.

All integers are int64 and all but the words themselves are not negative, so that compiled code, where uint64 and
int64 make a float, and plain Python, where nothing overflows, compute the same.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import bit_count, bit_length, rule

__all__ = [
    "DUAL",
    "FULL",
    "KIND",
    "SYMBOLS",
    "TREE",
    "bit_of",
    "closes_of",
    "falling",
    "masked_from",
    "nth_bit",
    "opens_of",
    "rising",
    "symbol_of",
]

SYMBOLS = 32  # of a word
KIND = 0x0F0F0F0F0F0F0F0F  # the low halves of all bytes
TREE, DUAL = 0, KIND  # word ^ TREE has a 1 in KIND for each symbol of the tree, word ^ DUAL for each other one
FULL = -1  # a word of '(' only: what stands behind the last symbol

_ONES = 0x0101010101010101
_THREES = 0x0303030303030303
_FIVES = 0x0505050505050505
_ALIVE = 0x4040404040404040
_POSITIVE = 0x7FFFFFFFFFFFFFFF
_BEHIND = 0x0101010101010100  # times lanes: in each the sum of those before it
_FORWARD = 0x23272B2F33373B3F  # 63 - 4 j in lane j
_BACKWARD = 0x3F3B37332F2B2723  # 63 - 4 (7 - j) in lane j


@rule
def bit_of(i: Any) -> Any:
    """The bit of a word that holds the KIND of symbol `i`, of which only the last five bits count."""
    return ((i & 28) << 1) | (i & 3)


@rule
def symbol_of(bit: Any) -> Any:
    """The symbol whose KIND that bit is: the inverse of `bit_of`."""
    return ((bit >> 3) << 2) | (bit & 3)


@rule
def opens_of(word: Any, flip: Any) -> Any:
    """The opening parentheses of one kind, as bits in KIND; `flip` is TREE or DUAL."""
    return (word ^ flip) & (word >> 4) & KIND


@rule
def closes_of(word: Any, flip: Any) -> Any:
    """The closing parentheses of one kind, as bits in KIND."""
    return (word ^ flip) & ((word >> 4) ^ KIND) & KIND


@rule
def masked_from(bits: Any, i: Any) -> Any:
    """Those of the bits that belong to symbol `i` and later ones."""
    return bits & -(1 << bit_of(i))


@rule
def falling(falls: Any, rises: Any, depth: Any) -> Any:
    """The bit of the first symbol, from low to high, at which the depth has fallen to zero; -1 if there is none.

    `depth` is between 1 and 32; each bit of `falls` takes one away and each of `rises` adds one.
    """
    lanes = _sums(rises) + 4 * _ONES - _sums(falls)
    lanes = ((lanes * _BEHIND) & _POSITIVE) + _FORWARD + depth * _ONES
    found = 0
    lanes += (rises & _ONES) - (falls & _ONES)
    found |= (~lanes & _ALIVE) >> 6
    lanes += ((rises >> 1) & _ONES) - ((falls >> 1) & _ONES)
    found |= (~lanes & _ALIVE) >> 5
    lanes += ((rises >> 2) & _ONES) - ((falls >> 2) & _ONES)
    found |= (~lanes & _ALIVE) >> 4
    lanes += ((rises >> 3) & _ONES) - ((falls >> 3) & _ONES)
    found |= (~lanes & _ALIVE) >> 3
    return bit_length(found & -found) - 1


@rule
def rising(falls: Any, rises: Any, depth: Any) -> Any:
    """The same from high to low, for a search to the left."""
    sums = ((_sums(rises) + 4 * _ONES - _sums(falls)) * _ONES) & _POSITIVE
    lanes = (depth + (sums >> 56)) * _ONES - sums + _BACKWARD
    found = 0
    lanes += ((rises >> 3) & _ONES) - ((falls >> 3) & _ONES)
    found |= (~lanes & _ALIVE) >> 3
    lanes += ((rises >> 2) & _ONES) - ((falls >> 2) & _ONES)
    found |= (~lanes & _ALIVE) >> 4
    lanes += ((rises >> 1) & _ONES) - ((falls >> 1) & _ONES)
    found |= (~lanes & _ALIVE) >> 5
    lanes += (rises & _ONES) - (falls & _ONES)
    found |= (~lanes & _ALIVE) >> 6
    return bit_length(found) - 1


@rule
def _sums(bits: Any) -> Any:
    """In each lane, how many of its four bits are 1."""
    pairs = bits - ((bits >> 1) & _FIVES)
    return (pairs & _THREES) + ((pairs >> 2) & _THREES)


@rule
def nth_bit(bits: Any, n: Any) -> Any:
    """The place of the n-th 1, counted from 0; there are more than `n`."""
    place = 0
    for half in (32, 16, 8):
        low = bit_count((bits >> place) & ((1 << half) - 1))
        if n >= low:
            n -= low
            place += half
    bits >>= place
    for _ in range(n):
        bits &= bits - 1
    return place + bit_length(bits & -bits) - 1
