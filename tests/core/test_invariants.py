"""The laws of a valid mesh, and that each can fail: one wrong entry, and the law names the element (I1-I5, I8)."""

from __future__ import annotations

import contextlib
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm
from halfmesh.core import invariants
from halfmesh.core.topology import COLUMNS, DELETED, N_DEAD_EDGES, N_DEAD_FACES, N_DEAD_VERTICES, N_EXTERIOR

ZOO = hm.testing.zoo()
PLACES = {N_DEAD_VERTICES: "vertices", N_DEAD_EDGES: "edges", N_DEAD_FACES: "faces", N_EXTERIOR: "exterior halfedges"}


def broken(name, changes):
    """A mesh of the zoo with some entries of its columns overwritten: {(column, index): value}."""
    mesh = ZOO[name].mesh()
    arrays = mesh.topology.__arrays__()
    for (column, index), value in changes.items():
        entries = getattr(arrays, column)
        entries.flags.writeable = True
        entries[index] = value
    return mesh


# Two triangles [0, 1, 2], [2, 1, 3]: halfedges 0 1 2 in face 0, 3 6 8 in face 1, exterior 5 7 9 4 and 1.
def butterfly(changes):
    mesh = hm.Mesh([[0, 1, 2], [2, 1, 3]])
    arrays = mesh.topology.__arrays__()
    for (column, index), value in changes.items():
        getattr(arrays, column)[index] = value
    return mesh


FLAWS = {
    "halfedge_links_in_range": [
        ({("next", 2): 10}, [2]),
        ({("prev", 3): -1}, [3]),
        ({("origin", 4): 4}, [4]),
        ({("face", 0): 2}, [0]),
        ({("face", 0): -2}, [0]),
    ],
    "vertex_halfedge_in_range": [({("vertex_halfedge", 3): 10}, [3]), ({("vertex_halfedge", 2): -2}, [2])],
    "face_halfedge_in_range": [({("face_halfedge", 1): -1}, [1]), ({("face_halfedge", 0): 10}, [0])],
    "edges_live_whole": [({(c, 3): DELETED for c in ("next", "prev", "origin", "face")}, [1])],
    "the_deleted_are_marked_throughout": [
        ({(c, h): DELETED for c in ("next", "prev", "origin") for h in (0, 1)}, [0, 1]),
    ],
    "nothing_alive_refers_to_deleted": [
        ({("vertex_halfedge", 3): DELETED}, [7, 8]),
        ({("face_halfedge", 0): DELETED}, [0, 2, 4]),
    ],
    "prev_undoes_next": [({("next", 0): 4}, [0, 2])],
    "vertex_halfedge_leaves_the_vertex": [({("vertex_halfedge", 3): 5}, [3])],
    "face_halfedge_is_in_the_face": [({("face_halfedge", 1): 0}, [1])],
    "isolated_vertices_have_no_halfedge": [({("vertex_halfedge", 3): -1}, [3])],
    "gaps_are_found_at_once": [({("vertex_halfedge", 0): 0}, [0])],
    "counts_are_true": [({("counts", N_EXTERIOR): 5}, [N_EXTERIOR]), ({("counts", N_DEAD_FACES): 1}, [N_DEAD_FACES])],
}


@pytest.mark.parametrize(("law", "flaw"), [(law, flaw) for law, flaws in FLAWS.items() for flaw in flaws])
def test_a_wrong_entry_is_reported_by_its_law_with_the_element(law, flaw):
    changes, elements = flaw
    with pytest.raises(hm.InvalidMeshError, match=law) as caught:
        butterfly(changes).check()
    assert caught.value.reason == law
    ((_, found),) = caught.value.elements.items()
    assert found.tolist() == elements


def test_a_vertex_whose_halfedge_is_deleted_is_reported():
    mesh = ZOO["islands"].mesh()
    arrays = mesh.topology.__arrays__()
    for column in ("next", "prev", "origin", "face"):
        getattr(arrays, column)[:6] = DELETED
    arrays.face_halfedge[0] = DELETED
    assert reported(mesh) == ("vertex_halfedge_is_alive", [0, 1, 2])
    arrays.vertex_halfedge[:3] = -1
    arrays.face_halfedge[0] = 0
    assert reported(mesh) == ("face_halfedge_is_alive", [0])


def reported(mesh):
    with pytest.raises(hm.InvalidMeshError) as caught:
        mesh.check()
    ((_, found),) = caught.value.elements.items()
    return caught.value.reason, found.tolist()


def relinked(mesh, pairs):
    arrays = mesh.topology.__arrays__()
    for h, after in pairs:
        arrays.next[h], arrays.prev[after] = after, h
    return mesh


def test_a_next_that_starts_elsewhere_is_reported():
    """Two triangles with the last links of their boundaries exchanged."""
    mesh = hm.Mesh([[0, 1, 2], [3, 4, 5]])
    assert reported(relinked(mesh, [(0, 8), (6, 2)])) == ("next_starts_where_this_ends", [0, 6])


def test_a_next_that_leaves_the_face_is_reported():
    """At the shared vertex of a bow tie, face 0 goes on into face 1."""
    mesh = ZOO["bow tie"].mesh()
    assert reported(relinked(mesh, [(4, 6), (10, 0)])) == ("next_stays_in_the_face", [4, 10])


def test_two_rings_at_one_vertex_are_reported():
    """The two gaps of a bow tie, each closed on itself: every link agrees, but half the vertex is out of reach."""
    mesh = ZOO["bow tie"].mesh()
    t = mesh.topology
    exterior = [h for h in range(12) if t.face[h] < 0]
    arriving = [h for h in exterior if t.origin[h ^ 1] == 0]
    crossed = [(a, int(t.next[b])) for a, b in zip(arriving, arriving[::-1], strict=True)]
    assert reported(relinked(mesh, crossed)) == ("one_ring_holds_all_of_a_vertex", [0])


def test_two_loops_of_one_face_are_reported():
    """Two separate triangles that say that they are the same face."""
    mesh = ZOO["two tetrahedra"].mesh()
    arrays = mesh.topology.__arrays__()
    arrays.face[arrays.face == 4] = 0
    arrays.face_halfedge[4] = arrays.face_halfedge[0]
    assert reported(mesh)[0] == "face_halfedge_is_in_the_face"
    arrays.face_halfedge[4] = DELETED
    arrays.counts[N_DEAD_FACES] = 1
    assert reported(mesh) == ("one_loop_holds_all_of_a_face", [0])


def test_every_law_has_been_seen_to_fail():
    here = {*FLAWS, "vertex_halfedge_is_alive", "face_halfedge_is_alive", "next_starts_where_this_ends"}
    here |= {"next_stays_in_the_face", "one_ring_holds_all_of_a_vertex", "one_loop_holds_all_of_a_face"}
    assert {law.__name__ for law in invariants.LAWS} == here


@pytest.mark.parametrize("specimen", ZOO.values(), ids=ZOO)
def test_every_mesh_of_the_zoo_obeys_every_law(specimen):
    """I1-I5, I8."""
    t = specimen.mesh().topology
    assert {law.__name__: law(t).tolist() for law in invariants.LAWS if len(law(t))} == {}


@given(st.sampled_from([s for s in ZOO.values() if s.faces]), st.data())
def test_no_corruption_of_one_entry_goes_unseen_or_hangs(specimen, data):
    """Whatever is written: `check` notices it, unless the mesh is still one that only names another halfedge."""
    mesh = specimen.mesh()
    column = data.draw(st.sampled_from(COLUMNS[:-1]))
    entries = getattr(mesh.topology.__arrays__(), column)
    n = len(getattr(mesh.topology, column))
    place = data.draw(st.integers(0, n - 1))
    before = int(entries[place])
    wild = st.sampled_from([-(2**31), -5, DELETED, -3, -2, -1, n, 2**31 - 1])
    entries[place] = data.draw((wild | st.integers(0, n - 1)).filter(lambda value: value != before))
    try:
        mesh.check()
    except hm.InvalidMeshError:
        return
    assert column in ("vertex_halfedge", "face_halfedge")
    hm.testing.assert_valid(mesh)


@given(st.sampled_from([s for s in ZOO.values() if s.faces]), st.integers(0, 2**32 - 1), st.floats(0, 1))
def test_check_and_handles_end_on_any_garbage(specimen, seed, share):
    """Rule 10: entries overwritten at random, in range or not: nothing hangs, nothing worse than an exception."""
    mesh = specimen.mesh()
    rng = np.random.default_rng(seed)
    for column in COLUMNS[:-1]:
        entries = getattr(mesh.topology.__arrays__(), column)
        hit = rng.random(len(entries)) < share
        entries[hit] = rng.integers(-5 if share > 0.5 else 0, len(mesh.topology.next), hit.sum())
    with_errors(mesh.check)
    for v in range(len(mesh.topology.vertex_halfedge)):
        for word in ("outgoing", "incoming", "neighbors", "edges", "faces"):
            with_errors(lambda v=v, word=word: list(getattr(mesh.vertices[v], word)()))
    for f in range(len(mesh.topology.face_halfedge)):
        for word in ("vertices", "halfedges", "edges", "neighbors"):
            with_errors(lambda f=f, word=word: list(getattr(mesh.faces[f], word)()))
    for u in range(len(mesh.topology.vertex_halfedge)):
        with_errors(lambda u=u: mesh.find_halfedge(u, 0))


@given(st.sampled_from([s for s in ZOO.values() if s.faces]), st.integers(0, 2**32 - 1))
def test_orbit_laws_end_even_by_themselves(specimen, seed):
    """Rings and loops that run into a circle which does not hold their start."""
    mesh = specimen.mesh()
    arrays, rng = mesh.topology.__arrays__(), np.random.default_rng(seed)
    for column in (arrays.next, arrays.prev):
        column[:] = rng.integers(0, len(mesh.topology.next), len(column))
    assert len(invariants.one_ring_holds_all_of_a_vertex(mesh.topology)) <= mesh.n_vertices
    assert len(invariants.one_loop_holds_all_of_a_face(mesh.topology)) <= mesh.n_faces


def with_errors(question):
    with contextlib.suppress(hm.HalfmeshError, IndexError):
        question()


def test_the_laws_are_vectorised_enough_for_a_large_mesh_to_be_checked_at_once():
    """I8 on a grid: halfedges are twice the edges, interior ones the sum of the face degrees."""
    n = 60
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    mesh = hm.Mesh(np.c_[a, a + 1, a + n + 2, a + n + 1])
    mesh.check()
    assert mesh.n_halfedges == 2 * mesh.n_edges
    assert mesh.n_interior_halfedges == mesh.face_degrees().sum() == 4 * n * n


def test_the_exception_survives_pickling_with_its_elements():
    with pytest.raises(hm.InvalidMeshError) as caught:
        butterfly({("next", 2): 10}).check()
    again = pickle.loads(pickle.dumps(caught.value))
    assert (again.reason, again.elements["halfedges"].tolist()) == ("halfedge_links_in_range", [2])
