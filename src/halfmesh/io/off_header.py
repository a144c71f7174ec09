"""The header of an OFF file, and what it says about the columns of a vertex."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh.io.data import Attributes
from halfmesh.io.source import Source

__all__ = ["Header", "as_color", "read_header"]

_GAP = re.compile(rb"(?:[\s]++|#[^\r\n]*+)*+")
_TOKEN = re.compile(rb"[^\s#]++")
_KEYWORD = re.compile(rb"(?P<prefix>(?:ST|C|N|4|n)*)OFF(?P<rest>.*)\Z", re.DOTALL)
_REST_OF_LINE = re.compile(rb"[ \t\v\f]*(?P<word>[^\s#]*)")
_COMMENT = re.compile(rb"#[ \t]*([^\r\n]*)")
_COUNT = re.compile(rb"\d{1,18}\Z")

_MOST_EXTRAS = 16  # columns of a vertex that the keyword does not announce
_MOST_DIMENSIONS = 100
_LIMIT = 2**31 - 1


@dataclass
class Header:
    """What stands before the first vertex.

    Attributes
    ----------
    n_vertices, n_faces : int
    body : int
        Byte behind the header.
    counts_at : int
        Byte of the counts.
    n_coordinates, normals, colors, texture : int, bool, bool, bool
        What a vertex has.
    homogeneous : bool
        The last coordinate is the `w` of 4OFF.
    binary : bool
    comments : list of str
    """

    n_vertices: int = 0
    n_faces: int = 0
    body: int = 0
    counts_at: int = 0
    n_coordinates: int = 3
    homogeneous: bool = False
    normals: bool = False
    colors: bool = False
    texture: bool = False
    binary: bool = False
    comments: list[str] = field(default_factory=list)
    n_colors: int = 4
    n_extras: int = 0

    @property
    def least_width(self) -> int:
        """Numbers of a vertex, a colour counted as four."""
        return self._width(4)

    def _width(self, n_colors: int) -> int:
        return self.n_coordinates + 3 * self.normals + n_colors * self.colors + 2 * self.texture

    def check_counts(self, source: Source) -> None:
        """Refuse counts that the bytes of the file can't hold, before anything is allocated for them."""
        left = source.end - self.body
        least = 2 * (self._width(3) * self.n_vertices + self.n_faces) - 1
        if least > left or max(self.n_vertices, self.n_faces) > _LIMIT:
            raise source.error(
                f"{self.n_vertices} vertices and {self.n_faces} faces are announced, which take {least} bytes or more, "
                f"but only {left} bytes follow; the counts are wrong, or the file was cut off",
                self.counts_at,
            )

    def width(self, source: Source) -> int:
        """Numbers of a vertex, by the first vertex line; sets `n_colors` and `n_extras`."""
        if self.n_vertices == 0:
            return self.least_width
        n = _tokens_in_line(source, self._first_token(source), self.least_width + _MOST_EXTRAS)
        self.n_colors = 3 if n == self._width(3) else 4
        self.n_extras = min(max(n - self.least_width, 0), _MOST_EXTRAS)
        return self._width(self.n_colors) + self.n_extras

    def _first_token(self, source: Source) -> int:
        gap = _GAP.match(source.view, self.body)
        assert gap is not None  # it matches nothing, too
        return gap.end()

    def points(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """The first three coordinates; zeros for what a file of fewer dimensions lacks."""
        n = min(self.n_coordinates - self.homogeneous, 3)
        if n == 3 == values.shape[1]:
            return values
        points = np.zeros((len(values), 3))
        points[:, :n] = values[:, :n]
        return points

    def attributes(self, values: NDArray[np.float64], seen: int) -> Attributes:
        """The other columns by name; bit c of `seen` says that column c was not written in integers."""
        named: Attributes = {}
        space = self.n_coordinates - self.homogeneous
        if space > 3:
            named["more_coordinates"] = values[:, 3:space].copy()
        if self.homogeneous:
            named["w"] = values[:, space].copy()
        at = self.n_coordinates
        if self.normals:
            named["normal"] = values[:, at : at + 3].copy()
            at += 3
        if self.colors:
            whole = not (seen >> at) & ((1 << self.n_colors) - 1)
            named["color"] = as_color(values[:, at : at + self.n_colors], whole)
            at += self.n_colors
        if self.texture:
            named["texcoord"] = values[:, at : at + 2].copy()
            at += 2
        if self.n_extras:
            named["extra"] = values[:, at:].copy()
        return named


def as_color(values: NDArray[np.float64], whole: bool) -> NDArray[Any]:
    """Components written as integers from 0 to 255 as uint8, anything else as float64."""
    if whole and values.size and values.min() >= 0 and values.max() <= 255:
        return values.astype(np.uint8)
    return np.ascontiguousarray(values)


class _Reader:
    """Tokens one by one, with the places they stand at."""

    def __init__(self, source: Source) -> None:
        self.source, self.at, self.start = source, source.begin, source.begin
        self.comments: list[str] = []

    def next(self) -> bytes:
        """The next token; empty at the end of the file."""
        gap = _GAP.match(self.source.view, self.at)
        assert gap is not None
        self.comments += [text.decode("utf-8", "replace").rstrip() for text in _COMMENT.findall(gap.group())]
        return self._take(gap.end())

    def same_line(self) -> bool:
        """Whether another token follows on this line."""
        rest = _REST_OF_LINE.match(self.source.view, self.at)
        return rest is not None and bool(rest["word"])

    def back(self, n: int) -> None:
        """Put back the last n bytes of the token: a keyword was glued to them."""
        self.at -= n

    def _take(self, start: int) -> bytes:
        self.start = start
        token = _TOKEN.match(self.source.view, start)
        if token is None:
            return b""
        self.at = token.end()
        return token.group()

    def count(self, what: str) -> int:
        token = self.next()
        if _COUNT.match(token) is None:
            raise self.source.error(
                f"expected the number of {what}, found {self.source.shown(self.start)}",
                min(self.start, self.source.end),
            )
        return int(token)


def read_header(source: Source) -> Header:
    """Read up to the counts; for binary files up to the end of the keyword's line."""
    header, reader = Header(), _Reader(source)
    token = reader.next()
    if not token:
        raise source.error("the file is empty; expected 'OFF' and the numbers of vertices, faces and edges")
    keyword = _KEYWORD.match(token)
    if keyword is not None:
        reader.back(len(keyword["rest"]))
        _apply_prefix(header, keyword["prefix"].decode(), source, reader)
        rest = _REST_OF_LINE.match(source.view, reader.at)
        if rest is not None and rest["word"] == b"BINARY":
            header.binary = True
            header.body = _after_line(source, rest.end())
            return header
        if header.n_coordinates == 0:
            header.n_coordinates = reader.count("dimensions") + header.homogeneous
            if not header.homogeneous < header.n_coordinates <= _MOST_DIMENSIONS:
                raise source.error(f"expected 1 to {_MOST_DIMENSIONS - 1} dimensions behind nOFF", reader.start)
    elif _COUNT.match(token) is not None:
        reader.back(len(token))
    else:
        raise source.error(
            f"expected 'OFF' (or COFF, NOFF, STOFF, 4OFF, nOFF) or the number of vertices, "
            f"found {source.shown(reader.start)}{_hint(source)}",
            reader.start,
        )
    header.n_vertices = reader.count("vertices")
    header.counts_at = reader.start
    together = reader.same_line()
    header.n_faces = reader.count("faces")
    if not together or reader.same_line():
        reader.count("edges")  # which nobody fills in reliably: it is read and forgotten
    header.body = reader.at
    header.comments = reader.comments
    return header


def _apply_prefix(header: Header, prefix: str, source: Source, reader: _Reader) -> None:
    letters = re.findall("ST|C|N|4|n", prefix)
    if len(set(letters)) < len(letters):
        raise source.error(f"the keyword {prefix}OFF says something twice", reader.start)
    header.texture, header.colors, header.normals = ("ST" in letters, "C" in letters, "N" in letters)
    header.homogeneous = "4" in letters
    header.n_coordinates = 0 if "n" in letters else 3 + header.homogeneous


def _hint(source: Source) -> str:
    head = bytes(source.data[: 1 << 16])
    if head.lstrip().startswith((b"{", b"(", b"LIST", b"INST")):
        return "; this is a Geomview scene, of which only a plain OFF object can be read: remove what is around it"
    return ""


def _after_line(source: Source, at: int) -> int:
    """The byte behind the line that ends at or after `at`."""
    end = re.compile(rb"[^\r\n]*(?:\r\n|\n|\r|\Z)").match(source.view, at)
    assert end is not None
    return end.end()


def _tokens_in_line(source: Source, at: int, most: int) -> int:
    tokens = re.compile(rb"[ \t\v\f]*[^\s#]++")
    n = 0
    while n < most and (token := tokens.match(source.view, at)) is not None:
        n += 1
        at = token.end()
    return n
