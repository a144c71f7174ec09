"""Kernels, and how each is run in each gear."""

from __future__ import annotations

import functools
import types
from collections.abc import Callable
from typing import Any, Generic, ParamSpec, TypeVar

import numpy as np

from halfmesh._jit import gears
from halfmesh._jit.arguments import Views, announce, interpretable, is_bound, lowered, refresh, view
from halfmesh._jit.compiler import Compilable, dispatcher, entry_point
from halfmesh._jit.loops import misspelled, unrolled
from halfmesh._jit.plain import Interpretable, plain_form

__all__ = ["Kernel", "Operation", "all_kernels", "inline_kernel", "kernel", "operation", "positional", "twofold"]

P = ParamSpec("P")
R = TypeVar("R")
F = TypeVar("F", bound=Callable[..., Any])

all_kernels: list[Kernel[Any, Any]] = []


_ONLY_READ = (
    " One of the meshes is only read: a kernel may walk it by rules and circulators, and neither change it nor read "
    "columns, t.next[h]; its to_mesh() gives one for which it may."
)


class Kernel(Compilable, Interpretable, Generic[P, R]):
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
            args = positional(self.py_func, args, kwargs)  # type: ignore[assignment]
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
            self._explain(error, args)
            raise
        finally:  # a kernel that failed may have run half, and what was announced is over
            refresh(args, compiled=True)

    def _explain(self, error: Exception, args: tuple[Any, ...]) -> None:
        """Say at the end of what Python or Numba reports which kernel it was, and what usually helps."""
        code = self.py_func.__code__
        if not any(self.__qualname__ in note for note in getattr(error, "__notes__", ())):
            error.add_note(
                f"in the kernel {self.__qualname__} ({code.co_filename}, line {code.co_firstlineno}). "
                f"{self.__name__}.interpreted(...) runs the same text in plain Python and shows the line. "
                "In a kernel the mesh is its topology t: hm.vertex_slots(t), hm.next_of(t, h), hm.outgoing(t, v); "
                "positions and other data are arguments of their own."
                + misspelled(self.py_func)
                + (_ONLY_READ if any(is_bound(interpretable(a)) for a in args) else "")
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
        source = unrolled(self.py_func)
        return dispatcher(self.py_func, source=source, keep=False, bounds=True)

    @functools.cached_property
    def compiled(self) -> Any:
        """The Numba dispatcher of this kernel (compiled at its first call, or read from the disk cache)."""
        return dispatcher(self.py_func, source=unrolled(self.py_func))

    @functools.cached_property
    def plain(self) -> Callable[P, R]:
        """The bare Python function; the kernels that it calls by name are bare as well."""
        return plain_form(self.py_func)  # type: ignore[no-any-return]

    @functools.cached_property
    def bound(self) -> Callable[P, R]:
        """The same for carriers that bind rules anew: every rule asks its carrier what it means."""
        return plain_form(self.py_func, follow_bindings=True)  # type: ignore[no-any-return]

    def interpreted(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Run in plain Python, on the same objects: set a breakpoint, print, step."""
        return self._interpret([interpretable(a) for a in args], args, kwargs)

    def _interpret(self, forms: list[Any], args: tuple[Any, ...], kwargs: dict[str, Any] | None = None) -> R:
        plain: Any = self.bound if any(map(is_bound, forms)) else self.plain
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
        return dispatcher(self.py_func, source=unrolled(self.py_func), nogil=False, salt="operation")


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


def positional(function: types.FunctionType, args: tuple[Any, ...], kwargs: dict[str, Any]) -> tuple[Any, ...]:
    import inspect

    bound = inspect.signature(function).bind(*args, **kwargs)
    bound.apply_defaults()
    return tuple(bound.arguments.values())
