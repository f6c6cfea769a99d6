"""The script that cuts meshes into charts: what it writes, against an independent count of how often each
texel of the atlas is covered, and what the program says of the same atlas."""

import csv
import json
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

PROJECT = pathlib.Path(os.environ["GNOMON_PROJECT"])
PROGRAM = os.environ["GNOMON_PROGRAM"]
SCRIPT = PROJECT / "scenes/charts/charts.py"
GRID = 1024  # points a side at which coverage is counted


def read(path):
    """Texture coordinates of each face's corners, and each face's corners in space."""
    points, places, faces = [], [], []
    for line in path.read_text().splitlines():
        word, *rest = line.split()
        if word == "v":
            points.append(tuple(map(float, rest)))
        elif word == "vt":
            places.append(tuple(map(float, rest)))
        elif word == "f":
            faces.append([tuple(int(n) - 1 for n in corner.split("/")) for corner in rest])
    return points, places, faces


def charts_of(faces):
    """The number of sets of faces that are connected by edges with the same places in the texture."""
    parent = list(range(len(faces)))

    def root(f):
        while parent[f] != f:
            f = parent[f]
        return f

    owner = {}
    for f, face in enumerate(faces):
        for a, b in zip(face, face[1:] + face[:1]):
            edge = tuple(sorted([a, b]))
            parent[root(f)] = root(owner.setdefault(edge, f))
    return len({root(f) for f in range(len(faces))})


def points_in(places, face):
    """The points of the grid that lie in a face's texture, as an index."""
    uv = np.array([places[corner[1]] for corner in face]) * GRID - 0.5
    low = np.maximum(np.ceil(uv.min(axis=0)).astype(int), 0)
    high = np.minimum(np.floor(uv.max(axis=0)).astype(int), GRID - 1)
    x, y = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1))
    e = np.roll(uv, -1, axis=0) - uv
    side = [e[k, 0] * (y - uv[k, 1]) - e[k, 1] * (x - uv[k, 0]) for k in range(len(uv))]
    inside = np.all([s > 1e-9 for s in side], axis=0) | np.all([s < -1e-9 for s in side], axis=0)
    return y[inside], x[inside]


def area_of(points, face):
    p = np.array([points[corner[0]] for corner in face])
    return 0.5 * np.linalg.norm(np.cross(p[2] - p[0], p[3 % len(p)] - p[1 if len(p) == 4 else 0]))


def shared_area(points, places, faces):
    """The share of the mesh's area whose points of the texture lie under another face, too."""
    count = np.zeros((GRID, GRID), int)
    for face in faces:
        count[points_in(places, face)] += 1
    areas = np.array([area_of(points, face) for face in faces])
    shared = np.array([np.mean(count[points_in(places, face)] > 1) for face in faces])
    return (areas * shared).sum() / areas.sum()


@pytest.fixture(scope="module")
def cut(tmp_path_factory):
    folder = tmp_path_factory.mktemp("charts")

    def of(name, *options):
        path = folder / f"{name}.obj"
        if not path.exists():
            mesh = PROJECT / "scenes/meshes/spot_control_mesh.obj"
            subprocess.run([sys.executable, SCRIPT, "cut", mesh, "--out", path, *options], check=True)
        return path

    return of


CASES = {
    "four": (["--charts", "4"], 4, False),
    "turned": (["--charts", "64", "--turn", "--margin", "4"], 64, False),
    "halves": (["--charts", "2", "--share", "1"], 2, True),
    "stacked": (["--charts", "16", "--share", "1", "--mirror"], 16, True),
}


@pytest.mark.parametrize("case", CASES)
def test_charts_are_as_many_as_asked_and_lie_beside_each_other(cut, case):
    options, charts, shared = CASES[case]
    points, places, faces = read(cut(case, *options))
    assert charts_of(faces) >= charts  # a chart too bent for one disc is divided
    assert charts_of(faces) <= charts * 1.2 + 1
    assert (shared_area(points, places, faces) > 0.01) == shared
    assert 0 <= np.min(places) and np.max(places) <= 1


def test_refinement_leaves_the_faces_of_the_cage(cut):
    """One step of Catmull and Clark: a face for every corner of a face, each with four."""
    cage = PROJECT / "scenes/meshes/spot_control_mesh.obj"
    corners = sum(len(face) for face in read(cage)[2])
    faces = read(cut("four", *CASES["four"][0]))[2]
    assert len(faces) == corners
    assert all(len(face) == 4 for face in faces)


def summary_of(mesh, relief, folder):
    study = folder / "atlas.toml"
    study.write_text(f"""[study]
name = "atlas"
title = "An atlas"
source = "tests"
[surface]
mesh = "{mesh}"
scheme = "catmull-clark"
[relief]
{relief}
height = 0.01
texels = [256, 256]
height_space = "world"
wrap = "clamp"
[truth]
triangles = 100000
[[view]]
type = "atlas"
samples = 3
[[light]]
elevation = 40
azimuth = 30
[[method]]
name = "unshadowed"
""")
    run = subprocess.run([PROGRAM, "run", study, "--metrics-only", "--no-cache", "--out", folder / "out"],
                         capture_output=True, text=True, check=False)
    if run.returncode:
        return run
    return json.loads((folder / "out/atlas/summary.json").read_text())


@pytest.mark.parametrize("case", ["four", "halves", "stacked"])
def test_the_program_says_whether_charts_overlap(cut, case, tmp_path):
    options, charts, shared = CASES[case]
    path = cut(case, *options)
    texture = summary_of(path, 'pattern = "cells"\nperiod = 16\ngroove = 4', tmp_path)["texture"]
    assert texture["charts_overlap"] == shared
    assert texture["charts"] == charts_of(read(path)[2])
    assert texture["shared_area"] == pytest.approx(shared_area(*read(path)), rel=0.1, abs=1e-3)


def test_a_solid_is_refused_where_charts_overlap(cut, tmp_path):
    run = summary_of(cut("halves", *CASES["halves"][0]), 'solid = "noise"\nperiod = 0.2', tmp_path)
    assert run.returncode == 3
    assert "overlap" in run.stderr


def test_cases_of_the_series_are_measured_and_stand_in_the_table(tmp_path):
    """As `reproduce --only charts` does, in the quick form."""
    for case in ("spot-4", "spot-halves"):
        subprocess.run([sys.executable, SCRIPT, "series", tmp_path / "series", "--only", case], check=True)
    studies = sorted((tmp_path / "series").glob("charts-*.toml"))
    assert [study.name for study in studies] == ["charts-spot-4.toml", "charts-spot-halves.toml"]
    subprocess.run([PROGRAM, "run", *studies, "--quick", "--metrics-only", "--no-cache", "--out", tmp_path / "out"],
                   check=True)
    table = tmp_path / "table/charts.csv"
    run = subprocess.run([sys.executable, PROJECT / "results/charts.py", tmp_path / "out", table],
                         check=True, capture_output=True, text=True)
    rows = {row.pop("case"): row for row in csv.DictReader(table.open())}
    assert float(rows["spot-halves"]["shared_area"]) > 0.5
    row = rows["spot-4"]
    assert row.pop("charts") == "4"
    assert float(row.pop("shared_area")) < 1e-3
    errors = {name: float(value) for name, value in row.items()}
    assert list(errors) == ["unshadowed", "shadow-map", "two-scales", "two-scales-surface", "uncertainty"]
    assert errors["unshadowed"] > 0.05 > errors["two-scales"] > 0
    assert f"| spot-4 | 4 | 0.0 | {100 * errors['unshadowed']:.2f} |" in run.stdout


def test_the_table_names_what_a_method_is_worse_than(tmp_path):
    (tmp_path / "charts-case").mkdir()
    (tmp_path / "charts-case/summary.json").write_text('{"texture": {"charts": 64, "shared_area": 0.02}}')
    lines = ["study,method,error_rate,uncertainty", "other,unshadowed,0.5,0.1", "charts-case,unshadowed,0.09,0.0004",
             "charts-case,shadow-map,0.0031,0.0004", "charts-case,two-scales,0.0033,0.0004",
             "charts-case,two-scales-surface,0.0039,0.0004"]
    (tmp_path / "ranking.csv").write_text("\n".join(lines))
    run = subprocess.run([sys.executable, PROJECT / "results/charts.py", tmp_path, tmp_path / "charts.csv"],
                         check=True, capture_output=True, text=True)
    assert run.stdout.splitlines()[2:] == ["| case | 64 | 2.0 | 9.00 | 0.31 | 0.33 | 0.39 | 0.04 |",
                                           "case: `two-scales-surface` 0.390 %, worse than `two-scales`",
                                           "case: `two-scales-surface` 0.390 %, worse than `shadow-map`"]
