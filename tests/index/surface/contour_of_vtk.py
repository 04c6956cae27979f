"""A rectilinear grid, and the points and normals of its contour by VTK, as doubles."""
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

folder, isovalue = sys.argv[1], float(sys.argv[2])
random = np.random.default_rng(5)
axes = [at + np.concatenate([[0], np.cumsum(10 ** random.uniform(-1, 1, n - 1))])
        for at, n in [(3, 17), (-20, 14), (0.5, 19)]]
grid = vtk.vtkRectilinearGrid()
grid.SetDimensions(*[len(axis) for axis in axes])
for axis, take in zip(axes, [grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates]):
    take(numpy_to_vtk(axis, deep=True))
z, y, x = np.meshgrid(*[np.arange(len(axis)) for axis in axes[::-1]], indexing="ij")
values = np.sin(0.4 * x) + np.cos(0.5 * y) * np.sin(0.3 * z) + 0.05 * random.standard_normal(x.shape)
scalars = numpy_to_vtk(values.ravel(), deep=True)
scalars.SetName("v")
grid.GetPointData().SetScalars(scalars)
writer = vtk.vtkXMLRectilinearGridWriter()
writer.SetFileName(folder + "/grid.vtr")
writer.SetInputData(grid)
writer.Write()
contour = vtk.vtkContourFilter()
contour.SetInputData(grid)
contour.SetValue(0, isovalue)
contour.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
contour.Update()
points = vtk_to_numpy(contour.GetOutput().GetPoints().GetData()).astype("f8")
points.tofile(folder + "/contour.bin")
