"""A mesh and its twin, changed together: what the state machine and the long run have in common."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np

from halfmesh.core.invariants import check
from halfmesh.core.statuses import REASONS
from halfmesh.core.topology import COLUMNS, NEWS
from halfmesh.testing import zoo

from .drawing import APPENDED, arguments, faces_to_add, missing_or_deleted
from .rings import Rotation, true
from .table import BY_NAME, KERNELS
from .wholes import compact

EMPTYING = {
    "remove_component", "remove_vertex", "remove_edge", "remove_face", "make_hole", "join_vertices", "dissolve_edge",
}  # fmt: skip
SPECIMENS = {name: specimen.mesh() for name, specimen in zoo().items() if name in APPENDED}


class Walk:
    """Every step is done by the library and by the twin, and everything is compared.

    A step is the name of an operator, or of a method below, and its arguments: plain ints, lists and names.
    """

    def __init__(self, mesh, gear="interpreted"):
        self.mesh, self.gear = mesh, gear
        self.done, self.refused, self.reasons = Counter(), Counter(), Counter()
        carry_attributes(mesh)
        check(mesh.topology)
        self.twin = Rotation(mesh)
        self.twin.assert_same(mesh)

    def draw(self, rng, names, largest):
        """A step at random; nothing that grows where there are more edges than `largest`."""
        ints = [rng.randrange(1 << 20) for _ in range(40)]
        chance = rng.random()
        if chance < 0.03:
            return "add_faces", [faces_to_add(self.twin, ints)]
        if chance < 0.05:
            return rng.choice(["compact", "copy"]), []
        n = len(self.twin.origin) // 2
        allowed = [name for name in names if n <= largest or not BY_NAME[name].grows] or names
        name = rng.choice(allowed)
        if name in EMPTYING and rng.random() * 40 > n:  # small meshes are to grow, not to vanish
            name = rng.choice(allowed)
        return name, arguments(self.twin, BY_NAME[name], ints)

    def take(self, name, args):
        """A step of any kind."""
        if name in BY_NAME:
            self.step(name, args)
        else:
            getattr(self, name)(*args)

    def step(self, name, args):
        """Apply an operator; the code or index that the library answers."""
        operator, m = BY_NAME[name], self.twin
        mine = [self.twin_of(arg) for arg in args]
        reasons = why_not(m, operator, mine)
        before = columns_of(self.mesh)
        values = {place: array.copy() for place, array in attributes_of(self.mesh)}
        total = self.total()
        promised = None if reasons - {"either"} else promise(m, operator, mine)
        answer = self.run(operator.kernel, args)
        if answer < 0:
            assert reasons, f"{name}{args} was refused: {REASONS[-answer].name}"
            given = REASONS[-answer].name
            assert given in reasons or reasons == {"either"}, f"{name}{args} is refused for {given}, not {reasons}"
            self.assert_nothing_changed(before, values)
            self.refused[name] += 1
            self.reasons[given] += 1
        else:
            assert not reasons or "either" in reasons, f"{name}{args} was not refused: {reasons}"
            check(self.mesh.topology)
            m.told = self.mesh
            assert answer == operator.act(m, *mine), f"{name}{args} gives {answer}"
            self.compare()
            if promised is not None:
                self.assert_kept(promised, name, args)
            self.assert_attributes(values, total if operator.keeps_faces else None)
            self.done[name] += 1
        return answer

    def run(self, kernel, args):
        run = getattr(kernel, "interpreted", kernel) if self.gear == "interpreted" else kernel
        return int(run(self.mesh, *(self.argument(arg) for arg in args)))

    def argument(self, arg):
        """As the library takes it: lists are arrays, names are meshes."""
        if isinstance(arg, str):
            return self.mesh if arg == "itself" else SPECIMENS[arg]
        return np.array(arg, dtype=np.int64) if isinstance(arg, list) else arg

    def twin_of(self, arg):
        if isinstance(arg, str):
            return self.twin.copy() if arg == "itself" else Rotation(SPECIMENS[arg])
        return arg

    def compare(self):
        self.twin.assert_same(self.mesh)
        self.twin.read_choices(self.mesh)

    # -- the whole mesh ------------------------------------------------------------------------------------------

    def add_faces(self, faces):
        """All or none, and otherwise as one by one."""
        alone, before = self.branch(), columns_of(self.mesh)
        answers = []
        for face in faces:
            answers.append(alone.step("add_face_of_vertices", [face]))
            if answers[-1] < 0:
                break
        corners, offsets = (
            np.array([v for face in faces for v in face], dtype=np.int64),
            np.cumsum([0, *map(len, faces)]),
        )
        answer = self.run(KERNELS["try_add_faces"], [corners, offsets])
        if answers and answers[-1] < 0:
            assert answer == answers[-1], f"add_faces({faces}) gives {answer}"
            assert columns_of(self.mesh) == before, "a refusal changed the columns"
        else:
            assert answer == self.twin.slots[2], f"add_faces({faces}) gives {answer}"
            assert columns_of(self.mesh)[:-1] == columns_of(alone.mesh)[:-1], "at once is not as one by one"
            assert all(same for _, same in attributes_equal(self.mesh, alone.mesh))
            check(self.mesh.topology)
            self.twin = alone.twin
        self.done["add_faces"] += 1

    def branch(self):
        """The same mesh and twin, to try something with."""
        other = object.__new__(Walk)
        other.mesh, other.twin, other.gear = self.mesh.copy(), self.twin.copy(), self.gear
        other.done, other.refused, other.reasons = Counter(), Counter(), Counter()
        return other

    def compact(self):
        labels, sums = self.labels(), self.total()
        maps = self.mesh.compact()
        new = compact(self.twin)
        for numbers, found in zip(new, (maps.vertices, maps.edges, maps.faces), strict=True):
            living = {x: k for x, k in enumerate(found.tolist()) if k >= 0}
            assert living == {x: k for x, k in numbers.items() if x >= 0}
        check(self.mesh.topology)
        self.compare()
        assert self.labels() == {new[0][v]: label for v, label in labels.items()}
        assert math.isclose(self.total(), sums, abs_tol=1e-9)

    def copy(self):
        """Go on with a copy; the one it was taken from is looked at again after the next step."""
        original, before = self.mesh, columns_of(self.mesh)
        self.mesh = original.copy()
        check(self.mesh.topology)
        self.compare()
        assert dict(attributes_equal(self.mesh, original)) == dict.fromkeys(dict(attributes_of(original)), True)
        assert columns_of(original)[:-1] == before[:-1]

    # -- what must hold ------------------------------------------------------------------------------------------

    def assert_nothing_changed(self, before, values):
        assert columns_of(self.mesh) == before, "a refusal changed the columns"
        for place, array in attributes_of(self.mesh):
            assert array.tobytes() == values[place].tobytes(), f"a refusal changed {place}"

    def assert_kept(self, promised, name, args):
        change, old = promised
        new = figures(self.twin, change)
        for what, by, a, b in zip(("V", "E", "F", "components", "boundary loops"), change, old, new, strict=True):
            assert by is None or b - a == by, f"{name}{args}: {what} changed by {b - a}, promised {by}"
        assert new[3] is None or self.mesh.n_connected_components == new[3]
        assert new[4] is None or self.mesh.n_boundary_loops == new[4]

    def assert_attributes(self, old, total):
        """Lengths; the label of a vertex that stays is its own; what faces carry is neither lost nor made."""
        for (kind, name), array in attributes_of(self.mesh):
            slots = self.twin.slots[("vertex", "edge", "face").index(kind)] if kind != "halfedge" else None
            assert len(array) == (2 * self.twin.slots[1] if slots is None else slots), f"{kind} data {name}"
        was = old["vertex", "label"]
        for v, label in self.labels().items():
            assert label == was[v] if v < len(was) else label in {0, *was.tolist()}, f"label of vertex {v}"
        if total is not None:
            assert math.isclose(self.total(), total, rel_tol=1e-9, abs_tol=1e-9), f"faces held {total}: {self.total()}"

    def labels(self):
        label = self.mesh.vertex_data["label"].tolist()
        return {v: label[v] for v in self.twin.ring}

    def total(self):
        return float(self.mesh.face_data["area"][sorted(self.twin.faces())].sum())


def why_not(m, operator, args):
    """All reasons that are true. A list of which a part is missing may be refused for what the others are, too."""
    reasons = missing_or_deleted(m, operator, args)
    if reasons and operator.takes == "H":
        return reasons | operator.why_not(m, [h for h in args[0] if h in m.origin])
    if reasons and operator.takes in {"V", "vvv", "vvvv"}:
        corners = args[0] if operator.takes == "V" else args
        repeated = any(u == v for u, v in zip(corners, [*corners[1:], *corners[:1]], strict=True))
        return reasons | true(few_vertices=len(corners) < 3, repeated_vertex=repeated)
    if reasons and operator.takes != "vGvG":
        return reasons
    return reasons | operator.why_not(m, *args)


def promise(m, operator, args):
    change = operator.promises(m, *args)
    return change, figures(m, change)


def figures(m, change):
    """V, E, F, and components and boundary loops where anything is said about them: they take a walk."""
    return (
        *m.counts(),
        None if change[3] is None else m.n_components(),
        None if change[4] is None else m.boundary_loops(),
    )


def columns_of(mesh):
    """Every column in use, as bytes, and the counts but for the news that Python has read."""
    t = mesh.topology
    counts = t.__arrays__().counts.copy()
    counts[NEWS] = 0
    return [*(getattr(t, name).tobytes() for name in COLUMNS[:-1]), counts.tolist()]


# -- attributes ------------------------------------------------------------------------------------------------------


def carry_attributes(mesh):
    """A label for each vertex, an amount for each face, and something on corners and edges that must only follow."""
    for table in (mesh.vertex_data, mesh.halfedge_data, mesh.edge_data, mesh.face_data):
        for name in [name for name in table if name != "points"]:
            del table[name]
    mesh.vertex_data.add("label", int)
    mesh.face_data.add("area", float, policy="sum")
    mesh.halfedge_data.add("uv", float, (2,))
    mesh.edge_data.add("crease", np.int8)
    mesh.vertex_data["label"][:] = np.arange(1, len(mesh.vertex_data["label"]) + 1)
    mesh.face_data["area"][:] = 1.0 + np.arange(len(mesh.face_data["area"]))


def attributes_of(mesh):
    tables = {
        "vertex": mesh.vertex_data,
        "halfedge": mesh.halfedge_data,
        "edge": mesh.edge_data,
        "face": mesh.face_data,
    }
    return [((kind, name), array) for kind, table in tables.items() for name, array in table.items()]


def attributes_equal(mesh, other):
    theirs = dict(attributes_of(other))
    return [(place, np.array_equal(array, theirs[place])) for place, array in attributes_of(mesh)]
