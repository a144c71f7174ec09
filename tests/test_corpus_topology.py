"""Real files: built with the topology that others computed for them, or refused for the reason they name."""

from __future__ import annotations

import csv
import os
from pathlib import Path

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.core.topology import COLUMNS
from reference import Reference, Refused

CORPUS = Path(os.environ.get("HALFMESH_CORPUS", Path(__file__).resolve().parents[2] / "shared" / "corpus"))
REASONS = {"nonmanifold_edge", "inconsistent_orientation", "nonorientable", "nonmanifold_vertex"}


def manifest():
    """The rows of the OFF and OBJ files; none where the corpus is absent."""
    table = CORPUS / "MANIFEST.tsv"
    if not table.is_file():
        return []
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    return [row for row in rows if row["format"] in ("off", "obj") and row["kind"] == "mesh"]


def reason(row):
    """Why a file can't be held, from its figures; None if it can."""
    if int(row["nonmanifold_edges"]):
        return "nonmanifold_edge"
    if row["orientable"] == "0":
        return "nonorientable"
    if row["oriented"] == "0":
        return "inconsistent_orientation"
    return None


HELD = [row for row in manifest() if reason(row) is None and not int(row["nonmanifold_vertices"])]
REFUSED = [row for row in manifest() if reason(row) is not None]
named = {"argnames": "row", "ids": lambda row: row["path"]}


def test_the_corpus_was_found(corpus):
    assert len(HELD) > 50
    assert len(REFUSED) > 4


@pytest.mark.parametrize(argvalues=HELD, **named)
def test_mesh_has_the_figures_of_the_manifest(row, corpus):
    """C1-C3, R3, R5, R7: counts, isolated vertices, components, Euler characteristic, genus, boundary loops."""
    mesh = hm.load(corpus / row["path"])
    mesh.check()
    isolated = int(row["isolated_vertices"])
    hm.testing.Figures(
        int(row["V"]),
        int(row["E"]),
        int(row["F"]),
        int(row["boundary_loops"]),
        int(row["components_vertex"]) + isolated,
        int(row["genus"]),
        isolated,
    ).assert_of(mesh)
    assert mesh.euler_characteristic == int(row["euler_all"])
    assert mesh.n_exterior_halfedges == int(row["boundary_edges"])
    assert mesh.has_boundary == (row["closed"] == "0")
    assert np.diff(mesh.vertex_faces()[1]).max() == int(row["max_valence"])


@pytest.mark.parametrize(argvalues=REFUSED, **named)
def test_mesh_that_can_not_be_held_is_refused_for_the_reason_of_its_class(row, corpus):
    """N1, N3, N5."""
    faces, points = hm.io.read(corpus / row["path"])
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh(faces, points)
    assert caught.value.reason == reason(row)
    if reason(row) == "nonmanifold_edge":
        assert len(caught.value.elements["edges"]) == int(row["nonmanifold_edges"])


def test_a_closed_fan_on_a_closed_fan_is_refused_and_two_open_ones_are_held(corpus):
    """N2, R8: the hourglass touches itself at one vertex; two quads meet at one corner."""
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.load(corpus / "obj" / "gc__hourglass_ico.obj")
    assert caught.value.reason == "nonmanifold_vertex"
    assert len(caught.value.elements["vertices"]) == 1
    mesh = hm.load(corpus / "obj" / "trimesh__face_in_group_name_mid_file.obj")
    assert (mesh.n_connected_components, mesh.n_boundary_loops) == (1, 1)


@pytest.mark.parametrize(argvalues=[row for row in manifest() if int(row["F"]) < 1500], **named)
def test_columns_are_those_of_the_slow_twin(row, corpus):
    """D1-D7: halfedge by halfedge."""
    faces, points = hm.io.read(corpus / row["path"])
    lists = listed(faces)
    try:
        twin = Reference(lists, len(points))
    except Refused as refused:
        expected = refused.reason
    else:
        mesh = hm.Mesh(faces, points)
        assert {name: getattr(mesh.topology, name).tolist() for name in COLUMNS[:-1]} == twin.columns()
        return
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh(faces, points)
    assert caught.value.reason == expected


def listed(faces):
    if isinstance(faces, tuple):
        return [part.tolist() for part in np.split(faces[0], faces[1][1:-1])]
    return faces.tolist()


@pytest.mark.parametrize(argvalues=[row for row in REFUSED if reason(row) == "inconsistent_orientation"], **named)
def test_faces_named_for_reversal_repair_the_file(row, corpus):
    """N5: what the error says would help, helps."""
    faces, points = hm.io.read(corpus / row["path"])
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh(faces, points)
    repaired = listed(faces)
    for f in caught.value.elements["reverse"]:
        repaired[f].reverse()
    assert hm.Mesh(repaired, points).n_faces == int(row["F"])
