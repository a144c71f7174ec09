"""Natives: functions that Python calls as it calls its own built-in ones, straight into compiled code.

A compiled kernel is reached from Python through a tuple of arguments and a conversion for each: 60 ns and more, and the
method around it costs as much again in plain Python. A *native* is a kernel ``f(self, arguments, n, names)`` with the
signature of a C function of Python (``METH_FASTCALL | METH_KEYWORDS``): it gets the addresses of the objects that it
was called with, and gives the address of one. A call costs 25 ns.

The `Record` is a few words of memory that belong to one such function. Where in an object its type and its slots lie,
is not assumed but found out, by `slots_of`.
"""

from __future__ import annotations

import ctypes
import functools
import sys
import sysconfig
from collections.abc import Callable
from typing import Any

import numpy as np

from halfmesh._jit import gears
from halfmesh._jit.compiler import c_address, dispatcher
from halfmesh._jit.intrinsics import c_function
from halfmesh._jit.kernels import Kernel

__all__ = ["Native", "Record", "are_possible", "maker_of", "native", "record_of", "slots_of"]

_N_ARGUMENTS = 4
_FASTCALL, _KEYWORDS, _NO_ARGUMENTS = 0x80, 0x02, 0x04  # METH_FASTCALL, METH_KEYWORDS, METH_NOARGS

record_of = c_function("PyLong_AsVoidPtr", "i")
"""``record_of(self)`` in a native: the address of its record, from that of the object."""


class Record(int):
    """A few words of memory, as the number that is their address; `owned` is what their contents refer to."""

    words: Any
    owned: tuple[Any, ...]

    @classmethod
    def of(cls, words: list[int], owned: tuple[Any, ...]) -> Record:
        memory = np.array(words, dtype=np.int64)
        made = int.__new__(cls, memory.ctypes.data)
        made.words, made.owned = memory, owned
        return made


class Native(Kernel[Any, int]):
    """A kernel with the signature of a built-in function."""

    @functools.cached_property
    def compiled(self) -> Any:
        """The dispatcher of what C calls."""
        return dispatcher(self.py_func, nogil=False, from_python=False, from_c=True, salt="native")

    @functools.cached_property
    def address(self) -> int:
        """Where its machine code is; compiled now, or read from the disk cache."""
        return c_address(self.compiled, _N_ARGUMENTS)

    def function(self, record: Record, name: str, doc: str) -> Any:
        """The built-in function with this record, which it keeps."""
        definition = _definition(self, name, doc)
        return _new_function()(ctypes.addressof(definition), record, None)


class _Definition(ctypes.Structure):
    """PyMethodDef of the stable ABI."""

    _fields_ = (
        ("name", ctypes.c_char_p),
        ("function", ctypes.c_void_p),
        ("flags", ctypes.c_int),
        ("doc", ctypes.c_char_p),
    )


@functools.cache  # it has to outlive the functions that were made of it
def _definition(native: Native, name: str, doc: str) -> _Definition:
    return _Definition(name.encode(), native.address, _FASTCALL | _KEYWORDS, doc.encode())


@functools.cache
def _new_function() -> Any:
    make = ctypes.pythonapi.PyCFunction_NewEx
    make.restype = ctypes.py_object
    make.argtypes = [ctypes.c_void_p, ctypes.py_object, ctypes.c_void_p]
    return make


def are_possible() -> bool:
    """Whether this Python is one whose objects compiled code can know: CPython of 64 bits, with the GIL."""
    return (
        not gears.interpret_only
        and sys.implementation.name == "cpython"
        and sys.maxsize == 2**63 - 1
        and sys.byteorder == "little"
        and not sysconfig.get_config_var("Py_GIL_DISABLED")
        and not sysconfig.get_config_var("Py_TRACE_REFS")
    )


def maker_of(kind: type) -> Callable[[], Any]:
    """What makes an empty object of a class: ``object.__new__(kind)``, in 15 ns, not 45.

    It needs no compiler: the C function that allocates objects is called as a built-in one whose ``self`` is the class.
    """
    if sys.implementation.name != "cpython":
        return functools.partial(object.__new__, kind)
    make: Callable[[], Any] = _new_function()(ctypes.addressof(_allocation()), kind, None)
    return make


@functools.cache
def _allocation() -> _Definition:
    place = ctypes.cast(ctypes.pythonapi.PyType_GenericAlloc, ctypes.c_void_p).value
    return _Definition(b"make", place, _NO_ARGUMENTS, None)  # called with the class and 0: no items


def slots_of(example: Any, **values: Any) -> dict[str, int]:
    """At which word of an object its type and its slots are: found by looking for these very values in it.

    Raises LookupError if they are not each in one place.
    """
    n_words = type(example).__basicsize__ // 8
    words = list((ctypes.c_int64 * n_words).from_address(id(example)))
    places = {}
    for name, value in (("type", type(example)), *values.items()):
        if words.count(id(value)) != 1:
            raise LookupError(f"no place for {name} in {example!r}")
        places[name] = words.index(id(value))
    return places


def native(function: Callable[[int, int, int, int], int]) -> Native:
    """Declare a kernel ``f(self, arguments, n, names)`` that Python calls like a built-in function.

    `self` is the address of its `Record` object, `arguments` that of `n` objects and as many as `names` has, which is
    the address of a tuple, or 0. It returns the address of an object that it owns, or 0 where Python has noted an
    exception.
    """
    return Native(function)
