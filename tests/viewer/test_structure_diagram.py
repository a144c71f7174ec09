"""The picture that explains the structure: complete, readable, and the same every time."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from itertools import combinations

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.errors import ElementError, PreconditionError
from halfmesh.viewer import FIGURE_FACES, FIGURE_POINTS, save_structure_diagram, structure_diagram
from halfmesh.viewer.arrows import segments_of
from halfmesh.viewer.board import text_width
from halfmesh.viewer.layout import lay_out
from halfmesh.viewer.legend import entries
from viewer.standin import StandIn, StandInTopology, stand_in

SVG = "{http://www.w3.org/2000/svg}"


def figure() -> StandIn:
    return stand_in(FIGURE_FACES, FIGURE_POINTS)


def triangle() -> StandIn:
    return stand_in([[0, 1, 2]], [[0, 0], [4, 0], [1.5, 3]])


def fan(n: int = 7) -> StandIn:
    rim = [[math.cos(math.tau * i / n), math.sin(math.tau * i / n)] for i in range(n)]
    return stand_in([[0, i + 1, (i + 1) % n + 1] for i in range(n)], [[0, 0], *rim])


def grid(n: int, m: int) -> StandIn:
    corner = lambda i, j: j * (n + 1) + i  # noqa: E731
    faces = [
        [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)] for j in range(m) for i in range(n)
    ]
    return stand_in(faces, [[i, j] for j in range(m + 1) for i in range(n + 1)])


READABLE = [figure, triangle, fan, lambda: grid(3, 2), lambda: grid(5, 4)]


def groups(svg: str, kind: str) -> list[ET.Element]:
    return [g for g in ET.fromstring(svg).iter(f"{SVG}g") if kind in g.get("class", "").split()]


@pytest.mark.parametrize(("kind", "count"), [("vertex", 8), ("halfedge", 22), ("edge", 11), ("face", 4)])
def test_every_element_is_drawn_once_under_its_index(kind: str, count: int) -> None:
    indices = [int(g.get("data-index", "-1")) for g in groups(structure_diagram(figure()), kind)]
    assert sorted(indices) == list(range(count))


@pytest.mark.parametrize("kind", ["vertex", "halfedge", "face"])
def test_every_element_shows_its_own_number(kind: str) -> None:
    for g in groups(structure_diagram(figure()), kind):
        written = [t.text or "" for t in g.iter(f"{SVG}text")]
        assert len(written) == 1
        assert written[0].split()[-1] == f"{kind[0]}{g.get('data-index')}"


def test_exactly_the_exterior_halfedges_are_dashed() -> None:
    mesh = figure()
    dashed = {
        int(g.get("data-index", "-1"))
        for g in groups(structure_diagram(mesh), "halfedge")
        if any(path.get("stroke-dasharray") for path in g.iter(f"{SVG}path"))
    }
    assert dashed == set(np.flatnonzero(mesh.topology.face == -1).tolist())


@pytest.mark.parametrize("make", READABLE)
def test_no_two_labels_overlap(make) -> None:  # type: ignore[no-untyped-def]
    labels = lay_out(make()).labels
    assert not [(a.text, b.text) for a, b in combinations(labels, 2) if a.box.overlaps(b.box)]


@pytest.mark.parametrize("make", READABLE)
def test_no_label_lies_on_a_line(make) -> None:  # type: ignore[no-untyped-def]
    layout = lay_out(make())
    lines = segments_of(layout.arrows)
    assert not [label.text for label in layout.labels if label.kind != "vertex" and label.box.hits(lines)]


@pytest.mark.parametrize("make", READABLE)
def test_no_label_leaves_the_picture(make) -> None:  # type: ignore[no-untyped-def]
    layout = lay_out(make())
    for label in layout.labels:
        center, half_width, half_height = label.box.center, label.box.half_width, label.box.half_height
        assert half_width < center.real < 830 - half_width, label.text
        assert half_height < center.imag < layout.height - half_height, label.text


@pytest.mark.parametrize("make", READABLE)
def test_no_arrow_touches_a_vertex(make) -> None:  # type: ignore[no-untyped-def]
    layout = lay_out(make())
    for arrow in layout.arrows.halfedges.values():
        ends = (arrow.tail, arrow.tip)
        assert min(abs(end - z) for end in ends for z in layout.place) > 1.5 * layout.size.radius
    bends = [piece for bend in layout.arrows.bends.values() for piece in bend.pieces]
    assert min(abs(end - z) for _, _, end in bends for z in layout.place) > 1.15 * layout.size.radius


def test_every_halfedge_runs_left_of_its_edge_at_the_same_distance() -> None:
    layout = lay_out(figure())
    for h, arrow in layout.arrows.halfedges.items():
        a = layout.place[layout.wiring.origin[h]]
        along = (layout.place[layout.wiring.target(h)] - a).conjugate()
        sides = [((end - a) * along).imag / abs(along) for end in (arrow.tail, arrow.tip)]
        assert sides == pytest.approx([-layout.size.offset] * 2)  # y points down: left is negative


def test_bends_lead_from_each_tip_to_the_tail_of_next() -> None:
    layout = lay_out(figure())
    near = 1.2 * layout.size.gap
    for h, bend in layout.arrows.bends.items():
        following = layout.arrows.halfedges[layout.wiring.next[h]]
        assert abs(bend.start - layout.arrows.halfedges[h].tip) < near
        assert abs(bend.pieces[-1][2] - following.tail) < near


def test_the_words_are_all_there() -> None:
    text = " ".join("".join(t.itertext()) for t in ET.fromstring(structure_diagram(figure())).iter(f"{SVG}text"))
    for word in ["twin h1", "next h2", "prev h8", "origin", "target", "face f0", "boundary loop"]:
        assert word in text
    for code in ["h.twin", "h.next", "h.prev", "h.origin", "h.target", "h.face"]:
        assert code in text


@pytest.mark.parametrize("highlight", range(22))
def test_the_legend_tells_the_links_of_the_highlighted_halfedge(highlight: int) -> None:
    mesh = figure()
    t = mesh.topology
    told = {word: value for _, word, value, _ in entries(lay_out(mesh, highlight=highlight))}
    assert told["h.twin"] == f"h{highlight ^ 1}"
    assert told["h.next"] == f"h{t.next[highlight]}"
    assert told["h.prev"] == f"h{t.prev[highlight]}"
    assert told["h.origin"] == f"v{t.origin[highlight]}"
    assert told["h.target"] == f"v{t.origin[highlight ^ 1]}"
    assert told["h.face"] == (f"f{t.face[highlight]}" if t.face[highlight] >= 0 else "-1")


def test_the_legend_fits_its_columns() -> None:
    longest = max(line for *_, meaning in entries(lay_out(figure())) for line in map(len, meaning))
    assert text_width("x" * longest, 13, em=0.52) < (830 - 46) / 4 - 38


def test_a_closed_mesh_has_no_boundary_loop() -> None:
    points = [[0, 0], [6, 0], [3, 5], [3, 1.8]]
    svg = structure_diagram(stand_in([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], points))
    assert "boundary loop" not in svg
    assert "f0 (outside)" in svg


def test_without_labels_only_the_words_remain() -> None:
    layout = lay_out(figure(), labels=False)
    texts = {label.text for label in layout.labels} - {""}
    assert texts == {"h", "twin", "next", "prev", "origin", "target", "face", "boundary loop"}


def test_the_same_mesh_gives_the_same_text() -> None:
    assert structure_diagram(figure()) == structure_diagram(figure())


def test_coordinates_of_any_size_give_the_same_picture() -> None:
    huge = (1e300 * np.array(FIGURE_POINTS)).tolist()
    assert structure_diagram(stand_in(FIGURE_FACES, huge)) == structure_diagram(figure())


def test_the_file_holds_the_text(tmp_path) -> None:  # type: ignore[no-untyped-def]
    save_structure_diagram(figure(), tmp_path / "figure.svg")
    assert (tmp_path / "figure.svg").read_bytes() == structure_diagram(figure()).encode()


@pytest.mark.parametrize(
    ("faces", "points"),
    [
        ([], []),
        ([], [[0, 0], [1, 1]]),
        ([[0, 1, 2]], [[0, 0], [0, 0], [0, 0]]),
        ([[0, 1, 2]], [[0, 0], [1, 0], [2, 0]]),
        ([[0, 1, 2]], [[0, 0], [0, 1], [1, 0]]),
        ([[0, 1, 2]], [[1e308, 0], [-1e308, 1e308], [0, -1e308]]),
    ],
    ids=["empty", "isolated", "one_place", "one_line", "from_below", "huge"],
)
def test_degenerate_layouts_are_drawn(faces: list[list[int]], points: list[list[float]]) -> None:
    svg = structure_diagram(stand_in(faces, points))
    assert len(groups(svg, "face")) == len(faces)
    assert len(groups(svg, "vertex")) == len(points)
    assert "nan" not in svg
    assert "inf" not in svg


def test_too_many_faces_are_refused_with_the_limit() -> None:
    with pytest.raises(PreconditionError, match=r"61 faces.*up to 60 faces"):
        structure_diagram(grid(61, 1))


def test_a_polygon_of_too_many_sides_is_refused() -> None:
    rim = [[math.cos(math.tau * i / 300), math.sin(math.tau * i / 300)] for i in range(300)]
    with pytest.raises(PreconditionError, match="600 halfedges"):
        structure_diagram(stand_in([list(range(300))], rim))


def test_a_point_without_position_is_refused_by_name() -> None:
    with pytest.raises(PreconditionError, match="vertex 1 "):
        structure_diagram(stand_in([[0, 1, 2]], [[0, 0], [math.nan, 0], [0, 1]]))


@pytest.mark.parametrize("highlight", [-1, 22])
def test_highlighting_no_halfedge_is_refused(highlight: int) -> None:
    with pytest.raises(ElementError, match=str(highlight)):
        structure_diagram(figure(), highlight=highlight)


def wire() -> StandIn:
    """One edge without any face."""
    t = [np.array(c, dtype=np.int32) for c in ([1, 0], [1, 0], [0, 1], [-1, -1], [0, 1], [])]
    return StandIn(StandInTopology(*t), np.array([[0.0, 0, 0], [1, 0, 0]]))


def test_a_wire_edge_turns_around_its_ends() -> None:
    layout = lay_out(wire())
    for bend in layout.arrows.bends.values():
        reach = max(abs(end - layout.place[layout.wiring.target(bend.index)]) for _, _, end in bend.pieces[:-1])
        assert reach == pytest.approx(layout.size.offset)


def test_deleted_elements_are_left_out() -> None:
    mesh = stand_in([[0, 1, 2], [2, 1, 3]], [[0, 0], [1, 0], [0.5, 1], [1.5, 1]])
    t = mesh.topology  # take away face 1, its outer edges 3 and 4, and vertex 3
    exterior = [1, 3, 5]
    t.face[exterior] = -1
    for h in exterior:
        t.next[h] = next(g for g in exterior if t.origin[g] == t.origin[h ^ 1])
        t.prev[t.next[h]] = h
    t.next[6:] = -2
    t.face_halfedge[1] = -2
    t.vertex_halfedge[3] = -2
    mesh.points[3] = math.nan
    svg = structure_diagram(mesh)
    drawn = {kind: [g.get("data-index") for g in groups(svg, kind)] for kind in ("vertex", "halfedge", "edge", "face")}
    assert drawn == {
        "vertex": ["0", "1", "2"],
        "halfedge": ["0", "1", "2", "3", "4", "5"],
        "edge": ["0", "1", "2"],
        "face": ["0"],
    }


@pytest.mark.parametrize("make", READABLE)
def test_arrows_that_follow_each_other_do_not_cross(make) -> None:  # type: ignore[no-untyped-def]
    layout = lay_out(make())

    def is_left(a: complex, b: complex, z: complex) -> bool:
        return ((z - a) * (b - a).conjugate()).imag < 0

    for h, one in layout.arrows.halfedges.items():
        two = layout.arrows.halfedges[layout.wiring.next[h]]
        parted = is_left(one.tail, one.tip, two.tail) == is_left(one.tail, one.tip, two.tip)
        assert parted or is_left(two.tail, two.tip, one.tail) == is_left(two.tail, two.tip, one.tip)


def test_the_real_mesh_gives_the_same_picture() -> None:
    mesh = hm.Mesh(FIGURE_FACES, FIGURE_POINTS)
    mesh.check()
    assert structure_diagram(mesh) == structure_diagram(figure())


def test_wire_and_isolated_vertices_of_a_mesh_are_drawn() -> None:
    mesh = hm.Mesh([[0, 1, 2]], [[0, 0], [2, 0], [1, 2], [3, 1], [4, 2], [4, 0]], edges=[[1, 3], [3, 4]])
    svg = structure_diagram(mesh)
    assert len(groups(svg, "vertex")) == 6
    assert len(groups(svg, "halfedge")) == 10
