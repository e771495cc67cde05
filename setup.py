"""Builds the Python package with CMake and puts it into the wheel: module, library, Python files and scenarios."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

source = Path(__file__).resolve().parent
version = re.search(r"project\(slipfront VERSION ([\d.]+)", (source / "CMakeLists.txt").read_text()).group(1)


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        # The folder that contains the package. setuptools makes it a build folder in an editable install, too.
        folder = Path(self.get_ext_fullpath(extension.name)).resolve().parent.parent
        with tempfile.TemporaryDirectory() as build:
            def cmake(*arguments):
                subprocess.run(["cmake", *arguments], check=True)

            cmake("-S", str(source), "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DSLIPFRONT_TESTS=OFF", "-DSLIPFRONT_BENCH=OFF",
                  "-DSLIPFRONT_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}", "-DSLIPFRONT_PYTHON_DIR=.")
            cmake("--build", build, "--target", "slipfront_python", *(["-j", str(self.parallel)] if self.parallel else []))
            cmake("--install", build, "--component", "python", "--prefix", str(folder))
            cmake("--install", build, "--component", "wheel", "--prefix", str(folder))


setup(version=version, packages=[], ext_modules=[Extension("slipfront._slipfront", sources=[])], cmdclass={"build_ext": CMakeBuild})
