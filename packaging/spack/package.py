"""A package of Spack. Nobody has built it yet; slipfront is developed and tested on Debian 12 only.

The dependencies are those of CMakeLists.txt, of "build" in apt-packages.txt, and of pyproject.toml. The project has no
public address yet, so there is no `url`, `git` or checksum. With a checkout: spack dev-build slipfront@0.1.0.
Spack must have a package of the C library libcsv (csv.h). We have not checked that.
"""

from spack.package import *


class Slipfront(CMakePackage):
    """Slip pulses on frictional interfaces, from the Frenkel-Kontorova model and Whitham modulation theory."""

    homepage = "https://doi.org/10.3390/lubricants3020311"  # the paper whose model it computes

    license("BSD-3-Clause AND LicenseRef-UDUNITS-2")

    version("0.1.0")

    generator("ninja")

    variant("mpi", default=True, description="Chains over several processes")
    variant("python", default=True, description="The Python package")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("python@3.11:", type=("build", "run"))  # the build calls it also without the Python package

    depends_on("boost")
    depends_on("fmt")
    depends_on("nlohmann-json")
    depends_on("tomlplusplus")
    depends_on("cli11")
    depends_on("libcsv")
    depends_on("muparser")
    depends_on("netcdf-c")
    depends_on("mpi", when="+mpi")

    extends("python", when="+python")
    depends_on("py-pybind11", type="build", when="+python")
    depends_on("py-numpy", type=("build", "run"), when="+python")
    depends_on("py-xarray", type="run", when="+python")
    depends_on("py-netcdf4", type="run", when="+python")
    depends_on("py-matplotlib", type="run", when="+python")

    def cmake_args(self):
        arguments = [
            self.define("SLIPFRONT_TESTS", False),
            self.define("SLIPFRONT_BENCH", False),
            self.define_from_variant("SLIPFRONT_MPI", "mpi"),
            self.define_from_variant("SLIPFRONT_PYTHON", "python"),
            self.define("Python3_EXECUTABLE", self.spec["python"].command.path),
        ]
        if self.spec.satisfies("+python"):
            arguments.append(self.define("SLIPFRONT_PYTHON_DIR", self.spec["python"].package.platlib))
        return arguments
