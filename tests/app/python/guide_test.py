"""The examples of the guide, each as a new user types it."""

import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import types
import unittest

import isochron
from made_series import arrays_of, write_vti

GUIDE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../docs/guide/cells.md")


def pyvista_of_vtk():
    """PyVista's from_regular_faces and read by the calls of VTK behind them."""
    import numpy as np
    import vtk
    from vtk.util import numpy_support

    class PolyData(vtk.vtkPolyData):
        @classmethod
        def from_regular_faces(cls, points, faces):
            cells, place, surface = vtk.vtkCellArray(), vtk.vtkPoints(), cls()
            starts = np.arange(0, faces.size + 1, faces.shape[1], dtype=np.int64)
            cells.SetData(*(numpy_support.numpy_to_vtkIdTypeArray(of.ravel().astype(np.int64), deep=True)
                            for of in (starts, faces)))
            place.SetData(numpy_support.numpy_to_vtk(points, deep=True))
            surface.SetPoints(place)
            surface.SetPolys(cells)
            return surface

    def read(name):
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(name)
        reader.Update()
        return reader.GetOutput()

    module = types.ModuleType("pyvista")
    module.PolyData = PolyData
    module.read = read
    return module


def blocks_of(page):
    with open(page) as text:
        return re.findall(r"^```python\n(.*?)^```$", text.read(), re.MULTILINE | re.DOTALL)


@contextlib.contextmanager
def within_a_run(arrays, **options):
    """A folder with run42 of nine steps and its index. arrays: of a step."""
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            os.mkdir("run42")
            for step in range(9):
                write_vti(f"run42/t{step}.vti", step, arrays(step))
            isochron.build("run42/*.vti", "run42.isochron", **options).close()
            yield
        finally:
            os.chdir(before)


class Guide(unittest.TestCase):
    def test_examples_work_as_they_stand(self):
        examples = blocks_of(GUIDE) + blocks_of(os.path.join(os.path.dirname(GUIDE), "arrays.md"))
        self.assertGreaterEqual(len(examples), 5)
        sys.modules.setdefault("pyvista", pyvista_of_vtk())
        with within_a_run(lambda step: {"rho": arrays_of(step)["depth"], "T": arrays_of(step)["rho"]}, array=["rho", "T"]):
            shutil.copy("run42.isochron", "run43.isochron")
            for example in examples:
                names = {}
                printed = io.StringIO()
                with self.subTest(example=example), contextlib.redirect_stdout(printed):
                    exec(compile(example, GUIDE, "exec"), names)
                self.assertNotIn("expected", printed.getvalue())  # no error was caught and printed
                if "added" in names:
                    self.assertGreater(names["cells"].size, 0)
                    self.assertEqual(names["part"].shape[0], 10)
                if "pixels" in names:
                    self.assertEqual(names["pixels"].shape, (360, 640, 3))
                if "surface" in names:
                    self.assertEqual(names["surface"].GetNumberOfPolys(), len(names["faces"]))

    def test_the_notebook_works_from_its_first_block_to_its_last(self):
        page = os.path.join(os.path.dirname(GUIDE), "notebook.md")
        blocks = blocks_of(page)
        self.assertEqual(len(blocks), 7)
        with within_a_run(lambda step: {"rho": arrays_of(step)["depth"]}, array="rho"):
            names = {}
            with contextlib.redirect_stdout(io.StringIO()):
                for block in blocks:
                    exec(compile(block, page, "exec"), names)
            self.assertEqual(names["added"].size - names["removed"].size, names["count"][1] - names["count"][0])
            self.assertEqual(names["cells"].size, names["count"].max())
            self.assertGreater(names["area"], 0)
            self.assertEqual(names["line"].shape, names["run"].shape[3:])
            self.assertEqual(names["pixels"].shape, (360, 640, 3))

    def test_other_programs_get_what_their_page_says(self):
        page = os.path.join(os.path.dirname(GUIDE), "programs.md")
        with open(page) as text:
            commands = [line for line in text if line.startswith("isochron export") and " vtp " in line]
        (block,) = blocks_of(page)
        self.assertEqual(len(commands), 1)
        sys.modules.setdefault("pyvista", pyvista_of_vtk())
        program = os.environ["ISOCHRON_PROGRAM"]
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            for command in ("generate sphere --steps 9 -o run42", "build run42 -o run42.isochron",
                            commands[0].removeprefix("isochron ")):
                subprocess.run([program, *command.split()], check=True, stdout=subprocess.DEVNULL)
            names = {}
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(block, page, "exec"), names)
            surface = names["surface"].GetPointData()
            self.assertGreater(names["surface"].GetNumberOfPolys(), 1000)
            self.assertEqual(surface.GetArray("color").GetNumberOfComponents(), 3)
            self.assertEqual(surface.GetArray("surface").GetRange(), (0, 1))
            self.assertTrue(os.path.exists("paraview/run42.pvd"))


if __name__ == "__main__":
    unittest.main()
