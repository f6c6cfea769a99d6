"""The notebooks of the manual, cell by cell, as their kernel would run them."""

import json
import os
import pathlib

import pytest

FOLDER = pathlib.Path(__file__).parents[2] / "docs" / "notebooks"


@pytest.mark.parametrize("name", sorted(file.stem for file in FOLDER.glob("*.ipynb")))
def test_runs(name, monkeypatch):
    program = pathlib.Path(os.environ["GNOMON_PROGRAM"])
    monkeypatch.setenv("PATH", str(program.parent), prepend=os.pathsep)
    book = json.loads((FOLDER / f"{name}.ipynb").read_text(encoding="utf-8"))
    names = {}
    for number, cell in enumerate(book["cells"], 1):
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [], "outputs are made anew by every reader"
            exec(compile("".join(cell["source"]), f"{name}, cell {number}", "exec"), names)


def test_there_are_three():
    assert len(list(FOLDER.glob("*.ipynb"))) == 3
