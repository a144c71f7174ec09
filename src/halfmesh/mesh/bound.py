"""Handles for meshes whose carrier binds the rules anew: the same words, asked of the carrier at each step."""

from __future__ import annotations

from typing import Any

from halfmesh.mesh.elements import Edge, Face, Halfedge, Vertex
from halfmesh.mesh.handles import Element, made

__all__ = ["BOUND"]

BOUND: dict[str, type[Element]] = {}


class _Bound(Element):
    """What the four kinds share: their mesh never changes, so they live as long as it does."""

    __slots__ = ()
    _family, _form = BOUND, "bound"

    @property
    def is_alive(self) -> bool:
        """Always: the mesh is only read."""
        return True


def _word(rule: Any, kind: str, doc: str | None) -> property:
    def get(self: Element) -> Element | None:
        index = self._t.ask(rule, self.index)
        return None if index < 0 else made(BOUND[kind], self._t, index)

    return property(get, doc=doc)


def _define(base: type[Element]) -> None:
    words: dict[str, Any] = {
        name: _word(rule, kind, rule.__doc__) for name, (rule, kind) in getattr(base, "_steps", {}).items()
    }
    BOUND[base.kind] = type(base.__name__, (_Bound, base), {"__slots__": (), "__module__": __name__, **words})


for _base in (Vertex, Halfedge, Edge, Face):
    _define(_base)
