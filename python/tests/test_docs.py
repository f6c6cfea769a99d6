"""The example of the manual, as a reader would run it."""

import pathlib
import re

PAGE = pathlib.Path(__file__).parents[2] / "docs" / "python.md"


def test_the_example_of_arrays_runs(capsys):
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.S)
    (example,) = [block for block in blocks if "gnomon.trace(" in block]
    exec(compile(example, str(PAGE), "exec"), {})
    wrong = re.fullmatch(
        r"wrong on (\d+\.\d) % of the surface \(truth: ± (\d\.\d) %\)\n", capsys.readouterr().out
    )
    # The same case as docs/example.cpp, of which install.example knows the figure.
    assert 36 <= float(wrong.group(1)) < 37 and float(wrong.group(2)) < 1


def test_commands_name_their_interpreter():
    """The first `python3` of a machine need not be the one that has the packages."""
    root = PAGE.parents[1]
    for page in [root / "README.md", *sorted(root.glob("docs/*.md"))]:
        for block in re.findall(r"```[a-z]*\n(.*?)```", page.read_text(encoding="utf-8"), re.S):
            for line in block.splitlines():
                assert not re.match(r"\s*(\S*=\S*\s+)*(python3?|pip3?)\s", line), f"{page}: {line}"
