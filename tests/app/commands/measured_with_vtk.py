"""Measures of isochron beside those of VTK and scipy, on series that numpy makes.

    /usr/bin/python3 measured_with_vtk.py ISOCHRON
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import scipy.ndimage
import vtk
from vtk.util import numpy_support


def blobs(rng, shape):
    """Smooth bumps well inside the grid: all surfaces of positive values are closed."""
    z, y, x = np.meshgrid(*(np.linspace(-1, 1, n) for n in shape), indexing="ij")
    field = np.zeros(shape)
    for _ in range(12):
        cx, cy, cz = rng.uniform(-0.5, 0.5, 3)
        width = rng.uniform(0.08, 0.25)
        field += rng.uniform(0.3, 1) * np.exp(-((x - cx) ** 2 + (y - cy) ** 2 + (z - cz) ** 2) / width**2)
    edge = (1 - x**2) * (1 - y**2) * (1 - z**2)
    return field * np.clip(4 * edge, 0, 1) - 1e-3


def measured(program, folder, values, spacing, isovalue):
    dims = [str(n) for n in values.shape[::-1]]
    kind = {"float32": "f32", "float64": "f64", "int16": "i16", "uint8": "u8"}[values.dtype.name]
    (folder / "t0.raw").write_bytes(values.tobytes())
    subprocess.run([program, "build", "t0.raw", "-o", "t.isochron", "--force", "--dims", *dims, "--type", kind,
                    "--spacing", *map(str, spacing)], cwd=folder, check=True, capture_output=True)
    found = subprocess.run([program, "measure", "t.isochron", "--isovalue", str(isovalue), "--json"], cwd=folder,
                           check=True, capture_output=True)
    subprocess.run([program, "export", "t.isochron", "--isovalue", str(isovalue), "--steps", "0", "-o", "t.ply",
                    "--force"], cwd=folder, check=True, capture_output=True)
    return json.loads(found.stdout)["rows"][0], of_mesh(folder / "t.ply")


def of_mesh(file):
    """Of the triangles that isochron writes: mass properties, and the number of pieces."""
    reader = vtk.vtkPLYReader()
    reader.SetFileName(str(file))
    return properties(reader)


def properties(source):
    pieces = vtk.vtkPolyDataConnectivityFilter()
    pieces.SetInputConnection(source.GetOutputPort())
    pieces.SetExtractionModeToAllRegions()
    pieces.Update()
    mass = vtk.vtkMassProperties()
    mass.SetInputConnection(source.GetOutputPort())
    mass.Update()
    return {"area": mass.GetSurfaceArea(), "volume": mass.GetVolume(), "pieces": pieces.GetNumberOfExtractedRegions()}


def of_vtk(values, spacing, isovalue):
    image = vtk.vtkImageData()
    image.SetDimensions(*values.shape[::-1])
    image.SetSpacing(*spacing)
    image.GetPointData().SetScalars(numpy_support.numpy_to_vtk(values.ravel(), deep=True))
    surface = vtk.vtkFlyingEdges3D()
    surface.SetInputData(image)
    surface.SetValue(0, isovalue)
    return properties(surface)


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    rng = np.random.default_rng(7)
    worst = {"mesh": 0.0, "contour": 0.0}
    for round_ in range(12):
        shape = tuple(rng.integers(40, 80, 3))
        spacing = tuple(np.round(rng.uniform(0.5, 2, 3), 3))
        field = blobs(rng, shape)
        kind = [np.float32, np.float64, np.int16][round_ % 3]
        scale = 1 if kind != np.int16 else 20000
        values = np.ascontiguousarray((field * scale).astype(kind))
        isovalue = float(np.round(rng.uniform(0.1, 0.5) * scale, 3)) + (0.5 if kind == np.int16 else 0)
        with tempfile.TemporaryDirectory() as folder:
            ours, mesh = measured(program, pathlib.Path(folder), values, spacing, isovalue)
        contour = of_vtk(values, spacing, isovalue)
        bodies = scipy.ndimage.label(values >= isovalue)[1]
        assert ours["border-edges"] == 0, ours
        assert ours["pieces"] == mesh["pieces"] == contour["pieces"], (ours, mesh, contour)
        assert ours["bodies"] == bodies, (ours, bodies)
        for name in ("area", "volume"):
            worst["mesh"] = max(worst["mesh"], abs(ours[name] / mesh[name] - 1))
            worst["contour"] = max(worst["contour"], abs(ours[name] / contour[name] - 1))
    # The contour of VTK divides the same polygons otherwise into triangles.
    print(f"measures differ from VTK's by {worst['mesh']:.1e} on the same triangles, {worst['contour']:.1e} on VTK's own")
    assert worst["mesh"] < 1e-4 and worst["contour"] < 1e-2, worst


main()
