"""The exceptions of halfmesh: one tree, so that ``except HalfmeshError`` catches all of them.

::

    HalfmeshError
    +-- InvalidMeshError   (ValueError)    the input is not a mesh that can be held
    +-- TopologyError      (ValueError)    this operation would break the mesh; nothing was changed
    +-- PreconditionError  (ValueError)    the mesh is not of the kind the function needs
    +-- StaleElementError  (RuntimeError)  the element was deleted
    +-- ElementError       (IndexError)    no such element, of another mesh, or of the wrong kind
    +-- FormatError        (ValueError)    a file is malformed

What the operating system refuses (a missing file, a full disk) stays an ``OSError``.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

__all__ = [
    "ElementError",
    "FormatError",
    "HalfmeshError",
    "InvalidMeshError",
    "PreconditionError",
    "StaleElementError",
    "TopologyError",
]


class HalfmeshError(Exception):
    """Base of all exceptions that halfmesh raises by itself."""


class InvalidMeshError(HalfmeshError, ValueError):
    """The input is not a mesh that can be held, or a held mesh breaks a law.

    Attributes
    ----------
    reason : str
        A stable one-word name of the (first) thing that is wrong, e.g. ``"nonmanifold_edge"``.
    elements : dict of str to ndarray
        *All* offending elements, by what they are: ``faces``, ``edges`` (vertex pairs, shape (n, 2)),
        ``vertices``, ``corners``, ``halfedges``. Only the first few are shown in the message.
    """

    def __init__(
        self, message: str, *, reason: str = "invalid", elements: Mapping[str, NDArray[np.integer]] | None = None
    ) -> None:
        super().__init__(message)
        self.reason = reason
        self.elements: dict[str, NDArray[np.integer]] = dict(elements or {})


class TopologyError(HalfmeshError, ValueError):
    """The operation would break the mesh; nothing was changed.

    Attributes
    ----------
    reason : str
        A stable one-word name of what stands against it, e.g. ``"would_be_parallel"``.
    """

    def __init__(self, message: str, *, reason: str = "refused") -> None:
        super().__init__(message)
        self.reason = reason

    def __reduce__(self) -> tuple[object, ...]:
        return _restore_topology_error, (str(self), self.reason)


def _restore_topology_error(message: str, reason: str) -> TopologyError:
    return TopologyError(message, reason=reason)


class PreconditionError(HalfmeshError, ValueError):
    """The mesh is not of the kind the function needs, e.g. a face is not a triangle."""


class StaleElementError(HalfmeshError, RuntimeError):
    """The element that the handle names was deleted, or its index means another one since compaction or a rollback."""


class ElementError(HalfmeshError, IndexError):
    """There is no such element, it belongs to another mesh, or it is of the wrong kind."""


class FormatError(HalfmeshError, ValueError):
    """A file is malformed.

    Attributes
    ----------
    path : str
        The file, as it was given.
    line : int or None
        Line number, counted from 1, in a text file.
    offset : int or None
        Byte offset, counted from 0, in a binary file.
    """

    def __init__(
        self, message: str, *, path: str | os.PathLike[str] = "", line: int | None = None, offset: int | None = None
    ) -> None:
        self.path = os.fspath(path)
        self.line = line
        self.offset = offset
        self.reason = message
        place = "".join(
            (self.path, "" if line is None else f", line {line}", "" if offset is None else f", byte {offset}")
        )
        super().__init__(f"{place}: {message}" if place else message)

    def __reduce__(self) -> tuple[object, ...]:
        return _restore_format_error, (self.reason, self.path, self.line, self.offset)


def _restore_format_error(message: str, path: str, line: int | None, offset: int | None) -> FormatError:
    return FormatError(message, path=path, line=line, offset=offset)
