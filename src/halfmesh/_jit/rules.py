"""Rules: kernels of one line, from which all else is made, and what carriers may bind anew."""

from __future__ import annotations

import functools
import types
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

import numpy as np

from halfmesh._jit.arguments import arrays, interpretable, is_bound
from halfmesh._jit.compiler import dispatcher
from halfmesh._jit.kernels import Kernel, Operation, positional
from halfmesh._jit.loops import inlined

__all__ = ["Rule", "asking", "rule"]

P = ParamSpec("P")
R = TypeVar("R")
F = TypeVar("F", bound=Callable[..., Any])

RULE: Any = None  # the templates below find it in a scope made for each rule


class Rule(Kernel[P, R]):
    """A one-line kernel ``rule(t, h)``; called from Python it is interpreted for an int, vectorised for an array."""

    @functools.cached_property
    def compiled(self) -> Any:
        """The dispatcher; its column reads skip Numba's test for negative indices, 8-13 % of a one-ring loop."""
        return dispatcher(self.py_func, unchecked=True, from_python=False, rule=self)

    @functools.cached_property
    def bound(self) -> Any:
        """Looks at each call what the carrier means by this rule."""

        def follow(t: Any, *rest: Any) -> Any:
            own: Any = self
            return t.rules.get(own, own).plain(t, *map(int, rest))  # NumPy's integers would overflow among bits

        return follow

    def meant_by(self, form: Any) -> Kernel[P, R]:
        """The kernel that this rule is on a carrier, given in its interpreted form."""
        return form.rules.get(self, self) if is_bound(form) else self  # type: ignore[no-any-return]

    def written_into(self, function: F, name: str) -> F:
        """The function with this rule's one expression in place of its calls ``name(t, i)``: saves a Python call."""
        return inlined(function, name, self.py_func)  # type: ignore[arg-type,return-value]

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        t, *rest = positional(self.py_func, args, kwargs) if kwargs else args
        form = interpretable(t)
        are_many = any(isinstance(x, np.ndarray) for x in rest)
        if are_many and is_bound(form):
            return _mapped(self.meant_by(form), t, *rest)  # type: ignore[no-any-return]
        if is_bound(form):
            return self.bound(form, *rest)  # type: ignore[no-any-return]
        return self.plain(arrays(t) if are_many else form, *rest)  # type: ignore[call-arg]


def rule(function: Callable[P, R]) -> Rule[P, R]:
    """Declare a navigation rule: one line, written once, for every gear."""
    return Rule(function)


# -- from Python, where interpreting a bound rule takes too long -------------------------------------------------------


def _ask(t: Any, x: int) -> Any:
    return RULE(t, x)


@functools.cache
def asking(rule: Rule[Any, Any]) -> Operation[Any, Any]:
    """A rule as a kernel that Python calls for one element at a time; it means what its carrier says."""
    made = types.FunctionType(_ask.__code__, {**_ask.__globals__, "RULE": rule}, f"ask_{rule.__name__}")
    made.__module__, made.__qualname__ = rule.__module__, f"ask_{rule.__name__}"
    return Operation(made)


# -- over arrays, where a carrier binds a rule anew --------------------------------------------------------------------


def _map(t: Any, elements: Any, out: Any) -> None:
    for i in range(len(elements)):
        out[i] = RULE(t, elements[i])


@functools.cache
def _mapping(meant: Kernel[Any, Any]) -> Kernel[Any, Any]:
    made = types.FunctionType(_map.__code__, {**_map.__globals__, "RULE": meant}, f"map_{meant.__name__}")
    made.__module__ = meant.__module__
    made.__qualname__ = made.__name__
    return Kernel(made)


def _mapped(meant: Kernel[Any, Any], t: Any, elements: Any) -> Any:
    """A rule on every element of an array."""
    flat = np.ascontiguousarray(elements, dtype=np.int64).ravel()
    is_question = any(isinstance(meant.plain(interpretable(t), int(x)), bool) for x in flat[:1])
    out = np.empty(len(flat), dtype=bool if is_question else np.int64)
    _mapping(meant).at(len(flat))(t, flat, out)
    return out.reshape(np.shape(elements))
