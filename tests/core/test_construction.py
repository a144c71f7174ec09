"""Face lists become columns: the same as those of the slow twin in `reference`, element for element (D1-D7, M3)."""

from __future__ import annotations

import contextlib
import itertools

import numpy as np
import pytest
from hypothesis import event, given
from hypothesis import strategies as st

import halfmesh as hm
from halfmesh.core import matching
from halfmesh.core.topology import COLUMNS
from reference import Reference, Refused
from soups import meshes_or_not, pieces

ZOO = hm.testing.zoo()


def columns(mesh):
    return {name: getattr(mesh.topology, name).tolist() for name in COLUMNS[:-1]}


def twin_of(specimen):
    return Reference(specimen.faces, specimen.figures.n_vertices, specimen.twins, specimen.edges)


def held_or_refused(*args, **kwargs):
    try:
        return Reference(*args, **kwargs), None
    except Refused as refused:
        return None, refused


def rows(ragged):
    indices, offsets = ragged
    return [part.tolist() for part in np.split(indices, offsets[1:-1])] if len(offsets) > 1 else []


@pytest.mark.parametrize("specimen", ZOO.values(), ids=ZOO)
def test_columns_of_the_zoo_are_those_of_the_slow_twin(specimen):
    """D1-D6, R1-R8, R11."""
    assert columns(specimen.mesh()) == twin_of(specimen).columns()


@pytest.mark.parametrize("specimen", ZOO.values(), ids=ZOO)
def test_figures_of_the_zoo_are_true(specimen):
    """C1-C3; the figures are checked against the slow twin too, so that they aren't what the library happens to say."""
    specimen.figures.assert_of(specimen.mesh())
    twin = twin_of(specimen)
    parts = twin.components()
    assert specimen.figures == hm.testing.Figures(
        twin.n_vertices,
        twin.n_darts // 2,
        len(twin.faces),
        len(twin.boundary_loops()),
        len(parts),
        sum(map(twin.genus, parts)),
        sum(not ring for ring in twin.ring),
    )


@given(meshes_or_not())
def test_random_faces_are_accepted_or_refused_exactly_as_by_the_slow_twin(soup):
    """D1-D6, I1-I5, R8, N1-N3, N5: the same columns, or the same reason with all the same elements."""
    faces, n = soup
    twin, refused = held_or_refused(faces, n)
    if refused:
        event(refused.reason)
        with pytest.raises(hm.InvalidMeshError) as caught:
            hm.Mesh(faces, n_vertices=n)
        assert caught.value.reason == refused.reason
        found = {kind: as_set(caught.value.elements[kind]) for kind in refused.elements}
        assert found == refused.elements
    else:
        event("held")
        mesh = hm.Mesh(faces, n_vertices=n)
        assert columns(mesh) == twin.columns()
        hm.testing.assert_valid(mesh)


@contextlib.contextmanager
def in_small_pieces():
    """Cut even the smallest face list into several parts and blocks, as large ones are."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HALFMESH_NUM_THREADS", "3")
        patch.setattr(matching, "_PART", 1)
        patch.setattr(matching, "_MOST_BITS", 1)
        yield


@given(soup=meshes_or_not())
def test_parts_and_blocks_change_nothing(soup):
    """Large inputs are cut into parts for threads and blocks for the cache: the result is that of the twin still."""
    faces, n = soup
    twin, refused = held_or_refused(faces, n)
    with in_small_pieces():
        if refused:
            with pytest.raises(hm.InvalidMeshError):
                hm.Mesh(faces, n_vertices=n)
        else:
            assert columns(hm.Mesh(faces, n_vertices=n)) == twin.columns()


def as_set(elements):
    return {tuple(row) for row in elements.tolist()} if elements.ndim == 2 else set(elements.tolist())


@given(pieces())
def test_face_vertices_gives_the_input_back(soup):
    """D7, O12: no face is reordered or turned, whatever the degrees."""
    faces, n = soup
    try:
        mesh = hm.Mesh(faces, n_vertices=n)
    except hm.InvalidMeshError:
        return
    assert rows(mesh.face_vertices()) == faces


@given(pieces(), st.data())
def test_wire_goes_where_the_slow_twin_puts_it(soup, data):
    """R4, R6: or is refused where faces close the vertex (N4)."""
    faces, n = soup
    vertex = st.integers(0, n - 1)
    plain, refused = held_or_refused(faces, n)
    if refused:
        return
    joined = {frozenset((u, v)) for u, v in zip(plain.origin[::2], plain.origin[1::2], strict=True)}
    new = [
        tuple(p) for p in {frozenset(p) for p in data.draw(st.lists(st.tuples(vertex, vertex), max_size=4))} - joined
    ]
    wire = sorted(p for p in new if len(p) == 2)
    twin, refused = held_or_refused(faces, n, edges=wire)
    if refused:
        with pytest.raises(hm.InvalidMeshError) as caught:
            hm.Mesh(faces, n_vertices=n, edges=wire)
        closed = {(u, v) for u, v in wire if any(plain.ring[x] and not plain.touches_gap(x) for x in (u, v))}
        assert (caught.value.reason, as_set(caught.value.elements["edges"])) == (refused.reason, closed)
    else:
        mesh = hm.Mesh(faces, n_vertices=n, edges=wire)
        assert columns(mesh) == twin.columns()
        hm.testing.assert_valid(mesh)


# ---------------------------------------------------------------------------------------------------------- each fact


def test_an_edge_is_a_pair_of_halfedges_numbered_by_first_appearance():
    """D4, M3, I2: 2e runs as the edge was first listed."""
    mesh = hm.Mesh([[0, 1, 2], [2, 1, 3]])
    assert mesh.edge_vertices().tolist() == [[0, 1], [1, 2], [2, 0], [1, 3], [3, 2]]


def test_columns_are_int32_16_bytes_a_halfedge_4_a_vertex_4_a_face():
    """D3, D7."""
    t = ZOO["torus"].mesh().topology
    assert {getattr(t, name).dtype for name in COLUMNS[:-1]} == {np.dtype(np.int32)}
    assert t.nbytes == 16 * 48 + 4 * 12 + 4 * 12


def test_several_fans_at_a_vertex_stand_in_the_order_of_their_lowest_faces():
    """R8: faces are 1 (fan a), 0 (fan b), 2 (fan c); the ring runs b, a, c and ends at the gap after c."""
    mesh = hm.Mesh([[0, 1, 2], [0, 3, 4], [0, 5, 6]])
    assert [v.index for v in mesh.vertices[0].neighbors()] == [1, 2, 3, 4, 5, 6]
    assert mesh.vertices[0].halfedge == mesh.find_halfedge(0, 6)


def test_the_halfedge_of_a_boundary_vertex_is_exterior_and_the_ring_starts_after_it():
    """I3, rule 4: at once in O(1), and the wedge of faces is contiguous."""
    mesh = ZOO["quads"].mesh()
    for v in mesh.vertices:
        if v.is_boundary:
            ring = list(v.outgoing())
            assert ring[-1] == v.halfedge
            assert [h.is_exterior for h in ring] == [False] * (len(ring) - 1) + [True]


def test_the_exterior_halfedges_run_against_the_faces():
    """I4, I5: along the boundary the hole is on the left."""
    mesh = hm.Mesh([[0, 1, 2]])
    (loop,) = mesh.boundary_loops()
    assert mesh.topology.origin[loop].tolist() == [1, 0, 2]


def test_the_slit_and_the_face_through_a_vertex_twice_are_held():
    """R7: an edge passed once each way by one face has that face on both sides."""
    mesh = ZOO["needle"].mesh()
    assert mesh.edge_faces().tolist() == [[0, 0], [0, 0]]
    assert ZOO["face through a vertex twice"].mesh().n_boundary_loops == 2


def test_isolated_vertices_keep_their_indices():
    """R5, N5."""
    mesh = hm.Mesh([[1, 3, 5]], n_vertices=7)
    assert [v.index for v in mesh.vertices if v.is_isolated] == [0, 2, 4, 6]


def test_topology_does_not_depend_on_positions():
    """R11."""
    flat, folded = (hm.Mesh([[0, 1, 2], [2, 1, 3]], points) for points in (np.zeros((4, 3)), np.full((4, 3), np.nan)))
    assert columns(flat) == columns(folded)


# --------------------------------------------------------------------------------------------------------------- twins


def test_explicit_twins_of_a_plain_mesh_change_nothing():
    """O9."""
    for specimen in (s for s in ZOO.values() if s.faces and s.twins is None and not s.edges):
        halfedges = specimen.mesh().corner_halfedges()
        corner = {h: c for c, h in enumerate(halfedges.tolist())}
        twins = [corner.get(h ^ 1, -1) for h in halfedges.tolist()]
        given_twins = hm.Mesh(specimen.faces, n_vertices=specimen.figures.n_vertices, twins=twins)
        assert columns(given_twins) == columns(specimen.mesh()), specimen.name


@given(st.lists(st.sampled_from([3, 4, 5]), min_size=1, max_size=3), st.data())
def test_random_gluings_of_polygons_agree_with_the_slow_twin(degrees, data):
    """R1, R2, R9: sides of polygons joined at random give loop edges, parallel edges, pinched vertices."""
    n = sum(degrees)
    sides = data.draw(st.permutations(range(n)))
    n_glued = data.draw(st.integers(0, n // 2))
    twins = [-1] * n
    for a, b in zip(sides[:n_glued], sides[n_glued : 2 * n_glued], strict=True):
        twins[a], twins[b] = b, a
    faces, n_vertices = glued(degrees, twins)
    for a, b in data.draw(st.lists(st.tuples(*[st.integers(0, n_vertices - 1)] * 2), max_size=2)):
        faces = [[b if v == a else v for v in face] for face in faces]
    twin, refused = held_or_refused(faces, n_vertices, twins)
    if refused:
        with pytest.raises(hm.InvalidMeshError) as caught:
            hm.Mesh(faces, n_vertices=n_vertices, twins=twins)
        assert as_set(caught.value.elements["vertices"]) == refused.elements["vertices"]
    else:
        mesh = hm.Mesh(faces, n_vertices=n_vertices, twins=twins)
        assert columns(mesh) == twin.columns()
        hm.testing.assert_valid(mesh)


def glued(degrees, twins):
    """Faces whose corners are named alike exactly where the twins make them one vertex."""
    begins = np.cumsum([0, *degrees]).tolist()
    after = [begins[f] + (k + 1) % d for f, d in enumerate(degrees) for k in range(d)]
    name = list(range(begins[-1]))
    for _ in name:
        for a, b in enumerate(twins):
            if b >= 0:
                name[a] = name[after[b]] = min(name[a], name[after[b]])
    number = {v: i for i, v in enumerate(sorted(set(name)))}
    flat = [number[v] for v in name]
    return [flat[a:b] for a, b in itertools.pairwise(begins)], len(number)


@pytest.mark.parametrize(
    ("twins", "wrong"),
    [
        ([-1, 3, -1, 9, -1, -1], [3]),
        ([-1, 3, -1, -2, -1, -1], [3]),
        ([0, 3, -1, 1, -1, -1], [0]),
        ([-1, 3, -1, -1, -1, -1], [1]),
        ([4, 3, -1, 1, 0, -1], [0, 4]),
        ([2**32 - 1, 3, -1, 1, -1, -1], [0]),
    ],
    ids=["no such corner", "negative", "itself", "one-sided", "other vertices", "not an int32"],
)
def test_wrong_twins_are_refused_with_their_corners(twins, wrong):
    """O9: wherever they point."""
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh([[0, 1, 2], [2, 1, 3]], twins=twins)
    assert caught.value.reason == "bad_twins"
    assert caught.value.elements["corners"].tolist() == wrong


def test_twins_may_have_the_shape_of_the_faces():
    mesh = hm.Mesh([[0, 1, 2], [2, 1, 3, 4]], twins=[[-1, 3, -1], [1, -1, -1, -1]])
    assert mesh.n_edges == 6
