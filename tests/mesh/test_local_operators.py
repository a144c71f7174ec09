"""Local operators through the mesh: Euler's numbers, inverses, refusals that change nothing, random walks."""

from __future__ import annotations

import itertools
import random

import numpy as np
import pytest

import halfmesh as hm
from halfmesh import _jit
from halfmesh.core.topology import COLUMNS
from halfmesh.testing import assert_valid, zoo

ZOO = zoo()


def columns(mesh):
    """Copies of all columns in use; of the counts, those of elements."""
    return {name: np.array(getattr(mesh.topology, name)) for name in COLUMNS[:-1]}


def faces_of(mesh):
    """The living faces as a set of vertex cycles, each from where it reads lowest."""
    indices, offsets = mesh.face_vertices()
    rows = [indices[a:b].tolist() for a, b in itertools.pairwise(offsets) if a < b]
    return sorted(min(row[k:] + row[:k] for k in range(len(row))) for row in rows)


def figures(mesh):
    return mesh.n_vertices, mesh.n_edges, mesh.n_faces, mesh.n_connected_components, mesh.n_boundary_loops


def change(before, after):
    return tuple(b - a for a, b in zip(before, after, strict=True))


def square():
    return hm.Mesh([[0, 1, 2], [0, 2, 3]], points=[[0, 0], [1, 0], [1, 1], [0, 1]])


# ------------------------------------------------------------------------------------------------ Euler's numbers, laws


@pytest.mark.parametrize("name", ZOO)
def test_every_edge_of_the_zoo_can_be_split_and_collapsed_back(name):
    mesh = ZOO[name].mesh()
    old, faces, is_simple = figures(mesh), faces_of(mesh), simple(mesh)
    for e in mesh.edges.indices.tolist():
        v = mesh.split_edge(e)
        assert_valid(mesh)
        assert change(old, figures(mesh)) == (1, 1, 0, 0, 0)
        back = next(h for h in v.outgoing() if h.edge.index == e)  # to where the edge came from
        if mesh.can_collapse(back.twin.next):
            mesh.collapse(back.twin.next)
            assert_valid(mesh)
            assert (figures(mesh), faces_of(mesh)) == (old, faces)
        else:
            assert not is_simple  # putting a vertex into a loop or a parallel edge undoes that: no way back
            return


def simple(mesh):
    """Whether no edge is a loop or parallel, and no face passes a vertex twice: where a split can be undone."""
    indices, offsets = mesh.face_vertices()
    rows = [indices[a:b].tolist() for a, b in itertools.pairwise(offsets)]
    ends = [tuple(sorted(pair)) for pair in mesh.edge_vertices()[mesh.edges.indices].tolist()]
    return len(set(ends)) == len(ends) and all(len(set(row)) == len(row) for row in rows)


@pytest.mark.parametrize("name", ZOO)
def test_every_face_of_the_zoo_can_be_split_at_a_point_and_joined_again(name):
    mesh = ZOO[name].mesh()
    for f in mesh.faces.indices.tolist():
        old, faces, degree = figures(mesh), faces_of(mesh), mesh.faces[f].degree
        v = mesh.split_face(f)
        assert_valid(mesh)
        assert change(old, figures(mesh)) == (1, degree, degree - 1, 0, 0)
        while v.degree > 1:  # the spokes go one by one; the last is a slit, which a collapse takes away
            h = next(h for h in v.outgoing() if mesh.can_join_faces(h))
            mesh.join_faces(h)
        mesh.collapse(v.halfedge)
        assert_valid(mesh)
        assert (figures(mesh), faces_of(mesh)) == (old, faces)


@pytest.mark.parametrize("name", ZOO)
def test_every_diagonal_of_the_zoo_can_be_put_in_and_taken_out(name):
    mesh = ZOO[name].mesh()
    for f in mesh.faces.indices.tolist()[:20]:
        corners = list(mesh.faces[f].halfedges())
        for a, b in zip(corners, corners[2:], strict=False):
            if mesh.can_connect(a, b):
                old, faces = figures(mesh), faces_of(mesh)
                h = mesh.connect(a, b)
                assert_valid(mesh)
                assert change(old, figures(mesh)) == (0, 1, 1, 0, 0)
                assert (h.origin, h.target) == (a.origin, b.origin)
                mesh.join_faces(h.twin)
                assert_valid(mesh)
                assert (figures(mesh), faces_of(mesh)) == (old, faces)


@pytest.mark.parametrize("name", ZOO)
def test_two_flips_turn_an_edge_of_triangles_round(name):
    mesh = ZOO[name].mesh()
    for e in mesh.edges.indices.tolist():
        if all(f is not None and f.degree == 3 for f in mesh.edges[e].faces) and mesh.can_flip(e):
            old, faces = figures(mesh), faces_of(mesh)
            a, b = mesh.edges[e].vertices
            mesh.flip(e)
            assert_valid(mesh)
            assert figures(mesh) == old
            mesh.flip(e, allow_parallel=True)
            assert mesh.edges[e].vertices == (b, a)
            assert faces_of(mesh) == faces


@pytest.mark.parametrize("name", ZOO)
def test_every_legal_collapse_of_the_zoo_keeps_the_surface(name):
    for h in ZOO[name].mesh().halfedges.indices.tolist():
        mesh = ZOO[name].mesh()
        if not mesh.can_collapse(h):
            continue
        old, genus = figures(mesh), mesh.genus
        triangles = sum(side.face is not None and side.face.degree == 3 and side.twin not in (side.next, side.prev)
                        for side in (mesh.halfedges[h], mesh.halfedges[h].twin))  # fmt: skip
        was_wire = mesh.halfedges[h].origin.degree == mesh.halfedges[h].target.degree == 1
        target = mesh.halfedges[h].target
        assert mesh.collapse(h) == target
        assert_valid(mesh)
        assert change(old, figures(mesh)) == (-1, -1 - triangles, -triangles, 0, -1 if was_wire else 0)
        assert mesh.genus == genus


# ------------------------------------------------------------------------------------------------------- random walks


OPERATORS = ["flip", "split_edge", "split_face", "connect", "join_faces", "join_faces", "collapse", "collapse"]


def step(mesh, rng):
    """One operator at random, legal or not."""
    operator, h = rng.choice(OPERATORS), mesh.halfedges[rng.choice(mesh.halfedges.indices.tolist())]
    loose = rng.random() < 0.3
    if operator == "flip":
        mesh.flip(h.edge, allow_parallel=loose)
    elif operator == "split_edge":
        mesh.split_edge(h, at=rng.random())
    elif operator == "split_face" and mesh.n_faces:
        mesh.split_face(rng.choice(mesh.faces.indices.tolist()))
    elif operator == "connect":
        loop = [h]
        while loop[-1].next != h:
            loop.append(loop[-1].next)
        mesh.connect(h, rng.choice(loop), allow_parallel=loose)
    elif operator == "join_faces":
        mesh.join_faces(h)
    elif operator == "collapse":
        mesh.collapse(h, at=rng.choice([0.0, 0.5, 1.0]))


def walk(mesh, rng, steps):
    for _ in range(steps):
        if not mesh.n_edges:
            return
        before, revision, euler = columns(mesh), mesh.revision, mesh.euler_characteristic
        points = mesh.points.copy()
        try:
            step(mesh, rng)
        except hm.TopologyError:
            for name, column in columns(mesh).items():
                assert np.array_equal(column, before[name]), name
            assert (mesh.revision, mesh.points.tolist()) == (revision, points.tolist())
        assert_valid(mesh)
        assert mesh.euler_characteristic == euler


@pytest.mark.parametrize("name", ZOO)
def test_random_walk_keeps_all_laws_and_refusals_change_nothing(name):
    mesh = ZOO[name].mesh()
    mesh.halfedge_data.add("uv", float, (2,))
    walk(mesh, random.Random(name), 60)


@pytest.mark.fuzz
@pytest.mark.parametrize("seed", range(200))
def test_long_random_walk(seed):
    for name, specimen in ZOO.items():
        walk(specimen.mesh(), random.Random(f"{seed} {name}"), 100)


# ----------------------------------------------------------------------------------------------------- what is refused


@pytest.mark.parametrize(
    ("act", "reason"),
    [
        (lambda mesh: mesh.flip(mesh.find_halfedge(0, 1).edge), "boundary_edge"),
        (lambda mesh: mesh.join_faces(mesh.find_halfedge(0, 1)), "boundary_edge"),
        (lambda mesh: mesh.connect(0, 0), "same_corner"),
        (lambda mesh: mesh.connect(mesh.find_halfedge(0, 1), mesh.find_halfedge(2, 3)), "different_faces"),
        (lambda mesh: mesh.connect(mesh.find_halfedge(0, 1), mesh.find_halfedge(1, 2)), "would_be_parallel"),
        (lambda mesh: mesh.connect(mesh.find_halfedge(1, 0), mesh.find_halfedge(0, 3)), "no_face"),
        (lambda mesh: mesh.collapse(mesh.find_halfedge(0, 2)), "would_leave_wire"),
    ],
)
def test_refusal_says_why_and_changes_nothing(act, reason):
    mesh = square()
    before = columns(mesh)
    with pytest.raises(hm.TopologyError) as refused:
        act(mesh)
    assert refused.value.reason == reason
    assert all(np.array_equal(column, before[name]) for name, column in columns(mesh).items())


def test_collapse_that_would_fold_or_pinch_is_refused():
    tetrahedron = hm.shapes.tetrahedron()
    with pytest.raises(hm.TopologyError) as refused:
        tetrahedron.collapse(0)
    assert refused.value.reason == "would_fold"
    quads = hm.Mesh([[0, 1, 2, 3], [1, 4, 5, 2]])
    with pytest.raises(hm.TopologyError) as refused:
        quads.collapse(quads.find_halfedge(1, 2))
    assert refused.value.reason == "would_pinch"
    triangle = hm.Mesh([[0, 1, 2]])
    with pytest.raises(hm.TopologyError) as refused:
        triangle.collapse(0)
    assert refused.value.reason in {"would_leave_wire", "would_close_hole"}


@pytest.mark.parametrize("wrong", [-1, 10**6, 1.5, True, "0", None])
def test_wrong_elements_are_no_elements(wrong):
    mesh = square()
    before = columns(mesh)
    for act in (mesh.flip, mesh.split_edge, mesh.split_face, mesh.collapse, mesh.join_faces):
        with pytest.raises(hm.ElementError):
            act(wrong)
    assert all(np.array_equal(column, before[name]) for name, column in columns(mesh).items())


def test_elements_of_another_mesh_and_of_the_wrong_kind_are_refused():
    mesh, other = square(), square()
    for act, element in (
        (mesh.flip, other.edges[0]),
        (mesh.flip, mesh.faces[0]),
        (mesh.split_face, mesh.edges[0]),
        (mesh.collapse, mesh.vertices[0]),
    ):
        with pytest.raises(hm.ElementError):
            act(element)


def test_deleted_elements_are_stale():
    mesh = square()
    h = mesh.find_halfedge(0, 2)
    f, kept = h.twin.face, h.face
    mesh.join_faces(h)
    for stale in (lambda: h.next, lambda: f.degree, lambda: mesh.flip(h.edge), lambda: mesh.split_face(f)):
        with pytest.raises(hm.StaleElementError):
            stale()
    assert not h.is_alive
    assert f not in mesh.faces
    assert list(mesh.faces) == [kept]


@pytest.mark.parametrize("point", [[0, 0, np.nan], [np.inf, 0, 0], [1], [1, 2, 3, 4], "abc", [[0, 0, 0]]])
def test_bad_points_are_refused_before_anything_changes(point):
    mesh = square()
    before = columns(mesh)
    for act, element in ((mesh.split_edge, 0), (mesh.split_face, 0), (mesh.collapse, 0)):
        with pytest.raises(hm.InvalidMeshError):
            act(element, point)
    assert all(np.array_equal(column, before[name]) for name, column in columns(mesh).items())


@pytest.mark.parametrize("at", [-0.1, 1.1, float("nan")])
def test_places_off_the_edge_are_refused(at):
    with pytest.raises(hm.InvalidMeshError):
        square().split_edge(0, at=at)


# --------------------------------------------------------------------------------------------- attributes that follow


def test_points_follow_a_split_and_a_collapse():
    mesh = square()
    e = mesh.find_halfedge(0, 1).edge
    assert mesh.split_edge(e, at=0.25).point.tolist() == [0.25, 0, 0]
    assert mesh.split_face(0, [5, 6]).point.tolist() == [5, 6, 0]
    mesh = hm.shapes.icosphere(1)
    h = mesh.halfedges[0]
    middle = (h.origin.point + h.target.point) / 2
    assert np.allclose(mesh.collapse(h, at=0.5).point, middle)


@pytest.mark.parametrize(
    ("policy", "dtype", "new", "merged"),
    [
        ("lerp", float, 2.5, 2.5),
        ("mean", float, 4.0, 4.0),
        ("copy", int, 2, 6),
        ("first", int, 2, 2),
        ("nearest", int, 2, 2),
        ("min", int, 2, 2),
        ("max", int, 6, 6),
        ("sum", int, 0, 8),
        (lambda values, weights: values.max() * 10 + weights[0], float, 60.875, None),
    ],
)
def test_policies_at_a_split_and_a_collapse(policy, dtype, new, merged):
    mesh = hm.Mesh([[0, 1, 2, 3]])
    mesh.vertex_data.add("x", dtype, policy=policy)[:] = [2, 6, 0, 0]
    v = mesh.split_edge(mesh.find_halfedge(0, 1), at=0.125)
    assert mesh.vertex_data["x"][v.index] == new
    if merged is not None:
        mesh = hm.Mesh([[0, 1, 2, 3]])
        mesh.vertex_data.add("x", dtype, policy=policy)[:] = [2, 6, 0, 0]
        v = mesh.collapse(mesh.find_halfedge(0, 1), at=0.125)
        assert mesh.vertex_data["x"][v.index] == merged


def test_normalized_directions_stay_of_length_one():
    mesh = hm.Mesh([[0, 1, 2]])
    mesh.vertex_data.add("n", float, (3,), policy="normalize")[:] = np.eye(3)
    v = mesh.split_edge(mesh.find_halfedge(0, 1))
    assert np.allclose(mesh.vertex_data["n"][v.index], [0.5**0.5, 0.5**0.5, 0])


def test_sums_are_shared_so_that_the_total_stays():
    mesh = hm.shapes.cube()
    mesh.face_data.add("mass", float, policy="sum")[:] = 1.0
    mesh.edge_data.add("length", float, policy="sum")[:] = 1.0
    mesh.split_face(0)
    mesh.split_edge(0, at=0.25)
    h = mesh.connect(mesh.faces[1].halfedge, mesh.faces[1].halfedge.next.next)
    assert np.isclose(mesh.face_data["mass"].sum(), 6.0)
    assert mesh.edge_data["length"][0] == 0.25
    assert np.isclose(mesh.edge_data["length"].sum(), 12.0)
    mesh.join_faces(h)
    assert np.isclose(mesh.face_data["mass"][mesh.faces.indices].sum(), 6.0)


@pytest.mark.parametrize("value", [0, 1, 2, 5, 7])
def test_sums_of_whole_numbers_are_shared_to_the_last(value):
    mesh = hm.shapes.cube()
    tables = (mesh.vertex_data, mesh.edge_data, mesh.face_data)
    for table in tables:
        table.add("count", np.uint8, policy="sum")[:] = value
    mesh.split_face(0)
    mesh.split_edge(0, at=0.3)
    mesh.connect(mesh.faces[1].halfedge, mesh.faces[1].halfedge.next.next)
    a, b, *_ = mesh.vertices[2].outgoing()
    mesh.split_vertex(a, b)
    assert [int(table["count"].sum()) for table in tables] == [8 * value, 12 * value, 6 * value]


def test_labels_of_faces_are_copied():
    mesh = hm.shapes.cube()
    mesh.face_data["label"] = np.arange(6)
    v = mesh.split_face(4)
    assert {int(mesh.face_data["label"][f.index]) for f in v.faces()} == {4}


def test_seam_in_corner_data_stays_a_seam_at_a_split():
    mesh = square()
    left, right = mesh.find_halfedge(0, 2), mesh.find_halfedge(2, 0)
    uv = mesh.halfedge_data.add("uv", float)
    for face, value in ((left.face, 10.0), (right.face, 20.0)):
        for h in face.halfedges():
            uv[h.index] = value
    v = mesh.split_edge(left)
    values = {h.face.index: mesh.halfedge_data["uv"][h.index] for h in v.outgoing()}
    assert values == {left.face.index: 10.0, right.face.index: 20.0}


def test_seam_in_corner_data_stays_a_seam_at_a_collapse():
    """Two sheets of a grid with values of their own, apart by 100; an edge on the seam contracts to its middle."""
    mesh = hm.shapes.grid(4, 4)
    x = mesh.points[:, 0]
    uv = mesh.halfedge_data.add("uv", float)
    middle = np.median(np.unique(x))
    for f in mesh.faces:
        sheet = 100.0 * (np.mean([v.point[0] for v in f.vertices()]) > middle)
        for h in f.halfedges():
            uv[h.index] = sheet + h.origin.point[1]
    on_seam = [
        h for h in mesh.halfedges
        if not h.origin.is_boundary and not h.target.is_boundary and h.origin.point[0] == h.target.point[0] == middle
    ]  # fmt: skip
    h = next(h for h in on_seam if mesh.can_collapse(h))
    y = (h.origin.point[1] + h.target.point[1]) / 2
    v = mesh.collapse(h, at=0.5)
    found = {float(mesh.halfedge_data["uv"][g.index]) for g in v.outgoing()}
    assert found == {y, 100.0 + y}


@pytest.mark.parametrize("dtype", ["f4", "f2", "i8", "u1", "?", "c16", "U5", "M8[s]", "i4,f8"])
def test_any_dtype_follows(dtype):
    mesh = square()
    mesh.vertex_data.add("x", dtype)
    mesh.face_data.add("x", dtype, (2,))
    mesh.split_face(0)
    mesh.split_edge(0)
    assert len(mesh.vertex_data["x"]) == 6
    assert_valid(mesh)


def test_new_elements_that_nothing_precedes_have_the_default():
    mesh = hm.shapes.cube()
    mesh.edge_data.add("weight", float, default=7.0)[:] = 1.0
    mesh.split_face(0)
    assert mesh.edge_data["weight"].tolist() == [1.0] * 12 + [7.0] * 4


@pytest.mark.parametrize(
    ("policy", "dtype"), [("median", float), ("lerp", "U3"), ("sum", "M8[s]"), ("normalize", int), ("min", complex)]
)
def test_policies_that_make_no_sense_are_refused(policy, dtype):
    with pytest.raises(ValueError, match=r"polic|follow"):
        square().vertex_data.add("x", dtype, policy=policy)


def test_policy_can_be_changed_and_is_copied():
    mesh = square()
    mesh.vertex_data["x"] = np.arange(4.0)
    assert mesh.vertex_data.policies == {"points": "lerp", "x": "lerp"}
    mesh.vertex_data.set_policy("x", "max")
    assert mesh.copy().vertex_data.policies["x"] == "max"
    with pytest.raises(KeyError):
        mesh.vertex_data.set_policy("y", "max")


# ---------------------------------------------------------------------- operators and points in one compiled call


def edited(mesh, n):
    """Splits and collapses, with places and without, until far more than `n` calls have been made of each."""
    rng = random.Random(1)
    for k in range(n):
        place = None if k % 3 else [0.5, float(k), -1.0]
        mesh.split_edge(rng.choice(mesh.edges.indices.tolist()), place, at=0.25 if place is None else 0.5)
        mesh.split_face(rng.choice(mesh.faces.indices.tolist()), place)
        e = rng.choice(mesh.edges.indices.tolist())
        if mesh.can_split_edge_triangular(e):
            mesh.split_edge_triangular(e, place, at=0.5)
        for _ in range(3):
            mesh.try_collapse(rng.choice(mesh.halfedges.indices.tolist()), place, at=0.75)
    return mesh


@pytest.mark.large
@pytest.mark.parametrize("others", [False, True])
def test_points_that_follow_in_the_same_call_are_those_that_follow_after_it(others, monkeypatch):
    meshes = [hm.shapes.icosphere(1), hm.shapes.icosphere(1)]
    for mesh in meshes if others else []:
        mesh.vertex_data["x"] = mesh.points.copy()
        mesh.halfedge_data["uv"] = np.arange(float(mesh.n_halfedges))
    with _jit.compiling_always():
        quick = edited(edited(meshes[0], 2), 200)
        monkeypatch.setattr(hm.Mesh, "_act_at", act_and_place)
        slow = edited(edited(meshes[1], 2), 200)
    assert_valid(quick)
    assert_valid(slow)
    assert np.array_equal(quick.topology.next, slow.topology.next)
    assert np.allclose(quick.points, slow.points, rtol=1e-14, atol=0)
    if others:
        assert np.array_equal(quick.vertex_data["x"], slow.vertex_data["x"])
        assert np.array_equal(quick.halfedge_data["uv"], slow.halfedge_data["uv"])


def act_and_place(mesh, operation, placing, element, weight, point, *more):
    return mesh._act_and_place(operation, (element,) if weight is None else (element, weight, *more), point)


def test_point_that_is_none_is_refused_before_anything_is_split():
    for mesh in (square(), edited(hm.shapes.icosphere(1), 30)):
        n = mesh.n_vertices
        for bad in ([0, 0, 0, 0], [0, float("nan"), 0], "abc"):
            with pytest.raises(hm.InvalidMeshError):
                mesh.split_edge(mesh.edges.indices[0].item(), bad)
            with pytest.raises(hm.InvalidMeshError):
                mesh.split_face(mesh.faces.indices[0].item(), bad)
        assert mesh.n_vertices == n
