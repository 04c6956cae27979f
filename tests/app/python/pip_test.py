"""`pip install .` of a clone: the package in a folder of its own, with the program and its readers."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from made_series import arrays_of, write_vti

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")

TYPED = """
import isochron, os
run = isochron.build(["t*.vti"], "run.isochron", array="rho")
assert "/site/isochron/" in isochron.__file__, isochron.__file__
assert run.cells(sum(run.range()) / 2, step=1).size > 0
"""

# In place of CMake: it notes how it is called, and instead of compiling takes what was built before.
CMAKE = """#!/usr/bin/python3
import json, os, shutil, subprocess, sys
words = sys.argv[1:]
with open(os.environ["CALLS"], "a") as calls:
    print(json.dumps(words), file=calls)
if os.environ["REAL_CMAKE"] == "none":
    sys.exit("CMake Error: there is no fmt")
built, folder = os.environ["BUILT"], words[words.index("-B") + 1 if "-B" in words else 1]
if "-B" in words:
    os.makedirs(folder, exist_ok=True)
elif words[0] == "--build":
    shutil.copytree(os.path.join(built, "python"), os.path.join(folder, "python"))
else:
    sys.exit(subprocess.run([os.environ["REAL_CMAKE"], words[0], built, *words[2:]]).returncode)
"""


class Pip(unittest.TestCase):
    def test_what_it_installs_stands_alone(self):
        built = os.environ["ISOCHRON_BUILD"]  # or CMake would compile all of it anew
        with tempfile.TemporaryDirectory() as folder:
            site = os.path.join(folder, "site")
            subprocess.run([sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index",
                            "--quiet", "--disable-pip-version-check", "--root-user-action=ignore", "--target", site,
                            SOURCE], check=True, env=os.environ | {"ISOCHRON_BUILD": built})
            for step in range(3):
                write_vti(os.path.join(folder, f"t{step}.vti"), step, {"rho": arrays_of(step)["depth"]})
            alone = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
            subprocess.run([sys.executable, "-c", TYPED], check=True, cwd=folder, env=alone | {"PYTHONPATH": site})
            said = subprocess.run([os.path.join(site, "bin", "isochron"), "--version"], check=True, cwd=folder,
                                  env=alone | {"PYTHONPATH": site}, capture_output=True, text=True)
            self.assertIn("isochron", said.stdout)

    def installed_without_a_built_folder(self, folder, **environment):
        """Pip in a new virtual environment, and how it has called CMake."""
        tree = os.path.join(folder, "tree")
        os.makedirs(os.path.join(tree, "app/python"))
        for name in ("setup.py", "pyproject.toml", "README.md", "CMakeLists.txt"):
            shutil.copy(os.path.join(SOURCE, name), tree)
        shutil.copytree(os.path.join(SOURCE, "app/python/isochron"), os.path.join(tree, "app/python/isochron"))
        os.mkdir(os.path.join(folder, "bin"))
        stand_in, calls = os.path.join(folder, "bin/cmake"), os.path.join(folder, "calls")
        with open(stand_in, "w") as program:
            program.write(CMAKE)
        os.chmod(stand_in, 0o755)
        python = os.path.join(folder, "venv/bin/python")
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", "--system-site-packages",
                        os.path.join(folder, "venv")], check=True)
        alone = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "ISOCHRON_BUILD")}
        said = subprocess.run([python, "-m", "pip", "install", "--no-build-isolation", "--no-index",
                               "--disable-pip-version-check", tree], cwd=folder, capture_output=True, text=True,
                              env=alone | {"PATH": os.path.join(folder, "bin") + ":" + os.environ["PATH"],
                                           "CALLS": calls, "BUILT": os.environ["ISOCHRON_BUILD"]} | environment)
        with open(calls) as lines:
            return said, [json.loads(line) for line in lines]

    def test_a_tree_that_was_never_built_is_built_by_cmake(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = os.path.realpath(folder)
            said, calls = self.installed_without_a_built_folder(folder, REAL_CMAKE=shutil.which("cmake"))
            self.assertEqual(said.returncode, 0, said.stdout + said.stderr)
            own = os.path.join(folder, "tree/build/wheel")
            self.assertEqual(calls[0][:4], ["-S", os.path.join(folder, "tree"), "-B", own])
            self.assertIn("-DPython_EXECUTABLE=" + os.path.join(folder, "venv/bin/python"), calls[0])
            self.assertEqual(calls[1], ["--build", own, "--target", "isochron_program", "isochron_python"])
            self.assertEqual([call[:3] for call in calls[2:]], [["--install", own, "--component"]] * (len(calls) - 2))
            self.assertEqual([call[3] for call in calls[2:]], ["program", "vtk", "mpi", "generate"])
            for typed in (["isochron", "--version"], ["python", "-c", "import isochron; isochron.Run"]):
                subprocess.run([os.path.join(folder, "venv/bin", typed[0]), *typed[1:]], check=True, cwd=folder,
                               env={"PATH": os.environ["PATH"]}, stdout=subprocess.DEVNULL)

    def test_what_cannot_be_built_ends_in_a_line_that_says_what_to_do(self):
        with tempfile.TemporaryDirectory() as folder:
            said, calls = self.installed_without_a_built_folder(folder, REAL_CMAKE="none")
            self.assertEqual(said.returncode, 1)
            self.assertEqual(len(calls), 1)
            self.assertIn("there is no fmt", said.stdout + said.stderr)
            self.assertIn("`./run build` once installs what compiling needs", said.stdout + said.stderr)


if __name__ == "__main__":
    unittest.main()
