"""Slow obvious readers, as a second opinion: lines, split, float()."""

from __future__ import annotations

from pathlib import Path

Parsed = tuple[list[list[float]], list[list[int]]]


def lines_of(path: Path) -> list[list[str]]:
    text = path.read_bytes().decode("utf-8-sig", "replace").replace("\\\r\n", " ").replace("\\\n", " ")
    rows = (line.split("#")[0].split() for line in text.replace("\r", "\n").split("\n"))
    return [row for row in rows if row]


def read_off(path: Path) -> Parsed:
    rows = lines_of(path)
    if rows[0][0].startswith("OFF"):
        rest = [rows[0][0][3:], *rows[0][1:]]
        rows[:1] = [[word for word in rest if word]] if any(rest) else []
    n_vertices, n_faces = int(rows[0][0]), int(rows[0][1])
    points = [[float(x) for x in row[:3]] for row in rows[1 : 1 + n_vertices]]
    faces = [[int(i) for i in row[1 : 1 + int(row[0])]] for row in rows[1 + n_vertices : 1 + n_vertices + n_faces]]
    return points, faces


def read_obj(path: Path) -> Parsed:
    points: list[list[float]] = []
    faces: list[list[int]] = []
    for word, *rest in lines_of(path):
        if word == "v":
            points.append([float(x) for x in rest[:3]])
        elif word == "f":
            corners = [int(x.split("/")[0]) for x in rest]
            faces.append([i - 1 if i > 0 else len(points) + i for i in corners])
    return points, faces


def read_ele(path: Path) -> Parsed:
    _, *nodes = lines_of(path.with_suffix(".node"))
    _, *elements = lines_of(path)
    base = int(nodes[0][0])
    return [[float(x), float(y), 0.0] for _, x, y, *_ in nodes], [[int(i) - base for i in row[1:4]] for row in elements]


def read(path: Path) -> Parsed:
    return {".off": read_off, ".obj": read_obj, ".ele": read_ele}[path.suffix.lower()](path)
