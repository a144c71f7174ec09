"""The lines of OBJ that say to what the following faces belong, as integer labels with names."""

from __future__ import annotations

import re
from collections import Counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh.io.data import Attributes
from halfmesh.io.source import Source

__all__ = ["LABELS", "read_labels"]

LABELS = {b"g": ("group", "groups"), b"o": ("object", "objects"), b"usemtl": ("material", "materials")}
_LINE = re.compile(rb"[^\r\n]*")


class _Runs:
    """A label and the face from which it holds, again and again."""

    def __init__(self, before: int) -> None:
        self.begins, self.labels = [0], [before]

    def set(self, face: int, label: int) -> None:
        self.begins.append(face)
        self.labels.append(label)

    def column(self, n_faces: int) -> NDArray[np.int32]:
        lengths = np.diff(np.array([*self.begins, n_faces]))
        return np.repeat(np.array(self.labels, dtype=np.int32), lengths)


def read_labels(
    source: Source, text: NDArray[np.uint8], events: NDArray[np.int64], n_faces: int
) -> tuple[Attributes, dict[str, Any]]:
    """Go through the lines that are neither points nor faces.

    Parameters
    ----------
    events : ndarray of shape (n, 2)
        How many faces come before the line, and where it begins.

    Returns
    -------
    attributes : dict
        ``group object material``: index of a name, -1 where none was given; ``smoothing``: the number, 0 for off.
    meta : dict
        The names, in the order of their appearance.
    """
    runs = {word: _Runs(-1) for word in LABELS}
    names: dict[bytes, dict[str, int]] = {word: {} for word in LABELS}
    smoothing = _Runs(0)
    libraries: list[str] = []
    ignored: Counter[str] = Counter()
    view = memoryview(text)  # type: ignore[arg-type]
    for face, at in events.tolist():
        line = _LINE.match(view, at)
        assert line is not None  # it may be empty
        word, rest = _split(line.group())
        if word in LABELS:
            name = " ".join(rest.decode("utf-8", "replace").split())
            runs[word].set(face, names[word].setdefault(name, len(names[word])))
        elif word == b"s":
            smoothing.set(face, _smoothing(source, rest, at))
        elif word == b"mtllib":
            libraries.append(rest.decode("utf-8", "replace").strip())
        else:
            ignored[word[:40].decode("ascii", "backslashreplace")] += 1
    attributes: Attributes = {LABELS[word][0]: run.column(n_faces) for word, run in runs.items() if len(run.begins) > 1}
    if len(smoothing.begins) > 1:
        attributes["smoothing"] = smoothing.column(n_faces)
    meta: dict[str, Any] = {LABELS[word][1]: list(names[word]) for word in LABELS if names[word]}
    if libraries:
        meta["material_libraries"] = libraries
    if ignored:
        meta["ignored"] = dict(ignored)
    return attributes, meta


def _split(line: bytes) -> tuple[bytes, bytes]:
    word, *rest = line.split(None, 1)
    return word, rest[0] if rest else b""


def _smoothing(source: Source, rest: bytes, at: int) -> int:
    token = (rest.split(b"#")[0].split() or [b"off"])[0]
    if token in {b"off", b"on"}:
        return int(token == b"on")
    if not re.fullmatch(rb"\d{1,9}", token):
        raise source.error(f"expected a smoothing group number or 'off', found {source.shown(at)}", at)
    return int(token)
