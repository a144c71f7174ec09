"""Arguments from a stream of small ints, so that a test generator can shrink them and any number means something.

Most operators refuse most arguments. So each says by letters in which ways its arguments are to be drawn; the second
may then lie in the ring or the loop of the first. Now and then there is nonsense: no such element, or a deleted one.
"""

from __future__ import annotations

from .rings import EDGES, FACES, VERTICES

APPENDED = ("itself", "bow tie with wire", "cone of one triangle", "isolated vertices")
WEIGHTS = (0.5, 0.0, 1.0, 0.25)


class Stream:
    """The ints, and zeros when they are used up."""

    def __init__(self, ints):
        self.ints = iter(ints)

    def below(self, n):
        return next(self.ints, 0) % n

    def one_of(self, items):
        items = list(items)
        return items[self.below(len(items))]


def arguments(m, operator, ints):
    """The arguments of an operator, as plain ints, lists, bools and floats."""
    stream = Stream(ints)
    way = stream.one_of(operator.ways.split() or [""])
    made = []
    for letter in way:
        candidates = DRAWN[letter](m, made[-1] if made else None, stream)
        made.append(candidates if isinstance(candidates, list) else nonsense_or(m, letter, candidates, stream))
    return made


def nonsense_or(m, letter, candidates, stream):
    """One of the candidates; rarely, or where there is none, any element, living, deleted or missing."""
    if isinstance(candidates, tuple):  # flags, weights and numbers make sense always
        return stream.one_of(candidates)
    candidates = sorted(candidates)
    if candidates and stream.below(24) != 23:
        return stream.one_of(candidates)
    slots = {"v": VERTICES, "g": VERTICES, "u": VERTICES, "e": EDGES, "f": FACES}.get(letter)
    n = 2 * m.slots[EDGES] if slots is None else m.slots[slots]
    return stream.below(n + 3) - 1


# -- one element -----------------------------------------------------------------------------------------------------


def vertices(m, before, stream):
    return set(m.ring)


def open_vertices(m, before, stream):
    return {v for v in m.ring if not m.is_closed(v)}


def neighbors(m, before, stream):
    return m.neighbors(before) if before in m.ring else set()


def halfedges(m, before, stream):
    return set(m.origin)


def edges(m, before, stream):
    return {h >> 1 for h in m.origin}


def faces(m, before, stream):
    return m.faces()


def exterior(m, before, stream):
    return {h for h in m.face if m.is_outside(h)}


def between_faces(m, before, stream):
    return {h for h in m.face if not m.is_outside(h) and not m.is_outside(h ^ 1)}


def beside_small_holes(m, before, stream):
    return {h for h in exterior(m, before, stream) if len(m.loop(h)) == 2}


def gap_or_none(m, before, stream):
    return {-1, *m.gaps(before)} if before in m.ring else {-1}


def in_the_loop(m, before, stream):
    return set(m.loop(before)) if before in m.origin else set()


def after(m, before, stream):
    return {m.next(before)} if before in m.origin else set()


def in_the_ring(m, before, stream):
    return set(m.ring[m.origin[before]]) if before in m.origin else set()


def exterior_in_the_ring(m, before, stream):
    return in_the_ring(m, before, stream) & exterior(m, before, stream)


def exterior_from_the_target(m, before, stream):
    return set(m.gaps(m.target(before))) if before in m.origin else set()


def of_a_face_as_large(m, before, stream):
    if before not in m.origin:
        return set()
    here = m.loop(before)
    ends = {m.origin[h] for h in here}
    large = {f for f in m.faces() if len(m.corners(f)) == len(here) and not ends & set(m.corners(f))}
    return {h for h in m.face if m.face[h] in large}


# -- lists -----------------------------------------------------------------------------------------------------------


def any_halfedges(m, before, stream):
    return [nonsense_or(m, "h", halfedges(m, before, stream), stream) for _ in range(stream.below(5))]


def any_vertices(m, before, stream):
    return [nonsense_or(m, "v", open_vertices(m, before, stream), stream) for _ in range(2 + stream.below(4))]


def around_a_walk(m, before, stream):
    """The vertices of a short walk along edges; a face of them may have to close a gap."""
    chain = walk(m, stream, halfedges(m, before, stream), 2 + stream.below(4))
    return [m.origin[h] for h in chain] + [m.target(h) for h in chain[-1:]]


def walk(m, stream, allowed, n, closing=False):
    """Darts that follow each other, at most `n`; one that must close takes the part that does."""
    if not allowed:
        return []
    chain = [stream.one_of(sorted(allowed))]
    while len(chain) < n:
        if closing and m.target(chain[-1]) in (ends := [m.origin[h] for h in chain]):
            return chain[ends.index(m.target(chain[-1])) :]
        following = [h for h in m.ring[m.target(chain[-1])] if h in allowed and h != chain[-1] ^ 1]
        if not following:
            break
        chain.append(stream.one_of(following))
    return chain


def along_gaps(m, before, stream):
    """A closed chain of exterior darts, if chance finds one."""
    return walk(m, stream, exterior(m, before, stream), 12, closing=True)


def path(m, before, stream):
    return walk(m, stream, between_faces(m, before, stream), 1 + stream.below(4))


def cycle(m, before, stream):
    inner = {h for h in between_faces(m, before, stream) if m.is_closed(m.origin[h]) and m.is_closed(m.target(h))}
    return walk(m, stream, inner, 12, closing=True)


def faces_to_add(m, ints):
    """Up to four lists of vertices, of which most may well be faces."""
    stream = Stream(ints)
    return [stream.one_of((around_a_walk, any_vertices))(m, None, stream) for _ in range(stream.below(5))]


DRAWN = {
    "v": vertices,
    "g": open_vertices,
    "u": neighbors,
    "h": halfedges,
    "e": edges,
    "f": faces,
    "p": gap_or_none,
    "x": exterior,
    "i": exterior,
    "t": between_faces,
    "c": beside_small_holes,
    "l": in_the_loop,
    "n": after,
    "r": in_the_ring,
    "z": exterior_in_the_ring,
    "a": exterior_from_the_target,
    "j": of_a_face_as_large,
    "H": any_halfedges,
    "V": any_vertices,
    "W": around_a_walk,
    "L": along_gaps,
    "P": path,
    "C": cycle,
    "m": lambda m, before, stream: APPENDED,
    "?": lambda m, before, stream: (False, True),
    "w": lambda m, before, stream: WEIGHTS,
    "N": lambda m, before, stream: (1, 3, 0, 20),
    "k": lambda m, before, stream: (-1, 1, 2, 0),
}


def missing_or_deleted(m, operator, args):
    """What speaks against the elements themselves: whatever is named must be there and alive."""
    reasons = set()
    kinds = {
        "v": (VERTICES, 1),
        "V": (VERTICES, 1),
        "h": (EDGES, 2),
        "H": (EDGES, 2),
        "G": (EDGES, 2),
        "e": (EDGES, 1),
        "f": (FACES, 1),
    }
    for letter, arg in zip(operator.takes, args, strict=True):
        if letter in kinds:
            place, times = kinds[letter]
            living = {"v": m.ring, "V": m.ring, "h": m.origin, "H": m.origin, "G": m.origin, "f": m.faces()}.get(letter)
            living = {h >> 1 for h in m.origin} if living is None else living
            for x in arg if isinstance(arg, list) else [arg]:
                if letter == "G" and x < 0:
                    continue
                if not 0 <= x < times * m.slots[place]:
                    reasons.add("missing_element")
                elif x not in living:
                    reasons.add("deleted_element")
    return reasons
