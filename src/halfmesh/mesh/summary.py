"""What there is to say about a mesh at a glance."""

from __future__ import annotations

import html
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from halfmesh.mesh.asking import Asked

__all__ = ["Summary", "duration", "summarize"]


@dataclass(frozen=True)
class Summary:
    """Counts, topology, degrees, memory and building time of a mesh; ``print`` it for a table.

    ``as_dict()`` has the same as plain numbers, for JSON.
    """

    vertices: int
    interior_vertices: int
    boundary_vertices: int
    isolated_vertices: int
    edges: int
    halfedges: int
    interior_halfedges: int
    exterior_halfedges: int
    faces: int
    face_degrees: dict[int, int]
    boundary_loops: int
    components: int
    euler_characteristic: int
    genus: int
    vertex_degree_min: int
    vertex_degree_mean: float
    vertex_degree_max: int
    kind: str
    topology_bytes: int
    attribute_bytes: int
    build_seconds: float

    def as_dict(self) -> dict[str, Any]:
        """The same as a dictionary of plain numbers."""
        return asdict(self)

    def rows(self) -> list[tuple[str, str]]:
        """Label and value of each line of the table."""
        loops = "none: closed" if self.boundary_loops == 0 else str(self.boundary_loops)
        kinds = ", ".join(f"{_polygon(d)} {n:,}" for d, n in list(self.face_degrees.items())[:6])
        kinds += ", ..." if len(self.face_degrees) > 6 else ""
        return [
            ("vertices", f"{self.vertices:,}"),
            (
                "  interior, boundary, isolated",
                _split(self.interior_vertices, self.boundary_vertices, self.isolated_vertices),
            ),
            ("  degree", f"{self.vertex_degree_min} to {self.vertex_degree_max}, mean {self.vertex_degree_mean:.2f}"),
            ("edges", f"{self.edges:,}"),
            ("halfedges", f"{self.halfedges:,}"),
            ("  interior, exterior", _split(self.interior_halfedges, self.exterior_halfedges)),
            ("faces", f"{self.faces:,}"),
            ("  by degree", kinds or "none"),
            ("boundary loops", loops),
            ("connected components", f"{self.components:,}"),
            ("Euler characteristic", f"{self.euler_characteristic:,}"),
            ("genus", f"{self.genus:,}"),
            ("memory", f"{_size(self.topology_bytes)} connectivity, {_size(self.attribute_bytes)} attributes"),
            ("built in", duration(self.build_seconds)),
        ]

    def __str__(self) -> str:
        width = max(len(label) for label, _ in self.rows())
        return "\n".join(f"{label:<{width}}  {value}" for label, value in self.rows())

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td style='text-align:left'>{html.escape(label).replace('  ', '&emsp;')}</td>"
            f"<td style='text-align:left'>{html.escape(value)}</td></tr>"
            for label, value in self.rows()
        )
        return f"<table><caption>halfmesh.{self.kind}</caption>{rows}</table>"


def _split(*numbers: int) -> str:
    return ", ".join(f"{n:,}" for n in numbers)


def _polygon(degree: int) -> str:
    return {3: "triangles", 4: "quads", 5: "pentagons", 6: "hexagons"}.get(degree, f"{degree}-gons")


def duration(seconds: float) -> str:
    """``1.23 ms``, ``12.3 s``."""
    return f"{1000 * seconds:.3g} ms" if seconds < 0.9995 else f"{seconds:.3g} s"


def _size(n: int) -> str:
    for unit in ("B", "kB", "MB"):
        if n < 1000:
            return f"{n:.3g} {unit}"
        n /= 1000  # type: ignore[assignment]
    return f"{n:.3g} GB"


def _histogram(degrees: NDArray[np.integer]) -> dict[int, int]:
    values, counts = np.unique(degrees, return_counts=True)
    return dict(zip(values.tolist(), counts.tolist(), strict=True))


def summarize(mesh: Asked) -> Summary:
    """Collect the summary of a mesh. O(n)."""
    degrees = mesh.vertex_degrees()[mesh.vertices.indices]
    return Summary(
        vertices=mesh.n_vertices,
        interior_vertices=mesh.n_interior_vertices,
        boundary_vertices=mesh.n_boundary_vertices,
        isolated_vertices=mesh.n_isolated_vertices,
        edges=mesh.n_edges,
        halfedges=mesh.n_halfedges,
        interior_halfedges=mesh.n_interior_halfedges,
        exterior_halfedges=mesh.n_exterior_halfedges,
        faces=mesh.n_faces,
        face_degrees=_histogram(mesh.face_degrees()[mesh.faces.indices]),
        boundary_loops=mesh.n_boundary_loops,
        components=mesh.n_connected_components,
        euler_characteristic=mesh.euler_characteristic,
        genus=mesh.genus,
        vertex_degree_min=int(degrees.min()) if len(degrees) else 0,
        vertex_degree_mean=float(degrees.mean()) if len(degrees) else 0.0,
        vertex_degree_max=int(degrees.max()) if len(degrees) else 0,
        kind=type(mesh).__name__,
        topology_bytes=mesh.topology.nbytes,
        attribute_bytes=sum(t.nbytes for t in (mesh.vertex_data, mesh.halfedge_data, mesh.edge_data, mesh.face_data)),
        build_seconds=mesh.build_seconds,
    )
