"""Rectilinear grids, files of several pieces and other grids by VTK."""
import json

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from manifest import done, expect, field, path, refuse

X, Y, Z = [0.0, 1.0, 3.0, 6.0, 10.0], [2.0, 2.5, 4.0, 4.25], [-1.0, 0.0, 5.0]


def array(values, name, components=1):
    data = numpy_to_vtk(np.ascontiguousarray(values).reshape(-1, components).squeeze(), deep=True)
    data.SetName(name)
    return data


def rectilinear(values):
    grid = vtk.vtkRectilinearGrid()
    grid.SetDimensions(5, 4, 3)
    for at, take in [(X, grid.SetXCoordinates), (Y, grid.SetYCoordinates), (Z, grid.SetZCoordinates)]:
        take(array(np.array(at), "at"))
    grid.GetPointData().SetScalars(array(values, "p"))
    return grid


def image(values, origin=(1, 2, 3), spacing=(0.5, 1, 2)):
    grid = vtk.vtkImageData()
    grid.SetDimensions(values.shape[::-1])
    grid.SetOrigin(origin)
    grid.SetSpacing(spacing)
    grid.GetPointData().SetScalars(array(values, "p"))
    return grid


def write(writer, data, name, **how):
    writer.SetFileName(path(name))
    writer.SetInputData(data)
    for key, value in how.items():
        getattr(writer, key)(value)
    writer.Write()


values = field(3, 4, 5)
where = dict(spacing=(2.5, 0.75, 3), origin=(0, 2, -1), positions=[X, Y, Z])
write(vtk.vtkXMLRectilinearGridWriter(), rectilinear(values), "a.vtr")
write(vtk.vtkXMLRectilinearGridWriter(), rectilinear(values), "ascii.vtr", SetDataMode=vtk.vtkXMLWriter.Ascii)
write(vtk.vtkRectilinearGridWriter(), rectilinear(values), "legacy.vtk", SetFileType=vtk.VTK_BINARY)
write(vtk.vtkXMLPRectilinearGridWriter(), rectilinear(values), "parts.pvtr", SetNumberOfPieces=2, SetStartPiece=0,
      SetEndPiece=1)
for name in ["a.vtr", "ascii.vtr", "legacy.vtk", "parts.pvtr"]:
    expect(name, values, **where)
# NaN and infinities as text; falling coordinates.
hard = values.copy()
hard[0, 1, 2], hard[1, 2, 3] = np.nan, -1e30
text = "\n".join(str(v) for v in hard.ravel())
for name, y in [("hard.vtk", Y), ("falling.vtk", Y[::-1])]:
    with open(path(name), "w") as f:
        f.write("# vtk DataFile Version 3.0\nnan\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 5 4 3\n" + "".join(
            f"{axis}_COORDINATES {len(at)} double\n{' '.join(map(str, at))}\n" for axis, at in zip("XYZ", (X, y, Z))) +
            f"POINT_DATA 60\nSCALARS p float\nLOOKUP_TABLE default\n{text}\n")
expect("hard.vtk", hard, **where)
expect("falling.vtk", hard, **{**where, "origin": (0, 4.25, -1), "positions": [X, Y[::-1], Z]},
       direction=[[1, 0, 0], [0, -1, 0], [0, 0, 1]])
series = field(2, 3, 4, 5)
write(vtk.vtkXMLPImageDataWriter(), image(values), "parts.pvti", SetNumberOfPieces=2, SetStartPiece=0, SetEndPiece=1)
expect("parts.pvti", values, spacing=(0.5, 1, 2), origin=(1, 2, 3))
for i in (0, 1):
    write(vtk.vtkXMLImageDataWriter(), image(series[i]), f"s{i}.vti")
with open(path("run.vti.series"), "w") as f:
    json.dump({"file-series-version": "1.0",
               "files": [{"name": "s1.vti", "time": 2.5}, {"name": "s0.vti", "time": 0.5}]}, f)
expect("run.vti.series", series, times=[0.5, 2.5], spacing=(0.5, 1, 2), origin=(1, 2, 3))
with open(path("bad.vti.series"), "w") as f:
    f.write('{"files": [{"name": "s1.vti"}]}')
refuse("bad.vti.series", "file 0 has no name, or no time that is a number")

# Resampled: what is linear along each axis stays exact.
z, y, x = np.meshgrid(Z, Y, X, indexing="ij")
write(vtk.vtkXMLRectilinearGridWriter(), rectilinear((x + 2 * y - z).astype("f8")), "linear.vtr")
z, y, x = np.meshgrid(np.linspace(-1, 5, 7), np.linspace(2, 4.25, 10), np.linspace(0, 10, 6), indexing="ij")
expect("linear.vtr", x + 2 * y - z, spacing=(2, 0.25, 1), origin=(0, 2, -1), kind="rounded", resample=[6, 10, 7])

# Curvilinear and unstructured grids by VTK's own resampling.
curved = vtk.vtkStructuredGrid()
curved.SetDimensions(5, 4, 3)
points = vtk.vtkPoints()
for k in range(3):
    for j in range(4):
        for i in range(5):
            points.InsertNextPoint(i + 0.1 * j, j, k + 0.05 * i)
curved.SetPoints(points)
curved.GetPointData().SetScalars(array(values, "p"))
append = vtk.vtkAppendFilter()
append.AddInputData(curved)
append.Update()
for writer, data, name in [(vtk.vtkXMLStructuredGridWriter(), curved, "c.vts"),
                           (vtk.vtkXMLUnstructuredGridWriter(), append.GetOutput(), "u.vtu"),
                           (vtk.vtkUnstructuredGridWriter(), append.GetOutput(), "u_legacy.vtk")]:
    write(writer, data, name, **({"SetFileType": vtk.VTK_BINARY} if name.endswith(".vtk") else {}))
    refuse(name, "--resample NX NY NZ makes a regular grid of it")
    resample = vtk.vtkResampleToImage()
    resample.SetInputDataObject(data)
    resample.SetSamplingDimensions(9, 8, 7)
    resample.Update()
    out = resample.GetOutput()
    got = vtk_to_numpy(out.GetPointData().GetArray("p")).astype("f8").reshape(7, 8, 9)
    hidden = vtk_to_numpy(out.GetPointData().GetArray("vtkGhostType")).reshape(7, 8, 9) != 0
    cells = vtk_to_numpy(out.GetCellData().GetArray("vtkGhostType")).reshape(6, 7, 8) != 0
    around = np.pad(cells, 1, constant_values=True)  # a vertex without a cell that is seen is not seen either
    hidden |= np.logical_and.reduce([around[k:k + 7, j:j + 8, i:i + 9] for k in (0, 1) for j in (0, 1) for i in (0, 1)])
    expect(name, np.where(hidden, np.nan, got), spacing=out.GetSpacing(), origin=out.GetOrigin(), kind="hidden",
           resample=[9, 8, 7])

# Two levels of refinement, the second on the first half of x; what the first says below it must not be seen.
levels = vtk.vtkOverlappingAMR()
levels.Initialize(2, [1, 1])
levels.SetOrigin([0, 0, 0])
levels.SetGridDescription(vtk.VTK_XYZ_GRID)
for number, (counts, cell) in enumerate((((8, 8, 8), 1), ((8, 16, 16), 0.5))):
    z, y, x = np.meshgrid(*[cell * (np.arange(n) + 0.5) for n in counts[::-1]], indexing="ij")
    grid = vtk.vtkUniformGrid()
    grid.SetSpacing(cell, cell, cell)
    grid.SetDimensions([n + 1 for n in counts])
    grid.GetCellData().AddArray(array(np.where((number == 0) & (x < 4), -99, x + 2 * y - 3 * z), "p"))
    levels.SetSpacing(number, [cell] * 3)
    levels.SetAMRBox(number, 0, vtk.vtkAMRBox([0, 0, 0], grid.GetDimensions(), [cell] * 3, [0, 0, 0], vtk.VTK_XYZ_GRID))
    levels.SetDataSet(number, 0, grid)
for name in ["levels.vth", "boxes.vthb"]:
    write(vtk.vtkXMLUniformGridAMRWriter(), levels, name)
at = 8 * np.arange(12) / 11  # between the borders of cells
z, y, x = np.meshgrid(at, at, at, indexing="ij")
cell = np.where(x < 4, 0.5, 1)


def center(v):
    return np.minimum(np.floor(v / cell), 8 / cell - 1) * cell + cell / 2


for name in ["levels.vth", "boxes.vthb"]:
    expect(name, center(x) + 2 * center(y) - 3 * center(z), spacing=[8 / 11] * 3, kind="within", resample=[12] * 3)
done()
