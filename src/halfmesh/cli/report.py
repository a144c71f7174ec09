"""What is known of a mesh file: the answer of ``halfmesh info``, as far as the file goes."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

import halfmesh as hm
from halfmesh.cli.words import complaint_about, size_text
from halfmesh.errors import HalfmeshError, InvalidMeshError
from halfmesh.io.formats import format_of
from halfmesh.io.meshes import mesh_of
from halfmesh.mesh.summary import Summary, duration

__all__ = ["Report"]


@dataclass
class Report:
    """A file, what it holds, and what is wrong with it.

    Attributes
    ----------
    path : Path
    n_bytes : int
    format : str
    read_seconds : float
    plain : dict
        Counts of the plain arrays, where the file can be read and its faces can't be held.
    summary : Summary or None
    orientation : str
    volume : float or None
        Enclosed by a closed mesh, positive if its faces look outward.
    error : Exception or None
        ``FormatError`` or ``OSError`` (can't be read), ``InvalidMeshError`` (can't be held, or breaks a law).
    """

    path: Path
    n_bytes: int = 0
    format: str = ""
    read_seconds: float = 0.0
    plain: dict[str, Any] = field(default_factory=dict)
    summary: Summary | None = None
    orientation: str = ""
    volume: float | None = None
    error: Exception | None = None

    @classmethod
    def of(cls, path: Path, *, check: bool = False) -> Report:
        """Read, build and count; `check` tests the laws as well. What goes wrong is kept, not raised."""
        report = cls(path)
        try:
            report._fill(check)
        except (HalfmeshError, OSError) as error:
            report.error = error
        return report

    def _fill(self, check: bool) -> None:
        self.n_bytes = self.path.stat().st_size
        self.format = format_of(self.path).name
        started = time.perf_counter()
        data = hm.io.read_data(self.path)
        self.read_seconds = time.perf_counter() - started
        try:
            mesh = mesh_of(data, str(self.path))
        except InvalidMeshError:
            kinds, counts = np.unique(np.diff(data.offsets), return_counts=True)
            by_degree = dict(zip(kinds.tolist(), counts.tolist(), strict=True))
            self.plain = {"vertices": data.n_vertices, "faces": data.n_faces, "face_degrees": by_degree}
            raise
        if check:
            mesh.check()
        self.summary = mesh.summary()
        self._orient(mesh)

    def _orient(self, mesh: hm.Mesh) -> None:
        """A mesh that can be held is oriented alike everywhere; a closed one looks outward or inward."""
        self.orientation = "consistent"
        if mesh.n_faces and not mesh.has_boundary:
            volume = float(hm.geometry.volume(mesh))
            if volume != 0.0 and math.isfinite(volume):  # a flat or broken body has no outside
                self.orientation += f", facing {'outward' if volume > 0 else 'inward'} (volume {volume:.4g})"
                self.volume = volume

    def rows(self) -> list[tuple[str, str]]:
        """Label and value of each line of the table; none for what can't be read."""
        if self.summary is None and not self.plain:
            return []
        made = [("file", f"{self.format}, {size_text(self.n_bytes)}")]
        if self.summary is not None:
            *shape, memory, built = self.summary.rows()
            made += [*shape, ("orientation", self.orientation), memory]
            made += [("read in", duration(self.read_seconds)), built]
        else:
            kinds = ", ".join(f"degree {d} {n:,}" for d, n in self.plain["face_degrees"].items()) or "none"
            made += [("points", f"{self.plain['vertices']:,}"), ("faces", f"{self.plain['faces']:,}")]
            made += [("  by degree", kinds), ("read in", duration(self.read_seconds))]
            made.append(("as a mesh", f"can't be held: {getattr(self.error, 'reason', '').replace('_', ' ')}"))
        return made

    @property
    def headline(self) -> str:
        """The counts in a line."""
        s = self.summary
        assert s is not None
        loops = {0: "closed", 1: "1 boundary loop"}.get(s.boundary_loops, f"{s.boundary_loops:,} boundary loops")
        return f"{s.vertices:,} vertices, {s.edges:,} edges, {s.faces:,} faces, {loops}"

    @property
    def complaint(self) -> str:
        """What is wrong, beginning with the name of the file."""
        assert self.error is not None
        return complaint_about(self.path, self.error)

    def as_dict(self) -> dict[str, Any]:
        """Plain numbers and texts, for JSON."""
        made: dict[str, Any] = {"file": str(self.path), "bytes": self.n_bytes, "format": self.format}
        if self.summary is not None:
            made |= self.summary.as_dict()
            made |= {"orientation": self.orientation, "volume": self.volume}
        made |= self.plain
        if self.summary is not None or self.plain:
            made["read_seconds"] = self.read_seconds
        made["error"] = None
        if self.error is not None:
            made["error"] = {"type": type(self.error).__name__, "message": self.complaint}
            if isinstance(self.error, InvalidMeshError):
                made["error"]["reason"] = self.error.reason
        return made
