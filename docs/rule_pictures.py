"""Draws the rules of contact points, negative gaps and impacts, as SVG. Nearest places, gaps and times are computed.

usage: rule_pictures.py FOLDER
"""

import math
import pathlib
import sys

from pictures import BLUE, GOLD, INK, RED, SAND, SCALE, TEAL, Picture


def nearest(p, line):
    """The nearest place to p of each segment of a line, as (distance, place, parameter)."""
    found = []
    for a, b in zip(line, line[1:]):
        way = (b[0] - a[0], b[1] - a[1])
        t = ((p[0] - a[0]) * way[0] + (p[1] - a[1]) * way[1]) / (way[0] ** 2 + way[1] ** 2)
        t = min(max(t, 0.0), 1.0)
        place = (a[0] + t * way[0], a[1] + t * way[1])
        found.append((math.dist(p, place), place, t))
    return found


def minima(p, line):
    """The local minima of the distance from p along a line: inside a segment, or at a corner both ways."""
    found = nearest(p, line)
    places = []
    for i, (distance, place, t) in enumerate(found):
        after = found[i + 1] if i + 1 < len(found) else None
        if 0.0 < t < 1.0 or (t == 1.0 and after is not None and after[2] == 0.0):
            places.append((distance, place))
    return places


def gap(picture, p, q, words, shift=(0.12, 0.0), anchor="start"):
    picture.arrow(p, q, RED, both=True, width=2)
    picture.dot(p)
    picture.dot(q)
    middle = ((p[0] + q[0]) / 2 + shift[0], (p[1] + q[1]) / 2 + shift[1])
    picture.text(middle, words, RED, anchor)


def surface(picture, line, color, below=-2.25):
    picture.path(line + [(line[-1][0], below), (line[0][0], below)], color, "none", 0, True, 0.35)
    picture.path(line, closed=False, stroke=INK, width=3)


def vertex_minima(file):
    picture = Picture("A vertex has a point at each local minimum within the margins")
    line = [(-4.0, 1.3), (-1.6, 1.0), (-0.7, -1.2), (0.2, -0.9), (1.2, -1.3), (2.0, 0.9), (4.0, 1.1)]
    vertex, reach = (0.2, 0.3), 1.45
    surface(picture, line, BLUE)
    picture.path([(-0.3, 2.2), vertex, (0.7, 2.2)], SAND, INK, 2, True, 0.75)
    x, y = picture.at(vertex)
    picture.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{reach * SCALE:.1f}" fill="none" stroke="{TEAL}" stroke-dasharray="6 4"/>')
    for distance, place in minima(vertex, line):
        if distance < reach:
            gap(picture, vertex, place, f"{distance:.2f} m", (0.1, -0.12))
        else:
            picture.path([vertex, place], closed=False, stroke=TEAL, dash="4 3")
            picture.text((place[0] + 0.12, place[1] - 0.1), f"{distance:.2f} m: beyond", TEAL)
    picture.text((-3.8, 1.8), "the sum of the margins", TEAL)
    picture.text((0.75, 1.95), "vertex of b")
    picture.text((-3.8, -1.9), "surface of a")
    picture.save(file)


def smallest_feature(file):
    picture = Picture("A point names the smallest feature that holds it")
    line = [(-4.0, -1.2), (-0.4, -0.2), (4.0, -1.4)]
    surface(picture, line, BLUE)
    for vertex in ((-0.35, 0.9), (-2.3, 0.5), (2.0, 0.4)):
        picture.path([(vertex[0] - 0.45, 2.0), vertex, (vertex[0] + 0.45, 2.0)], SAND, INK, 2, True, 0.75)
        distance, place = min(minima(vertex, line))
        gap(picture, vertex, place, f"{distance:.2f} m")
    picture.text((-0.3, -0.95), "edge, in section: two vertices, once", INK, "middle")
    picture.text((-2.4, -1.5), "facet: three vertices", INK, "middle")
    picture.text((2.4, -1.6), "facet: three vertices", INK, "middle")
    picture.save(file)


def flat(p):
    """A place in space as it is drawn."""
    return p[0] + 0.45 * p[1], 0.35 * p[1] + p[2]


def edge_pair(file):
    picture = Picture("Two edges have a point where both insides are nearest")
    a, b = ((-2.4, 0.3, -0.7), (2.2, -0.3, -0.9)), ((-0.5, -2.6, 0.9), (0.5, 2.4, 0.6))
    u, v, w = ([y - x for x, y in zip(*pair)] for pair in (a, b, (b[0], a[0])))
    dot = lambda x, y: sum(i * j for i, j in zip(x, y))
    uu, uv, vv, uw, vw = dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)
    s, t = (uv * vw - vv * uw) / (uu * vv - uv * uv), (uu * vw - uv * uw) / (uu * vv - uv * uv)
    assert 0 < s < 1 and 0 < t < 1
    p, q = ([x + k * y for x, y in zip(start, way)] for start, way, k in ((a[0], u, s), (b[0], v, t)))
    picture.path([flat(a[0]), flat(a[1]), flat((2.0, -2.0, -1.2)), flat((-2.6, -1.4, -1.0))], BLUE, "none", 0, True, 0.4)
    picture.path([flat(b[0]), flat(b[1]), flat((-3.2, 2.2, 1.9)), flat((-3.6, -2.4, 2.0))], SAND, "none", 0, True, 0.5)
    picture.path([flat(x) for x in a], closed=False, width=4)
    picture.path([flat(x) for x in b], closed=False, width=4)
    gap(picture, flat(p), flat(q), f"gap {math.dist(p, q):.2f} m")
    picture.text((-3.5, -0.5), "edge of a")
    picture.text((1.3, 1.6), "edge of b")
    picture.text((-3.8, -2.1), f"weights {1 - s:.2f}, {s:.2f} on a and {1 - t:.2f}, {t:.2f} on b")
    picture.save(file)


def crossed_closed(file):
    picture = Picture("A vertex inside a closed body keeps the side that it came from")
    wall = [(-4.0, 0.55), (4.0, 0.55), (4.0, -0.55), (-4.0, -0.55)]
    picture.path(wall, BLUE, INK, 3, True, 0.35)
    for x, y, words in ((-2.2, 0.25, "shallow"), (1.2, -0.3, "past the middle")):
        vertex = (x, y)
        picture.path([(x - 0.6, 2.0), vertex, (x + 0.6, 2.0)], SAND, INK, 2, True, 0.75)
        gap(picture, vertex, (x, 0.55), f"gap {y - 0.55:.2f} m", (0.65, 0.25))
        picture.text((x, 2.08), words, INK, "middle")
    picture.path([(1.2, -0.3), (1.2, -0.55)], closed=False, stroke=TEAL, dash="4 3")
    picture.text((1.35, -0.95), "nearer, but not the side it came from", TEAL, "middle")
    picture.arrow((3.2, 1.9), (3.2, 1.0), GOLD)
    picture.text((3.05, 1.4), "way in", GOLD, "end")
    picture.text((-3.8, -1.9), "a: a thin closed body, in section")
    picture.save(file)


def crossed_sheet(file):
    picture = Picture("The wrong side of a sheet is found along edges")
    picture.path([(-2.6, 0.0), (2.6, 0.0)], closed=False, stroke=BLUE, width=5)
    right = [(-3.4, 1.6), (-2.2, 1.3), (-1.0, 0.8)]
    wrong = [(0.1, -0.5), (1.2, -0.8), (2.1, -0.55)]
    picture.path(right + wrong, closed=False, stroke=INK, width=2)
    for p in right:
        picture.dot(p, TEAL)
    for p in wrong:
        gap(picture, p, (p[0], 0.0), f"{p[1]:.2f} m", (0.1, -0.05))
    other = [(-2.4, -1.2), (-1.4, -1.5), (-0.4, -1.3)]
    picture.path(other, closed=False, stroke=INK, width=2, dash="5 4")
    for p in other:
        picture.dot(p, TEAL)
    picture.text((-3.9, -1.95), "no edge leads from here through a: no negative gap", TEAL)
    picture.text((-0.25, 0.55), "cut edge", GOLD)
    picture.arrow((-0.3, 0.5), (-0.36, 0.12), GOLD, width=2)
    picture.text((2.7, 0.05), "a: a sheet", BLUE)
    picture.text((-3.9, 2.0), "b, in section")
    picture.save(file)


def passed_edges(file):
    picture = Picture("Edges that have passed each other have a negative gap")
    a = [(-2.6, -1.6), (0.0, 0.45), (2.6, -1.6)]
    b = [(-2.6, 1.9), (0.0, -0.35), (2.6, 1.9)]
    picture.path(a, BLUE, INK, 2, True, 0.45)
    picture.path(b, SAND, INK, 2, True, 0.6)
    gap(picture, a[1], b[1], f"gap {b[1][1] - a[1][1]:.2f} m", (0.6, -0.05))
    picture.arrow((-1.5, -0.1), (-1.5, 0.8))
    picture.text((-1.65, 0.4), "normal", GOLD, "end")
    picture.text((-0.1, -1.3), "a: an edge seen along it", INK, "middle")
    picture.text((0.0, 1.6), "b: an edge across it", INK, "middle")
    picture.text((-3.9, -2.05), "moving b by -gap * normal takes both points together")
    picture.save(file)


def one_crossing(file):
    """Two lines that cross twice: what the curves cut off is one crossing each."""
    picture = Picture("Facets that meet, and what they cut off, are one crossing")
    floor = lambda x: -0.55 + 0.12 * math.sin(1.3 * x)
    line = [(0.2 * i - 4.0, floor(0.2 * i - 4.0)) for i in range(41)]
    surface(picture, line, BLUE)
    body = [(-3.6, 1.9), (-2.9, 0.2), (-2.3, -1.2), (-1.6, -1.0), (-0.9, 0.5), (0.0, 1.0), (0.9, 0.4), (1.5, -0.9), (2.2, -1.1), (2.8, 0.2), (3.5, 1.9)]
    picture.path(body, SAND, INK, 2, True, 0.6)
    inside = [p for p in body if p[1] < floor(p[0])]
    for p in inside:
        picture.dot(p)
    for a, b in zip(body, body[1:]):
        ha, hb = a[1] - floor(a[0]), b[1] - floor(b[0])
        if ha * hb < 0:
            t = ha / (ha - hb)
            picture.dot((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])), GOLD)
    picture.text((-2.0, -1.75), "one crossing", RED, "middle")
    picture.text((1.9, -1.75), "another one", RED, "middle")
    picture.text((0.0, -1.3), "inside: winding number 1", INK, "middle")
    picture.text((-3.9, -2.1), "gold: where an edge meets a facet, points of the intersection curves", GOLD)
    picture.text((0.0, 1.5), "b", INK, "middle")
    picture.save(file)


def thick_enough(file):
    """A vertex in a thin wall: the wall's thickness through it is the longest way out."""
    picture = Picture("Without a last step no way out is longer than the wall is thick")
    low, high, left, right = -0.3, 0.45, -4.0, 3.2
    picture.path([(left, high), (right, high), (right, low), (left, low)], BLUE, INK, 3, True, 0.35)
    vertex = (-0.6, 0.2)
    picture.path([(-2.4, 1.9), vertex, (-0.9, 1.9)], SAND, INK, 2, True, 0.75)
    picture.path([(0.9, -1.7), vertex, (2.2, -1.5)], SAND, INK, 2, True, 0.75)
    gap(picture, vertex, (vertex[0], high), f"gap {vertex[1] - high:.2f} m", (0.12, 0.5))
    picture.path([vertex, (right, vertex[1])], closed=False, stroke=TEAL, dash="6 4")
    picture.text((1.4, 0.62), "along the wall: never", TEAL)
    picture.arrow((-3.3, low), (-3.3, high), GOLD, both=True, width=2)
    picture.text((-3.15, 0.02), f"thick by {high - low:.2f} m", GOLD)
    picture.text((-3.9, -1.9), "edges come in through both sides: the crossing as a whole tells the side")
    picture.save(file)


def way_apart(file):
    """A blade through a plate, no vertex inside; the ways up and down are of the drawn lengths."""
    picture = Picture("No vertex inside: the least translation that parts what has crossed")
    plate, (left, right, low, high) = [(-3.4, 0.3), (3.4, 0.3), (3.4, -0.3), (-3.4, -0.3)], (-0.35, 0.35, -1.0, 1.7)
    picture.path(plate, BLUE, INK, 3, True, 0.35)
    picture.path([(left, low), (right, low), (right, high), (left, high)], SAND, INK, 2, True, 0.75)
    for x in (left, right):
        picture.dot((x, low))
        picture.dot((x, 0.3))
    ways = {"up": 0.3 - low, "down": high + 0.3, "aside": 3.4 + right}
    assert min(ways, key=ways.get) == "up"
    picture.arrow((0.9, low), (0.9, 0.3), RED, width=2)
    picture.text((1.05, -0.6), f"gap -{ways['up']:.2f} m", RED)
    picture.text((-1.0, -1.55), f"down would take {ways['down']:.2f} m, aside {ways['aside']:.2f} m", TEAL)
    picture.text((-3.3, 0.5), "a: a plate", INK)
    picture.text((0.5, 1.5), "b: a blade", INK)
    picture.text((-3.9, -2.05), "points: where the surfaces touch last on that way")
    picture.save(file)


def winding_twice(file):
    """A closed strip whose ends overlap, with the winding number of each region."""
    picture = Picture("A closed body is past itself where it winds twice")
    left = [(-3.6, -1.5), (0.9, -1.3), (1.2, 0.3), (-3.4, 0.3)]
    right = [(3.6, 1.6), (-0.9, 1.2), (-1.0, -0.6), (3.4, -0.4)]
    picture.path(left, BLUE, INK, 2, True, 0.4)
    picture.path(right, BLUE, INK, 2, True, 0.4)
    picture.text((-2.2, -0.7), "1")
    picture.text((2.4, 0.6), "1")
    picture.text((0.1, -0.2), "2", RED, "middle")
    picture.text((-2.6, 1.4), "0", TEAL)
    vertex, line = (-1.0, -0.6), [(1.2, 0.3), (-3.4, 0.3)]
    distance, place = min((d, p) for d, p, _ in nearest(vertex, line))
    gap(picture, vertex, place, f"gap -{distance:.2f} m", (-0.12, 0.0), "end")
    vertex, line = (1.2, 0.3), [(-1.0, -0.6), (3.4, -0.4)]
    distance, place = min((d, p) for d, p, _ in nearest(vertex, line))
    gap(picture, vertex, place, f"gap -{distance:.2f} m", (0.12, 0.0))
    picture.text((-3.9, -2.05), "two arms of one closed body, in section, and winding numbers")
    picture.save(file)


def crossed_itself(file):
    """A sheet over itself with a dent through the lower layer: the fewer vertices are on the wrong side."""
    picture = Picture("A sheet that is past itself: the side with fewer vertices goes back")
    lower = [(-3.8, 0.0), (3.6, 0.0)]
    upper = [(-3.6, 1.3), (-2.5, 1.1), (-1.5, 0.6), (-0.6, -0.5), (0.2, -0.8), (1.0, -0.45), (1.8, 0.6), (2.7, 1.1), (3.6, 1.3)]
    turn = [(3.6 + 0.6 * math.sin(math.pi * i / 12), 0.65 - 0.65 * math.cos(math.pi * i / 12)) for i in range(13)]
    picture.path(lower + turn + list(reversed(upper)), closed=False, stroke=BLUE, width=3)
    for p in upper:
        if p[1] > 0.0:
            picture.dot(p, TEAL)
        else:
            gap(picture, p, (p[0], 0.0), f"{p[1]:.2f} m", (0.0, p[1] / 2 - 0.3), "middle")
    picture.text((-3.8, 1.65), "without a margin; after a step with points these tell the side", TEAL)
    picture.text((-3.9, -1.9), "with a margin it keeps the side that it is on: no gap is negative")
    picture.save(file)


def no_inside(file):
    """A cup that was added as closed, its mouth to the right: a half-line that leaves through it meets nothing."""
    picture = Picture("A closed body with a border is taken as a sheet")
    cup = [(1.6, 1.3), (-2.4, 1.3), (-2.4, -1.3), (1.6, -1.3)]
    picture.path(cup, closed=False, stroke=BLUE, width=4)
    for p in (cup[0], cup[-1]):
        picture.dot(p, GOLD)
    picture.text((1.75, 1.25), "border", GOLD)
    picture.path([(-0.9 + 0.6 * math.cos(math.pi * i / 12), 0.6 * math.sin(math.pi * i / 12)) for i in range(24)], SAND, INK, 2, True, 0.75)
    picture.text((-0.9, -0.05), "no points", TEAL, "middle")
    picture.path([(0.5, 0.0), (3.7, 0.0)], closed=False, stroke=TEAL, dash="6 4")
    picture.path([(0.5, 0.0), (0.5, 2.1)], closed=False, stroke=TEAL, dash="6 4")
    picture.text((2.0, 0.12), "meets it never", TEAL)
    picture.text((0.62, 1.75), "meets it once", TEAL)
    picture.text((-3.9, -2.05), "is this inside? it would hang on the direction, so there is no inside")
    picture.save(file)


def minima_of_both(file):
    """Two boxes over a floor in section: which points are minima of both surfaces."""
    picture = Picture("Which points are minima of both surfaces")
    ground = [(-4.0, -1.0), (-2.4, -1.0), (-0.8, -1.0), (0.8, -1.0), (2.4, -1.0), (4.0, -1.0)]
    surface(picture, ground, BLUE)
    turn, corner = math.radians(9), (1.4, -0.85)
    leaning = [(corner[0] + x * math.cos(turn) - y * math.sin(turn), corner[1] + x * math.sin(turn) + y * math.cos(turn)) for x, y in ((0, 0), (1.7, 0), (1.7, 1.3), (0, 1.3))]
    level = [(-3.3, -0.75), (-1.5, -0.75), (-1.5, 0.7), (-3.3, 0.7)]
    for box in (level, leaning):
        picture.path(box, SAND, INK, 2, True, 0.75)
    for p, minimum in ((level[0], True), (level[1], True), (leaning[0], True), (leaning[1], False)):
        picture.arrow(p, (p[0], -1.0), RED if minimum else TEAL, both=True, width=2)
        picture.dot(p, RED if minimum else TEAL)
    for p, q in (((-0.8, -1.0), level[1]), ((0.8, -1.0), leaning[0])):
        picture.arrow(p, q, TEAL, width=2)
        picture.dot(p, TEAL)
    picture.text((-3.9, 1.9), "minimum of both surfaces", RED)
    picture.text((-3.9, 1.55), "minimum for its vertex alone", TEAL)
    picture.text((-2.4, -1.6), "floor of many facets, in section", INK)
    picture.save(file)


def curves(file):
    """A sheet seen from above and two tubes through it: a closed curve, and one that ends on the border."""
    picture = Picture("Intersection curves are closed or end on a border")
    low, high = (-3.2, -1.7), (1.9, 1.7)
    sheet = [low, (high[0], low[1]), high, (low[0], high[1])]
    picture.path(sheet, BLUE, INK, 3, True, 0.3)
    ring = lambda center, radius, n: [(center[0] + radius * math.cos(2 * math.pi * (i + 0.5) / n), center[1] + radius * math.sin(2 * math.pi * (i + 0.5) / n)) for i in range(n)]
    closed = ring((-1.4, 0.1), 0.95, 10)
    picture.path(closed, SAND, RED, 4, True, 0.6)
    for p in closed:
        picture.dot(p)
    tube = ring((2.0, 0.2), 1.0, 10)
    picture.path(tube, SAND, INK, 1, True, 0.6, "5 4")
    inside = [p for p in tube if p[0] <= high[0]]
    inside.sort(key=lambda p: math.atan2(p[1] - 0.2, p[0] - 2.0) % (2 * math.pi))
    ends = []
    for a, b in zip(tube, tube[1:] + tube[:1]):
        if (a[0] - high[0]) * (b[0] - high[0]) < 0:
            t = (high[0] - a[0]) / (b[0] - a[0])
            ends.append((high[0], a[1] + t * (b[1] - a[1])))
    ends.sort(key=lambda p: -p[1])
    line = [ends[0]] + inside + [ends[1]]
    picture.path(line, closed=False, stroke=RED, width=4)
    for p in line:
        picture.dot(p)
    picture.text((-1.4, 0.05), "closed", RED, "middle")
    picture.text((1.35, 0.15), "open", RED, "middle")
    picture.text((3.05, 0.9), "tube", INK)
    picture.text((2.1, -1.35), "border of the sheet", INK)
    picture.text((-3.1, 1.4), "a: a sheet, from above", INK)
    picture.save(file)


def impact_time(file):
    """Distance over time of three pairs of features, and when each is an impact."""
    picture = Picture("When features with margins meet")
    reach, left, right, low = 1.0, -3.0, 3.4, -1.6
    at = lambda t, d: (left + (right - left) * t, low + 1.6 * d)
    picture.arrow(at(0, 0), at(1.08, 0), INK, width=1.5)
    picture.arrow(at(0, 0), at(0, 2.3), INK, width=1.5)
    picture.path([at(0, reach), at(1, reach)], closed=False, stroke=TEAL, dash="6 4")
    picture.text((left - 0.1, at(0, reach)[1] - 0.05), "margins", TEAL, "end")
    picture.text((left - 0.1, at(0, 2.1)[1]), "distance", INK, "end")
    picture.text(at(1.0, -0.22), "time 1", INK, "middle")
    picture.text(at(0.0, -0.22), "0", INK, "middle")
    pairs = ((2.0, 1.9, reach, INK, "begins beyond: at the margins"), (0.6, 0.9, 0.06, BLUE, "begins nearer: at a tenth of that"), (0.6, -0.4, None, GOLD, "departs: no impact"))
    for begin, speed, stop, color, words in pairs:
        end = 1.0 if stop is None else min(1.0, begin / speed)
        picture.path([at(0, begin), at(end, begin - speed * end)], closed=False, stroke=color, width=3)
        if stop is not None:
            time = (begin - stop) / speed
            picture.dot(at(time, stop))
            picture.text((at(time, stop)[0] + 0.12, at(time, stop)[1] + 0.12), f"{time:.2f}", RED)
    picture.text(at(0.28, 1.65), pairs[0][4], INK)
    picture.text(at(0.30, 0.42), pairs[1][4], BLUE)
    picture.text(at(0.68, 0.68), pairs[2][4], GOLD)
    picture.save(file)


def safe_step(file):
    picture = Picture("A step that stops before the first impact")
    wall, half, start, end, margin = 1.2, 0.35, -2.8, 2.6, 0.3
    picture.path([(wall, -1.8), (wall + 0.15, -1.8), (wall + 0.15, 1.8), (wall, 1.8)], BLUE, INK, 2)
    picture.path([(wall - margin, -1.8), (wall - margin, 1.8)], closed=False, stroke=TEAL, dash="6 4")
    first = (wall - margin - half - start) / (end - start)
    free = min(1.0, 0.999 * first)
    for x, opacity, dash in ((start, 0.9, ""), (start + free * (end - start), 0.55, ""), (end, 0.15, "5 4")):
        picture.path([(x - half, -half), (x + half, -half), (x + half, half), (x - half, half)], SAND, INK, 2, True, opacity, dash)
    picture.arrow((start, -0.8), (end, -0.8), INK, width=1.5)
    picture.text((start, 0.6), "0", INK, "middle")
    picture.text((start + free * (end - start), 0.6), f"{free:.3f}", RED, "middle")
    picture.text((end, 0.6), "1", INK, "middle")
    picture.text((wall - margin - 0.1, 1.6), "sum of the margins", TEAL, "end")
    picture.save(file)


def main():
    folder = pathlib.Path(sys.argv[1])
    drawn = (
        *(vertex_minima, smallest_feature, edge_pair),
        *(one_crossing, crossed_closed, thick_enough, way_apart, crossed_sheet, passed_edges),
        *(winding_twice, crossed_itself, no_inside, curves, impact_time, safe_step),
    )
    for draw in drawn:
        draw(folder / f"{draw.__name__}.svg")
    minima_of_both(folder / "minima.svg")


if __name__ == "__main__":
    main()
