"""What compiled code does by other means than Python's: single instructions, memory, Python's own C functions."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = [
    "Intrinsic",
    "apart",
    "bit_count",
    "bit_length",
    "c_function",
    "compiled_only",
    "real_at",
    "set_real",
    "set_word",
    "word_at",
]


class Intrinsic:
    """A name in a kernel's text that means one thing compiled and another interpreted."""

    def __init__(self, name: str, plain: Callable[..., Any], compiled: Callable[[], Any]) -> None:
        self.name, self.plain, self.compiled = name, plain, compiled

    def __call__(self, *args: Any) -> Any:
        return self.plain(*args)

    def __repr__(self) -> str:
        return self.name


@functools.cache
def _never_inlined() -> Any:
    from numba.core import types as nbtypes
    from numba.extending import intrinsic

    @intrinsic
    def never_inlined(typing_context: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            builder.function.attributes.add("noinline")
            return context.get_dummy_value()

        return nbtypes.void(), generate

    return never_inlined


@functools.cache
def _on_bits(instruction: str) -> Any:
    from numba.core import cgutils
    from numba.core import types as nbtypes
    from numba.extending import intrinsic

    @intrinsic
    def on_bits(typing_context: Any, word: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            (x,) = arguments
            if instruction == "ctpop":
                return builder.ctpop(x)
            return builder.sub(x.type(64), builder.ctlz(x, cgutils.false_bit))

        return nbtypes.int64(nbtypes.int64), generate

    return on_bits


apart = Intrinsic("apart", lambda: None, _never_inlined)
"""``apart()`` in the body of a kernel keeps its code out of its callers: for the rare case in a small kernel, which
LLVM would otherwise write into all of them. Twenty pens with the growth of the journal took 8 s to optimize."""

bit_count = Intrinsic("bit_count", int.bit_count, lambda: _on_bits("ctpop"))
"""``bit_count(x)`` in a kernel: how many bits of an int64 that is not negative are 1, by one machine instruction."""

bit_length = Intrinsic("bit_length", int.bit_length, lambda: _on_bits("ctlz"))
"""``bit_length(x)`` in a kernel: the place behind the highest 1 of an int64 that is not negative; 0 for 0."""


def c_function(name: str, arguments: str, result: str = "i") -> Any:
    """A function of Python's C API, for kernels: ``i`` an int64 or an address, ``d`` a double."""

    def compiled() -> Any:
        from numba.core import types as nbtypes

        kinds = {"i": nbtypes.int64, "d": nbtypes.float64}
        return nbtypes.ExternalFunction(name, kinds[result](*(kinds[a] for a in arguments)))

    return Intrinsic(f"{name}({arguments}) -> {result}", compiled_only, functools.cache(compiled))


def compiled_only(*args: Any) -> Any:
    """The interpreted form of what has none."""
    raise NotImplementedError("this is done in compiled code only")


@functools.cache
def _in_memory(kind: str, writes: bool) -> Any:
    """The word, or the float, at a place of eight bytes each behind an address: read, or written."""
    from llvmlite import ir
    from numba.core import types as nbtypes
    from numba.extending import intrinsic

    value = {"i": nbtypes.int64, "d": nbtypes.float64}[kind]
    form = {"i": ir.IntType(64), "d": ir.DoubleType()}[kind]

    def pointer(builder: Any, arguments: Any) -> Any:
        return builder.gep(builder.inttoptr(arguments[0], form.as_pointer()), [arguments[1]])

    @intrinsic
    def read(typing_context: Any, address: Any, place: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            return builder.load(pointer(builder, arguments))

        return value(nbtypes.int64, nbtypes.int64), generate

    @intrinsic
    def write(typing_context: Any, address: Any, place: Any, new: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            builder.store(arguments[2], pointer(builder, arguments))
            return context.get_dummy_value()

        return nbtypes.void(nbtypes.int64, nbtypes.int64, value), generate

    return write if writes else read


word_at = Intrinsic("word_at", compiled_only, lambda: _in_memory("i", False))
"""``word_at(address, i)`` in a kernel: the i-th word of eight bytes there, as an int64."""

set_word = Intrinsic("set_word", compiled_only, lambda: _in_memory("i", True))
"""``set_word(address, i, x)`` writes it."""

real_at = Intrinsic("real_at", compiled_only, lambda: _in_memory("d", False))
"""``real_at(address, i)``: the same as a float64."""

set_real = Intrinsic("set_real", compiled_only, lambda: _in_memory("d", True))
"""``set_real(address, i, x)`` writes it."""
