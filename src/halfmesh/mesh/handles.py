"""What the four kinds of handle share, and how their words are made from rules.

The words themselves are in `elements`. A step costs as much as the rule, interpreted, and one new object; there is
nothing in it that asks whether all is well: see `core.epochs` for what happens when it is not.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Generic, NoReturn, TypeVar, overload

from halfmesh._jit import maker_of
from halfmesh.core.epochs import successor_of
from halfmesh.core.topology import DELETED, EDGE_SLOTS, FACE_SLOTS, VERTEX_SLOTS
from halfmesh.errors import InvalidMeshError, StaleElementError

if TYPE_CHECKING:
    from halfmesh.mesh.asking import Asked

__all__ = ["KINDS", "Element", "made", "step"]

R = TypeVar("R")
E = TypeVar("E", bound="Element")

KINDS: dict[str, type[Element]] = {}
_PLACES = {"vertex": (VERTEX_SLOTS, 0), "halfedge": (EDGE_SLOTS, 1), "edge": (EDGE_SLOTS, 0), "face": (FACE_SLOTS, 0)}

_new: Any = object.__new__


class Element:
    """What all handles share: an index, and the mesh that it counts in."""

    __slots__ = ("_t", "index")

    kind: ClassVar[str]
    plural: ClassVar[str]
    column: ClassVar[str]  # whose mark says that an element of this kind was deleted
    index: int
    _t: Any  # the interpreted carrier of the mesh

    _family: ClassVar[Mapping[str, type[Element]]] = KINDS  # the classes of the handles that its words give
    _form: ClassVar[str] = "plain"  # the form of kernels that walks its carrier
    _empty: ClassVar[Callable[[], Any]]  # makes a handle of this class that is not filled in yet
    _steps: ClassVar[dict[str, tuple[Any, str]]]  # the words that follow one rule: the rule, and the kind it leads to

    def __init_subclass__(cls) -> None:
        cls._empty = maker_of(cls)
        if "kind" in vars(cls):  # not for classes that users derive
            KINDS[cls.kind] = cls

    def __new__(cls, mesh: Asked, index: int | Element) -> Element:
        """A handle of the family that the mesh has."""
        return _new(mesh._family[cls.kind] if KINDS.get(cls.kind) is cls else cls)  # type: ignore[no-any-return]

    def __init__(self, mesh: Asked, index: int | Element) -> None:
        self.index = getattr(mesh, self.plural).resolve(index)
        self._t = mesh.topology.__views__()

    @property
    def mesh(self) -> Any:
        """The mesh that the element belongs to. A handle alone does not keep it."""
        mesh = self._t.mesh()
        if mesh is None:
            raise StaleElementError(f"the mesh of {self.kind} {self.index} is gone; keep a name for it")
        return mesh

    @property
    def is_alive(self) -> bool:
        """Whether the element still exists; every other word raises if not."""
        try:
            return bool(getattr(self._t, self.column)[self._slot()] != DELETED)
        except StaleElementError:
            return self._goes_over() and self.is_alive

    def _slot(self) -> int:
        """The element's place in its column."""
        return self.index

    def _check(self) -> None:
        if not self.is_alive:
            self._stale()

    def _stale(self) -> NoReturn:
        why = getattr(getattr(self._t, self.column), "why", "was deleted")
        raise StaleElementError(f"{self.kind} {self.index} {why}") from None

    def _goes_over(self) -> bool:
        """Change to the carrier that followed a closed one, if the element is there still."""
        kind, shift = _PLACES[self.kind]
        successor = successor_of(self._t, kind, self.index >> shift)
        if successor is None:
            return False
        self._t = successor
        return True

    def _step_again(self, word: str) -> Any:
        """A step that was refused: from a carrier that was closed, or a deleted element."""
        self._check()
        return getattr(self, word)

    def _absent(self, found: int) -> None:
        """No element there (-1), or no element here (the mark)."""
        if found != -1:
            self._stale()

    def _walk(self, circulator: Any, kind: type[E]) -> Iterator[E]:
        """Handles along a circulator; a corrupt mesh raises instead of walking forever."""
        self._check()
        t, form, kind = self._t, self._form, self._family[kind.kind]  # type: ignore[assignment]
        value = circulator.value and getattr(circulator.value, form)
        step, end = getattr(circulator.step, form), getattr(circulator.start, form)(t, self.index)
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

    def _is(self, rule: Any) -> bool:
        """The answer of a rule that is a question."""
        self._check()
        return bool(getattr(rule, self._form)(self._t, self.index))

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
        if type(self) is not type(other) or self.index != other.index:
            return False
        return self._t is other._t or self._meets(other)

    def _meets(self, other: Element) -> bool:
        """Whether both count in the same mesh, at the same time: when neither goes over any further."""
        self._goes_over()
        other._goes_over()
        return self._t is other._t

    def __lt__(self, other: Element) -> bool:
        if type(self) is not type(other) or not (self._t is other._t or self._meets(other)):
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
    handle: E = kind._empty()
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
        if "_steps" not in vars(owner):
            owner._steps = {}
        owner._steps[name] = self.rule, self.kind

    @overload
    def __get__(self, instance: None, owner: type) -> property: ...
    @overload
    def __get__(self, instance: Element, owner: type) -> R: ...
    def __get__(self, instance: Element | None, owner: type) -> property | R:
        made = property(self._getter(), doc=self.__doc__)
        setattr(self.owner, self.name, made)
        return made.__get__(instance, owner)

    def _getter(self) -> Callable[[Any], Any]:
        rule, new, word = self.rule.plain, KINDS[self.kind]._empty, self.name
        per_slot = 2 if self.owner.kind == "edge" else 1

        def get(self: Any) -> Any:
            try:  # costs nothing where nothing is raised; the whole is inside, to spare a jump
                t = self._t
                index = rule(t, self.index)
                if index < 0:
                    return self._absent(index)
                made = new()
                made._t = t
                made.index = index
                return made
            except StaleElementError:
                return self._step_again(word)

        def get_checked(self: Any) -> Any:  # the rule is arithmetic, it sees no mark
            try:
                t = self._t
                index = self.index
                if t.next[per_slot * index] < 0:
                    self._stale()
                made = new()
                made._t = t
                made.index = rule(t, index)
                return made
            except StaleElementError:
                return self._step_again(word)

        getter: Callable[[Any], Any] = self.rule.written_into(get if self.reads else get_checked, "rule")
        return getter
