"""The compiled form of carriers: structrefs that compiled code borrows, and Python hands in by their address."""

from __future__ import annotations

import functools
import sys
from collections.abc import Mapping
from typing import Any

import numpy as np

from halfmesh._jit.compiler import Compilable, define_carriers, dispatcher, undefined
from halfmesh._jit.fingerprint import fingerprints
from halfmesh._jit.intrinsics import Intrinsic, compiled_only

__all__ = ["CarrierAt", "CarrierType", "declare_carrier"]


class CarrierType:
    """The compiled form of a carrier: `make` builds one from its arrays, `take` gets them out again."""

    def __init__(self, name: str, fields: tuple[str, ...], growing: Compilable | None) -> None:
        self.name, self.fields, self.growing = name, fields, growing
        self.rules: dict[Any, Any] = {}
        self._make: Any = None
        self._take: Any = None

    def bind(self, rules: Mapping[Any, Any]) -> None:
        """Have these rules mean other kernels wherever they are called with a carrier of this type.

        To be said where the carrier is declared, before anything is compiled for it. In the interpreted gear it holds
        for views whose class has the same `rules`.
        """
        self.rules.update(rules)

    def make(self, *arrays: Any) -> Any:
        """The compiled form of a carrier with these arrays; shares their memory."""
        define_carriers()
        return self._make(*arrays)

    def take(self, proxy: Any) -> tuple[Any, ...]:
        """The arrays that the compiled form holds now."""
        return self._take(proxy)  # type: ignore[no-any-return]

    def at(self, *forms: tuple[str, int]) -> CarrierAt:
        """``at(address)`` in a kernel: a carrier of this type, whose arrays have these dtypes and dimensions."""
        return CarrierAt(self, forms)

    def define(self) -> None:
        """Create the Numba type; all carriers are defined before anything is compiled or read from the cache."""
        from numba.core import types as nbtypes
        from numba.experimental import structref

        # what the bound rules compile to is part of the type, and so of the disk cache's keys
        stamp = fingerprints(kernel.py_func for kernel in self.rules.values())

        class Type(nbtypes.StructRef):  # type: ignore[misc, unused-ignore]
            rules = self.rules

            def __init__(self, fields: Any) -> None:
                super().__init__(fields)
                self.name += stamp  # its key, by which types are equal

            def preprocess_fields(self, fields: Any) -> Any:
                return tuple((n, nbtypes.unliteral(t)) for n, t in fields)

        proxy = _proxy_class()
        for made, suffix in ((Type, "Type"), (proxy, "Proxy")):
            made.__name__ = made.__qualname__ = self.name + suffix
            setattr(sys.modules[__name__], made.__name__, made)  # pickle looks here when the disk cache is read
        _define_uncounted(Type)
        structref.define_constructor(proxy, Type, list(self.fields))
        _define_boxing(Type, proxy)
        if self.growing is not None:
            _define_growing(Type, self.growing.compiled)
        scope: dict[str, Any] = {"Proxy": proxy}
        names = ", ".join(self.fields)
        exec(f"def make_{self.name}({names}): return Proxy({names})", scope)
        exec(f"def take_{self.name}(t): return ({''.join(f't.{f}, ' for f in self.fields)})", scope)
        for verb in ("make", "take"):
            function = scope[f"{verb}_{self.name}"]
            function.__module__ = __name__
            setattr(self, f"_{verb}", dispatcher(function, salt=repr((self.fields, stamp))))


class CarrierAt(Intrinsic):
    """A carrier by its address: the number that `CarrierType.make` gave to Python."""

    def __init__(self, carrier: CarrierType, forms: tuple[tuple[str, int], ...]) -> None:
        self.carrier, self.forms = carrier, forms
        super().__init__(f"{carrier.name}{carrier.fields} of {forms}", compiled_only, functools.cache(self._define))

    @functools.cached_property
    def kind(self) -> Any:
        """The Numba type of the carrier."""
        return self.carrier.make(*(np.zeros((1,) * n, dtype) for dtype, n in self.forms))._numba_type_

    def fits(self, proxy: Any) -> bool:
        """Whether that is what lies at this address."""
        return bool(proxy._numba_type_ == self.kind)

    def _define(self) -> Any:
        from numba.core import cgutils
        from numba.core import types as nbtypes
        from numba.extending import intrinsic

        kind = self.kind

        @intrinsic
        def borrow(typing_context: Any, address: Any) -> Any:
            def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
                carried = cgutils.create_struct_proxy(kind)(context, builder)
                carried.meminfo = builder.inttoptr(arguments[0], carried.meminfo.type)
                return carried._getvalue()

            return kind(nbtypes.int64), generate

        return borrow


def _define_uncounted(carrier: Any) -> None:
    """Let compiled code hold a structref without counting its references, which whoever calls a kernel keeps alive.

    Numba counts at every call that passes it on, atomically: a fourth of the time of an operator made of small steps.
    """
    from numba.core import types as nbtypes
    from numba.core.datamodel import models
    from numba.core.datamodel.registry import default_manager
    from numba.experimental import structref

    class Model(models.StructModel):  # type: ignore[misc, unused-ignore]
        def __init__(self, manager: Any, kind: Any) -> None:
            super().__init__(manager, kind, [("meminfo", nbtypes.voidptr)])  # Numba's own is a counted MemInfoPointer

    default_manager.register(carrier, Model)
    structref.define_attributes(carrier)


def _proxy_class() -> Any:
    """What Python holds of a structref: the number that is its address, and what keeps it alive."""

    class Proxy(int):
        _numba_type_: Any
        _meminfo: Any

        @classmethod
        def boxed(cls, address: int, numba_type: Any, meminfo: Any) -> Proxy:
            made = int.__new__(cls, address)
            made._numba_type_, made._meminfo = numba_type, meminfo
            return made

    return Proxy


def _define_boxing(carrier: Any, proxy: Any) -> None:
    """How a carrier goes in and out.

    Numba's own way in looks up an attribute and calls into its runtime; with an address a call takes 160 ns, not 270.
    """
    from numba.core import cgutils
    from numba.core import types as nbtypes
    from numba.extending import NativeValue, box, typeof_impl, unbox

    @typeof_impl.register(proxy)
    def type_of_proxy(value: Any, context: Any) -> Any:
        return value._numba_type_

    name = proxy.__name__.removesuffix("Proxy")
    maker = f"make_{name}"

    @box(carrier)
    def box_carrier(kind: Any, value: Any, c: Any) -> Any:
        if maker not in c.builder.function.name:  # it would be freed twice: see docs/decisions/0010
            raise TypeError(f"a kernel can't return a {name}: it only borrows what it was called with")
        meminfo = cgutils.create_struct_proxy(kind)(c.context, c.builder, value=value).meminfo
        arguments = [
            c.pyapi.long_from_ulonglong(c.builder.ptrtoint(meminfo, c.pyapi.ulonglong)),
            c.pyapi.unserialize(c.pyapi.serialize_object(kind)),
            c.box(nbtypes.MemInfoPointer(nbtypes.voidptr), meminfo),  # takes over the constructor's reference
        ]
        make = c.pyapi.unserialize(c.pyapi.serialize_object(proxy.boxed))
        made = c.pyapi.call_function_objargs(make, arguments)
        for owned in (make, *arguments):
            c.pyapi.decref(owned)
        return made

    @unbox(carrier)
    def unbox_carrier(kind: Any, argument: Any, c: Any) -> Any:
        carried = cgutils.create_struct_proxy(kind)(c.context, c.builder)
        carried.meminfo = c.builder.bitcast(c.pyapi.long_as_voidptr(argument), carried.meminfo.type)
        return NativeValue(carried._getvalue())


def _define_growing(carrier: Any, more: Any) -> None:
    """Let ``carrier[i]`` in a kernel mean ``carrier.values[i]``, and an assignment to it make room first."""
    import operator

    from numba.core import types as nbtypes
    from numba.extending import overload

    @overload(operator.getitem)
    def get(column: Any, key: Any) -> Any:
        def get_row(column: Any, key: Any) -> Any:
            return column.values[key]

        return get_row if isinstance(column, carrier) else None

    @overload(operator.setitem)
    def set(column: Any, key: Any, value: Any) -> Any:
        if not isinstance(column, carrier):
            return None
        if isinstance(key, nbtypes.BaseTuple):

            def set_part(column: Any, key: Any, value: Any) -> None:
                if key[0] >= len(column.values):
                    column.values = more(column.values, 2 * key[0] + 2, column.default)
                column.values[key] = value

            return set_part

        def set_row(column: Any, key: Any, value: Any) -> None:
            if key >= len(column.values):
                column.values = more(column.values, 2 * key + 2, column.default)
            column.values[key] = value

        return set_row


def declare_carrier(name: str, fields: tuple[str, ...], *, growing: Compilable | None = None) -> CarrierType:
    """Announce a carrier with these arrays; its Numba type is made when Numba is first needed.

    With `growing`, a kernel ``(array, n, row)`` that gives a longer copy, the carrier stands for its array ``values``,
    which grows by rows like ``default`` when a kernel sets one behind its end.
    """
    made = CarrierType(name, fields, growing)
    undefined.append(made)
    return made
