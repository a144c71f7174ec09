"""potpourri3d: here for its reader and writer."""

from __future__ import annotations

from pathlib import Path

import potpourri3d as pp3d

from benchmarks.compare.peer import Peer, Surface, Way, Ways, counted, triangles


class Potpourri3d(Peer):
    name = "potpourri3d"
    module = "potpourri3d"

    def readers(self, path: Path) -> Ways:
        return {
            "read_mesh": Way(
                lambda: pp3d.read_mesh(str(path)),
                "arrays only",
                facts=lambda vf: counted(len(vf[0]), len(vf[1])),
                points=lambda vf: vf[0],
            )
        }

    def writers(self, surface: Surface, path: Path) -> Ways:
        if path.suffix != ".obj":
            return super().writers(surface, path)
        return {"write_mesh": Way(lambda: pp3d.write_mesh(surface.points, triangles(surface), str(path)))}


peer = Potpourri3d()
