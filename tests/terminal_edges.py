"""What tests of Polylla share: the certificate of a result, and polygons as lists."""

from __future__ import annotations

import numpy as np

import halfmesh as hm


def polygons_of(mesh):
    """The vertices of every face, as lists."""
    indices, offsets = mesh.face_vertices()
    return [row.tolist() for row in np.split(indices, offsets[1:-1])] if len(offsets) > 1 else []


def certify(mesh, polygons, report):
    """Assert all that is promised of the polygons of a triangle mesh, without the library's own walks."""
    hm.testing.assert_valid(polygons)
    faces, triangles = polygons_of(polygons), mesh.triangles()
    assert all(len(set(face)) == len(face) >= 3 for face in faces), "a polygon is not simple"
    left, right = polygons.edge_faces().T
    assert not ((left == right) & (left >= 0)).any(), "an edge has the same polygon on both sides"
    assert polygons.euler_characteristic == mesh.euler_characteristic
    assert polygons.n_boundary_loops == mesh.n_boundary_loops
    assert polygons.n_connected_components == mesh.n_connected_components
    of_triangle = report.triangle_polygon[mesh.faces.indices]
    for p, face in enumerate(faces):
        assert boundary_of(triangles[of_triangle == p]) == sides_of(face), "triangles don't make up their polygon"
    assert (report.n_triangles, report.n_polygons) == (mesh.n_faces, len(faces))
    assert report.n_frontier_edges == int(((left >= 0) | (right >= 0)).sum())
    assert np.bincount(of_triangle, minlength=len(faces)).min(initial=1) > 0, "a polygon without triangles"


def boundary_of(triangles):
    """The directed sides of triangles of which the opposite is not there."""
    sides = {side for triangle in triangles.tolist() for side in sides_of(triangle)}
    return {(u, v) for u, v in sides if (v, u) not in sides}


def sides_of(face):
    return set(zip(face, [*face[1:], face[0]], strict=True))
