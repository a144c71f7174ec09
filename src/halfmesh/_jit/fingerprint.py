"""What a compiled kernel depends on, as one hash: the key of the disk cache.

Numba's own cache looks at the file of one function. A kernel also depends on the kernels it calls, on the constants
it reads, in whatever files they stand, the user's own included. The fingerprint follows them all: two functions with
the same fingerprint compile to the same machine code, and an edit anywhere below changes it.
"""

from __future__ import annotations

import types
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

__all__ = ["fingerprint", "fingerprints"]


def fingerprint(function: types.FunctionType, *salt: str) -> str:
    """Hash of a function's code and of everything it can reach; `salt` adds what else the result depends on."""
    import hashlib  # 3 ms, and only what compiles needs it

    digest = hashlib.blake2b(digest_size=16)
    for text in salt:
        digest.update(text.encode())
    for part in _parts(function, set()):
        digest.update(part)
        digest.update(b"\0")
    return digest.hexdigest()


def fingerprints(functions: Iterable[types.FunctionType]) -> str:
    """One hash of several functions; empty for none."""
    return " ".join(fingerprint(function) for function in functions)


def _parts(function: types.FunctionType, seen: set[int]) -> Iterator[bytes]:
    if id(function) in seen:  # recursion: the first visit already said it all
        yield b"again:" + function.__qualname__.encode()
        return
    seen.add(id(function))
    yield from _code_parts(function.__code__)
    yield from _value_parts(function.__defaults__, seen)
    yield from _value_parts(function.__kwdefaults__, seen)
    for cell in function.__closure__ or ():
        yield from _value_parts(cell.cell_contents, seen)
    names = list(_names(function.__code__))
    for name in names:
        if name in function.__globals__:
            yield name.encode()
            value = function.__globals__[name]
            if isinstance(value, types.ModuleType):
                yield from _module_parts(value, names, seen)
            else:
                yield from _value_parts(value, seen)


def _code_parts(code: types.CodeType) -> Iterator[bytes]:
    yield code.co_code
    yield repr((code.co_names, code.co_varnames, code.co_freevars, code.co_argcount, code.co_flags)).encode()
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _code_parts(constant)
        else:
            yield repr(constant).encode()


def _names(code: types.CodeType) -> Iterator[str]:
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _names(constant)


def _module_parts(module: types.ModuleType, names: list[str], seen: set[int]) -> Iterator[bytes]:
    """`hm.target_of` inside a kernel: the name is an attribute of a module."""
    yield module.__name__.encode()
    if module.__name__.split(".")[0] in ("numpy", "math"):
        return  # their version is part of the salt
    for name in names:
        if hasattr(module, name):
            value = getattr(module, name)
            yield name.encode()
            if isinstance(value, types.ModuleType):
                if id(value) not in seen:  # packages know their modules, and these their packages
                    seen.add(id(value))
                    yield from _module_parts(value, names, seen)
            else:
                yield from _value_parts(value, seen)


def _value_parts(value: Any, seen: set[int]) -> Iterator[bytes]:
    dependencies = getattr(value, "__kernel_sources__", None)
    if dependencies is not None:  # a kernel or a circulator
        for function in dependencies():
            yield from _parts(function, seen)
    elif isinstance(value, types.FunctionType):
        yield from _parts(value, seen)
    elif isinstance(getattr(value, "py_func", None), types.FunctionType):  # somebody's own numba function
        yield from _parts(value.py_func, seen)
    elif isinstance(value, np.ndarray):
        yield f"{value.dtype}{value.shape}".encode()
        yield np.ascontiguousarray(value).tobytes()
    elif isinstance(value, tuple):
        yield f"{type(value).__qualname__}{len(value)}".encode()
        for item in value:
            yield from _value_parts(item, seen)
    elif isinstance(value, type | types.BuiltinFunctionType | types.ModuleType):
        yield f"{getattr(value, '__module__', '')}.{getattr(value, '__qualname__', value)}".encode()
    else:
        # a repr with an address in it only costs the cache, never correctness
        yield f"{type(value).__qualname__} {value!r}".encode()
