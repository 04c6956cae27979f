"""The examples of the guide, each as a new user types it."""

import contextlib
import io
import os
import re
import sys
import tempfile
import types
import unittest

import isochron
from made_series import arrays_of, write_vti

GUIDE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../docs/guide/cells.md")


def pyvista_of_vtk():
    """PyVista's from_regular_faces by the calls of VTK behind it."""
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

    module = types.ModuleType("pyvista")
    module.PolyData = PolyData
    return module


class Guide(unittest.TestCase):
    def test_examples_work_as_they_stand(self):
        with open(GUIDE) as page:
            examples = re.findall(r"^```python\n(.*?)^```$", page.read(), re.MULTILINE | re.DOTALL)
        self.assertGreaterEqual(len(examples), 5)
        sys.modules.setdefault("pyvista", pyvista_of_vtk())
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                os.mkdir("run42")
                for step in range(9):
                    arrays = arrays_of(step)
                    write_vti(f"run42/t{step}.vti", step, {"rho": arrays["depth"], "T": arrays["rho"]})
                isochron.build("run42/*.vti", "run42.isochron", array=["rho", "T"]).close()
                for example in examples:
                    names = {}
                    printed = io.StringIO()
                    with self.subTest(example=example), contextlib.redirect_stdout(printed):
                        exec(compile(example, GUIDE, "exec"), names)
                    self.assertNotIn("expected", printed.getvalue())  # no error was caught and printed
                    if "cells" in names:
                        self.assertGreater(names["cells"].size, 0)
                        self.assertEqual(names["part"].shape[0], 10)
                    if "pixels" in names:
                        self.assertEqual(names["pixels"].shape, (360, 640, 3))
                    if "surface" in names:
                        self.assertEqual(names["surface"].GetNumberOfPolys(), len(names["faces"]))
            finally:
                os.chdir(before)


if __name__ == "__main__":
    unittest.main()
