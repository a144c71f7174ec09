"""What has been compiled, and what has not."""

from __future__ import annotations

import importlib
import pkgutil
import sys
import types
from collections.abc import Iterator
from typing import Any

from halfmesh import _jit

__all__ = ["kernels_of", "n_compiled_here", "n_from_cache", "never_compiled"]


def n_compiled_here() -> int:
    """How many kernels this process has compiled itself; those that it read from the cache are not counted."""
    return sum(bool(k.compiled.stats.cache_misses) for k in _touched())


def n_from_cache() -> int:
    """How many kernels this process has read from the cache and not compiled."""
    return sum(bool(k.compiled.stats.cache_hits and not k.compiled.stats.cache_misses) for k in _touched())


def _touched() -> list[_jit.Kernel[Any, Any]]:
    return [k for k in _jit.all_kernels if "compiled" in vars(k)]


def kernels_of(package: types.ModuleType) -> list[_jit.Kernel[Any, Any]]:
    """All kernels of a package, which is imported whole for it."""
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        importlib.import_module(module.name)
    inside = (package.__name__, f"{package.__name__}.")
    known = [k for k in _jit.all_kernels if k.__module__ == inside[0] or k.__module__.startswith(inside[1])]
    return [k for k in known if getattr(sys.modules.get(k.__module__), k.py_func.__name__, None) is k]


def never_compiled(package: types.ModuleType) -> list[_jit.Kernel[Any, Any]]:
    """Kernels that this process has neither compiled nor read from the cache, nor any kernel that calls them.

    Navigation rules are left out: they cost nothing to compile, and the circulators need most of them.
    """
    ours = kernels_of(package)
    reached: set[int] = set()
    for k in ours:
        if "compiled" in vars(k) and k.compiled.signatures:
            _reach(k, reached)
    return [k for k in ours if id(k) not in reached and not isinstance(k, _jit.Rule)]


def _reach(value: Any, reached: set[int]) -> None:
    """Mark a kernel or circulator, and everything that it calls."""
    if id(value) in reached:
        return
    if isinstance(value, _jit.Circulator):
        reached.add(id(value))
        for part in (value.start, value.step, value.value):
            _reach(part, reached)
    elif isinstance(value, _jit.Kernel):
        reached.add(id(value))
        scope = value.py_func.__globals__
        names = list(_names(value.py_func.__code__))
        modules = [scope[name] for name in names if isinstance(scope.get(name), types.ModuleType)]
        for name in names:
            _reach(scope.get(name), reached)
            for module in modules:  # `hm.neighbors` in a kernel
                _reach(getattr(module, name, None), reached)


def _names(code: types.CodeType) -> Iterator[str]:
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _names(constant)
