"""`pip install .`: builds with CMake what the package `gnomon` needs and puts all of it beside the
module, so that the package works wherever it is moved. pyproject.toml has everything else."""

import pathlib
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        package = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
        build = pathlib.Path(self.build_temp).resolve()
        self.cmake(
            "--preset", "release", "-S", ROOT, "-B", build,
            "-DBUILD_TESTING=OFF", f"-DPython_EXECUTABLE={sys.executable}",
        )  # fmt: skip
        self.cmake("--build", build)
        self.cmake("--install", build, "--prefix", package, "--component", "python")
        # The program, the library, its shaders and its reader of image formats.
        self.cmake("--install", build, "--prefix", package / "inner")

    def cmake(self, *arguments):
        subprocess.run(["cmake", *map(str, arguments)], check=True, cwd=ROOT)


setup(ext_modules=[Extension("gnomon._gnomon", [])], cmdclass={"build_ext": CMakeBuild})
