"""What no mesh can make sense of: documented errors, in either gear, and no kernel is spoiled for later calls."""

from __future__ import annotations

import math

import numpy as np
import pytest

import halfmesh as hm
from halfmesh._jit import gears

HUGE = (2**31, 2**62, 2**63 - 1, 2**63, 2**64, 2**70, -1, -(2**63), -(2**70))

each_gear = pytest.mark.parametrize("is_compiled", [False, True])

OF_ONE = {
    "flip": (),
    "try_flip": (),
    "split_edge": (),
    "split_face": (),
    "collapse": (),
    "join_vertices": (),
    "open_edge": (),
    "close_edge": (),
    "zip_hole": (),
    "dissolve_vertex": (),
    "remove_face": (),
    "reverse_component": (),
    "connect": (0,),
    "stitch": (0,),
    "join_loop": (0,),
    "weld": (0,),
    "add_edge": (0,),
    "make_adjacent": (0,),
}


@each_gear
@pytest.mark.parametrize("name", OF_ONE)
def test_no_index_is_too_large_to_be_refused(name, is_compiled, monkeypatch):
    monkeypatch.setattr(gears, "always_compile", is_compiled)
    mesh = hm.shapes.grid(3, 3)
    revision = mesh.revision
    for index in HUGE:
        with pytest.raises(hm.ElementError):
            getattr(mesh, name)(index, *OF_ONE[name])
    assert mesh.revision == revision


@pytest.mark.parametrize("name", ["cut", "can_cut", "split_loop", "can_split_loop", "submesh"])
def test_no_index_in_a_list_is_too_large_to_be_refused(name):
    mesh = hm.shapes.cube()
    for index in HUGE:
        with pytest.raises(hm.ElementError):
            getattr(mesh, name)([0, index])


def test_no_number_of_vertices_is_too_large_to_be_refused():
    mesh = hm.shapes.cube()
    for n in (2**31, 2**63 - 1, 2**63, np.uint64(2**63), 2**70):
        with pytest.raises(hm.TopologyError, match="int32"):
            mesh.add_vertices(n)
    assert mesh.n_vertices == 8


@each_gear
def test_options_count_by_whether_they_are_true(is_compiled, monkeypatch):
    monkeypatch.setattr(gears, "always_compile", is_compiled)
    kite = hm.shapes.tetrahedron()
    for no in (None, "", [], 0, 0.0, np.False_):
        assert not kite.try_flip(0, allow_parallel=no)
        assert not kite.can_join_loop(0, 1, allow_parallel=no)
    for yes in (True, "yes", [0], 2**70, 0.5, np.True_):
        assert kite.copy().try_flip(0, allow_parallel=yes)


def test_places_on_an_edge_are_single_numbers():
    with pytest.raises(hm.InvalidMeshError, match="no place on the edge"):
        hm.shapes.cube().split_edge(0, at=np.array([0.2, 0.5]))


@pytest.mark.parametrize(
    "point",
    [
        "abc",
        ["1", "2", "3"],
        [True, False, True],
        [1j, 0, 0],
        [None, 0, 0],
        [2**70, 0, 0],
        [[1, 2, 3]],
        [[1], [2, 3]],
        5.0,
        [math.inf, 0, 0],
        [0.0, 0.0, math.nan],
        np.ma.array([1.0, 2.0, 3.0], mask=[0, 1, 0]),
        {1, 2, 3},
    ],
    ids=repr,
)
def test_points_are_two_or_three_finite_real_numbers(point):
    mesh = hm.shapes.cube()
    for change in (
        lambda: mesh.add_vertex(point),
        lambda: mesh.split_edge(0, point),
        lambda: mesh.split_face(0, point),
        lambda: mesh.join_vertices(0, point),
        lambda: setattr(mesh.vertices[0], "point", point),
    ):
        with pytest.raises(hm.InvalidMeshError) as refused:
            change()
        assert refused.value.reason == "bad_points"
    assert (mesh.n_vertices, mesh.n_edges) == (8, 12)
    assert np.array_equal(mesh.points, hm.shapes.cube().points)


@pytest.mark.parametrize("n", [2.5, math.nan, math.inf, "3"])
def test_numbers_of_pairs_to_zip_are_whole(n):
    with pytest.raises(TypeError):
        hm.shapes.grid(2, 2).zip_hole(0, n)


def test_nothing_is_zipped_up_at_a_halfedge_that_is_not_there():
    with pytest.raises(hm.ElementError):
        hm.shapes.grid(2, 2).zip_hole(999, 0)


def test_points_are_there_once_one_was_given():
    for operator in ("split_edge", "split_face"):
        mesh = hm.Mesh([[0, 1, 2], [0, 2, 3]])
        getattr(mesh, operator)(0)
        assert not mesh.has_points
        mesh.split_edge(mesh.edges.indices[0], [1, 2, 3])
        assert mesh.has_points


@pytest.mark.parametrize("id", ["3", 2.0, None, [1]])
def test_ids_are_integers(id):
    ids = hm.shapes.cube().ids
    for find in (ids.find_vertex, ids.find_halfedge, ids.find_edge, ids.find_face):
        with pytest.raises(TypeError):
            find(id)
