"""Compiles the module and the program for `pip install .`, in build/wheel: CMake, Ninja, a compiler and the libraries
that the README names have to be there. ISOCHRON_BUILD names a folder in which CMake has built before, to build less."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).parent.resolve()
BUILT = SOURCE / "build" / "wheel"  # as deep as ./run build's folder, so that ccache finds what that compiled
WORK = BUILT / "setuptools"


def cmake(*words, **options):
    """Runs CMake. What it says stands above the line with which a failure ends."""
    try:
        subprocess.run(["cmake", *words], check=True, **options)
    except FileNotFoundError:
        raise SystemExit("isochron: there is no cmake, which compiles it: apt install cmake ninja-build")
    except subprocess.CalledProcessError as error:
        raise SystemExit(f"isochron: cmake ended with {error.returncode}, as it says above: `./run build` once installs "
                         "what compiling needs on Debian, or says what is missing")


class Build(build_ext):
    def build_extension(self, extension):
        folder = pathlib.Path(os.environ.get("ISOCHRON_BUILD", BUILT)).resolve()
        package = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
        native = folder / "python" / "isochron"
        # Its own folder is configured each time: the interpreter may be another, and the last time may have failed.
        if "ISOCHRON_BUILD" not in os.environ:
            cmake("-S", SOURCE, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                  f"-DPython_EXECUTABLE={sys.executable}")
        cmake("--build", folder, "--target", "isochron_program", "isochron_python")
        package.mkdir(parents=True, exist_ok=True)
        for module in native.glob("_native*.so"):
            shutil.copy(module, package)
        for component in "program", "vtk", "mpi", "generate":
            cmake("--install", folder, "--component", component, "--prefix", package / "_program",
                  stdout=subprocess.DEVNULL)
        shutil.rmtree(package / "_program" / "share" / "doc")  # the guide is read elsewhere


WORK.mkdir(parents=True, exist_ok=True)
setup(
    version=re.search(r"project\(\w+\s+VERSION\s+([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1],
    packages=["isochron"],
    package_dir={"isochron": "app/python/isochron"},
    package_data={"isochron": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("isochron._native", [])],
    cmdclass={"build_ext": Build},
    options={"build": {"build_base": str(WORK)}, "egg_info": {"egg_base": str(WORK)}},
)
