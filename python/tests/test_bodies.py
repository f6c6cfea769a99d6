"""A method for whole bodies must not depend on how a body lies in space or in its texture."""

from pathlib import Path

import numpy as np
import pytest

import gnomon

SPOT = Path(__file__).parents[2] / "scenes/meshes/spot_control_mesh.obj"

STUDY = """
[study]
name = "{name}"
title = "Spot, laid otherwise"
source = "a test"
frames = 0
[surface]
mesh = "{name}.obj"
scheme = "catmull-clark"
[relief]
solid = "noise"
texels = [512, 512]
period = 0.24
height = 0.036
height_space = "world"
wrap = "clamp"
[bake]
azimuths = 8
[truth]
step = 0.25
[[view]]
type = "atlas"
samples = 8
[[light]]
azimuth = 150
elevation = 20
[[method]]
name = "two-scales"
[[method]]
name = "geodesic-march"
"""


class Body:
    """A mesh file: points, texture coordinates, and faces of corners (point, texture coordinate)."""

    def __init__(self, file):
        rows = [line.split() for line in file.read_text().splitlines() if line.strip()]
        self.points = np.array([row[1:4] for row in rows if row[0] == "v"], float)
        self.uv = np.array([row[1:3] for row in rows if row[0] == "vt"], float)
        self.faces = [
            [tuple(int(index) - 1 for index in corner.split("/")[:2]) for corner in row[1:]]
            for row in rows
            if row[0] == "f"
        ]

    def write(self, file):
        lines = ["v %.9g %.9g %.9g" % tuple(point) for point in self.points]
        lines += ["vt %.9g %.9g" % tuple(uv) for uv in self.uv]
        for face in self.faces:
            lines.append("f " + " ".join("%d/%d" % (p + 1, t + 1) for p, t in face))
        file.write_text("\n".join(lines) + "\n")


def as_it_is(body):
    pass


def scaled(body):
    body.points *= 137


def turned(body):
    rotation = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0], [0.48, 0.64, 0.6]])
    body.points = body.points @ rotation.T


def mirrored(body):
    body.points *= [-1, 1, 1]
    body.faces = [face[::-1] for face in body.faces]


def unwrapped_again(body):
    """Charts are cut by two planes through the body's middle, given a quarter turn, and packed anew."""
    middle = np.median(body.points, axis=0)
    copies = {}
    for face in body.faces:
        centre = np.mean([body.points[p] for p, _ in face], axis=0)
        quarter = tuple(centre[:2] > middle[:2])
        face[:] = [(p, copies.setdefault((t, quarter), len(copies))) for p, t in face]
    uv = np.array([body.uv[t] for t, _ in copies])[:, ::-1] * [-1, 1]
    body.uv = packed(uv, charts_of(body.faces, len(uv)))


def charts_of(faces, count):
    """Lists of texture coordinates that faces connect."""
    parent = list(range(count))

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for face in faces:
        for _, t in face:
            parent[root(t)] = root(face[0][1])
    charts = {}
    for i in range(count):
        charts.setdefault(root(i), []).append(i)
    return sorted(charts.values())


def packed(uv, charts, gap=0.012):
    """The charts side by side on shelves, tall ones first, at the largest scale that fits."""
    boxes = [(uv[chart].min(axis=0), np.ptp(uv[chart], axis=0), chart) for chart in charts]
    boxes.sort(key=lambda box: -box[1][1])
    for scale in np.arange(1, 0.2, -0.01):
        laid = uv.copy()
        at = np.array([gap, gap])
        shelf = 0
        for corner, size, chart in boxes:
            if at[0] + scale * size[0] + gap > 1:
                at = np.array([gap, at[1] + shelf + gap])
                shelf = 0
            laid[chart] = scale * (uv[chart] - corner) + at
            at[0] += scale * size[0] + gap
            shelf = max(shelf, scale * size[1])
        if laid.max() < 1:
            return laid
    raise AssertionError("the charts do not fit")


@pytest.fixture(scope="module")
def errors(tmp_path_factory):
    """The methods' errors on Spot as a change lays it, in percent."""
    found = {}

    def measured(change):
        if change not in found:
            name = change.__name__
            folder = tmp_path_factory.mktemp(name)
            body = Body(SPOT)
            change(body)
            body.write(folder / f"{name}.obj")
            text = STUDY.format(name=name)
            if change is scaled:
                for length in (0.24, 0.036):
                    text = text.replace(f"= {length}\n", f"= {137 * length}\n")
            (folder / f"{name}.toml").write_text(text)
            rows = gnomon.run(folder / f"{name}.toml", out=folder / "out").rows()
            found[change] = {
                row["method"]: 100 * row["value"]
                for row in rows
                if (row["metric"], row["region"], row["answer"]) == ("error_rate", "all", "drawn")
            }
        return found[change]

    return measured


@pytest.mark.parametrize("change", [scaled, turned, mirrored, unwrapped_again])
def test_two_scales_is_as_right_on_a_body_laid_otherwise(errors, change):
    plain = errors(as_it_is)
    laid = errors(change)
    assert abs(laid["two-scales"] - plain["two-scales"]) < 0.2
    assert laid["two-scales"] < 0.7
    assert laid["geodesic-march"] > 4, "the control: no path over the texture leads to another limb"
