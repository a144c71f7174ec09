"""Numba's dispatchers, and their disk cache."""

from __future__ import annotations

import contextlib
import functools
import os
import sys
import threading
import time
import types
from typing import TYPE_CHECKING, Any

import numpy as np

from halfmesh._jit.fingerprint import fingerprint
from halfmesh._jit.intrinsics import Intrinsic
from halfmesh._jit.loops import with_column_reads

if TYPE_CHECKING:
    import pathlib

    from numba.core.caching import FunctionCache

__all__ = [
    "Compilable",
    "c_address",
    "cache_folder",
    "define_carriers",
    "dispatcher",
    "entry_point",
    "numba",
    "undefined",
]

undefined: list[Any] = []  # carriers whose Numba type was not made yet
_defining = threading.RLock()


class Compilable:
    """What compiled code may call by name: its ``compiled`` is a Numba dispatcher."""

    compiled: Any


@functools.cache
def numba() -> Any:
    """Numba, imported once, taught to see a :class:`Compilable` as the dispatcher that it wraps."""
    import numba
    from numba.core import types as nbtypes
    from numba.extending import typeof_impl

    @typeof_impl.register(Compilable)
    def _typeof(value: Any, context: Any) -> Any:
        return nbtypes.Dispatcher(value.compiled)

    @typeof_impl.register(Intrinsic)
    def _typeof_intrinsic(value: Any, context: Any) -> Any:
        from numba.core.registry import cpu_target

        made = value.compiled()
        cpu_target.typing_context.refresh()  # it may be newer than what the context has seen
        return cpu_target.typing_context.resolve_value_type(made)

    return numba


@functools.cache
def _unchecked() -> Any:
    """``column[i]`` for an index that is known not to be negative, as an int64: so kernels have few signatures."""
    from numba.core import types as nbtypes
    from numba.extending import intrinsic

    @intrinsic
    def read(typing_context: Any, column: Any, index: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            array = context.make_array(signature.args[0])(context, builder, arguments[0])
            return builder.sext(builder.load(builder.gep(array.data, [arguments[1]])), arguments[1].type)

        return nbtypes.intp(column, nbtypes.intp), generate

    return read


@functools.cache
def _checked() -> Any:
    """The same for a process that checks all bounds, with the same type."""

    def read(column: Any, index: Any) -> Any:
        return np.int64(column[index])

    return numba().njit(error_model="numpy", nogil=True)(read)


def define_carriers() -> None:
    """Make the types of all carriers that were declared, before anything is compiled or read from the cache."""
    with _defining:  # the first kernels of a process may be called by two threads at once
        while undefined:
            undefined.pop().define()


def dispatcher(
    function: types.FunctionType,
    *,
    source: types.FunctionType | None = None,
    keep: bool = True,
    unchecked: bool = False,
    bounds: bool = False,
    inline: bool = False,
    nogil: bool = True,
    from_python: bool = True,
    from_c: bool = False,
    salt: str = "",
    rule: Any = None,
) -> Any:
    """The Numba dispatcher of a function.

    Parameters
    ----------
    function : function
        What it does, and what the cache key is taken from.
    source : function, optional
        What is compiled in its stead, if that was written anew.
    keep : bool
        Keep the result on disk.
    unchecked : bool
        Read columns without Numba's test for negative indices (but with it where bounds are checked).
    bounds : bool
        Check every index of the function's own text.
    inline : bool
        Write the code into every caller.
    nogil : bool
        Let other threads run while it does.
    from_python : bool
        Also make what Python needs to call it; for rules, which only kernels call, that would be half the code.
    from_c : bool
        Also make what C needs to call it, see `c_address`.
    salt : str
        What else the cache key depends on.
    rule : Rule, optional
        The rule that it is the dispatcher of: carriers may bind another kernel to it.
    """
    define_carriers()
    source = source or function
    if unchecked:
        source = with_column_reads(source, _checked() if numba().config.BOUNDSCHECK else _unchecked())
    made = numba().njit(
        error_model="numpy",
        nogil=nogil,
        boundscheck=bounds or None,
        forceinline=inline,
        no_cpython_wrapper=not from_python,
        no_cfunc_wrapper=not from_c,
    )(source)
    _forget_literals(made)
    if rule is not None:
        _follow_bindings(made, rule)
    cache = _disk_cache(source, fingerprint(function, salt, _own_source(), *_versions())) if keep else None
    if cache is not None:
        made._cache = cache
    return made


def _forget_literals(made: Any) -> None:
    """Let ``f(t, 1)`` and ``f(t, 2)`` in a kernel call the same compiled code; Numba makes one for each constant."""
    from numba.core import types as nbtypes

    resolve = made.get_call_template

    def get_call_template(args: Any, kws: Any) -> Any:
        return resolve(tuple(map(nbtypes.unliteral, args)), {name: nbtypes.unliteral(t) for name, t in kws.items()})

    made.get_call_template = get_call_template


def _follow_bindings(made: Any, rule: Any) -> None:
    """Have the dispatcher of a rule stand aside for the kernel that the type of its first argument binds to it."""
    own_template, own_overload = made.get_call_template, made.get_overload

    def bound(args: Any) -> Any:
        kernel = getattr(args[0], "rules", {}).get(rule) if args else None
        return None if kernel is None else kernel.compiled

    def get_call_template(args: Any, kws: Any) -> Any:
        other = bound(args)
        return (own_template if other is None else other.get_call_template)(args, kws)

    def get_overload(args: Any) -> Any:
        other = bound(args)
        return (own_overload if other is None else other.get_overload)(args)

    made.get_call_template, made.get_overload = get_call_template, get_overload


def entry_point(made: Any, args: tuple[Any, ...]) -> Any:
    """The machine code of a dispatcher for arguments of these types, None if it was not compiled for them.

    Called directly it spares the dispatcher's look at the types of its arguments, 1.4 us of 1.7 where one is a carrier.
    """
    types = tuple(numba().typeof(a) for a in args)
    found = made.overloads.get(types)
    return None if found is None else getattr(found, "entry_point", None)


def c_address(made: Any, n_arguments: int) -> int:
    """Where the machine code of a dispatcher is, as C calls it with so many int64 and takes one from it."""
    from numba.core import types as nbtypes

    signature = (nbtypes.int64,) * n_arguments
    made.compile(signature)
    found = made.overloads[signature]
    return int(found.library.get_pointer_to_function(found.fndesc.llvm_cfunc_wrapper_name))


@functools.cache
def _own_source() -> str:
    import pathlib

    here = pathlib.Path(__file__).parent
    names = ("compiler", "intrinsics", "carriers", "kernels", "rules", "circulators", "loops", "natives")
    return "".join((here / f"{name}.py").read_text("utf-8") for name in names)


@functools.cache
def _versions() -> tuple[str, ...]:
    config = numba().config
    return (sys.version, np.__version__, numba().__version__, str(config.BOUNDSCHECK), str(config.OPT))


def cache_folder() -> pathlib.Path:
    """Where compiled kernels are kept: ``$HALFMESH_CACHE_DIR``, or the place that the system gives to caches."""
    import pathlib

    import platformdirs

    chosen = os.environ.get("HALFMESH_CACHE_DIR")
    base = pathlib.Path(chosen) if chosen else platformdirs.user_cache_path("halfmesh", appauthor=False)
    checked = "-boundscheck" if numba().config.BOUNDSCHECK else ""
    return base / f"{sys.implementation.cache_tag}-numba{numba().__version__}{checked}"


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
    from numba.core import types as nbtypes
    from numba.core.caching import CompileResultCacheImpl, FunctionCache, _CacheLocator

    folder = _writable_folder()
    if folder is None:
        return None
    # A file for each stamp: two scripts may have a function of the same name, and Numba writes the index before the
    # code, so that one process could read what another wrote for other source.
    import hashlib

    place = hashlib.blake2b(f"{function.__code__.co_filename} {stamp}".encode(), digest_size=8).hexdigest()

    class Locator(_CacheLocator):  # type: ignore[misc, unused-ignore]
        def get_cache_path(self) -> str:
            return str(folder)

        def get_source_stamp(self) -> str:
            return stamp

        def get_disambiguator(self) -> str:
            return place

        @classmethod
        def from_function(cls, py_func: Any, py_file: str) -> Any:
            return cls()

    class Implementation(CompileResultCacheImpl):  # type: ignore[misc, unused-ignore]
        _locator_classes = [Locator]  # noqa: RUF012 - as Numba declares it

    class Cache(FunctionCache):  # type: ignore[misc, unused-ignore]
        _impl_class = Implementation

        def _index_key(self, sig: Any, codegen: Any) -> Any:
            # The stamp knows the code, and what closures hold. The types are named, not pickled: the index of a kernel
            # is to be read where the carriers that others have called it with were never declared.
            is_named = not any(isinstance(t, nbtypes.Callable) for t in sig)
            return (", ".join(t.name for t in sig) if is_named else sig, codegen.magic_tuple())

        def load_overload(self, sig: Any, target_context: Any) -> Any:
            try:
                return super().load_overload(sig, target_context)
            except Exception:  # a file cut short or damaged: whatever pickle says, it is compiled anew
                return None

        def save_overload(self, sig: Any, data: Any) -> None:
            with contextlib.suppress(Exception):  # a full disk, what can't be pickled: it is not kept, that is all
                super().save_overload(sig, data)
                _prune(folder)

    return Cache(function)  # type: ignore[no-untyped-call, unused-ignore]


@functools.cache
def _prune(folder: str) -> None:
    """Drop what earlier versions of kernels left behind; once in a process, and only in one that compiles anyway."""
    import pathlib

    oldest = time.time() - 60 * 86400
    for entry in pathlib.Path(folder).glob("*.nb?"):
        with contextlib.suppress(OSError):
            if entry.stat().st_mtime < oldest:
                entry.unlink()
