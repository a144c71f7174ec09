"""Pictures of meshes.

:func:`structure_diagram` draws a small mesh with all of its halfedges and links, as SVG text and without any
dependency: the figure that explains the structure. :func:`plot` hands the faces of any mesh to matplotlib,
:func:`plot_polygons` colors them by their number of sides.
"""

from __future__ import annotations

from halfmesh.viewer.diagram import save_structure_diagram, structure_diagram
from halfmesh.viewer.example_patch import FIGURE_FACES, FIGURE_POINTS
from halfmesh.viewer.plotting import plot
from halfmesh.viewer.polygons import plot_polygons, save_polygons_plot

__all__ = [
    "FIGURE_FACES",
    "FIGURE_POINTS",
    "plot",
    "plot_polygons",
    "save_polygons_plot",
    "save_structure_diagram",
    "structure_diagram",
]
