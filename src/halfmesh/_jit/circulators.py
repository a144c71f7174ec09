"""Loops that are declared by their rules: ``for h in outgoing(t, v)``, in every gear."""

from __future__ import annotations

import functools
import types
from collections.abc import Callable, Iterator
from typing import Any, Generic, NoReturn, ParamSpec, TypeVar

from halfmesh._jit.arguments import interpretable, is_bound
from halfmesh._jit.compiler import Compilable, dispatcher
from halfmesh._jit.loops import Loop
from halfmesh._jit.plain import Interpretable

__all__ = ["Circulator", "circulator", "declared"]

P = ParamSpec("P")
R = TypeVar("R")


class Circulator(Compilable, Interpretable, Loop, Generic[P, R]):
    """A loop over the elements around something: ``for h in outgoing(t, v)``, in any gear.

    Parameters
    ----------
    function : callable
        Carries the name, the parameters and the documentation; its body is never run.
    start, step : Kernel
        ``start(t, x)`` is the first halfedge, or -1 for none; ``step(t, h)`` the one after `h`. The loop ends when
        the first comes round again.
    value : Kernel or None
        ``value(t, h)`` is what the loop yields; the halfedge itself by default.
    skips : bool
        Leave out values of -1 (a face that isn't there).
    """

    __name__: str
    __qualname__: str

    def __init__(self, function: Callable[P, R], start: Any, step: Any, value: Any, skips: bool) -> None:
        functools.update_wrapper(self, function)
        self.start, self.step, self.value, self.skips = start, step, value, skips

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Iterate in plain Python; the walk is not bounded, so hand it a valid mesh."""
        t, x = args
        form = interpretable(t)
        return (self.bound if is_bound(form) else self.plain)(form, x)  # type: ignore[no-any-return]

    @functools.cached_property
    def compiled(self) -> Any:
        """A Numba generator: what compiled code falls back on where the loop could not be written out."""
        return dispatcher(self._generator(None), keep=False)  # Numba can't link a generator from its cache

    @functools.cached_property
    def plain(self) -> Any:
        """The bare generator function over bare rules."""
        return self._generator("plain")

    @functools.cached_property
    def bound(self) -> Any:
        """The same over rules that ask their carrier what they mean."""
        return self._generator("bound")

    def _generator(self, form: str | None) -> Any:
        rules = {"START": self.start, "STEP": self.step, "VALUE": self.value}
        if form is not None:
            rules = {name: k and getattr(k, form) for name, k in rules.items()}
        template = _circulate_values if self.value is not None else _circulate_halfedges
        template = _circulate_present_values if self.skips else template
        made = types.FunctionType(template.__code__, {**template.__globals__, **rules}, self.__name__)
        made.__qualname__, made.__module__ = self.__qualname__, self.__module__
        return made

    def __kernel_sources__(self) -> tuple[types.FunctionType, ...]:
        return tuple(k.py_func for k in (self.start, self.step, self.value) if k is not None)


START: Any = None  # the templates below find these three in a scope made for each circulator
STEP: Any = None
VALUE: Any = None


def _circulate_halfedges(t: Any, x: int) -> Iterator[int]:
    end = START(t, x)
    at = end
    more = at >= 0
    while more:
        h = at
        at = STEP(t, at)
        more = at != end
        yield h


def _circulate_values(t: Any, x: int) -> Iterator[int]:
    end = START(t, x)
    at = end
    more = at >= 0
    while more:
        value = VALUE(t, at)
        at = STEP(t, at)
        more = at != end
        yield value


def _circulate_present_values(t: Any, x: int) -> Iterator[int]:
    end = START(t, x)
    at = end
    more = at >= 0
    while more:
        value = VALUE(t, at)
        at = STEP(t, at)
        more = at != end
        if value >= 0:
            yield value


def circulator(
    *, start: Any, step: Any, value: Any = None, skips: bool = False
) -> Callable[[Callable[P, R]], Circulator[P, R]]:
    """Declare a circulator by its three rules; the decorated function gives name, parameters and documentation."""
    return lambda function: Circulator(function, start, step, value, skips)


def declared() -> NoReturn:
    """The body of what is declared by its rules and documented by its name: it is never run."""
    raise AssertionError("the rules of a declaration are run, not its body")
