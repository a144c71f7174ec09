"""The only file that talks to Numba, and only when the first compiled call needs it.

One function, several gears, all from the same source:

========================  ==========================================================  =============================
``f(...)``                compiled, releases the GIL, cached on disk                  hot loops, the user's too
``f.at(n)(...)``          compiled, or interpreted while `n` is small and nothing     library calls: a small mesh
                          has been compiled yet                                       never waits for a compiler
``f.interpreted(...)``    plain Python over the same arrays                           debugging, tests
``f.plain``               the bare function with the kernels it calls bare too        handles, vectorised rules
========================  ==========================================================  =============================

A *carrier* is an object whose arrays a kernel may read, write and replace by larger ones. In compiled code it is a
Numba structref; in interpreted code it is an ordinary object with the same attribute names.
"""

from __future__ import annotations

import contextlib
import functools
import os
import pathlib
import sys
import types
from typing import TYPE_CHECKING, Any, Generic, ParamSpec, Protocol, TypeVar

import numpy as np

from halfmesh._fingerprint import fingerprint
from halfmesh._loops import unrolled, with_column_reads

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numba.core.caching import FunctionCache

__all__ = [
    "Carrier",
    "CarrierType",
    "Circulator",
    "Kernel",
    "Rule",
    "Views",
    "circulator",
    "compiling_always",
    "declare_carrier",
    "kernel",
    "n_threads",
    "parallel",
    "rule",
    "view",
]

P = ParamSpec("P")
R = TypeVar("R")

SMALL = 3000  # elements; below it an interpreted pass (about 1 us per element and step) beats importing Numba (0.4 s)

_interpret_only = os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")
_strict = os.environ.get("HALFMESH_STRICT", "0") not in ("", "0")
_always_compile = False


# ---------------------------------------------------------------------------------------------------------- kernels


class Kernel(Generic[P, R]):
    """A function of the subset of Python that Numba compiles; see the table at the top of this module."""

    def __init__(self, function: Callable[P, R]) -> None:
        functools.update_wrapper(self, function)
        assert isinstance(function, types.FunctionType)
        self.py_func: types.FunctionType = function
        _all_kernels.append(self)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        if kwargs:
            args = _positional(self.py_func, args, kwargs)  # type: ignore[assignment]
        if _interpret_only or (args and isinstance(args[0], Views)):
            return self.interpreted(*args)  # type: ignore[call-arg]
        return self._compiled_call(*args)

    def _compiled_call(self, *args: Any) -> R:
        result: R = self.compiled(*[_lowered(a) for a in args])
        for a in args:
            _refresh(a)
        return result

    @functools.cached_property
    def compiled(self) -> Any:
        """The Numba dispatcher of this kernel (compiled at its first call, or read from the disk cache)."""
        return _dispatcher(self.py_func)

    @functools.cached_property
    def plain(self) -> Callable[P, R]:
        """The bare Python function; the kernels that it calls by name are bare as well."""
        return _plain(self.py_func)

    def interpreted(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Run in plain Python, on the same objects: set a breakpoint, print, step."""
        plain: Any = self.plain
        return plain(*[_interpretable(a) for a in args], **kwargs)  # type: ignore[no-any-return]

    def at(self, n: int) -> Callable[P, R]:
        """The gear that suits an input of `n` elements; `n` decides only while this kernel has not been compiled."""
        if _interpret_only or (n < SMALL and not _always_compile and "compiled" not in self.__dict__):
            return self._quick
        return self._compiled_call

    def _quick(self, *args: Any) -> R:
        """Interpreted over memoryviews: elements are plain ints and floats, twice as fast as NumPy scalars."""
        plain: Any = self.plain
        return plain(*[_view(a) if isinstance(a, np.ndarray) else _interpretable(a) for a in args])  # type: ignore[no-any-return]

    def __kernel_sources__(self) -> tuple[types.FunctionType, ...]:
        return (self.py_func,)

    def __repr__(self) -> str:
        return f"<halfmesh kernel {self.__module__}.{self.__qualname__}>"

    def __reduce__(self) -> str:
        return self.__qualname__


class Rule(Kernel[P, R]):
    """A one-line kernel ``rule(t, h)``; called from Python it is interpreted for an int, vectorised for an array."""

    @functools.cached_property
    def compiled(self) -> Any:
        """The dispatcher; its column reads skip Numba's test for negative indices, 8-13 % of a one-ring loop."""
        return _dispatcher(self.py_func, unchecked=True)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        t, *rest = args
        plain: Any = self.plain
        if any(isinstance(x, np.ndarray) for x in rest):
            return plain(_arrays(t), *rest, **kwargs)  # type: ignore[no-any-return]
        return plain(_interpretable(t), *rest, **kwargs)  # type: ignore[no-any-return]


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


def rule(function: Callable[P, R]) -> Rule[P, R]:
    """Declare a navigation rule: one line, written once, for every gear."""
    return Rule(function)


# ------------------------------------------------------------------------------------------------------ circulators


class Circulator(Generic[P, R]):
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

    def __init__(self, function: Callable[P, R], start: Any, step: Any, value: Any, skips: bool) -> None:
        functools.update_wrapper(self, function)
        self.start, self.step, self.value, self.skips = start, step, value, skips

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Iterate in plain Python; the walk is not bounded, so hand it a valid mesh."""
        t, x = args
        return self._generator(True)(_interpretable(t), x)  # type: ignore[no-any-return]

    @functools.cached_property
    def compiled(self) -> Any:
        """A Numba generator: what compiled code falls back on where the loop could not be written out."""
        return _dispatcher(self._generator(False), keep=False)  # Numba can't link a generator from its cache

    @functools.cached_property
    def plain(self) -> Any:
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


def _is_circulator(value: Any) -> bool:
    return isinstance(value, Circulator)


# --------------------------------------------------------------------------------------------------- plain functions

_plain_of: dict[types.FunctionType, types.FunctionType] = {}


def _plain(function: types.FunctionType) -> Any:
    if function in _plain_of:
        return _plain_of[function]
    scope = dict(function.__globals__)
    closure = tuple(types.CellType(_bare(cell.cell_contents)) for cell in function.__closure__ or ())
    made = types.FunctionType(function.__code__, scope, function.__name__, function.__defaults__, closure or None)
    made.__kwdefaults__, made.__qualname__, made.__module__ = (
        function.__kwdefaults__,
        function.__qualname__,
        function.__module__,
    )
    _plain_of[function] = made  # before the kernels it calls: it may call itself
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


# --------------------------------------------------------------------------------------------------------- arguments


class Views:
    """The interpreted carrier: the arrays of a carrier as memoryviews, under the same names."""


class Carrier(Protocol):
    """An object that kernels take as one argument; it lends its arrays in three forms."""

    def __compiled__(self) -> Any:
        """The structref proxy; made by :func:`structref_class`."""

    def __views__(self) -> Views:
        """An object whose attributes are memoryviews."""

    def __arrays__(self) -> Any:
        """An object whose attributes are NumPy arrays."""

    def __refresh__(self) -> None:
        """Called after a compiled kernel: take the arrays anew if it made them larger."""


def _lowered(argument: Any) -> Any:
    return argument.__compiled__() if hasattr(argument, "__compiled__") else argument


def _interpretable(argument: Any) -> Any:
    return argument.__views__() if hasattr(argument, "__views__") else argument


def _arrays(argument: Any) -> Any:
    return argument.__arrays__() if hasattr(argument, "__arrays__") else argument


def _refresh(argument: Any) -> None:
    if hasattr(argument, "__refresh__"):
        argument.__refresh__()


class _StrictView:
    """A memoryview that refuses negative indices: -1 means "none" here, and must never be read through."""

    def __init__(self, array: Any) -> None:
        self._view = memoryview(array)
        self.shape = self._view.shape

    def __len__(self) -> int:
        return len(self._view)

    def __getitem__(self, key: Any) -> Any:
        return self._view[self._checked(key)]  # type: ignore[call-overload]

    def __setitem__(self, key: Any, value: Any) -> None:
        self._view[self._checked(key)] = value

    @staticmethod
    def _checked(key: Any) -> Any:
        for k in key if isinstance(key, tuple) else (key,):
            if k < 0:
                raise IndexError(f"a kernel used the negative index {k}")
        return key


def _view(array: Any) -> Any:
    return _StrictView(array) if _strict else memoryview(array)


def view(array: Any) -> Any:
    """The interpreted gear's form of an array: elements are plain ints and floats."""
    return _view(array)


# ------------------------------------------------------------------------------------------------------------- numba

_all_kernels: list[Kernel[Any, Any]] = []
_carriers: list[CarrierType] = []


@functools.cache
def _numba() -> Any:
    """Numba, imported once, taught to see a `Kernel` in compiled code as the dispatcher that it wraps."""
    import numba
    from numba.core import types as nbtypes
    from numba.extending import typeof_impl

    @typeof_impl.register(Kernel)
    @typeof_impl.register(Circulator)
    def _typeof(value: Any, context: Any) -> Any:
        return nbtypes.Dispatcher(value.compiled)

    return numba


@functools.cache
def _unchecked() -> Any:
    """``column[i]`` for an index that is known not to be negative."""
    from numba.core import types as nbtypes
    from numba.extending import intrinsic

    @intrinsic
    def read(typing_context: Any, column: Any, index: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            array = context.make_array(signature.args[0])(context, builder, arguments[0])
            return builder.load(builder.gep(array.data, [arguments[1]]))

        return column.dtype(column, nbtypes.intp), generate

    return read


@functools.cache
def _define_carriers() -> None:
    for made in _carriers:
        made.define()


def _dispatcher(function: types.FunctionType, *, keep: bool = True, unchecked: bool = False) -> Any:
    numba = _numba()
    _define_carriers()
    source = unrolled(function, _is_circulator)
    if unchecked and not numba.config.BOUNDSCHECK:
        source = with_column_reads(function, _unchecked())
    dispatcher = numba.njit(error_model="numpy", nogil=True)(source)
    cache = _disk_cache(source, _stamp(function)) if keep else None
    if cache is not None:
        dispatcher._cache = cache
    return dispatcher


def _stamp(function: types.FunctionType) -> str:
    return fingerprint(function, _own_source(), *_versions())


@functools.cache
def _own_source() -> str:
    here = pathlib.Path(__file__).parent
    return "".join((here / name).read_text("utf-8") for name in ("_jit.py", "_loops.py", "_fingerprint.py"))


@functools.cache
def _versions() -> tuple[str, ...]:
    numba = _numba()
    return (sys.version, np.__version__, numba.__version__, str(numba.config.BOUNDSCHECK), str(numba.config.OPT))


def cache_folder() -> pathlib.Path:
    """Where compiled kernels are kept: ``$HALFMESH_CACHE_DIR``, or the place that the system gives to caches."""
    import platformdirs

    chosen = os.environ.get("HALFMESH_CACHE_DIR")
    base = pathlib.Path(chosen) if chosen else platformdirs.user_cache_path("halfmesh", appauthor=False)
    return base / f"{sys.implementation.cache_tag}-numba{_numba().__version__}"


@functools.cache
def _writable_folder() -> str | None:
    folder = cache_folder()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    return str(folder) if os.access(folder, os.W_OK) else None


def _disk_cache(function: types.FunctionType, stamp: str) -> FunctionCache | None:
    """Numba's cache with our key; None where nothing can be written, which costs the recompilation and no more."""
    from numba.core.caching import CompileResultCacheImpl, FunctionCache, _CacheLocator

    folder = _writable_folder()
    if folder is None:
        return None

    class Locator(_CacheLocator):  # type: ignore[misc, unused-ignore]
        def get_cache_path(self) -> str:
            return folder

        def get_source_stamp(self) -> str:
            return stamp

        def get_disambiguator(self) -> None:
            return None

        @classmethod
        def from_function(cls, py_func: Any, py_file: str) -> Any:
            return cls()

    class Implementation(CompileResultCacheImpl):  # type: ignore[misc, unused-ignore]
        _locator_classes = (Locator,)

    class Cache(FunctionCache):  # type: ignore[misc, unused-ignore]
        _impl_class = Implementation

    return Cache(function)


# -------------------------------------------------------------------------------------------------- structref classes


class CarrierType:
    """The compiled form of a carrier: `make` builds one from its arrays, `take` gets them out again."""

    def __init__(self, name: str, fields: tuple[str, ...]) -> None:
        self.name, self.fields = name, fields

    def make(self, *arrays: Any) -> Any:
        _define_carriers()
        return self._make(*arrays)

    def take(self, proxy: Any) -> tuple[Any, ...]:
        return self._take(proxy)  # type: ignore[no-any-return]

    def define(self) -> None:
        """Create the Numba type; all carriers are defined before anything is compiled or read from the cache."""
        from numba.core import types as nbtypes
        from numba.experimental import structref

        class Type(nbtypes.StructRef):  # type: ignore[misc, unused-ignore]
            def preprocess_fields(self, fields: Any) -> Any:
                return tuple((n, nbtypes.unliteral(t)) for n, t in fields)

        class Proxy(structref.StructRefProxy):  # type: ignore[misc, unused-ignore]
            pass

        for made, suffix in ((Type, "Type"), (Proxy, "Proxy")):
            made.__name__ = made.__qualname__ = self.name + suffix
            setattr(sys.modules[__name__], made.__name__, made)  # pickle looks here when the disk cache is read
        structref.register(Type)
        structref.define_constructor(Proxy, Type, list(self.fields))
        structref.define_boxing(Type, Proxy)
        scope: dict[str, Any] = {"Proxy": Proxy}
        names = ", ".join(self.fields)
        exec(f"def make_{self.name}({names}): return Proxy({names})", scope)
        exec(f"def take_{self.name}(t): return ({''.join(f't.{f}, ' for f in self.fields)})", scope)
        self._make, self._take = (self._dispatcher(scope[f"{verb}_{self.name}"]) for verb in ("make", "take"))

    def _dispatcher(self, function: types.FunctionType) -> Any:
        function.__module__ = __name__
        dispatcher = _numba().njit(nogil=True)(function)
        cache = _disk_cache(function, fingerprint(function, repr(self.fields), _own_source(), *_versions()))
        if cache is not None:
            dispatcher._cache = cache
        return dispatcher


def declare_carrier(name: str, fields: tuple[str, ...]) -> CarrierType:
    """Announce a carrier with these arrays; its Numba type is made when Numba is first needed."""
    _carriers.append(CarrierType(name, fields))
    return _carriers[-1]


# ----------------------------------------------------------------------------------------------------------- threads


@functools.cache
def _pool() -> Any:
    from concurrent.futures import ThreadPoolExecutor

    return ThreadPoolExecutor(n_threads(), thread_name_prefix="halfmesh")


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_pool.cache_clear)  # a pool's threads do not survive a fork


def n_threads() -> int:
    """How many threads flat loops are cut into: ``$HALFMESH_NUM_THREADS``, or the processors this process may use."""
    chosen = os.environ.get("HALFMESH_NUM_THREADS")
    if chosen:
        return max(1, int(chosen))
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def parallel(function: Callable[..., R], jobs: list[tuple[Any, ...]]) -> list[R]:
    """Run ``function(*job)`` for every job, on several threads where the function releases the GIL; results in order."""
    if len(jobs) == 1 or n_threads() == 1 or _interpret_only:
        return [function(*job) for job in jobs]
    return list(_pool().map(lambda job: function(*job), jobs))


@contextlib.contextmanager
def compiling_always() -> Iterator[None]:
    """Within this context even the smallest input is compiled: how ``halfmesh warmup`` fills the cache."""
    global _always_compile
    before, _always_compile = _always_compile, True
    try:
        yield
    finally:
        _always_compile = before
