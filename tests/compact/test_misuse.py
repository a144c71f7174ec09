"""What one may try with meshes that are only read, and what is said when it can't be."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.errors import ElementError, StaleElementError

FORMS = [hm.TriangleMesh, hm.CompactMesh]


@pytest.mark.parametrize("form", FORMS)
def test_they_are_valid(form):
    hm.testing.assert_valid(form(hm.shapes.icosphere(1)))


@pytest.mark.parametrize("form", FORMS)
def test_they_can_be_saved(form, tmp_path):
    small = form(hm.shapes.icosphere(1))
    hm.save(small, tmp_path / "sphere.off")
    assert np.array_equal(hm.load(tmp_path / "sphere.off").triangles(), small.to_mesh().triangles())


@pytest.mark.parametrize("form", FORMS)
def test_a_copy_has_points_and_attributes_of_its_own(form):
    small = form(hm.shapes.icosphere(1))
    small.face_data["label"] = np.arange(small.n_faces)
    again = small.copy()
    again.points[:] = 0.0
    again.face_data["label"][:] = 7
    assert small.points.any()
    assert small.face_data["label"].tolist() == list(range(small.n_faces))
    assert again.vertices[3].mesh is again


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(
    ("thing", "remedy"),
    [([[0, 1, 2]], "Mesh\\(faces, points\\)"), (hm.CompactMesh(hm.shapes.octahedron()), "to_mesh"), (None, "Mesh\\(")],
)
def test_they_are_made_from_meshes_only(form, thing, remedy):
    with pytest.raises(ElementError, match=remedy):
        form(thing)


def test_polylla_takes_meshes_only():
    with pytest.raises(ElementError, match="not list"):
        hm.polylla([[0, 1, 2]])


@pytest.mark.large
@pytest.mark.parametrize("form", FORMS)
def test_an_operator_says_that_the_mesh_is_only_read(form):
    with pytest.raises(Exception, match="Unknown attribute") as raised:
        hm.flip(form(hm.shapes.icosphere(1)), 0)
    assert "only read" in "".join(raised.value.__notes__)


@pytest.mark.parametrize("form", FORMS)
def test_a_copy_takes_nothing_from_its_original(form):
    small = form(hm.shapes.icosphere(1))
    v = small.vertices[3]
    before = v.point.copy()
    again = small.copy()
    again.points[:] = 0.0
    assert v.mesh is small
    assert v.point.tolist() == before.tolist()
    assert v != again.vertices[3]


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(
    "twice", [copy.deepcopy, lambda mesh: pickle.loads(pickle.dumps(mesh)), lambda mesh: mesh.copy()]
)
def test_attributes_and_remarks_go_along(form, twice):
    small = form(hm.shapes.octahedron())
    small.face_data["label"] = np.arange(small.n_faces)
    small.meta["source"] = ["a scan"]
    again = twice(small)
    assert again.face_data["label"].tolist() == list(range(small.n_faces))
    assert again.meta == small.meta
    assert again.meta["source"] is not small.meta["source"]


@pytest.mark.parametrize("form", FORMS)
def test_a_handle_steps_on_when_its_mesh_is_gone(form):
    """As the handles of a mesh do: what it stands on is held by the handle."""
    h = form(hm.shapes.octahedron()).halfedges[0]
    assert h.next.next.next == h
    assert h.origin.degree == 4
    with pytest.raises(StaleElementError):
        _ = h.mesh
