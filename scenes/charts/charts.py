#!/usr/bin/env python3
"""Cuts a closed mesh into charts and lays them out anew: meshes and studies of atlases as they are met.

  python3 charts.py cut MESH.obj --charts 64 --margin 1 --out cut.obj
  python3 charts.py series FOLDER     # all cases, a mesh and a study each; then: gnomon run FOLDER/*.toml

The cage is refined once (Catmull & Clark), which leaves its limit surface as it is. Charts are the faces
nearest to seeds that lie far from each other; what is no disc is cut open. Every chart is flattened with as
little distortion as leaves its faces convex (Garanzha and others 2021), and all are packed, with one scale,
in rows. Needs NumPy. The same numbers in, the same file out on one machine.
"""

import argparse
import heapq
import pathlib

import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent
TEXELS = 512  # a side of the map that margins are counted on


# ---- meshes: points, and faces as tuples of them


def read_obj(path):
    points, faces = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            points.append([float(word) for word in words[1:4]])
        elif words and words[0] == "f":
            faces.append(tuple(int(word.split("/")[0]) - 1 for word in words[1:]))
    return np.array(points), faces


def edges_of(faces):
    """The faces at each edge, with the edge's place in them."""
    edges = {}
    for f, face in enumerate(faces):
        for i, a in enumerate(face):
            b = face[(i + 1) % len(face)]
            edges.setdefault((min(a, b), max(a, b)), []).append((f, i))
    return edges


def refined(points, faces):
    """One step of Catmull and Clark on a closed cage."""
    edges = edges_of(faces)
    middles = np.array([points[list(face)].mean(axis=0) for face in faces])
    number = {edge: len(points) + len(faces) + k for k, edge in enumerate(edges)}
    on_edges = np.array([(points[a] + points[b] + middles[[f for f, _ in sides]].sum(axis=0)) / 4
                         for (a, b), sides in edges.items()])
    valence = np.zeros(len(points))
    sums = np.zeros((2, len(points), 3))
    for (a, b), sides in edges.items():
        for p in (a, b):
            valence[p] += 1
            sums[0, p] += (points[a] + points[b]) / 2
    for face, middle in zip(faces, middles):
        sums[1, list(face)] += middle
    n = valence[:, None]
    moved = (sums[1] / n + 2 * sums[0] / n + (n - 3) * points) / n
    quads = []
    for f, face in enumerate(faces):
        around = [number[min(a, b), max(a, b)] for a, b in zip(face, face[1:] + face[:1])]
        for i, p in enumerate(face):
            quads.append((p, around[i], len(points) + f, around[i - 1]))
    return np.concatenate([moved, middles, on_edges]), quads


# ---- charts


def charts_of(points, faces, edges, count):
    """The chart of each face: that of the nearest of `count` seeds, over the faces' middles."""
    if count >= len(faces):
        return np.arange(len(faces))
    middles = np.array([points[list(face)].mean(axis=0) for face in faces])
    beside = [[] for _ in faces]
    for sides in edges.values():
        for f, _ in sides:
            beside[f] += [g for g, _ in sides if g != f]
    chart = np.full(len(faces), -1)
    distance = np.full(len(faces), np.inf)
    seed = int(np.argmax(np.linalg.norm(middles - middles.mean(axis=0), axis=1)))
    k = 0
    while k < count or np.isinf(distance).any():  # each part of the mesh has a chart at least
        distance[seed], chart[seed] = 0, k
        queue = [(0.0, seed)]
        while queue:
            near, f = heapq.heappop(queue)
            if near > distance[f]:
                continue
            for g in beside[f]:
                far = near + np.linalg.norm(middles[f] - middles[g])
                if far < distance[g]:
                    distance[g], chart[g] = far, k
                    heapq.heappush(queue, (far, g))
        seed = int(np.argmax(distance))
        k += 1
    return np.unique(chart, return_inverse=True)[1]


def tips_joined(points, inside):
    """Edges to cut a closed surface along: paths that join eight places far from each other."""
    beside = {}
    for a, b in inside:
        length = np.linalg.norm(points[a] - points[b])
        beside.setdefault(a, []).append((b, length))
        beside.setdefault(b, []).append((a, length))
    cut, tips = set(), [max(beside, key=lambda p: (np.linalg.norm(points[p] - points[list(beside)].mean(axis=0)), p))]
    for _ in range(8):
        distance = dict.fromkeys(tips, 0.0)
        before = {}
        queue = [(0.0, p) for p in tips]
        while queue:
            near, p = heapq.heappop(queue)
            if near > distance[p]:
                continue
            for q, length in beside[p]:
                if near + length < distance.get(q, np.inf):
                    distance[q], before[q] = near + length, p
                    heapq.heappush(queue, (near + length, q))
        p = max(distance, key=lambda q: (distance[q], q))
        while p in before:
            cut.add((min(p, before[p]), max(p, before[p])))
            tips.append(p)
            p = before[p]
    return cut


def disc_of(points, faces, edges, members):
    """A chart's corners as points of a disc: numbers for each face's corners, and the 3D point of each."""
    inside = [edge for edge, sides in edges.items() if len(sides) == 2 and all(f in members for f, _ in sides)]
    # All inner edges are cut but those of a tree over the faces; then ends of cuts are glued again.
    start = min(members)
    joined, reached, queue = set(), {start}, [start]
    across = {}
    for edge in inside:
        (f, _), (g, _) = edges[edge]
        across.setdefault(f, []).append((g, edge))
        across.setdefault(g, []).append((f, edge))
    for f in queue:
        for g, edge in across.get(f, []):
            if g not in reached:
                reached.add(g)
                joined.add(edge)
                queue.append(g)
    cut = {edge for edge in inside if edge not in joined}
    around = {}
    border = 0
    for edge, sides in edges.items():
        if any(f in members for f, _ in sides) and (edge in cut or edge not in joined):
            border += edge not in cut
            for p in edge:
                around.setdefault(p, set()).add(edge)
    if border == 0:
        cut = tips_joined(points, inside)
    else:
        ends = [p for p, cuts in around.items() if len(cuts) == 1]
        while ends:
            p = ends.pop()
            for edge in list(around[p]):
                if edge in cut and len(around[p]) == 1:
                    cut.discard(edge)
                    for q in edge:
                        around[q].discard(edge)
                        if len(around[q]) == 1:
                            ends.append(q)
    parent = {(f, p): (f, p) for f in members for p in faces[f]}

    def root(corner):
        while parent[corner] != corner:
            parent[corner] = parent[parent[corner]]
            corner = parent[corner]
        return corner

    for edge in inside:
        if edge not in cut:
            (f, _), (g, _) = edges[edge]
            for p in edge:
                parent[root((f, p))] = root((g, p))
    numbers, corners = {}, []
    for f in sorted(members):
        corners.append([numbers.setdefault(root((f, p)), len(numbers)) for p in faces[f]])
    place = np.zeros((len(numbers), 3))
    for f, corner in zip(sorted(members), corners):
        place[corner] = points[list(faces[f])]
    return place, corners


def border_of(corners):
    """The disc's border, corner by corner."""
    sides = {(a, b) for face in corners for a, b in zip(face, face[1:] + face[:1])}
    after = {a: b for a, b in sides if (b, a) not in sides}
    loop = [min(after)]
    while after[loop[-1]] != loop[0]:
        loop.append(after[loop[-1]])
    assert len(loop) == len(after), "a chart that is no disc"
    return loop


def crosses_itself(outline):
    a, b = outline, np.roll(outline, -1, axis=0)

    def side(p, q, r):
        return np.sign((q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0]))

    p, q, r, s = a[:, None], b[:, None], a[None], b[None]
    meet = (side(p, q, r) * side(p, q, s) < 0) & (side(r, s, p) * side(r, s, q) < 0)
    return bool(meet.any())


def flattened(place, corners):
    """Places in the plane, in the world's lengths: the map of least distortion whose faces stay convex."""
    loop = border_of(corners)
    # First on a circle, every inner point the mean of its neighbours (Tutte 1963).
    count = len(place)
    matrix = np.eye(count)
    on_border = np.zeros(count, bool)
    on_border[loop] = True
    for face in corners:
        for i, a in enumerate(face):
            for b in face[:i] + face[i + 1:]:
                if not on_border[a]:
                    matrix[a, a] += 1
                    matrix[a, b] -= 1
    matrix[~on_border] -= np.eye(count)[~on_border]
    lengths = np.linalg.norm(place[np.roll(loop, -1)] - place[loop], axis=1)
    angle = 2 * np.pi * np.concatenate([[0], np.cumsum(lengths)[:-1]]) / lengths.sum()
    right = np.zeros((count, 2))
    right[loop] = lengths.sum() / (2 * np.pi) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    at = np.linalg.solve(matrix, right)
    # Every corner of a face with its two neighbours is a triangle that must not turn over.
    triples = np.array([[face[(i + 1) % len(face)], face[i], face[i - 1]]
                        for face in corners for i in range(len(face))])
    u, v = place[triples[:, 0]] - place[triples[:, 1]], place[triples[:, 2]] - place[triples[:, 1]]
    length = np.linalg.norm(u, axis=1)
    along = (u * v).sum(axis=1) / length
    high = np.maximum(np.sqrt(np.maximum((v * v).sum(axis=1) - along ** 2, 0)), 1e-3 * length)
    area = length * high
    weight = area / area.sum()

    def energy(x, delta):
        """tr JᵀJ / χ + (det² + 1) / χ with χ = (det + √(det² + δ²)) / 2, and its gradient."""
        x = x.reshape(-1, 2)
        e, f = x[triples[:, 0]] - x[triples[:, 1]], x[triples[:, 2]] - x[triples[:, 1]]
        j1 = e / length[:, None]
        j2 = (f - (along / length)[:, None] * e) / high[:, None]
        det = j1[:, 0] * j2[:, 1] - j1[:, 1] * j2[:, 0]
        square = np.sqrt(det ** 2 + delta ** 2)
        # Without the loss of digits where det is far below 0.
        chi = np.where(det > 0, 0.5 * (det + square), 0.5 * delta ** 2 / np.maximum(square - det, 1e-300))
        top = (j1 ** 2).sum(axis=1) + (j2 ** 2).sum(axis=1) + det ** 2 + 1
        slope = 2 * det / chi - top / chi ** 2 * 0.5 * (1 + det / np.maximum(square, 1e-300))
        g1 = weight[:, None] * (2 * j1 / chi[:, None] + slope[:, None] * np.stack([j2[:, 1], -j2[:, 0]], axis=1))
        g2 = weight[:, None] * (2 * j2 / chi[:, None] + slope[:, None] * np.stack([-j1[:, 1], j1[:, 0]], axis=1))
        to_f = g2 / high[:, None]
        to_e = g1 / length[:, None] - (along / length / high)[:, None] * g2
        gradient = np.zeros_like(x)
        np.add.at(gradient, triples[:, 0], to_e)
        np.add.at(gradient, triples[:, 2], to_f)
        np.add.at(gradient, triples[:, 1], -to_e - to_f)
        return float((weight * top / chi).sum()), gradient.ravel(), float(det.min())

    best = None
    for delta in (0.1, 0.03, 0.01):
        x, pairs = at.ravel().copy(), []
        value, gradient, least = energy(x, delta)
        for step in range(120):
            way = gradient.copy()  # L-BFGS (Nocedal 1980)
            kept = []
            for s, y, r in reversed(pairs):
                a = r * (s @ way)
                way -= a * y
                kept.append(a)
            if pairs:
                s, y, r = pairs[-1]
                way *= 1 / (r * (y @ y))
            else:
                way *= 0.01 * np.abs(x).max() / max(np.abs(way).max(), 1e-300)
            for (s, y, r), a in zip(pairs, reversed(kept)):
                way += s * (a - r * (y @ way))
            size, down = 1.0, gradient @ way
            while size > 1e-10:
                tried = energy(x - size * way, delta)
                if tried[0] <= value - 1e-4 * size * down:
                    break
                size *= 0.5
            else:
                break
            s, y = -size * way, tried[1] - gradient
            if s @ y > 0:
                pairs = (pairs + [(s, y, 1 / (s @ y))])[-8:]
            fell = value - tried[0]
            x, (value, gradient, least) = x + s, tried
            if step % 10 == 9 and least > 1e-3 and not crosses_itself(x.reshape(-1, 2)[loop]):
                best = x.copy()
            if fell < 1e-5 * value:
                break
        at = x.reshape(-1, 2)
        if least > 1e-3 and not crosses_itself(at[loop]):
            best = x.copy()
            if delta <= 0.03:
                break
    if best is None:
        return None
    return best.reshape(-1, 2)


def of_one_face(place, corner):
    """A face by itself: its sides' mean lengths as a rectangle, or a triangle by its sides."""
    p = place[corner]
    if len(corner) == 4:
        wide = np.linalg.norm(p[1] - p[0]) + np.linalg.norm(p[2] - p[3])
        tall = np.linalg.norm(p[3] - p[0]) + np.linalg.norm(p[2] - p[1])
        flat = 0.5 * np.array([[0, 0], [wide, 0], [wide, tall], [0, tall]])
    else:
        a, b = p[1] - p[0], p[2] - p[0]
        wide = np.linalg.norm(a)
        flat = np.array([[0, 0], [wide, 0], [a @ b / wide, np.linalg.norm(np.cross(a, b)) / wide]])
    at = np.zeros((len(place), 2))
    at[corner] = flat
    return at


def turned(at, angle):
    c, s = np.cos(angle), np.sin(angle)
    return at @ np.array([[c, s], [-s, c]])


def least_box(at):
    """Turned so that its box has the least area, and moved to the origin."""
    boxes = [turned(at, angle) for angle in np.arange(0, 90, 3) * np.pi / 180]
    best = min(boxes, key=lambda box: np.ptp(box, axis=0).prod())
    return best - best.min(axis=0)


def packed(sizes, margin, texels):
    """Corners of boxes in rows, and the scale at which all fit a square map with the margin between."""
    order = sorted(range(len(sizes)), key=lambda k: (-sizes[k][1], k))

    def rows(scale):
        corners, x, y, tall = np.zeros((len(sizes), 2)), margin, margin, 0.0
        for k in order:
            wide, high = scale * sizes[k]
            if x + wide + margin > texels and x > margin:
                x, y, tall = margin, y + tall + margin, 0.0
            if x + wide + margin > texels:
                return None
            corners[k] = x, y
            x, tall = x + wide + margin, max(tall, high)
        return corners if y + tall + margin <= texels else None

    low, high = 0.0, 4 * texels / np.sqrt(sum(size.prod() for size in sizes))
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if rows(middle) is not None else (low, middle)
    return rows(low), low


def cut(points, faces, charts, margin, turn=False, mirror=False, share=0, texels=TEXELS):
    """Texture coordinates of every face's corners.

    turn    every chart at another angle; mirror: every other chart mirrored
    share   so many charts lie on top of others, mirrored
    texels  a side of the map that the margin is counted on
    """
    edges = edges_of(faces)
    chart = charts_of(points, faces, edges, charts)
    lists = [[int(f) for f in np.flatnonzero(chart == k)] for k in range(chart.max() + 1)]
    flat, members = [], []
    while lists:
        own = set(lists.pop(0))
        place, corners = disc_of(points, faces, edges, own)
        at = of_one_face(place, corners[0]) if len(own) == 1 else flattened(place, corners)
        if at is None:  # too bent for one disc: two halves
            half = charts_of(points, [faces[f] for f in sorted(own)], edges_of([faces[f] for f in sorted(own)]), 2)
            lists += [[f for f, h in zip(sorted(own), half) if h == k] for k in range(half.max() + 1)]
            continue
        k = len(flat)
        at = least_box(at)
        at = turned(at, 2.39996 * k) if turn else at
        at = at * [-1, 1] if mirror and k % 2 else at
        flat.append(at - at.min(axis=0))
        members.append((sorted(own), corners))
    order = sorted(range(len(flat)), key=lambda k: -np.ptp(flat[k], axis=0).prod())
    below = {order[2 * k + 1]: order[2 * k] for k in range(share)}
    own = [k for k in range(len(flat)) if k not in below]
    corners, scale = packed([np.ptp(flat[k], axis=0) for k in own], margin, texels)
    uv = [None] * len(faces)
    for k, (of, numbers) in enumerate(members):
        at = flat[k]
        if k in below:
            at = (np.ptp(at, axis=0) - at) * [1, 0] + at * [0, 1]
            at = at * (np.ptp(flat[below[k]], axis=0) / np.ptp(at, axis=0))
        placed = corners[own.index(below.get(k, k))] + scale * at
        for f, corner in zip(of, numbers):
            uv[f] = placed[corner] / texels
    return uv, len(flat)


def obj_text(points, faces, uv):
    lines = [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in points]
    numbers = {}
    shared = [[numbers.setdefault(f"vt {u:.7f} {v:.7f}", len(numbers)) for u, v in face] for face in uv]
    lines += list(numbers)
    for face, corners in zip(faces, shared):
        lines.append("f " + " ".join(f"{p + 1}/{t + 1}" for p, t in zip(face, corners)))
    return "\n".join(lines) + "\n"


# ---- the series

# Of a body: its mesh, how often its cage is refined, the solid's period and height, and the camera.
BODIES = {
    "spot": ("spot_control_mesh.obj", 1, 0.24, 0.036, [-3.4, 2.1, -5.0], [0, 0.12, 0.1], 18, -20),
    "koala": ("koala_unwrapped.obj", 1, 0.9, 0.14, [-13, 8, 20], [0, 1.29, 0.36], 20, 20),
    "goathead": ("goathead_unwrapped.obj", 1, 2.0, 0.3, [-24, 18, 46], [0.8, 2.7, 0.7], 20, 20),
}

# Name, charts, and what else `cut` is told.
CASES = [(str(n), n, {}) for n in (1, 4, 16, 64, 256, 1024)] + [
    # Two texels between, so that no texel lies beside two faces: bilinear heights at a border ask a texel beyond
    # it. With one between them, the relief is torn at every border, in the truth too: `shadow-map` 1.61 %,
    # `two-scales` 1.15 % wrong on the goat's head.
    ("faces", 10 ** 6, {"texels": 2 * TEXELS, "margin": 2}),
    ("margin-0", 64, {"margin": 0}),
    ("margin-4", 64, {"margin": 4}),
    ("turned", 64, {"turn": True}),
    ("mirrored", 64, {"mirror": True}),
    ("halves", 2, {"share": 1}),
    ("stacked", 64, {"share": 1}),
    ("nested", 64, {"inner": 0.6}),
    ("entering", 64, {"inner": 0.0}),
]


def with_inner(points, faces, inner):
    """The body with a copy that is `inner` as large within it, or a copy that enters it from the side."""
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    if inner > 0:
        copy = middle + inner * (points - middle)
    else:
        copy = points + [0.6 * np.ptp(points[:, 0]), 0.1 * np.ptp(points[:, 1]), 0]
    return np.concatenate([points, copy]), faces + [tuple(p + len(points) for p in face) for face in faces]


def study_text(name, mesh, body, refinement, faces, shared, texels):
    _, _, period, height, eye, target, fov, side = body
    pieces = 2 ** (refinement - 1)
    relief = (f'pattern = "cells"\nperiod = 16\ngroove = 4\nheight = {0.5 * height}' if shared else
              f'solid = "noise"\nperiod = {period}\nheight = {height}')
    lines = [f"""[study]
name = "charts-{name}"
title = "Charts: {name}"
source = "atlases of many charts"

[surface]
mesh = "{mesh}"
scheme = "catmull-clark"

[relief]
{relief}
texels = [{texels}, {texels}]
height_space = "world"
wrap = "clamp"

[truth]
step = 0.25

[[view]]
type = "camera"
width = 384
height = 384
eye = {eye}
target = {target}
up = [0, 1, 0]
fov = {fov}

[[view]]
type = "atlas"
samples = {max(2, round((100000 / faces) ** 0.5))}

[[light]]
name = "low"
azimuth = 150
elevation = {side}

[[light]]
name = "behind"
azimuth = 200
elevation = {-1.25 * side}
"""]
    for method, own in (("unshadowed", 0), ("shadow-map", 9), ("two-scales", 4), ("two-scales-surface", 4)):
        lines.append(f'[[method]]\nname = "{method}"\n')
        if own and pieces > 1:
            lines.append(f"base = {{ subdivisions = {max(1, round(own / pieces))} }}\n")
            if own == 4:
                lines.append(f"parameters = {{ light_pieces = {max(1, round(9 / pieces))} }}\n")
    return "".join(lines)


def write_case(folder, body_name, case):
    name, charts, options = case
    body = BODIES[body_name]
    points, faces = read_obj(FOLDER.parent / "meshes" / body[0])
    options = dict(options)
    inner = options.pop("inner", None)
    if inner is not None:
        points, faces = with_inner(points, faces, inner)
    refinement = body[1]
    for _ in range(refinement):
        points, faces = refined(points, faces)
    while len(faces) < charts < 10 ** 6:
        points, faces = refined(points, faces)
        refinement += 1
    uv, count = cut(points, faces, charts, options.pop("margin", 1), **options)
    stem = f"{body_name}-{name}"
    (folder / f"{stem}.obj").write_text(obj_text(points, faces, uv))
    text = study_text(stem, f"{stem}.obj", body, refinement, len(faces), "share" in options, options.get("texels", TEXELS))
    (folder / f"charts-{stem}.toml").write_text(text)
    print(f"{stem}: {count} charts, {len(faces)} faces")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("cut")
    one.add_argument("mesh", type=pathlib.Path)
    one.add_argument("--charts", type=int, required=True)
    one.add_argument("--margin", type=float, default=1, help=f"texels of a map of {TEXELS} a side")
    one.add_argument("--refine", type=int, default=1, help="steps of Catmull and Clark before")
    one.add_argument("--turn", action="store_true", help="every chart at another angle")
    one.add_argument("--mirror", action="store_true", help="every other chart mirrored")
    one.add_argument("--share", type=int, default=0, help="so many charts lie mirrored on others")
    one.add_argument("--out", type=pathlib.Path, required=True)
    series = commands.add_parser("series")
    series.add_argument("folder", type=pathlib.Path)
    series.add_argument("--only", default="", help="cases whose name has this in it")
    given = parser.parse_args()
    if given.command == "cut":
        points, faces = read_obj(given.mesh)
        for _ in range(given.refine):
            points, faces = refined(points, faces)
        uv, _ = cut(points, faces, given.charts, given.margin, given.turn, given.mirror, given.share)
        given.out.write_text(obj_text(points, faces, uv))
        return
    given.folder.mkdir(parents=True, exist_ok=True)
    for body in BODIES:
        for case in CASES:
            if given.only in f"{body}-{case[0]}":
                write_case(given.folder, body, case)


if __name__ == "__main__":
    main()
