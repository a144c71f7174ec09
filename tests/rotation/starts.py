"""What walks start from: the zoo, and the small real files where the corpus is there."""

from __future__ import annotations

import csv
import os
from functools import partial
from pathlib import Path

import halfmesh as hm
from halfmesh.testing import zoo

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("HALFMESH_CORPUS", ROOT.parent / "shared" / "corpus"))
LARGEST = 150  # edges of a real file: a step walks all of the twin


def starts():
    """Functions that make a mesh anew, by name."""
    return {name: specimen.mesh for name, specimen in zoo().items()} | real_files()


def real_files():
    table = CORPUS / "MANIFEST.tsv"
    if not table.is_file():
        return {}
    with table.open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file, delimiter="\t") if is_small(row)]
    return {row["path"]: partial(hm.load, CORPUS / row["path"]) for row in rows}


def is_small(row):
    """Small, and a mesh that can be held."""
    sound = row["expect"] == "MUST_LOAD" and row["oriented"] == "1" and row["nonmanifold_vertices"] == "0"
    named = row["path"].lower().endswith((".off", ".obj"))
    return sound and named and row["E"].isdigit() and int(row["E"]) <= LARGEST
