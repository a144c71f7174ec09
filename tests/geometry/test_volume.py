"""Volume."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm

g = hm.geometry


def test_volume_of_the_cube_is_one():
    assert g.volume(hm.shapes.cube()) == pytest.approx(1.0, rel=1e-15)


def test_volume_of_the_regular_solids():
    volumes = [g.volume(getattr(hm.shapes, name)()) for name in ("tetrahedron", "octahedron", "icosahedron")]
    golden = (1 + 5**0.5) / 2
    assert np.allclose(volumes, [8 / (9 * 3**0.5), 4 / 3, 20 / 3 * golden**2 / (golden**2 + 1) ** 1.5], rtol=1e-14)


def test_faces_that_look_inward_enclose_a_negative_volume():
    cube = hm.shapes.cube()
    inward = hm.Mesh(cube.face_vertices()[0].reshape(-1, 4)[:, ::-1], cube.points)
    assert g.volume(inward) == -g.volume(cube)


@pytest.mark.parametrize(
    ("finer", "exact"),
    [
        (lambda k: hm.shapes.icosphere(k), 4 / 3 * np.pi),
        (lambda k: hm.shapes.torus(8 * 2**k, 4 * 2**k), 2 * np.pi**2 * 0.16),
        (lambda k: hm.shapes.cylinder(6 * 2**k, 1, closed=True), 2 * np.pi),
    ],
    ids=["sphere", "torus", "cylinder"],
)
def test_volume_converges_with_order_two(finer, exact):
    errors = np.array([abs(g.volume(finer(k)) - exact) for k in (2, 3, 4)])
    assert np.allclose(np.log2(errors[:-1] / errors[1:]), 2, atol=0.1)


def test_a_warped_quad_bounds_as_the_fan_around_its_barycenter():
    cube = hm.shapes.cube()
    cube.points[7] = [1.5, 1.2, 1.3]
    indices, _ = cube.face_vertices()
    quads = indices.reshape(-1, 4)
    points = np.concatenate([cube.points, g.face_barycenters(cube)])
    middle = np.arange(8, 14)
    fans = [np.stack([quads[:, k], quads[:, (k + 1) % 4], middle], axis=1) for k in range(4)]
    assert g.volume(cube) == pytest.approx(g.volume(hm.Mesh(np.concatenate(fans), points)), rel=1e-14)


def test_volume_is_kept_a_million_units_away_from_the_origin():
    far = hm.shapes.icosphere(3)
    far.points += 2.0**20
    near = far.copy()
    near.points -= 2.0**20  # exact: only the way there has rounded
    assert g.volume(far) == pytest.approx(g.volume(near), rel=1e-13)


def test_an_open_surface_is_refused_and_an_open_edge_is_named():
    box = hm.shapes.cube()
    opened = hm.Mesh(box.face_vertices()[0].reshape(-1, 4)[:-1], box.points)
    with pytest.raises(
        hm.PreconditionError, match=r"4 edges have a face on one side only, e\.g\. edge (\d+)"
    ) as refused:
        g.volume(opened)
    assert opened.edges[int(str(refused.value).split()[-1])].is_boundary


def test_wire_does_not_open_a_closed_surface():
    cube = hm.shapes.cube()
    wired = hm.Mesh(cube.face_vertices(), np.concatenate([cube.points, [[5, 5, 5], [6, 6, 6]]]), edges=[[8, 9]])
    assert g.volume(wired) == pytest.approx(1.0, rel=1e-14)


def test_nothing_encloses_nothing():
    assert g.volume(hm.Mesh([])) == 0.0
