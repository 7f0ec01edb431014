"""Draws the pictures of the page on concepts, as SVG, in the plane: directions, planes, zones and gaps are computed.

usage: pictures.py FOLDER
"""

import math
import pathlib
import sys

INK, BLUE, SAND, RED, TEAL, GOLD = "#262c36", "#3f7fc1", "#e8c87a", "#ff3e14", "#14a0a8", "#d99a00"
WIDTH, HEIGHT, SCALE = 640, 360, 80.0  # pixels, pixels a metre


class Picture:
    def __init__(self, title):
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" '
            f'font-family="DejaVu Sans, sans-serif" font-size="15"><title>{title}</title>',
            '<defs><marker id="tip" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" orient="auto-start-reverse">'
            '<path d="M0 0 10 5 0 10z" fill="context-stroke"/></marker></defs>',
            f'<rect width="{WIDTH}" height="{HEIGHT}" rx="8" fill="#ffffff"/>',
        ]

    @staticmethod
    def at(p):
        return WIDTH / 2 + SCALE * p[0], HEIGHT / 2 - SCALE * p[1]

    def path(self, points, fill="none", stroke=INK, width=2.0, closed=True, opacity=1.0, dash=""):
        way = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(self.at, points))
        kind = "polygon" if closed else "polyline"
        self.parts.append(
            f'<{kind} points="{way}" fill="{fill}" fill-opacity="{opacity}" stroke="{stroke}" stroke-width="{width}" '
            f'stroke-linejoin="round" stroke-dasharray="{dash}"/>'
        )

    def arrow(self, a, b, color=GOLD, both=False, width=3.0):
        (x, y), (u, v) = self.at(a), self.at(b)
        start = ' marker-start="url(#tip)"' if both else ""
        self.parts.append(
            f'<line x1="{x:.1f}" y1="{y:.1f}" x2="{u:.1f}" y2="{v:.1f}" stroke="{color}" stroke-width="{width}" marker-end="url(#tip)"{start}/>'
        )

    def dot(self, p, color=RED):
        x, y = self.at(p)
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{color}" stroke="#ffffff"/>')

    def text(self, p, words, color=INK, anchor="start"):
        x, y = self.at(p)
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" fill="{color}" text-anchor="{anchor}">{words}</text>')

    def save(self, file):
        file.write_text("\n".join(self.parts + ["</svg>\n"]))


def blob(center, radius, corners, dent=0.0, turn=0.0):
    points = []
    for i in range(corners):
        angle = turn + 2 * math.pi * i / corners
        r = radius * (1 + dent * math.cos(3 * angle))
        points.append((center[0] + r * math.cos(angle), center[1] + 0.8 * r * math.sin(angle)))
    return points


def along(n, points):
    return [n[0] * x + n[1] * y for x, y in points]


def contact(a, b):
    """Direction, depth and planes of two convex hulls that overlap: the least overlap, found by trying directions."""
    best = min(
        (max(along(n, a)) - min(along(n, b)), n)
        for n in ((math.cos(t), math.sin(t)) for t in (2 * math.pi * k / 20000 for k in range(20000)))
    )
    depth, n = best
    return n, depth, max(along(n, a)), min(along(n, b))


def place(n, height, side):
    """The point at a height along n, and so far across it."""
    return n[0] * height - n[1] * side, n[1] * height + n[0] * side


def clip(points, n, low, high):
    """The part of a polygon in the slab."""
    for sign, limit in ((1.0, low), (-1.0, -high)):
        kept, count = [], len(points)
        for i in range(count):
            p, q = points[i], points[(i + 1) % count]
            u, v = sign * along(n, [p])[0] - limit, sign * along(n, [q])[0] - limit
            if u >= 0:
                kept.append(p)
            if (u >= 0) != (v >= 0):
                t = u / (u - v)
                kept.append((p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])))
        points = kept
    return points


A = blob((-1.0, -0.2), 1.5, 13, turn=0.1)
B = blob((1.15, 0.35), 1.25, 11, turn=0.25)


def direction(file):
    n, depth, high, low = contact(A, B)
    picture = Picture("Direction, depth and slab")
    picture.path([place(n, low, -2.6), place(n, low, 2.6), place(n, high, 2.6), place(n, high, -2.6)], TEAL, "none", 0, True, 0.15)
    picture.path(A, BLUE, INK, 2, True, 0.75)
    picture.path(B, SAND, INK, 2, True, 0.75)
    for height, name in ((high, "plane of a"), (low, "plane of b")):
        picture.path([place(n, height, -2.6), place(n, height, 2.6)], closed=False, stroke=TEAL, dash="6 4")
        shift = 0.12 if height == high else -0.12
        picture.text(place(n, height + shift, -1.95), name, TEAL, "start" if height == high else "end")
    picture.arrow(place(n, high, 1.15), place(n, high + 0.9, 1.15))
    picture.text(place(n, high + 1.0, 1.15), "n", GOLD)
    picture.arrow(place(n, low, -1.3), place(n, high, -1.3), RED, both=True, width=2)
    picture.text(place(n, high + 0.12, -1.36), f"d = {depth:.2f} m", RED)
    picture.text((-2.0, -0.2), "a", "#ffffff")
    picture.text((1.6, 0.4), "b")
    picture.save(file)


def zones(file):
    n, _, high, low = contact(A, B)
    picture = Picture("Impact zones")
    picture.path(A, BLUE, INK, 2, True, 0.35)
    picture.path(B, SAND, INK, 2, True, 0.35)
    for body, color, height, name in ((A, BLUE, low, "zone of a"), (B, SAND, high, "zone of b")):
        part = clip(body, n, low, high)
        picture.path(part, color, INK, 2, True, 0.95)
        across = along((-n[1], n[0]), part)
        picture.path([place(n, height, min(across)), place(n, height, max(across))], closed=False, stroke=TEAL, width=6)
        end = place(n, height, min(across) - 0.18)
        picture.text(end, name, TEAL, "end" if height == low else "start")
    for height in (high, low):
        picture.path([place(n, height, -2.6), place(n, height, 2.6)], closed=False, stroke=TEAL, width=1, dash="6 4")
    picture.save(file)


def carried(file):
    picture = Picture("The carried direction")
    cloth = [(x / 10, -0.75 - 0.85 * math.exp(-((x / 10) ** 2) / 0.55) + 0.75) for x in range(-30, 31)]
    picture.path(cloth, closed=False, stroke=BLUE, width=4)
    ball = [(0.62 * math.cos(t), -0.18 + 0.62 * math.sin(t)) for t in (2 * math.pi * k / 60 for k in range(60))]
    picture.path(ball, SAND, INK, 2, True, 0.9)
    picture.path([(0.0, 1.95), (0.0, 0.5)], closed=False, stroke=INK, width=1.5, dash="5 4")
    picture.text((0.1, 1.75), "the way it came in")
    picture.arrow((0.0, -0.18), (0.0, 0.95))
    picture.text((0.12, 0.75), "carried: back out above", GOLD)
    picture.arrow((0.0, -0.18), (0.0, -1.35), RED, width=2)
    picture.text((0.12, -1.35), "smallest: down, through the cloth", RED)
    picture.text((-2.9, -0.3), "slack cloth", BLUE)
    picture.save(file)


def points(file):
    margin = 0.3
    picture = Picture("Margins and a contact point")
    upper = [(-3.2, 1.5), (-1.2, 1.0), (0.1, 0.22), (1.4, 1.1), (3.2, 1.3)]
    lower = [(-3.2, -0.6), (-1.0, -0.35), (1.2, -0.3), (3.2, -0.7)]
    for line, color in ((upper, SAND), (lower, BLUE)):
        way = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(picture.at, line))
        picture.parts.append(
            f'<polyline points="{way}" fill="none" stroke="{color}" stroke-opacity="0.35" stroke-width="{2 * margin * SCALE}" '
            'stroke-linejoin="round"/>'
        )
        picture.path(line, closed=False, stroke=INK, width=3)
    tip, (p, q) = upper[2], (lower[1], lower[2])
    way = (q[0] - p[0], q[1] - p[1])
    t = ((tip[0] - p[0]) * way[0] + (tip[1] - p[1]) * way[1]) / (way[0] ** 2 + way[1] ** 2)
    foot = (p[0] + t * way[0], p[1] + t * way[1])
    gap = math.dist(tip, foot)
    picture.arrow(foot, tip, RED, both=True, width=2)
    picture.dot(tip)
    picture.dot(foot)
    picture.text((tip[0] + 0.2, -0.08), f"gap {gap:.2f} m", RED)
    n = ((tip[0] - foot[0]) / gap, (tip[1] - foot[1]) / gap)
    picture.arrow((-0.45, foot[1]), (-0.45 + 0.9 * n[0], foot[1] + 0.9 * n[1]))
    picture.text((-0.95, 0.45), "normal", GOLD, "end")
    picture.text((2.0, 0.55), "margin of b", INK)
    picture.text((2.1, -1.15), "margin of a", INK)
    picture.text((tip[0] + 0.15, 0.62), "vertex", INK)
    picture.text((foot[0] - 0.6, -0.92), f"on the edge: weights {1 - t:.2f}, {t:.2f}", INK)
    picture.save(file)


def motion(file):
    picture = Picture("Motion between two steps")
    picture.path([(0.3, -2.0), (0.42, -2.0), (0.42, 2.0), (0.3, 2.0)], BLUE, INK, 2)
    start, end, half = -2.6, 2.4, 0.35
    time = (0.3 - half - start) / (end - start)
    for x, opacity, dash in ((start, 0.9, ""), (end, 0.15, "5 4"), (start + time * (end - start), 0.5, "")):
        box = [(x - half, -half), (x + half, -half), (x + half, half), (x - half, half)]
        picture.path(box, SAND, INK, 2, True, opacity, dash)
    picture.arrow((start, -0.75), (end, -0.75), INK, width=1.5)
    picture.dot((0.3, -half))
    picture.dot((0.3, half))
    picture.text((start, 0.6), "last step", INK, "middle")
    picture.text((end, 0.6), "positions set", INK, "middle")
    picture.text((0.55, 1.4), f"first impact at {time:.2f} of the way", RED)
    picture.save(file)


def main():
    folder = pathlib.Path(sys.argv[1])
    for draw in (direction, zones, carried, points, motion):
        draw(folder / f"{draw.__name__}.svg")


if __name__ == "__main__":
    main()
