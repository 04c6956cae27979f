"""Compiles the module and the program for `pip install .`: CMake, a compiler and the libraries that the README
names have to be there. A folder in which CMake has built before is named by ISOCHRON_BUILD."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).parent.resolve()
WORK = SOURCE / "build" / "wheel"  # git ignores it


class Build(build_ext):
    def build_extension(self, extension):
        folder = pathlib.Path(os.environ.get("ISOCHRON_BUILD", WORK / "cmake")).resolve()
        package = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
        native = folder / "python" / "isochron"
        if not (folder / "CMakeCache.txt").exists():
            subprocess.run(["cmake", "-S", SOURCE, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "isochron_program", "isochron_python"], check=True)
        package.mkdir(parents=True, exist_ok=True)
        for module in native.glob("_native*.so"):
            shutil.copy(module, package)
        subprocess.run(["cmake", "--install", folder, "--component", "program", "--prefix",
                        package / "_program"], check=True, stdout=subprocess.DEVNULL)
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
