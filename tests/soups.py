"""Random face lists: soups that are mostly refused, and meshes cut, glued and renumbered out of those of the zoo."""

from __future__ import annotations

from hypothesis import strategies as st

from halfmesh.testing import zoo

SOUND = [s for s in zoo().values() if s.faces and s.twins is None and not s.edges]


def soups(n_vertices=6, max_faces=6):
    """Any lists of small faces over few vertices, now and then with an index that does not exist."""
    vertex = st.integers(-1, n_vertices) | st.integers(0, n_vertices - 1)
    return st.lists(
        st.lists(vertex, max_size=5) | st.lists(vertex, min_size=3, max_size=5, unique=True), max_size=max_faces
    )


@st.composite
def pieces(draw):
    """(faces, n_vertices): a mesh of the zoo, some faces removed, some turned, vertices glued, all renumbered."""
    specimen = draw(st.sampled_from(SOUND))
    faces = [list(face) for face in specimen.faces]
    n = specimen.figures.n_vertices + draw(st.integers(0, 2))
    kept = draw(st.lists(st.sampled_from(range(len(faces))), unique=True, max_size=len(faces)))
    faces = [faces[f] for f in kept] if draw(st.booleans()) else draw(st.permutations(faces))
    for a, b in draw(st.lists(st.tuples(st.integers(0, n - 1), st.integers(0, n - 1)), max_size=2)):
        faces = [[b if v == a else v for v in face] for face in faces]
    for f in draw(st.lists(st.integers(0, max(len(faces) - 1, 0)), max_size=2)) if faces else []:
        faces[f] = faces[f][::-1]
    number = draw(st.permutations(range(n)))
    turns = draw(st.lists(st.integers(0, 6), min_size=len(faces), max_size=len(faces)))
    faces = [
        [number[v] for v in face[k % len(face) :] + face[: k % len(face)]] for face, k in zip(faces, turns, strict=True)
    ]
    return faces, n


def meshes_or_not():
    return pieces() | soups().map(lambda faces: (faces, 6))
