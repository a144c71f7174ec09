"""The rows of the corpus's table: what each file truly holds."""

from __future__ import annotations

import csv
import os
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("HALFMESH_CORPUS", ROOT.parent / "shared" / "corpus"))


class Row(NamedTuple):
    path: str
    n_vertices: int | None
    n_edges: int | None
    n_faces: int | None
    degrees: dict[int, int]
    expect: str
    n_bytes: int


def rows(*folders: str) -> list[Row]:
    """The files in these folders that are read; none where the corpus is absent."""
    table = CORPUS / "MANIFEST.tsv"
    if not table.is_file():
        return []
    with table.open(encoding="utf-8", newline="") as file:
        return [_row(r) for r in csv.DictReader(file, delimiter="\t") if _wanted(r["path"], folders)]


def _wanted(path: str, folders: tuple[str, ...]) -> bool:
    return path.startswith(tuple(f"{folder}/" for folder in folders)) and path.lower().endswith(
        (".off", ".obj", ".ele")
    )


def _row(row: dict[str, str]) -> Row:
    v, e, f = (int(row[c]) if row[c].isdigit() else None for c in "VEF")
    pairs = (pair.split(":") for pair in row["degrees"].split(",") if pair.replace(":", "").isdigit())
    return Row(row["path"], v, e, f, {int(d): int(n) for d, n in pairs}, row["expect"], int(row["bytes"]))
