"""Polylla on random triangulations (G1): the slow twin polygon for polygon, and any order of the input."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm
from halfmesh.algorithms._polylla_marks import INSIDE, LONGEST, OUTSIDE
from halfmesh.algorithms._polylla_repair import repair
from halfmesh.algorithms._polylla_travel import travel
from terminal_edges import Twin, certify, cycles, lattice, polygons_of, random_delaunay, shuffled

seeds = st.integers(0, 2**32 - 1)


def compared(triangles, points):
    """Polygons and report, after they were found equal to the twin's and certified."""
    mesh = hm.Mesh(triangles, points)
    polygons, report = hm.polylla(mesh, report=True)
    certify(mesh, polygons, report)
    twin = Twin(triangles, mesh.points)
    assert cycles(polygons_of(polygons)) == cycles(twin.polygons)
    assert (report.n_tips, report.n_repaired, report.n_added) == (twin.n_tips, twin.n_repaired, twin.n_added)
    return polygons, report


def in_any_order(triangles, points, seed):
    """Nothing but the numbers changes when vertices, faces and corners are shuffled."""
    expected, known = compared(triangles, points)
    rows, moved, new = shuffled(triangles, expected.points, seed)
    polygons, report = hm.polylla(hm.Mesh(rows, moved), report=True)
    assert cycles(polygons_of(polygons)) == cycles([new[p].tolist() for p in polygons_of(expected)])
    assert (report.n_tips, report.n_repaired, report.n_added) == (known.n_tips, known.n_repaired, known.n_added)


@given(st.integers(4, 90), seeds)
def test_delaunay_triangles(n, seed):
    in_any_order(*random_delaunay(n, seed), seed)


@given(st.integers(1, 8), st.integers(1, 8), seeds, st.sampled_from([0.0, 0.3, 0.9]))
def test_grids_with_random_diagonals(columns, rows, seed, jitter):
    """Full of ties without jitter."""
    in_any_order(*lattice(columns, rows, seed, jitter), seed)


@given(seeds, st.floats(0.3, 0.95))
def test_patches_with_holes_and_several_components(seed, density):
    triangles, points = lattice(7, 6, seed, 0.5)
    kept = np.random.default_rng(seed).random(len(triangles)) < density
    in_any_order(triangles[kept], points, seed)


@given(seeds)
def test_curved_patches(seed):
    triangles, points = lattice(7, 6, seed, 0.5)
    points[:, 2] = np.random.default_rng(seed).normal(size=len(points))
    in_any_order(triangles, points, seed)


@given(st.integers(3, 7), st.integers(3, 7), seeds, st.integers(1, 5))
def test_tori_with_points_anywhere_on_a_small_lattice(columns, rows, seed, size):
    """Full of ties, of points in the same place, of regions that meet themselves across the whole surface."""
    triangles, points = lattice(columns, rows, seed, 0, around=(True, True))
    compared(triangles, np.random.default_rng(seed).integers(0, size, points.shape))


@pytest.mark.parametrize("seed", [40, 54, 55, 65, 95, 105])
def test_ways_between_triangles_that_don_t_begin_or_end_where_the_walk_comes_by(seed):
    """Tori where the path between two visits of a vertex leads along edges of that vertex first."""
    triangles, points = lattice(3 + seed % 5, 3 + seed // 5 % 5, seed, 0, around=(True, True))
    compared(triangles, np.random.default_rng(seed).integers(0, 1 + seed % 5, points.shape))


@given(st.integers(3, 7), st.integers(3, 7), seeds)
def test_tori_with_points_anywhere(columns, rows, seed):
    triangles, points = lattice(columns, rows, seed, 0, around=(True, True))
    in_any_order(triangles, np.random.default_rng(seed).random(points.shape), seed)


@given(st.integers(1, 9), seeds)
def test_spheres_with_points_anywhere(n, seed):
    mesh = hm.shapes.tetrahedron()
    rng = np.random.default_rng(seed)
    for _ in range(n):
        mesh.split_face(mesh.faces[int(rng.integers(mesh.n_faces))])
    in_any_order(mesh.triangles(), rng.random(mesh.points.shape), seed)


@given(st.integers(2, 12), seeds)
def test_any_tree_of_all_triangles_falls_into_simple_polygons(n, seed):
    """Regions that lengths hardly ever make: the whole patch, by a random spanning tree, with tips all over."""
    mesh = hm.Mesh(*lattice(n, n, seed))
    marks, start = marks_of_a_tree(mesh, np.random.default_rng(seed))
    walks = travel(mesh, marks, start, mesh.n_vertices, mesh.n_faces)
    assert walks.degrees.tolist() == [mesh.n_faces + 2]
    walks = repair(mesh, marks, start, walks, mesh.n_vertices)
    for begin, degree in zip(walks.begins.tolist(), walks.degrees.tolist(), strict=True):
        assert len(set(walks.vertices[begin : begin + degree].tolist())) == degree
    assert int((walks.degrees - 2).sum()) == mesh.n_faces
    assert np.array_equal(np.bincount(walks.of_triangle), walks.degrees - 2)


def marks_of_a_tree(mesh, rng):
    """Marks as if each triangle's longest edge led to its parent in a random tree; and the edge where they all end."""
    t = mesh.topology
    marks = np.where(t.face < 0, OUTSIDE, INSIDE).astype(np.uint8)
    reached, front, start = {0}, [0], None
    while front:
        f = front[rng.integers(len(front))]
        leading = [h.index for h in mesh.faces[f].halfedges() if h.twin.face and h.twin.face.index not in reached]
        if not leading:
            front.remove(f)
            continue
        h = leading[rng.integers(len(leading))]
        g = h ^ 1
        marks[g] = LONGEST
        if start is None:
            marks[h], start = LONGEST, h
        reached.add(int(t.face[g]))
        front.append(int(t.face[g]))
    return marks, np.array([start], np.int32)


@pytest.mark.parametrize("name", hm.testing.zoo())
def test_zoo(name):
    """Whatever has triangles, each with three vertices, points, and no parallel edges."""
    specimen = hm.testing.zoo()[name]
    mesh = specimen.mesh()
    mesh.points = np.random.default_rng(5).random((mesh.n_vertices, 3))
    if mesh.is_triangular and (specimen.twins is None or name == "twins of a plain mesh"):
        polygons, report = hm.polylla(mesh, report=True)
        certify(mesh, polygons, report)
        assert cycles(polygons_of(polygons)) == cycles(Twin(mesh.triangles(), mesh.points).polygons)
    elif mesh.is_triangular and all(len({*f.vertices()}) == 3 for f in mesh.faces):
        polygons, report = hm.polylla(mesh, report=True)
        hm.testing.assert_valid(polygons)
        assert all(len(set(face)) == len(face) >= 3 for face in polygons_of(polygons))
    else:
        with pytest.raises(hm.PreconditionError):
            hm.polylla(mesh)


@pytest.mark.large
def test_large_mesh_keeps_to_the_published_ratio():
    """0.16 polygons a triangle in random Delaunay meshes; a tip for every hundred triangles."""
    triangles, points = random_delaunay(3000, 1)
    _, report = compared(triangles, points)
    assert report.n_polygons / report.n_triangles == pytest.approx(0.16, rel=0.02)
    assert 0.005 < report.n_tips / report.n_triangles < 0.015
