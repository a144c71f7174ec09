"""Components and whole meshes: turned around, removed, appended, taken out."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.testing import assert_valid, zoo

ZOO = zoo()
TABLES = ("vertex_data", "halfedge_data", "edge_data", "face_data")
every_mesh = pytest.mark.parametrize("name", ZOO)


def columns(mesh):
    names = ("next", "prev", "origin", "face", "vertex_halfedge", "face_halfedge")
    return {name: getattr(mesh.topology, name).tolist() for name in names}


def rows(mesh):
    indices, offsets = mesh.face_vertices()
    return [indices[a:b].tolist() for a, b in itertools.pairwise(offsets)]


def labelled(mesh):
    """The mesh with a number on every element."""
    for table in TABLES:
        label = getattr(mesh, table).add("label", int, default=-7)
        label[:] = np.arange(len(label))
    return mesh


def values(mesh):
    return {table: {name: a.tolist() for name, a in getattr(mesh, table).items()} for table in TABLES}


def worn(name):
    """A specimen from which a face and a vertex were removed."""
    mesh = labelled(ZOO[name].mesh())
    if mesh.n_faces:
        mesh.remove_face(0)
    if mesh.n_vertices:
        mesh.remove_vertex(mesh.n_vertices - 1)
    return mesh


# -- turned around -----------------------------------------------------------------------------------------------------


@every_mesh
def test_reversing_twice_is_the_identity(name):
    mesh = labelled(ZOO[name].mesh())
    before = columns(mesh), values(mesh)
    mesh.reverse()
    assert_valid(mesh)
    mesh.reverse()
    assert (columns(mesh), values(mesh)) == before


@every_mesh
def test_faces_are_read_backwards_from_the_same_corner(name):
    mesh = worn(name)
    before = rows(mesh)
    mesh.reverse()
    assert_valid(mesh)
    assert rows(mesh) == [face[:1] + face[:0:-1] for face in before]


@every_mesh
def test_corner_data_stay_with_their_corners(name):
    """A corner is known by its vertex and face, and the vertices before and after it: these change their parts."""
    mesh = labelled(ZOO[name].mesh())

    def corners(turned):
        t, label = mesh.topology, mesh.halfedge_data["label"]
        n = len(t.next)
        before, after = t.origin[t.prev], t.origin[t.next]
        neighbors = (after, before) if turned else (before, after)
        return sorted(zip(*(a.tolist() for a in (t.origin, t.face, *neighbors, label)), range(n), strict=True))

    known = [key[:-1] for key in corners(False)]
    mesh.reverse()
    assert [key[:-1] for key in corners(True)] == known


@every_mesh
def test_reversing_each_component_reverses_all(name):
    mesh, other = ZOO[name].mesh(), ZOO[name].mesh()
    other.reverse()
    for v in np.unique(mesh.components().vertex_component, return_index=True)[1].tolist():
        mesh.reverse_component(v)
        assert_valid(mesh)
    assert columns(mesh) == columns(other)


def test_reversing_a_component_leaves_the_others():
    mesh = hm.Mesh([[0, 1, 2], [3, 4, 5, 6], [2, 1, 7]])
    mesh.reverse_component(mesh.vertices[7])
    assert rows(mesh) == [[0, 2, 1], [3, 4, 5, 6], [2, 7, 1]]


def test_volume_changes_its_sign():
    mesh = hm.shapes.icosphere(1)
    volume = hm.geometry.volume(mesh)
    mesh.reverse()
    assert hm.geometry.volume(mesh) == pytest.approx(-volume)


def test_corner_data_follow_whatever_their_policy():
    mesh = hm.Mesh([[0, 1, 2, 3]])
    for policy in ("lerp", "sum", "copy", lambda values, weights: 1 / 0):
        mesh.halfedge_data.add("u", float, policy=policy)[:] = mesh.topology.origin + 10.0 * mesh.topology.face
        mesh.reverse()
        assert mesh.halfedge_data["u"].tolist() == (mesh.topology.origin + 10.0 * mesh.topology.face).tolist()
        del mesh.halfedge_data["u"]


# -- taken away --------------------------------------------------------------------------------------------------------


@every_mesh
def test_components_go_one_by_one(name):
    mesh = ZOO[name].mesh()
    for n in range(mesh.n_connected_components, 0, -1):
        assert mesh.n_connected_components == n
        v = next(iter(mesh.vertices))
        of = mesh.components()
        euler = of.euler_characteristic[of.vertex_component[v.index]]
        before = mesh.euler_characteristic
        mesh.remove_component(v)
        assert_valid(mesh)
        assert mesh.euler_characteristic == before - euler
    assert (mesh.n_vertices, mesh.n_edges, mesh.n_faces, mesh.n_exterior_halfedges) == (0, 0, 0, 0)


def test_removing_a_component_leaves_the_others_as_they_are():
    mesh = hm.Mesh([[0, 1, 2], [3, 4, 5], [6, 7, 8]], edges=[[5, 9]])
    mesh.remove_component(9)
    assert [f.index for f in mesh.faces] == [0, 2]
    mesh.compact()
    assert columns(mesh) == columns(hm.Mesh([[0, 1, 2], [3, 4, 5]]))


def test_gone_and_missing_vertices_are_refused():
    mesh = hm.Mesh([[0, 1, 2]], n_vertices=4)
    v = mesh.vertices[3]
    mesh.remove_component(v)
    before = columns(mesh)
    for act in (mesh.remove_component, mesh.reverse_component):
        with pytest.raises(hm.StaleElementError, match="vertex 3"):
            act(v)
        for wrong in (4, -1, hm.Mesh([[0, 1, 2]]).vertices[0], mesh.faces[0], 1.5):
            with pytest.raises(hm.ElementError):
                act(wrong)
    assert columns(mesh) == before


# -- put together ------------------------------------------------------------------------------------------------------


@every_mesh
def test_what_was_appended_can_be_taken_out_again(name):
    mesh, other = labelled(hm.shapes.cube()), labelled(ZOO[name].mesh())
    first = mesh.copy()
    maps = mesh.append(other)
    assert_valid(mesh)
    assert mesh.euler_characteristic == first.euler_characteristic + other.euler_characteristic
    assert mesh.n_connected_components == 1 + other.n_connected_components
    for part, vertices in ((other, maps.vertices), (first, np.arange(8))):
        out, _ = mesh.submesh(vertices=vertices)
        assert (columns(out), values(out)) == (columns(part), values(part))


@every_mesh
def test_appended_deleted_elements_stay_deleted(name):
    mesh, other = hm.shapes.tetrahedron(), worn(name)
    maps = mesh.append(other)
    assert_valid(mesh)
    assert (mesh.n_vertices, mesh.n_edges, mesh.n_faces) == (4 + other.n_vertices, 6 + other.n_edges, 4 + other.n_faces)
    for kind, offset in (("vertices", 4), ("halfedges", 12), ("edges", 6), ("faces", 4)):
        alive, of = getattr(other, kind).indices, getattr(maps, kind)
        assert of.dtype == np.int32
        assert np.flatnonzero(of >= 0).tolist() == alive.tolist()
        assert of[alive].tolist() == (alive + offset).tolist()


def test_a_mesh_may_be_appended_to_itself():
    mesh = labelled(hm.shapes.cube())
    maps = mesh.append(mesh)
    assert_valid(mesh)
    assert maps.faces.tolist() == [6, 7, 8, 9, 10, 11]
    assert mesh.face_data["label"].tolist() == 2 * list(range(6))


def test_attributes_are_united():
    mesh, other = hm.Mesh([[0, 1, 2]]), hm.Mesh([[0, 1, 2], [2, 1, 3]], [[0, 0], [1, 0], [0, 1], [1, 1]])
    mesh.face_data.add("both", int, default=5, policy="max")
    other.face_data.add("both", int, default=6, policy="min")[:] = [1, 2]
    mesh.face_data.add("mine", np.float32, (2,), default=0.5)
    other.face_data.add("theirs", np.uint8, default=9, policy="first")[:] = [3, 4]
    other.meta["groups"] = ["a"]
    mesh.append(other)
    assert mesh.has_points
    assert mesh.points.tolist() == [[0, 0, 0]] * 3 + other.points.tolist()
    assert {name: a.tolist() for name, a in mesh.face_data.items()} == {
        "both": [5, 1, 2],
        "mine": [[0.5, 0.5]] * 3,
        "theirs": [9, 3, 4],
    }
    assert mesh.face_data["theirs"].dtype == np.uint8
    assert mesh.face_data.policies == {"both": "max", "mine": "lerp", "theirs": "first"}
    assert mesh.meta == {"groups": ["a"]}
    assert mesh.meta["groups"] is not other.meta["groups"]


def test_an_attribute_of_another_kind_is_refused_before_anything_changes():
    for shape, dtype in (((), float), ((2,), int)):
        mesh, other = hm.shapes.cube(), hm.shapes.cube()
        mesh.edge_data.add("crease", int)
        other.vertex_data.add("new", int)
        other.edge_data.add("crease", dtype, shape)
        before = columns(mesh), values(mesh)
        with pytest.raises(hm.InvalidMeshError, match="'crease'") as refusal:
            mesh.append(other)
        assert refusal.value.reason == "bad_attribute"
        assert (columns(mesh), values(mesh)) == before


def test_handles_stay_when_a_mesh_is_appended():
    mesh = hm.shapes.cube()
    v = mesh.vertices[0]
    mesh.append(hm.shapes.icosphere(2))
    assert v.degree == 3
    assert mesh.vertices[8].degree == 5


# -- taken out ---------------------------------------------------------------------------------------------------------


@every_mesh
def test_all_of_a_mesh_is_a_copy(name):
    mesh = labelled(ZOO[name].mesh())
    out, maps = mesh.submesh(vertices=mesh.vertices)
    assert (columns(out), values(out)) == (columns(mesh), values(mesh))
    assert maps.halfedges.tolist() == list(range(mesh.n_halfedges))
    out.points[:] = 5  # and shares nothing with it
    assert not (mesh.points == 5).any()


@every_mesh
def test_what_vertices_span_is_what_is_left_without_the_others(name):
    mesh = labelled(ZOO[name].mesh())
    chosen = [v for v in range(mesh.n_vertices) if v % 3]
    out, maps = mesh.submesh(vertices=chosen)
    assert_valid(out)
    other = mesh.copy()
    for v in range(0, mesh.n_vertices, 3):
        other.remove_vertex(v)
    theirs = other.compact()
    for kind in ("vertices", "halfedges", "edges", "faces"):
        assert np.array_equal(getattr(maps, kind), getattr(theirs, kind))
    left, right = columns(out), columns(other)
    assert {k: left[k] for k in ("next", "prev", "origin", "face")} == {
        k: right[k] for k in ("next", "prev", "origin", "face")
    }
    assert values(out) == values(other)


@every_mesh
def test_faces_come_with_their_edges_and_vertices(name):
    mesh = worn(name)
    chosen = mesh.faces.indices[::2]
    out, maps = mesh.submesh(chosen)
    assert_valid(out)
    assert out.n_faces == len(chosen)
    assert out.n_isolated_vertices == 0
    for f in chosen.tolist():
        assert [v.index for v in out.faces[maps.faces[f]].vertices()] == [
            maps.vertices[v.index] for v in mesh.faces[f].vertices()
        ]
    for table, of in zip(TABLES, (maps.vertices, maps.halfedges, maps.edges, maps.faces), strict=True):
        kept = np.flatnonzero(of >= 0)
        assert getattr(out, table)["label"].tolist() == getattr(mesh, table)["label"][kept].tolist()


@every_mesh
def test_around_each_vertex_the_order_is_kept(name):
    mesh = ZOO[name].mesh()
    out, maps = mesh.submesh(mesh.faces.indices[1:])
    old_of_new = np.flatnonzero(maps.halfedges >= 0)
    for v in out.vertices:
        ring = [old_of_new[h.index] for h in v.outgoing()]
        whole = [h.index for h in mesh.halfedges[int(ring[0])].origin.outgoing() if maps.halfedges[h.index] >= 0]
        turned = whole.index(ring[0])
        assert ring == whole[turned:] + whole[:turned]


def test_parts_may_be_named_in_many_ways():
    mesh = hm.shapes.cube()
    mask = np.arange(6) % 2 == 0
    expected = columns(mesh.submesh([0, 2, 4])[0])
    for faces in (
        (4, 2, 0, 2),
        mask,
        np.array([0, 2, 4], np.uint8),
        [mesh.faces[f] for f in (0, 2, 4)],
        iter([0, 2, 4]),
    ):
        assert columns(mesh.submesh(faces)[0]) == expected


def test_a_part_may_be_empty():
    mesh = hm.shapes.cube()
    for out, maps in (mesh.submesh([]), mesh.submesh(np.zeros(0)), mesh.submesh(vertices=[])):
        assert_valid(out)
        assert out.n_vertices == 0
        assert maps.faces.tolist() == [-1] * 6


def test_a_mask_may_be_true_of_the_deleted_but_no_index():
    mesh = hm.shapes.cube()
    mesh.remove_face(2)
    assert mesh.submesh(np.ones(6, bool))[0].n_faces == 5
    with pytest.raises(hm.StaleElementError, match="face 2"):
        mesh.submesh([1, 2])


def test_what_is_no_part_is_refused():
    mesh = hm.shapes.cube()
    for wrong in ([6], [-1], [0.5], np.array([1.0]), np.ones(5, bool), [mesh.vertices[0]], [hm.shapes.cube().faces[0]]):
        with pytest.raises(hm.ElementError):
            mesh.submesh(wrong)
    with pytest.raises(TypeError):
        mesh.submesh()
    with pytest.raises(TypeError):
        mesh.submesh([0], vertices=[0])


def test_what_a_mesh_knows_comes_with_a_part():
    mesh = hm.shapes.cube()
    mesh.face_data.add("label", int, default=4, policy="min")
    mesh.meta["note"] = ["x"]
    out, _ = mesh.submesh([0])
    assert out.has_points
    assert out.meta == {"note": ["x"]}
    assert out.meta["note"] is not mesh.meta["note"]
    assert out.face_data.policies["label"] == "min"
    assert out.face_data.column("label").default.tolist() == [4]
    assert out.split_face(0).degree == 4
    assert_valid(out)
