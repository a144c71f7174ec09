"""The interpreted gear: a function rebuilt so that what it calls is interpreted too."""

from __future__ import annotations

import types
from typing import Any

__all__ = ["Interpretable", "plain_form"]


class Interpretable:
    """What interpreted code may call by name, in two forms."""

    plain: Any
    """The bare Python function."""

    bound: Any
    """The same, asking at every rule what its carrier means by it; see `CarrierType.bind`."""


_plain_of: dict[tuple[types.FunctionType, bool], types.FunctionType] = {}


def plain_form(function: types.FunctionType, follow_bindings: bool = False) -> Any:
    if (function, follow_bindings) in _plain_of:
        return _plain_of[function, follow_bindings]
    scope = dict(function.__globals__)
    closure = tuple(types.CellType() for _ in function.__closure__ or ())
    made = types.FunctionType(function.__code__, scope, function.__name__, function.__defaults__, closure or None)
    made.__kwdefaults__, made.__qualname__, made.__module__ = (
        function.__kwdefaults__,
        function.__qualname__,
        function.__module__,
    )
    _plain_of[function, follow_bindings] = made  # before the kernels it calls: it may call itself
    for cell, original in zip(closure, function.__closure__ or (), strict=True):
        cell.cell_contents = _bare(original.cell_contents, follow_bindings)
    for name in function.__code__.co_names:
        if name in scope:
            scope[name] = _bare(scope[name], follow_bindings)
    return made


def _bare(value: Any, follow_bindings: bool) -> Any:
    if not isinstance(value, Interpretable):
        return value
    return value.bound if follow_bindings else value.plain
