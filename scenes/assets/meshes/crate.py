#!/usr/bin/env python3
"""Writes crate.obj: a crate with hard edges, as a game has it. Each of its six sides is a frame of four
quadrilaterals, four walls and a panel that lies deeper; every polygon has its own normal. The sides
are squares of one texture, three a row, unfolded: frame, walls and panel.
Usage, in this folder: python3 crate.py
"""

import pathlib

FILE = pathlib.Path(__file__).parent / "crate.obj"
HALF, FRAME, DEPTH = 1.0, 0.25, 0.1  # half the crate's side; the frame's width; how deep the panel lies
# A side's square in the texture, of 1/3 x 1/2: its place, its size, and the margin to its neighbours.
TILE, MARGIN = (1 / 3, 1 / 2), 1 / 48
# Each side's outward normal, and the direction in which u grows.
SIDES = [
    ((0, 0, 1), (1, 0, 0)), ((0, 0, -1), (-1, 0, 0)), ((1, 0, 0), (0, 0, -1)),
    ((-1, 0, 0), (0, 0, 1)), ((0, 1, 0), (1, 0, 0)), ((0, -1, 0), (1, 0, 0)),
]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


class Writer:
    """Vertices, texture coordinates and normals, each once."""

    def __init__(self):
        self.lists = {"v": [], "vt": [], "vn": []}
        self.faces = []

    def index(self, kind, values):
        row = " ".join(f"{value + 0.0:.7g}" for value in values)
        known = self.lists[kind]
        if row not in known:
            known.append(row)
        return known.index(row) + 1

    def face(self, points, uvs, normal):
        n = self.index("vn", normal)
        corners = [f"{self.index('v', p)}/{self.index('vt', t)}/{n}" for p, t in zip(points, uvs)]
        self.faces.append("f " + " ".join(corners))

    def text(self):
        lines = ["# A crate: crate.py wrote it."]
        for kind, rows in self.lists.items():
            lines += [f"{kind} {row}" for row in rows]
        return "\n".join(lines + self.faces) + "\n"


def side(writer, number, normal, along):
    up = cross(normal, along)
    inner = HALF - FRAME
    # On the unfolded side the walls lie between the frame and the panel.
    reach = HALF + DEPTH
    low = [TILE[0] * (number % 3), TILE[1] * (number // 3)]
    scale = [(TILE[k] - 2 * MARGIN) / (2 * reach) for k in (0, 1)]

    def point(x, y, depth):
        return [x * along[k] + y * up[k] + (HALF - depth) * normal[k] for k in range(3)]

    def uv(x, y):
        return [low[k] + MARGIN + (value + reach) * scale[k] for k, value in enumerate((x, y))]

    def ring(half):
        return [(-half, -half), (half, -half), (half, half), (-half, half)]

    frame, edge, panel = ring(HALF), ring(inner), ring(inner)
    frame_uv, edge_uv, panel_uv = ring(reach), ring(inner + DEPTH), ring(inner)
    inward = [up, [-a for a in along], [-u for u in up], along]
    for k in range(4):
        j = (k + 1) % 4
        writer.face(
            [point(*frame[k], 0), point(*frame[j], 0), point(*edge[j], 0), point(*edge[k], 0)],
            [uv(*frame_uv[k]), uv(*frame_uv[j]), uv(*edge_uv[j]), uv(*edge_uv[k])],
            normal)
        writer.face(
            [point(*edge[k], 0), point(*edge[j], 0), point(*panel[j], DEPTH), point(*panel[k], DEPTH)],
            [uv(*edge_uv[k]), uv(*edge_uv[j]), uv(*panel_uv[j]), uv(*panel_uv[k])],
            inward[k])
    writer.face([point(*p, DEPTH) for p in panel], [uv(*p) for p in panel_uv], normal)


def main():
    writer = Writer()
    for number, (normal, along) in enumerate(SIDES):
        side(writer, number, normal, along)
    FILE.write_text(writer.text())


if __name__ == "__main__":
    main()
