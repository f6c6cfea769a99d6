#!/usr/bin/env python3
"""Writes spot_on_ground.obj: Spot, and a ground under its hooves, as two objects that share one atlas.

Spot's charts lie in the left half of the atlas, the ground in the right half. On a map of 2 N x N
texels Spot has the texels that it has on one of N x N alone.
Usage, in this folder: python3 spot_on_ground.py
"""

import pathlib

FOLDER = pathlib.Path(__file__).parent
MESHES = FOLDER.parent.parent / "meshes"
# The limit surface's hooves reach down to y = -0.73.
GROUND = -0.72
# The ground in world units, longer where the shadow falls, in faces about as large as Spot's.
X, Z, COLUMNS, ROWS = (-1.2, 3.2), (-1.7, 1.9), 24, 20
# Its chart: eight texels and more from Spot's charts and from the map's sides, on 1024 x 512 texels.
U, V = (0.51, 0.99), (0.02, 0.98)


def between(ends, step, steps):
    return ends[0] + (ends[1] - ends[0]) * step / steps


def spot():
    lines = ["o spot"]
    for line in (MESHES / "spot_control_mesh.obj").read_text().splitlines():
        words = line.split()
        if words[0] == "vt":
            line = f"vt {float(words[1]) / 2:.7g} {words[2]}"
        lines.append(line)
    return lines


def ground(vertices, uvs):
    """The grid seen from above, its first corner after that many of Spot's."""
    lines = ["o ground"]
    nodes = [(i, j) for j in range(ROWS + 1) for i in range(COLUMNS + 1)]
    for i, j in nodes:
        lines.append(f"v {between(X, i, COLUMNS):.7g} {GROUND} {between(Z, j, ROWS):.7g}")
    for i, j in nodes:
        lines.append(f"vt {between(U, i, COLUMNS):.7g} {between(V, ROWS - j, ROWS):.7g}")
    for j in range(ROWS):
        for i in range(COLUMNS):
            # Counter-clockwise from above, y up: x to the right, z toward the reader.
            corners = [(i, j + 1), (i + 1, j + 1), (i + 1, j), (i, j)]
            numbers = [1 + k + l * (COLUMNS + 1) for k, l in corners]
            lines.append("f " + " ".join(f"{vertices + n}/{uvs + n}" for n in numbers))
    return lines


def main():
    body = spot()
    count = {word: sum(line.startswith(word + " ") for line in body) for word in ("v", "vt")}
    text = "\n".join(body + ground(count["v"], count["vt"])) + "\n"
    (FOLDER / "spot_on_ground.obj").write_text(text)


if __name__ == "__main__":
    main()
