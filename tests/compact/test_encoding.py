"""M4: the compact mesh is the mesh, and takes less than five bits for each edge."""

from __future__ import annotations

import random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from isomorphism import assert_alike, encoded
from mullin import from_symbols, from_text, random_symbols

import halfmesh as hm
from halfmesh.compact.decoding import decoded
from halfmesh.compact.encoding import compacted, maps_of
from halfmesh.core.invariants import check
from halfmesh.core.topology import COLUMNS
from soups import meshes_or_not
from wandering import wander

ZOO = hm.testing.zoo()
FLAT = {name: specimen for name, specimen in ZOO.items() if specimen.figures.genus == 0}
every_flat_mesh = pytest.mark.parametrize("specimen", FLAT.values(), ids=FLAT)


def shuffled(faces, rng):
    """The same faces in another order, over other numbers."""
    faces = np.asarray(faces)
    return rng.permutation(faces.max() + 1)[faces[rng.permutation(len(faces))]]


def with_holes(mesh, rng, share):
    """The mesh without some of its faces, which are not compacted away."""
    for f in rng.permutation(mesh.n_faces)[: int(share * mesh.n_faces)].tolist():
        mesh.remove_face(f)
    return mesh


# -- alike -------------------------------------------------------------------------------------------------------------


@every_flat_mesh
def test_every_rule_says_of_every_element_what_it_says_of_the_mesh(specimen):
    encoded(specimen.mesh().topology)


@pytest.mark.parametrize("seed", range(4))
def test_grids_with_holes_and_deleted_elements(seed):
    rng = np.random.default_rng(seed)
    mesh = with_holes(hm.shapes.grid(9, 7), rng, 0.1 + 0.2 * seed)
    mesh.remove_vertex(20)
    mesh.add_vertex()
    encoded(mesh.topology)


def test_islands_of_all_sorts_at_once():
    """Closed ones, some with holes, wire, loops, and isolated vertices between them."""
    mesh = hm.Mesh([])
    for specimen in FLAT.values():
        mesh.append(specimen.mesh())
        mesh.add_vertex()
    encoded(mesh.topology)


def test_loops_and_parallel_edges():
    mesh = hm.Mesh([[0, 1, 2]], n_vertices=5)
    for u, v in ((0, 0), (0, 1), (1, 1), (3, 3), (3, 3), (3, 4), (2, 3)):
        mesh.add_edge(u, v)
    assert mesh.genus == 0
    encoded(mesh.topology)


@pytest.mark.parametrize("seed", range(6))
def test_random_planar_maps(seed):
    """Loops, parallel edges, vertices and faces of degree one: any tour, as columns."""
    rng = np.random.default_rng(seed)
    t = decoded(from_symbols(*random_symbols(rng, 400, rng.random(), depth=0.5)))
    check(t)
    encoded(t)


@given(start=meshes_or_not(), seed=st.integers(0, 10**6), n=st.integers(0, 40))
def test_whatever_the_operators_make(start, seed, n):
    """Walks over odd maps; where they come to a handle, it is refused."""
    try:
        faces, n_vertices = start
        mesh = hm.Mesh(faces, n_vertices=n_vertices)
    except hm.InvalidMeshError:
        mesh = hm.Mesh([[0, 1, 2, 3]])
    wander(mesh, random.Random(seed), n)
    if mesh.genus:
        with pytest.raises(hm.PreconditionError):
            compacted(mesh.topology)
    else:
        check(decoded(encoded(mesh.topology)))


@pytest.mark.large
@pytest.mark.parametrize("order", ["coherent", "shuffled"])
@pytest.mark.parametrize("share", [0.0, 0.02, 0.4])
def test_large_grids(order, share):
    rng = np.random.default_rng(3)
    faces = np.concatenate(hm.shapes.grid(150, 120).face_vertices()[0].reshape(-1, 4)[:, [[0, 1, 2], [0, 2, 3]]])
    encoded(with_holes(hm.Mesh(shuffled(faces, rng) if order == "shuffled" else faces), rng, share).topology)


@pytest.mark.large
def test_many_components():
    triangles = np.arange(90_000).reshape(-1, 3)
    encoded(hm.Mesh(triangles).topology)


@pytest.mark.large
@pytest.mark.parametrize("n", [100_000])
def test_star_and_path_of_wire(n):
    """One parenthesis around all, and as deep as can be."""
    for edges in ([(0, i) for i in range(1, n)], [(i, i + 1) for i in range(n - 1)]):
        encoded(hm.Mesh([], edges=edges, n_vertices=n).topology)


@pytest.mark.large
def test_fan_and_bipyramid():
    n = 100_000
    rim = np.arange(n)
    fan = np.stack([rim, np.roll(rim, -1), np.full(n, n)], axis=1)
    for faces in (fan, fan[:-1], np.concatenate([fan, fan[:, [1, 0, 2]] + [0, 0, 1]])):
        encoded(hm.Mesh(faces).topology)


# -- back --------------------------------------------------------------------------------------------------------------


@every_flat_mesh
def test_back_in_columns_it_is_valid_and_the_same(specimen):
    t = specimen.mesh().topology
    made = compacted(t)
    back = decoded(made.topology)
    check(back)
    maps = maps_of(t, made)
    assert np.array_equal(maps.faces[t.face[t.face >= 0]], back.face[number(maps, back)][t.face >= 0])
    assert np.array_equal(maps.vertices[t.origin], back.origin[number(maps, back)])
    assert np.array_equal(number(maps, back)[t.next], back.next[number(maps, back)])


def number(maps, back):
    """The halfedge of the decoded mesh that each old one is: of edge e, in the order of the tour."""
    h, of_pair = maps.halfedges, maps.halfedges.reshape(-1, 2)
    return 2 * maps.edges.repeat(2) + (h > of_pair.min(axis=1).repeat(2)) if len(h) else h


@every_flat_mesh
def test_encoding_what_was_decoded_gives_the_same_figures(specimen):
    once = compacted(specimen.mesh().topology).topology
    twice = compacted(decoded(once)).topology
    assert repr(once) == repr(twice)


def test_the_text_of_a_small_mesh():
    """The tour of a triangle, from outside along its boundary: two tree edges, then the one that is left."""
    t = compacted(hm.Mesh([[0, 1, 2]]).topology).topology
    assert text(t) == "(([))]"
    assert text(from_text("([)]")) == "([)]"


def text(t):
    from halfmesh.compact.parentheses import is_opening, is_tree

    return "".join("])[("[2 * is_opening(t, i) + is_tree(t, i)] for i in range(t.n_halfedges))


# -- refused -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", [name for name in ZOO if name not in FLAT])
def test_what_has_handles_is_refused(name):
    mesh = ZOO[name].mesh()
    with pytest.raises(hm.PreconditionError, match=f"component 0, .* genus {mesh.genus}"):
        compacted(mesh.topology)


def test_the_component_with_the_handle_is_named():
    mesh = ZOO["cube"].mesh()
    mesh.append(ZOO["torus"].mesh())
    with pytest.raises(hm.PreconditionError, match="component 1, that of vertex 8, has genus 1"):
        compacted(mesh.topology)


def test_the_source_is_not_touched():
    mesh = with_holes(hm.shapes.grid(4, 4), np.random.default_rng(0), 0.3)
    before = {name: getattr(mesh.topology, name).tobytes() for name in COLUMNS[:-1]}
    compacted(mesh.topology)
    assert before == {name: getattr(mesh.topology, name).tobytes() for name in COLUMNS[:-1]}


# -- figures -----------------------------------------------------------------------------------------------------------


@pytest.mark.large
def test_less_than_five_bits_for_each_edge():
    """M4: published are 5.51 bits for planar embeddings with their directories."""
    for mesh in (hm.shapes.grid(400, 300), hm.shapes.icosphere(6)):
        compact = compacted(mesh.topology).topology
        assert compact.bits_per_edge < 4.7


@pytest.mark.large
def test_what_a_hole_costs():
    """At most 96 bits: its node, and one vertex with its halfedge."""
    rng = np.random.default_rng(0)
    mesh = with_holes(hm.shapes.grid(200, 200), rng, 0.02)
    a = compacted(mesh.topology).topology.__arrays__()
    assert len(a.gap_vertices) <= len(a.holes) <= mesh.n_boundary_loops


def test_maps_of_a_mesh_with_nothing():
    encoded(hm.Mesh([]).topology)
    encoded(hm.Mesh([], n_vertices=3).topology)


def test_maps_stay_one_to_one_after_deletion():
    mesh = hm.shapes.icosphere(1)
    mesh.remove_vertex(0)
    made = compacted(mesh.topology)
    assert_alike(mesh.topology, made)
    assert maps_of(mesh.topology, made).vertices[0] == -1
