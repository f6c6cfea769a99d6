"""One version everywhere; an interpreter that is not the right one gets one line."""

import json
import os
import pathlib
import re
import subprocess
import sys

import gnomon

ROOT = pathlib.Path(__file__).parents[2]


def found(file, pattern):
    return re.search(pattern, (ROOT / file).read_text(encoding="utf-8"), re.MULTILINE).group(1)


def test_is_the_same_in_every_file():
    version = found("CMakeLists.txt", r"^project\(Gnomon VERSION ([0-9.]+)")
    assert found("pyproject.toml", r'^version = "([^"]+)"') == version
    assert found("CITATION.cff", r"^version: (\S+)") == version
    assert json.loads((ROOT / "codemeta.json").read_text(encoding="utf-8"))["version"] == version


def imported(package, *options):
    """The last line that `import gnomon` ends with."""
    told = subprocess.run(
        [sys.executable, *options, "-c", "import sys; sys.path.insert(0, sys.argv[1]); import gnomon", package],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": ""},
    )
    assert told.returncode == 1
    return told.stderr.splitlines()[-1]


def copied(folder, rename):
    """The package with another name for its module."""
    package = folder / "gnomon"
    package.mkdir()
    for file in pathlib.Path(gnomon.__file__).parent.iterdir():
        name = rename(file.name) if file.name.startswith("_gnomon.") else file.name
        if name:
            (package / name).symlink_to(file.resolve())
    return folder


def test_another_python_is_told_which_it_takes(tmp_path):
    version = "%d%d" % sys.version_info[:2]
    other = copied(tmp_path, lambda name: name.replace(f"cpython-{version}", "cpython-399"))
    assert re.fullmatch(
        r"ImportError: gnomon in \S+ is built for Python 3\.99; \S+ is Python 3\.\d+", imported(other)
    )


def test_a_package_that_is_not_built_says_how(tmp_path):
    bare = copied(tmp_path, lambda name: None if name.endswith(".so") else name)
    assert re.fullmatch(
        r"ImportError: gnomon in \S+ is not built: `./gnomon python` in a checkout .*", imported(bare)
    )


def test_a_python_without_numpy_is_told_so():
    folder = pathlib.Path(gnomon.__file__).parents[1]
    line = imported(folder, "-S", "-E")  # without the packages of the site
    assert line.startswith("ImportError: gnomon takes NumPy, which ") and sys.executable in line


#: Stands for CMake and Ninja: says what a build says.
TOOL = """#!/bin/sh
case $1 in --build) echo "[1/2] Building"; echo "[2/2] Linking" ;; *) echo "$0 $*" ;; esac
exit ${TOOL_STATUS:-0}
"""


def built(folder, prelude="pass", **environment):
    """What `pip install -v` gets to hear, with tools that do nothing."""
    for name in ["cmake", "ninja"]:
        (folder / name).write_text(TOOL)
        (folder / name).chmod(0o755)
    script = (
        f"import runpy, sys; {prelude}; sys.argv = ['setup.py', 'build_ext', '--build-temp', 'temporary', "
        "'--build-lib', 'library']; runpy.run_path(sys.path[0] + '/setup.py', run_name='__main__')"
    )
    path = f"{folder}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(ROOT)!r}); {script}"],
        capture_output=True,
        text=True,
        cwd=folder,
        env={**os.environ, "PATH": path, **environment},
    )


def test_pip_hears_how_far_the_build_is_and_for_whom(tmp_path):
    told = built(tmp_path)
    assert told.returncode == 0, told.stderr
    assert f"gnomon: building for {sys.executable} " in told.stdout
    assert f"-DPython_EXECUTABLE={sys.executable}" in told.stdout
    assert "[1/2] Building" in told.stdout and "[2/2] Linking" in told.stdout
    assert built(tmp_path, TOOL_STATUS="1").stderr.splitlines()[-1].startswith("gnomon: cmake --preset")


def test_pip_is_told_which_header_its_interpreter_lacks(tmp_path):
    told = built(tmp_path, "import sysconfig; sysconfig.get_path = lambda name: '/nowhere'")
    assert told.returncode == 1
    assert told.stderr.splitlines()[-1] == (
        f"gnomon: pip runs on {sys.executable}, whose header /nowhere/Python.h is missing: install it "
        "(Debian: python3-dev), or use pip of an interpreter that has it, as /usr/bin/python3 -m pip"
    )
