"""Builds slipfront with CMake and puts it into a wheel: Python package, library, program, scenarios
and the explorer's page.

The folder slipfront of the wheel is the prefix of the installation. The environment variable
CMAKE_ARGS has further options for CMake.
"""

import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

source = Path(__file__).resolve().parent
version = re.search(r"project\(slipfront VERSION ([\d.]+)",
                    (source / "CMakeLists.txt").read_text()).group(1)
page = source / "apps/explorer/page"  # in an sdist, built


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        # setuptools makes this a build folder in an editable install, too.
        prefix = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        with tempfile.TemporaryDirectory() as build:
            def cmake(*arguments):
                subprocess.run(["cmake", *arguments], check=True)

            cmake("-S", str(source), "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                  "-DSLIPFRONT_TESTS=OFF", "-DSLIPFRONT_BENCH=OFF", "-DSLIPFRONT_PYTHON=ON",
                  f"-DPython3_EXECUTABLE={sys.executable}", "-DSLIPFRONT_PYTHON_DIR=..",
                  "-DCMAKE_INSTALL_LIBDIR=lib", "-DSLIPFRONT_INTERPRETER=/usr/bin/python3",
                  f"-DSLIPFRONT_PAGE={page}", *shlex.split(os.environ.get("CMAKE_ARGS", "")))
            cmake("--build", build, *(["-j", str(self.parallel)] if self.parallel else []))
            for component in ("runtime", "python", "manual"):
                cmake("--install", build, "--component", component, "--prefix", str(prefix),
                      "--strip")


setup(version=version, packages=[], ext_modules=[Extension("slipfront._slipfront", sources=[])],
      scripts=["python/launcher/slipfront"], cmdclass={"build_ext": CMakeBuild})
