"""Many vertices and many faces at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from halfmesh.core.adding import Refused, add_faces
from halfmesh.core.construction import Defective, construct
from halfmesh.core.facelist import FaceList, as_face_list
from halfmesh.core.operators.building import try_add_vertices
from halfmesh.core.statuses import DELETED_ELEMENT, REASONS, TOO_LARGE
from halfmesh.core.topology import DELETED, FACE_SLOTS, LIMIT, VERTEX_SLOTS
from halfmesh.errors import InvalidMeshError, StaleElementError, TopologyError
from halfmesh.mesh.editing.base import Base
from halfmesh.mesh.elements import Element, Vertex
from halfmesh.mesh.positions import as_points

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Bulk"]


class Bulk(Base):
    """Building in bulk: at the speed of ``Mesh(faces, points)``, on a mesh that is there."""

    def add_vertices(self, points: ArrayLike | int) -> NDArray[np.int64]:
        """Add isolated vertices.

        Parameters
        ----------
        points : (n, 3) or (n, 2) array_like of float, or int
            Their positions, which needn't be finite, as in ``Mesh(faces, points)``; or how many, at zero.

        Returns
        -------
        ndarray of int64, shape (n,)
            Their indices, which are the last ones.

        Raises
        ------
        InvalidMeshError
            The points are no such array.

        Notes
        -----
        V + n, components + n. O(n), amortised.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> mesh.add_vertices([[0, 0, 2], [1, 0, 2]])
        array([8, 9])
        >>> mesh.points[9].tolist()
        [1.0, 0.0, 2.0]
        """
        positions = None if _is_number(points) else as_points(points)
        n = int(points) if positions is None else len(positions)  # type: ignore[arg-type]
        if n < 0:
            raise InvalidMeshError(f"can't add {n} vertices", reason="bad_count")
        first = self._run(try_add_vertices, n, n) if n <= LIMIT else -TOO_LARGE
        if first < 0:
            self._refuse("add", first, ("vertices,", n))
        if positions is not None:
            self.vertex_data._put("points", first, positions)
            self.has_points = True
        return np.arange(first, first + n)

    def add_faces(self, faces: Any) -> NDArray[np.int64]:
        """Add many faces over vertices that are there: all, or none.

        Parameters
        ----------
        faces : (n, k) array_like of int, list of lists, or tuple (indices, offsets)
            The vertices of each, counter-clockwise, as in ``Mesh(faces)``.

        Returns
        -------
        ndarray of int64, shape (n,)
            Their indices, which are the last ones, in the order of the list.

        Raises
        ------
        InvalidMeshError
            The faces by themselves can't be held; ``error.elements`` names all that are wrong, by their row.
        TopologyError
            They can, but not together with what is there: naming the first one, for the reason that `add_face` has.
        StaleElementError, ElementError
            A vertex was deleted; a handle is of another mesh.

        Notes
        -----
        What comes out is what adding them one by one gives, except that on a mesh without edges several fans at one
        vertex are in the order of their lowest faces, as in ``Mesh(faces)``. Their order never decides whether they can
        be added.

        F + n. On a mesh without edges this is as quick as building it. Otherwise O(sum of the degrees of their
        corners), and O(mesh) where the mesh is not much larger than what is added: 50 to 200 ns a triangle in coherent
        order. Very many faces (200,000 on two threads, 400,000 on one) over twice as many vertices at most are sewn on
        by all threads, in one and a half to four times the time that building takes a face, if they are in shuffled
        order or most of their vertices are new.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([], n_vertices=5)
        >>> mesh.add_faces([[0, 1, 2], [2, 1, 3]])
        array([0, 1])
        >>> mesh.add_faces([[3, 1, 4]])
        array([2])
        >>> mesh
        <Mesh: 5 vertices, 7 edges, 3 faces, with boundary>
        """
        counts = self._t.counts
        first = counts[FACE_SLOTS]
        face_list = as_face_list(self._rows(faces), n_vertices=counts[VERTEX_SLOTS])
        if face_list.n_faces:
            try:
                add_faces(self._topology, face_list)
            except Defective:
                from halfmesh.core.diagnosis import explain

                raise explain(face_list) from None
            except Refused as refusal:
                raise self._refusal(face_list, refusal) from None
        return np.arange(first, first + face_list.n_faces)

    def _rows(self, faces: Any) -> Any:
        """Lists of handles as lists of ints; whatever else, as it is."""
        of_lists = isinstance(faces, list) and faces and isinstance(faces[0], list | tuple)
        if of_lists and any(isinstance(v, Element) for v in faces[0]):
            return [[self._index(Vertex, v) for v in row] for row in faces]
        return faces

    def _refusal(self, faces: FaceList, refusal: Refused) -> Exception:
        begins = faces.begins()
        corners = faces.corners[begins[refusal.row] : begins[refusal.row + 1]].tolist()
        name, sentence = REASONS[refusal.code]
        if refusal.code == DELETED_ELEMENT:
            v = next(v for v in corners if self._t.vertex_halfedge[v] == DELETED)
            return StaleElementError(f"can't add face {refusal.row} of the list: vertex {v} was deleted")
        try:
            construct(faces)
        except Defective:
            from halfmesh.core.diagnosis import explain

            return explain(faces)
        return TopologyError(
            f"can't add face {refusal.row} of the list, with vertices {corners}, to what is there: {sentence}; "
            "none of them was added",
            reason=name,
        )


def _is_number(points: Any) -> bool:
    return isinstance(points, int | np.integer) and not isinstance(points, bool)
