"""`pip install .` of a clone: the package in a folder of its own, with the program and its readers."""

import os
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


class Pip(unittest.TestCase):
    def test_what_it_installs_stands_alone(self):
        built = os.environ["ISOCHRON_BUILD"]  # or CMake would build all of it anew
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


if __name__ == "__main__":
    unittest.main()
