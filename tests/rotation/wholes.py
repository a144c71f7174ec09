"""Whole components and whole meshes, on rings."""

from __future__ import annotations

from .rings import EDGES, FACES, OUTSIDE, VERTICES


def reverse_component(m, v):
    """Seen from behind: what arrived leaves, and counter-clockwise is clockwise."""
    part = m.component(v)
    darts = [h for h in m.origin if m.origin[h] in part]
    faces = {m.face[h] for h in darts} - {OUTSIDE}
    shown = {f: m.prev(m.side(f)) for f in faces}
    turned = {h: m.target(h) for h in darts}
    for u in part:
        m.ring[u] = [h ^ 1 for h in reversed(m.ring[u])]
    m.origin.update(turned)
    m.shown_in.update(shown)
    return 0


def remove_component(m, v):
    part = m.component(v)
    for h in [h for h in m.origin if m.origin[h] in part]:
        del m.origin[h], m.face[h]
    for u in part:
        del m.ring[u]
    return 0


def append(m, other):
    """The slots of the other mesh after those of this one, the deleted among them."""
    v, e, f = m.slots
    m.ring.update({u + v: [h + 2 * e for h in ring] for u, ring in other.ring.items()})
    m.origin.update({h + 2 * e: u + v for h, u in other.origin.items()})
    m.face.update({h + 2 * e: g if g == OUTSIDE else g + f for h, g in other.face.items()})
    for kind in (VERTICES, EDGES, FACES):
        m.slots[kind] += other.slots[kind]
    return v


def compact(m):
    """The living move together, in their order."""
    vertex = {v: k for k, v in enumerate(sorted(m.ring))}
    edge = {e: k for k, e in enumerate(sorted({h >> 1 for h in m.origin}))}
    face = {f: k for k, f in enumerate(sorted(m.faces()))} | {OUTSIDE: OUTSIDE}

    def dart(h):
        return 2 * edge[h >> 1] + h % 2

    m.ring = {vertex[v]: [dart(h) for h in ring] for v, ring in m.ring.items()}
    m.origin = {dart(h): vertex[v] for h, v in m.origin.items()}
    m.face = {dart(h): face[f] for h, f in m.face.items()}
    m.slots = [len(vertex), len(edge), len(face) - 1]
    return vertex, edge, face
