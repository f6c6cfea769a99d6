"""`pip install .`: builds with CMake what the package `gnomon` needs and puts all of it beside the
module, so that the package works wherever it is moved. pyproject.toml has everything else."""

import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


def refuse(reason):
    sys.exit(f"gnomon: {reason}")


def require_interpreter():
    """The module is built for the interpreter that runs pip, and takes its headers."""
    header = pathlib.Path(sysconfig.get_path("include"), "Python.h")
    if not header.exists():
        refuse(
            f"pip runs on {sys.executable}, whose header {header} is missing: install it (Debian: "
            "python3-dev), or use pip of an interpreter that has it, as /usr/bin/python3 -m pip"
        )
    for tool in ("cmake", "ninja"):
        if shutil.which(tool) is None:
            refuse(f"{tool} not found: install what packages.txt lists up to \"only for tests\"")


class Progress:
    """Tells how far the build is. pip keeps what it is told until the end, unless it is called with -v:
    so it is told on the terminal itself, where there is one."""

    def __init__(self):
        try:
            self.terminal = open("/dev/tty", "w", encoding="utf-8")
        except OSError:
            self.terminal = None

    def tell(self, line):
        print(line, flush=True)
        step = re.match(r"\[(\d+)/(\d+)\]", line)
        if step and self.terminal:
            self.terminal.write(f"\rgnomon: building, {step.group(1)} of {step.group(2)} ")
            self.terminal.flush()

    def end(self):
        if self.terminal:
            self.terminal.write("\n")
            self.terminal.close()


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        require_interpreter()
        package = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
        build = pathlib.Path(self.build_temp).resolve()
        print(f"gnomon: building for {sys.executable} {sys.version.split()[0]}", flush=True)
        self.cmake(
            "--preset", "release", "-S", ROOT, "-B", build, "-DBUILD_TESTING=OFF",
            "-DGNOMON_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}",
        )  # fmt: skip
        self.cmake("--build", build)
        self.cmake("--install", build, "--prefix", package, "--component", "python")
        # The program, the library, its shaders and its reader of image formats.
        self.cmake("--install", build, "--prefix", package / "inner")

    def cmake(self, *arguments):
        progress = Progress()
        command = ["cmake", *map(str, arguments)]
        with subprocess.Popen(
            command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        ) as work:
            for line in work.stdout:
                progress.tell(line.rstrip("\n"))
        if work.returncode != 0:
            refuse(f"{' '.join(command)} failed: what it says stands above")


if __name__ == "__main__":
    setup(ext_modules=[Extension("gnomon._gnomon", [])], cmdclass={"build_ext": CMakeBuild})
