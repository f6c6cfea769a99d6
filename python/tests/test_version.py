"""One version everywhere."""

import json
import pathlib
import re

ROOT = pathlib.Path(__file__).parents[2]


def found(file, pattern):
    return re.search(pattern, (ROOT / file).read_text(encoding="utf-8"), re.MULTILINE).group(1)


def test_is_the_same_in_every_file():
    version = found("CMakeLists.txt", r"^project\(Gnomon VERSION ([0-9.]+)")
    assert found("pyproject.toml", r'^version = "([^"]+)"') == version
    assert found("CITATION.cff", r"^version: (\S+)") == version
    assert json.loads((ROOT / "codemeta.json").read_text(encoding="utf-8"))["version"] == version
