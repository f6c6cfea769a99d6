import os
import subprocess

import pytest

STUDY = """
[study]
name = "small"
title = "Columns on a plane"
source = "a test"
frames = 0
[surface]
shape = "plane"
quads = [4, 4]
size = [32, 32]
[relief]
pattern = "columns"
texels = [32, 32]
period = 16
radius = 4
wall = 1
height = 4
height_space = "world"
[bake]
azimuths = 8
[truth]
step = 0.5
[[view]]
type = "camera"
width = 64
height = 64
eye = [0, 0, 80]
fov = 30
[[light]]
name = "evening"
azimuth = 20
elevation = 30
[[method]]
name = "unshadowed"
[[method]]
name = "max-forsyth"
"""


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    """Every test has an empty folder and a cache of its own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("GNOMON_CACHE", str(tmp_path / "cache"))


@pytest.fixture
def study(tmp_path):
    file = tmp_path / "small.toml"
    file.write_text(STUDY)
    return file


def command(*arguments):
    """The command line's own answer."""
    return subprocess.run(
        [os.environ["GNOMON_PROGRAM"], *map(str, arguments)], capture_output=True, text=True
    )
