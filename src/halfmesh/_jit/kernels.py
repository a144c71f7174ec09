"""What is decorated: kernels, rules and circulators, and how each is run in each gear."""

from __future__ import annotations

import functools
import types
from collections.abc import Callable, Iterator
from typing import Any, Generic, NoReturn, ParamSpec, TypeVar

import numpy as np

from halfmesh._jit import gears
from halfmesh._jit.arguments import Views, announce, arrays, interpretable, lowered, refresh, view
from halfmesh._jit.compiler import Compilable, dispatcher, entry_point
from halfmesh._jit.loops import inlined, misspelled, unrolled

__all__ = [
    "Circulator",
    "Kernel",
    "Operation",
    "Rule",
    "all_kernels",
    "circulator",
    "declared",
    "inline_kernel",
    "kernel",
    "operation",
    "rule",
    "twofold",
]

P = ParamSpec("P")
R = TypeVar("R")
F = TypeVar("F", bound=Callable[..., Any])

all_kernels: list[Kernel[Any, Any]] = []


class Kernel(Compilable, Generic[P, R]):
    """A function of the subset of Python that Numba compiles; see the table at the top of this module."""

    __name__: str
    __qualname__: str

    def __init__(self, function: Callable[P, R]) -> None:
        functools.update_wrapper(self, function)
        assert isinstance(function, types.FunctionType)
        self.py_func: types.FunctionType = function
        self._interpreted_so_far = 0
        all_kernels.append(self)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        if kwargs:
            args = _positional(self.py_func, args, kwargs)  # type: ignore[assignment]
        if gears.interpret_only or (args and isinstance(args[0], Views)):
            return self.interpreted(*args)  # type: ignore[call-arg]
        return self._compiled_call(*args)

    def _compiled_call(self, *args: Any) -> R:
        return self._run(self.compiled, args)

    def _run(self, compiled: Any, args: tuple[Any, ...]) -> R:
        announce(args)
        try:
            return compiled(*[lowered(a) for a in args])  # type: ignore[no-any-return]
        except Exception as error:
            self._explain(error)
            raise
        finally:  # a kernel that failed may have run half, and what was announced is over
            refresh(args, compiled=True)

    def _explain(self, error: Exception) -> None:
        """Say at the end of what Python or Numba reports which kernel it was, and what usually helps."""
        code = self.py_func.__code__
        if not any(self.__qualname__ in note for note in getattr(error, "__notes__", ())):
            error.add_note(
                f"in the kernel {self.__qualname__} ({code.co_filename}, line {code.co_firstlineno}). "
                f"{self.__name__}.interpreted(...) runs the same text in plain Python and shows the line. "
                "In a kernel the mesh is its topology t: hm.vertex_slots(t), hm.next_of(t, h), hm.outgoing(t, v); "
                "positions and other data are arguments of their own." + misspelled(self.py_func)
            )

    def checked(self, *args: Any) -> R:
        """Run compiled, with every index of this kernel's own text checked: IndexError instead of a broken process.

        Compiled anew in each process and not kept, so for finding a mistake only.
        """
        if gears.interpret_only:
            return self.interpreted(*args)  # type: ignore[call-arg]
        return self._run(self._checked, args)

    @functools.cached_property
    def _checked(self) -> Any:
        source = unrolled(self.py_func, _is_circulator)
        return dispatcher(self.py_func, source=source, keep=False, bounds=True)

    @functools.cached_property
    def compiled(self) -> Any:
        """The Numba dispatcher of this kernel (compiled at its first call, or read from the disk cache)."""
        return dispatcher(self.py_func, source=unrolled(self.py_func, _is_circulator))

    @functools.cached_property
    def plain(self) -> Callable[P, R]:
        """The bare Python function; the kernels that it calls by name are bare as well."""
        return _plain(self.py_func)  # type: ignore[no-any-return]

    def interpreted(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Run in plain Python, on the same objects: set a breakpoint, print, step."""
        return self._interpret([interpretable(a) for a in args], args, kwargs)

    def _interpret(self, forms: list[Any], args: tuple[Any, ...], kwargs: dict[str, Any] | None = None) -> R:
        plain: Any = self.plain
        announce(args)
        try:
            return plain(*forms, **(kwargs or {}))  # type: ignore[no-any-return]
        finally:
            refresh(args, compiled=False)

    def entry(self, *args: Any) -> Callable[..., Any] | None:
        """The compiled code for arguments of these types, to be called with lowered ones; None if there is none yet.

        The caller does what a call does besides: typing, lowering, refreshing. That is three quarters of a short call.
        """
        if "compiled" not in self.__dict__ or gears.interpret_only:
            return None
        found: Callable[..., Any] | None = entry_point(self.compiled, args)
        return found

    def at(self, n: int) -> Callable[P, R]:
        """The gear that suits an input of `n` elements; it decides only while this kernel has not been compiled.

        Many small inputs are a large one: once a kernel has interpreted enough of them, it is compiled.
        """
        if gears.interpret_only or (not gears.always_compile and "compiled" not in self.__dict__ and self._is_small(n)):
            return self._quick  # type: ignore[return-value]
        return self._compiled_call  # type: ignore[return-value]

    def _is_small(self, n: int) -> bool:
        if n >= gears.SMALL or self._interpreted_so_far >= gears.ENOUGH:
            return False
        self._interpreted_so_far += n
        return True

    def _quick(self, *args: Any) -> R:
        """Interpreted over memoryviews: elements are plain ints and floats, twice as fast as NumPy scalars."""
        return self._interpret([view(a) if isinstance(a, np.ndarray) else interpretable(a) for a in args], args)

    def __kernel_sources__(self) -> tuple[types.FunctionType, ...]:
        return (self.py_func,)

    def __repr__(self) -> str:
        return f"<halfmesh kernel {self.__module__}.{self.__qualname__}>"

    def __reduce__(self) -> str:
        return self.__qualname__


class InlineKernel(Kernel[P, R]):
    """A kernel whose compiled code is written into every caller."""

    @functools.cached_property
    def compiled(self) -> Any:
        """The dispatcher; always inlined."""
        return dispatcher(self.py_func, inline=True, from_python=False, salt="inline")


class Operation(Kernel[P, R]):
    """A short kernel that Python calls for one element at a time: it keeps the GIL, which would cost as much as it."""

    quick: Any = None
    """The compiled code itself, once there is any: called with lowered arguments, see `entry`."""

    @functools.cached_property
    def compiled(self) -> Any:
        """The dispatcher; 30 ns of a call of 110 would go into giving the GIL away and taking it back."""
        return dispatcher(self.py_func, source=unrolled(self.py_func, _is_circulator), nogil=False, salt="operation")


class Rule(Kernel[P, R]):
    """A one-line kernel ``rule(t, h)``; called from Python it is interpreted for an int, vectorised for an array."""

    @functools.cached_property
    def compiled(self) -> Any:
        """The dispatcher; its column reads skip Numba's test for negative indices, 8-13 % of a one-ring loop."""
        return dispatcher(self.py_func, unchecked=True, from_python=False)

    def written_into(self, function: F, name: str) -> F:
        """The function with this rule's one expression in place of its calls ``name(t, i)``: saves a Python call."""
        return inlined(function, name, self.py_func)  # type: ignore[arg-type,return-value]

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        t, *rest = _positional(self.py_func, args, kwargs) if kwargs else args
        plain: Any = self.plain
        if any(isinstance(x, np.ndarray) for x in rest):
            return plain(arrays(t), *rest)  # type: ignore[no-any-return]
        return plain(interpretable(t), *rest)  # type: ignore[no-any-return]


def kernel(function: Callable[P, R]) -> Kernel[P, R]:
    """Compile a loop over a mesh, from the library or your own.

    Parameters
    ----------
    function : callable
        Takes meshes, attribute columns, NumPy arrays and numbers. A :class:`~halfmesh.Mesh` arrives as its topology
        `t`, to be walked by the rules (``next_of(t, h)``, ...) and circulators (``for h in outgoing(t, v)``); an
        attribute column arrives with its array as ``.values``.

    Returns
    -------
    Kernel
        Call it like the function. It is compiled for the argument types at the first call and kept on disk;
        ``kernel.interpreted(...)`` runs the very same text in plain Python, for a debugger.

    Notes
    -----
    Kernels don't raise: return a code. They release the GIL.

    Examples
    --------
    >>> import numpy as np, halfmesh as hm
    >>> from halfmesh import outgoing
    >>> @hm.kernel
    ... def degrees(t, out):
    ...     for v in range(len(out)):
    ...         for h in outgoing(t, v):
    ...             out[v] += 1
    >>> mesh = hm.shapes.cube()
    >>> out = np.zeros(mesh.n_vertices, dtype=np.int64)
    >>> degrees(mesh, out)
    >>> out
    array([3, 3, 3, 3, 3, 3, 3, 3])
    """
    return Kernel(function)


def twofold(interpreted: Callable[..., Any]) -> Callable[[Callable[P, R]], Kernel[P, R]]:
    """Declare a kernel whose interpreted form is another function: for the few that must know their gear."""

    def declare(function: Callable[P, R]) -> Kernel[P, R]:
        made = Kernel(function)
        made.plain = interpreted
        return made

    return declare


def inline_kernel(function: Callable[P, R]) -> Kernel[P, R]:
    """Declare a small kernel that is written into every caller: where a call costs more than what it does.

    A call of compiled code counts references to the carrier, atomically: 5-10 ns, five times what a pen writes in.
    """
    return InlineKernel(function)


def operation(function: Callable[P, R]) -> Operation[P, R]:
    """Declare a short kernel ``operation(t, i, ...)`` that Python calls for one element at a time."""
    return Operation(function)


def rule(function: Callable[P, R]) -> Rule[P, R]:
    """Declare a navigation rule: one line, written once, for every gear."""
    return Rule(function)


# -- circulators -------------------------------------------------------------------------------------------------------


class Circulator(Compilable, Generic[P, R]):
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
        return self._generator(True)(interpretable(t), x)  # type: ignore[no-any-return]

    @functools.cached_property
    def compiled(self) -> Any:
        """A Numba generator: what compiled code falls back on where the loop could not be written out."""
        return dispatcher(self._generator(False), keep=False)  # Numba can't link a generator from its cache

    @functools.cached_property
    def plain(self) -> Any:
        """The bare generator function over bare rules."""
        return self._generator(True)

    def _generator(self, plain: bool) -> Any:
        rules = {"START": self.start, "STEP": self.step, "VALUE": self.value}
        if plain:
            rules = {name: k and k.plain for name, k in rules.items()}
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


def _is_circulator(value: Any) -> bool:
    return isinstance(value, Circulator)


# -- plain functions ---------------------------------------------------------------------------------------------------

_plain_of: dict[types.FunctionType, types.FunctionType] = {}


def _plain(function: types.FunctionType) -> Any:
    if function in _plain_of:
        return _plain_of[function]
    scope = dict(function.__globals__)
    closure = tuple(types.CellType() for _ in function.__closure__ or ())
    made = types.FunctionType(function.__code__, scope, function.__name__, function.__defaults__, closure or None)
    made.__kwdefaults__, made.__qualname__, made.__module__ = (
        function.__kwdefaults__,
        function.__qualname__,
        function.__module__,
    )
    _plain_of[function] = made  # before the kernels it calls: it may call itself
    for cell, original in zip(closure, function.__closure__ or (), strict=True):
        cell.cell_contents = _bare(original.cell_contents)
    for name in function.__code__.co_names:
        if name in scope:
            scope[name] = _bare(scope[name])
    return made


def _bare(value: Any) -> Any:
    return value.plain if isinstance(value, Kernel | Circulator) else value


def _positional(function: types.FunctionType, args: tuple[Any, ...], kwargs: dict[str, Any]) -> tuple[Any, ...]:
    import inspect

    bound = inspect.signature(function).bind(*args, **kwargs)
    bound.apply_defaults()
    return tuple(bound.arguments.values())
