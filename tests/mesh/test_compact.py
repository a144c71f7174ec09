"""Compaction: what was deleted goes, everything else keeps its order, its links and its attributes."""

from __future__ import annotations

import random

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.testing import assert_valid, zoo

ZOO = zoo()


def worn(name):
    """A specimen from which a few things were deleted."""
    mesh, rng = ZOO[name].mesh(), random.Random(name)
    for table, collection in (
        (mesh.vertex_data, mesh.vertices),
        (mesh.halfedge_data, mesh.halfedges),
        (mesh.edge_data, mesh.edges),
        (mesh.face_data, mesh.faces),
    ):
        table.add("was", np.int64, default=-5, policy="copy")
        if len(collection):
            table["was"][:] = np.arange(len(table["was"]))
    for h in rng.sample(mesh.halfedges.indices.tolist(), min(6, mesh.n_halfedges)):
        if h in mesh.halfedges and mesh.can_collapse(h):
            mesh.collapse(h)
    for e in rng.sample(mesh.edges.indices.tolist(), min(3, mesh.n_edges)):
        if e in mesh.edges and mesh.can_join_faces(e):
            mesh.join_faces(e)
    return mesh


@pytest.mark.parametrize("name", ZOO)
def test_compacted_mesh_is_the_same_mesh(name):
    mesh = worn(name)
    old, summary = mesh.copy(), mesh.summary()
    maps = mesh.compact()
    assert_valid(mesh)
    assert mesh.summary().as_dict() | {"attribute_bytes": 0, "topology_bytes": 0} == summary.as_dict() | {
        "attribute_bytes": 0,
        "topology_bytes": 0,
    }
    t, o = mesh.topology, old.topology
    h, v, f = old.halfedges.indices, old.vertices.indices, old.faces.indices
    for column in ("next", "prev"):
        assert np.array_equal(getattr(t, column), maps.halfedges[getattr(o, column)[h]])
    assert np.array_equal(t.origin, maps.vertices[o.origin[h]])
    assert np.array_equal(t.face, np.where(o.face[h] >= 0, np.r_[maps.faces, -1][o.face[h]], -1))
    assert np.array_equal(t.face_halfedge, maps.halfedges[o.face_halfedge[f]])
    assert np.array_equal(mesh.points, old.points[v])
    assert (len(t.next), len(t.vertex_halfedge), len(t.face_halfedge)) == (len(h), len(v), len(f))


@pytest.mark.parametrize("name", ZOO)
def test_maps_lead_from_old_indices_to_new(name):
    mesh = worn(name)
    living = {kind: getattr(mesh, kind).indices for kind in ("vertices", "halfedges", "edges", "faces")}
    maps = mesh.compact()
    for kind, indices in living.items():
        new = getattr(maps, kind)
        assert new.dtype == np.int32
        assert np.array_equal(np.flatnonzero(new >= 0), indices)
        assert np.array_equal(new[indices], np.arange(len(indices)))
        assert np.array_equal(getattr(mesh, kind).indices, np.arange(len(indices)))


def test_attributes_keep_their_rows_policies_and_defaults():
    mesh = hm.shapes.cube()
    mesh.face_data.add("label", int, default=9, policy="max")[:] = np.arange(6)
    mesh.join_faces(0)
    alive = mesh.faces.indices
    expected = mesh.face_data["label"][alive].tolist()
    mesh.compact()
    assert mesh.face_data["label"].tolist() == expected
    assert mesh.face_data.policies["label"] == "max"
    assert mesh.face_data.column("label").default.tolist() == [9]


def test_handles_from_before_are_stale_and_say_so():
    mesh = hm.shapes.cube()
    v, h, e, f = mesh.vertices[0], mesh.halfedges[3], mesh.edges[2], mesh.faces[1]
    mesh.join_faces(0)
    mesh.compact()
    for handle in (v, h, e, f):
        assert not handle.is_alive
        with pytest.raises(hm.StaleElementError):
            handle.halfedge if handle is not h else handle.next  # noqa: B018 - the step is the test
    for act, handle in ((mesh.flip, e), (mesh.split_face, f), (mesh.collapse, h)):
        with pytest.raises(hm.StaleElementError):
            act(handle)
    assert v != mesh.vertices[0]
    assert v not in mesh.vertices
    assert mesh.vertices[0].degree >= 2


def test_nothing_happens_where_nothing_was_deleted():
    mesh = hm.shapes.cube()
    v, revision, points = mesh.vertices[0], mesh.revision, mesh.points
    maps = mesh.compact()
    assert maps.vertices.tolist() == list(range(8))
    assert mesh.revision == revision
    assert v.degree == 3
    assert np.shares_memory(points, mesh.points)


def test_mesh_goes_on_changing_after_compaction():
    mesh = hm.shapes.icosphere(1)
    for _ in range(5):
        h = next(h for h in mesh.halfedges if mesh.can_collapse(h))
        mesh.collapse(h)
        mesh.compact()
        mesh.split_face(0)
        assert_valid(mesh)
    assert mesh.euler_characteristic == 2


def test_everything_may_have_been_deleted():
    mesh = hm.Mesh([], n_vertices=2, edges=[[0, 1]])
    mesh.collapse(0)
    mesh.compact()
    assert_valid(mesh)
    assert (mesh.n_vertices, mesh.n_edges) == (1, 0)
