"""Handles: a vertex, halfedge, edge or face that you can hold.

A handle is a name, not the element: as cheap as a pair of words, equal to every other handle of the same element.
Each step delegates to one rule of `core.navigation`, interpreted over memoryviews: calling compiled code for a single
step would cost ten times the step itself.

A step on a deleted element raises :class:`StaleElementError`, at no cost in the good case: all columns of a deleted
element hold a negative mark, and what reads a mark refuses.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, ClassVar, Generic, NoReturn, TypeVar, overload

from halfmesh._jit import declared
from halfmesh.core import circulation, navigation
from halfmesh.core.topology import DELETED
from halfmesh.errors import InvalidMeshError, StaleElementError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from halfmesh.mesh.mesh import Mesh

__all__ = ["Edge", "Element", "Face", "Halfedge", "Vertex", "made"]

R = TypeVar("R")
E = TypeVar("E", bound="Element")

_new: Any = object.__new__


class Element:
    """What all handles share: an index, and the mesh that it counts in."""

    __slots__ = ("_t", "index")

    kind: ClassVar[str]
    plural: ClassVar[str]
    column: ClassVar[str]  # whose mark says that an element of this kind was deleted
    index: int
    _t: Any  # the interpreted carrier of the mesh

    def __init__(self, mesh: Mesh, index: int | Element) -> None:
        self.index = getattr(mesh, self.plural).resolve(index)
        self._t = mesh.topology.__views__()

    @property
    def mesh(self) -> Mesh:
        """The mesh that the element belongs to. A handle alone does not keep it."""
        mesh: Mesh | None = self._t.mesh()
        if mesh is None:
            raise StaleElementError(f"the mesh of {self.kind} {self.index} is gone; keep a name for it")
        return mesh

    @property
    def is_alive(self) -> bool:
        """Whether the element still exists; every other word raises if not."""
        try:
            return bool(getattr(self._t, self.column)[self._slot()] != DELETED)
        except StaleElementError:
            return False

    def _slot(self) -> int:
        """The element's place in its column."""
        return self.index

    def _check(self) -> None:
        if not self.is_alive:
            self._stale()

    def _stale(self) -> NoReturn:
        raise StaleElementError(f"{self.kind} {self.index} was deleted, or its index moved when the mesh was compacted")

    def _absent(self, found: int) -> None:
        """No element there (-1), or no element here (the mark)."""
        if found != -1:
            self._stale()

    def _walk(self, circulator: Any, kind: type[E]) -> Iterator[E]:
        """Handles along a circulator; a corrupt mesh raises instead of walking forever."""
        self._check()
        t, value = self._t, circulator.value and circulator.value.plain
        step, end = circulator.step.plain, circulator.start.plain(t, self.index)
        at = end
        if at < 0:
            return
        for _ in range(2 * t.counts[1]):
            found = at if value is None else value(t, at)
            at = step(t, at)
            if found >= 0 or not circulator.skips:
                yield made(kind, t, found)
            if at == end:
                return
        raise InvalidMeshError(f"the walk around {self.kind} {self.index} does not close; see mesh.check()")

    def _count(self, circulator: Any) -> int:
        return sum(1 for _ in self._walk(circulator, type(self)))

    def __index__(self) -> int:
        return self.index

    def __compiled__(self) -> int:
        return self.index  # a kernel takes a handle as its index

    def __views__(self) -> int:
        return self.index

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Element):
            return NotImplemented
        return type(self) is type(other) and self.index == other.index and self._t is other._t

    def __lt__(self, other: Element) -> bool:
        if type(self) is not type(other) or self._t is not other._t:
            return NotImplemented
        return self.index < other.index

    def __le__(self, other: Element) -> bool:
        return NotImplemented if self.__lt__(other) is NotImplemented else self.index <= other.index

    def __hash__(self) -> int:
        return hash((self.kind, self.index))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.index})"

    def __reduce__(self) -> NoReturn:
        raise TypeError("a handle means nothing without its mesh; pickle the mesh and keep handle.index")


def made(kind: type[E], t: Any, index: int) -> E:
    """A handle of what is known to be an element."""
    handle: E = _new(kind)
    handle._t = t
    handle.index = index
    return handle


def step(rule: Any, kind: str, *, reads: bool = True) -> Callable[[Callable[[Any], R]], _Step[R]]:
    """Declare a property that follows one rule to an element of that kind; `reads` a column, or is arithmetic."""
    return lambda function: _Step(rule, kind, reads, function.__doc__)


class _Step(Generic[R]):
    """What `step` declares. The first use writes the getter and puts it in its own place."""

    def __init__(self, rule: Any, kind: str, reads: bool, doc: str | None) -> None:
        self.rule, self.kind, self.reads, self.__doc__ = rule, kind, reads, doc

    def __set_name__(self, owner: type[Element], name: str) -> None:
        self.owner, self.name = owner, name

    @overload
    def __get__(self, instance: None, owner: type) -> property: ...
    @overload
    def __get__(self, instance: Element, owner: type) -> R: ...
    def __get__(self, instance: Element | None, owner: type) -> property | R:
        made = property(self._getter(), doc=self.__doc__)
        setattr(self.owner, self.name, made)
        return made.__get__(instance, owner)

    def _getter(self) -> Callable[[Any], Any]:
        rule, kind, new, per_slot = self.rule.plain, _KINDS[self.kind], _new, 2 if self.owner is Edge else 1

        def get(self: Any) -> Any:
            t = self._t
            index = rule(t, self.index)
            if index < 0:
                return self._absent(index)
            made = new(kind)
            made._t = t
            made.index = index
            return made

        def get_checked(self: Any) -> Any:  # the rule is arithmetic, it sees no mark
            t = self._t
            index = self.index
            if t.next[per_slot * index] < 0:
                self._stale()
            made = new(kind)
            made._t = t
            made.index = rule(t, index)
            return made

        getter: Callable[[Any], Any] = self.rule.written_into(get if self.reads else get_checked, "rule")
        return getter


class Vertex(Element):
    """A vertex: a point where edges meet."""

    __slots__ = ()
    kind, plural = "vertex", "vertices"
    column = "vertex_halfedge"

    @step(navigation.halfedge_of_vertex, "halfedge")
    def halfedge(self) -> Halfedge | None:
        """A halfedge that leaves the vertex, an exterior one if there is any; None if it is isolated."""
        declared()

    @property
    def point(self) -> NDArray[np.float64]:
        """Its position, shape (3,): a view, writing into it moves the vertex."""
        self._check()
        row: NDArray[np.float64] = self._t.vertex_data["points"][self.index]
        return row

    @point.setter
    def point(self, point: Any) -> None:
        self.point[:] = point

    @property
    def degree(self) -> int:
        """Number of edges; a loop edge counts twice. Complexity: O(degree)."""
        return self._count(circulation.outgoing)

    @property
    def is_boundary(self) -> bool:
        """Whether it touches a gap. An isolated vertex does not. Complexity: O(1)."""
        self._check()
        return bool(navigation.is_boundary_vertex.plain(self._t, self.index))

    @property
    def is_isolated(self) -> bool:
        """Whether no edge touches it."""
        self._check()
        return bool(navigation.is_isolated.plain(self._t, self.index))

    def outgoing(self) -> Iterator[Halfedge]:
        """The halfedges that leave it, counter-clockwise; at a boundary vertex the exterior one comes last."""
        return self._walk(circulation.outgoing, Halfedge)

    def incoming(self) -> Iterator[Halfedge]:
        """The halfedges that arrive at it, counter-clockwise."""
        return self._walk(circulation.incoming, Halfedge)

    def neighbors(self) -> Iterator[Vertex]:
        """The other ends of its edges, counter-clockwise; one that is joined twice comes twice."""
        return self._walk(circulation.neighbors, Vertex)

    def edges(self) -> Iterator[Edge]:
        """Its edges, counter-clockwise."""
        return self._walk(circulation.edges_around, Edge)

    def faces(self) -> Iterator[Face]:
        """The faces around it, counter-clockwise; gaps are left out."""
        return self._walk(circulation.faces_around, Face)


class Halfedge(Element):
    """One of the two directed sides of an edge."""

    __slots__ = ()
    kind, plural = "halfedge", "halfedges"
    column = "next"

    @step(navigation.twin_of, "halfedge", reads=False)
    def twin(self) -> Halfedge:
        """The other halfedge of the same edge."""
        declared()

    @step(navigation.next_of, "halfedge")
    def next(self) -> Halfedge:
        """The one after it around its face or boundary loop."""
        declared()

    @step(navigation.prev_of, "halfedge")
    def prev(self) -> Halfedge:
        """The one before it around its face or boundary loop."""
        declared()

    @step(navigation.ccw_of, "halfedge")
    def ccw(self) -> Halfedge:
        """The next one counter-clockwise around its origin: twin(prev)."""
        declared()

    @step(navigation.cw_of, "halfedge")
    def cw(self) -> Halfedge:
        """The next one clockwise around its origin: next(twin)."""
        declared()

    @step(navigation.origin_of, "vertex")
    def origin(self) -> Vertex:
        """The vertex that it leaves."""
        declared()

    @step(navigation.target_of, "vertex")
    def target(self) -> Vertex:
        """The vertex that it arrives at."""
        declared()

    @step(navigation.face_of, "face")
    def face(self) -> Face | None:
        """The face on its left; None if it is exterior."""
        declared()

    @step(navigation.edge_of, "edge", reads=False)
    def edge(self) -> Edge:
        """The edge that it is a side of."""
        declared()

    @property
    def is_exterior(self) -> bool:
        """Whether there is no face on its left."""
        self._check()
        return bool(navigation.is_exterior.plain(self._t, self.index))

    @property
    def is_boundary(self) -> bool:
        """Whether it or its twin is exterior."""
        return self.edge.is_boundary

    @property
    def length(self) -> float:
        """Distance between its ends."""
        return self.edge.length


class Edge(Element):
    """An edge: two halfedges that run against each other."""

    __slots__ = ()
    kind, plural = "edge", "edges"
    column = "next"

    def _slot(self) -> int:
        return 2 * self.index

    @step(navigation.halfedge_of_edge, "halfedge", reads=False)
    def halfedge(self) -> Halfedge:
        """Its first halfedge, ``2 * index``."""
        declared()

    @property
    def vertices(self) -> tuple[Vertex, Vertex]:
        """Its two ends: origin and target of its halfedge."""
        h = self.halfedge
        return h.origin, h.target

    @property
    def faces(self) -> tuple[Face | None, Face | None]:
        """The faces left and right of its halfedge; None where there is none."""
        h = self.halfedge
        return h.face, h.twin.face

    @property
    def is_boundary(self) -> bool:
        """Whether a face is missing on one side, or on both."""
        self._check()
        return bool(navigation.is_boundary_edge.plain(self._t, self.index))

    @property
    def length(self) -> float:
        """Distance between its ends."""
        a, b = self.vertices
        points = self._t.vertex_data["points"]
        return math.dist(points[a.index], points[b.index])


class Face(Element):
    """A face: a polygon of any number of sides, counter-clockwise."""

    __slots__ = ()
    kind, plural = "face", "faces"
    column = "face_halfedge"

    @step(navigation.halfedge_of_face, "halfedge")
    def halfedge(self) -> Halfedge:
        """One of its halfedges: that of the first listed corner, in a mesh made from a face list."""
        declared()

    @property
    def degree(self) -> int:
        """Number of corners. Complexity: O(degree)."""
        return self._count(circulation.face_halfedges)

    def vertices(self) -> Iterator[Vertex]:
        """Its corners, counter-clockwise, as they were listed."""
        return self._walk(circulation.face_vertices, Vertex)

    def halfedges(self) -> Iterator[Halfedge]:
        """Its halfedges, counter-clockwise."""
        return self._walk(circulation.face_halfedges, Halfedge)

    def edges(self) -> Iterator[Edge]:
        """Its edges, counter-clockwise."""
        return self._walk(circulation.face_edges, Edge)

    def neighbors(self) -> Iterator[Face]:
        """The faces across its edges, counter-clockwise; boundary edges are left out."""
        return self._walk(circulation.face_neighbors, Face)


_KINDS: dict[str, type[Element]] = {"vertex": Vertex, "halfedge": Halfedge, "edge": Edge, "face": Face}
