"""Meshes of simulations, resampled: Exodus by VTK's writer, OpenFOAM, AMReX and CGNS as their descriptions say. Values
are linear along each axis where they are to stay exact."""
import os
import shutil
import struct

import numpy as np
import vtk
from vtk.util.vtkAlgorithm import VTKPythonAlgorithmBase

from cgns_files import write_zone
from manifest import done, expect, path, refuse


def linear(x, y, z, time=0.0):
    return x + 2 * y - 3 * z + 10 * time


def grid_values(size, spacing, origin=(0, 0, 0), time=0.0):
    at = [origin[i] + spacing[i] * np.arange(size[i]) for i in range(3)]
    z, y, x = np.meshgrid(at[2], at[1], at[0], indexing="ij")
    return linear(x, y, z, time)


# Exodus: hexahedra between points at whole numbers, three steps.
class Steps(VTKPythonAlgorithmBase):
    """Gives the mesh at each of its times."""
    TIMES = [0.5, 1.0, 2.5]

    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkUnstructuredGrid")

    def RequestInformation(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        key = vtk.vtkStreamingDemandDrivenPipeline
        info.Set(key.TIME_STEPS(), self.TIMES, len(self.TIMES))
        info.Set(key.TIME_RANGE(), [self.TIMES[0], self.TIMES[-1]], 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        time = info.Get(vtk.vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()) or 0.0
        image = vtk.vtkImageData()
        image.SetDimensions(5, 4, 3)
        image.SetSpacing(2, 1, 1)
        append = vtk.vtkAppendFilter()
        append.AddInputData(image)
        append.Update()
        mesh = append.GetOutput()
        values = vtk.vtkDoubleArray()
        values.SetName("temp")
        for i in range(mesh.GetNumberOfPoints()):
            values.InsertNextValue(linear(*mesh.GetPoint(i), time))
        mesh.GetPointData().AddArray(values)
        vtk.vtkUnstructuredGrid.GetData(info).ShallowCopy(mesh)
        return 1


source = Steps()
writer = vtk.vtkExodusIIWriter()
writer.SetInputConnection(source.GetOutputPort())
writer.SetFileName(path("a.exo"))
writer.WriteAllTimeStepsOn()
writer.Write()
expect("a.exo", np.array([grid_values((9, 4, 5), (1, 1, 0.5), time=t) for t in Steps.TIMES]), times=Steps.TIMES,
       spacing=(1, 1, 0.5), kind="within", array="temp", resample=[9, 4, 5])
refuse("a.exo", "--resample NX NY NZ or --resample-by-cell makes one of it")
refuse("a.exo", "pressure", array="pressure", resample=[9, 4, 5])


def write(name, text):
    os.makedirs(os.path.dirname(path(name)), exist_ok=True)
    with open(path(name), "wb" if isinstance(text, bytes) else "w") as f:
        f.write(text)


# OpenFOAM: 3 x 2 x 2 cells of size 1, values at the cells; the two times are folders.
def foam(kind, name, text):
    return f"FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n{text}"


def foam_case(case, size, origin=(0, 0, 0), control=None):
    """`control`: the folder of the whole case, of which this is the part of one processor."""
    nx, ny, nz = size
    ox, oy, oz = origin

    def point(i, j, k):
        return i + (nx + 1) * (j + (ny + 1) * k)

    def cell(i, j, k):
        return i + nx * (j + ny * k)

    points = [f"({i + ox} {j + oy} {k + oz})" for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    inner, outer = [], []  # corners, owner, neighbor
    for k in range(nz + 1):
        for j in range(ny + 1):
            for i in range(nx + 1):
                for axis in range(3):
                    at, size_of = [i, j, k], [nx, ny, nz]
                    b, c = (axis + 1) % 3, (axis + 2) % 3
                    if at[b] == size_of[b] or at[c] == size_of[c]:
                        continue
                    step = np.eye(3, dtype=int)
                    corners = [point(*(np.array(at) + d)) for d in (0 * step[0], step[b], step[b] + step[c], step[c])]
                    below = np.array(at) - step[axis]
                    if at[axis] == 0:
                        outer.append((corners[::-1], cell(*at), None))
                    elif at[axis] == size_of[axis]:
                        outer.append((corners, cell(*below), None))
                    else:
                        inner.append((corners, cell(*below), cell(*at)))
    inner.sort(key=lambda face: (face[1], face[2]))
    faces = inner + outer
    mesh = case + "/constant/polyMesh/"

    def listed(items):
        return f"{len(items)}\n(\n" + "\n".join(items) + "\n)\n"

    write(mesh + "points", foam("vectorField", "points", listed(points)))
    write(mesh + "faces", foam("faceList", "faces", listed([f"4({' '.join(map(str, f[0]))})" for f in faces])))
    write(mesh + "owner", foam("labelList", "owner", listed([str(f[1]) for f in faces])))
    write(mesh + "neighbour", foam("labelList", "neighbour", listed([str(f[2]) for f in inner])))
    write(mesh + "boundary", foam("polyBoundaryMesh", "boundary",
                                  f"1\n(\nwalls {{ type wall; nFaces {len(outer)}; startFace {len(inner)}; }}\n)\n"))
    write((control or case) + "/system/controlDict", foam("dictionary", "controlDict",
                                             "startTime 0; endTime 1; deltaT 0.5; writeControl timeStep; writeInterval "
                                             "1; timeFormat general; timePrecision 6;\n"))
    for time in (0.5, 1):
        values = [str(linear(i + ox + 0.5, j + oy + 0.5, k + oz + 0.5, time)) for k in range(nz)
                  for j in range(ny) for i in range(nx)]
        write(f"{case}/{time}/p", foam("volScalarField", "p",
                                       "dimensions [0 2 -2 0 0 0 0];\ninternalField nonuniform List<scalar> "
                                       + listed(values) + ";\nboundaryField { walls { type zeroGradient; } }\n"))
    write((control or case) + "/run.foam", "")


foam_case("cavity", (4, 3, 3))
# VTK averages cells to points: within, what is linear stays so; a border point has the mean of fewer cells.
inner = grid_values((4, 3, 3), (1, 1, 1), (0, 0, 0))


def averaged(size, time, first=0):
    cells = np.array([[[linear(first + i + 0.5, j + 0.5, k + 0.5, time) for i in range(size[0])] for j in range(size[1])]
                      for k in range(size[2])])
    padded = np.pad(cells, 1, constant_values=np.nan)
    around = [padded[k:k + size[2] + 1, j:j + size[1] + 1, i:i + size[0] + 1] for k in (0, 1) for j in (0, 1)
              for i in (0, 1)]
    return np.nanmean(around, axis=0)


steps = np.array([averaged((4, 3, 3), time) for time in (0.5, 1)])
for name in ["cavity", "cavity/run.foam", "cavity/system/controlDict"]:
    expect(name, steps, times=[0.5, 1], kind="within", array="p", resample=[5, 4, 4])


# The same case, divided between two processors at x = 2, where no vertex lies. A mesh of the whole may be there, too.
def divided(time):
    """Along x from each part's own points."""
    parts = [averaged((2, 3, 3), time, first) for first in (0, 2)]
    at = np.linspace(0, 4, 6)
    return np.stack([parts[0][..., 0] * (1 - x) + parts[0][..., 1] * x if x < 1 else
                     parts[0][..., 1] * (2 - x) + parts[0][..., 2] * (x - 1) if x < 2 else
                     parts[1][..., 0] * (3 - x) + parts[1][..., 1] * (x - 2) if x < 3 else
                     parts[1][..., 1] * (4 - x) + parts[1][..., 2] * (x - 3) for x in at], axis=-1)


for case in ["divided", "mesh_too", "all_too"]:
    for processor in (0, 1):
        foam_case(f"{case}/processor{processor}", (2, 3, 3), (2 * processor, 0, 0), case)
foam_case("mesh_too", (4, 3, 3))
for time in ("0.5", "1"):
    shutil.rmtree(path(f"mesh_too/{time}"))
for case in ["divided", "mesh_too"]:
    expect(case, np.array([divided(time) for time in (0.5, 1)]), times=[0.5, 1], spacing=(0.8, 1, 1), kind="within",
           array="p", resample=[6, 4, 4])
foam_case("all_too", (4, 3, 3))
expect("all_too", steps, times=[0.5, 1], kind="within", array="p", resample=[5, 4, 4])
write("empty/system/controlDict", foam("dictionary", "controlDict", "startTime 0; endTime 1; deltaT 1;\n"))
refuse("empty", "without constant/polyMesh", resample=[4, 4, 4])
os.makedirs(path("empty/processors4"))
refuse("empty", "reconstructPar", resample=[4, 4, 4])


# AMReX: a level of 8 x 8 x 8 cells, and one twice as fine on the first half of x; cells of the coarse level below it say
# something else, which must not be seen.
def fab(low, high, values):
    head = "FAB ((8, (64 11 52 0 1 12 0 1023)),(8, (8 7 6 5 4 3 2 1)))"
    return (f"{head}(({low}) ({high}) (0,0,0)) 1\n").encode() + values.astype("<f8").tobytes()


def level(folder, number, low, high, values):
    box = f"(({low}) ({high}) (0,0,0))"
    write(f"{folder}/Level_{number}/Cell_H",
          f"1\n1\n1\n0\n(1 0\n{box}\n)\n1\nFabOnDisk: Cell_D_00000 0\n\n1,1\n{values.min():.16e},\n\n1,1\n"
          f"{values.max():.16e},\n")
    write(f"{folder}/Level_{number}/Cell_D_00000", fab(low, high, values))


def plotfile(folder, time):
    at = (np.arange(8) + 0.5) / 8
    z, y, x = np.meshgrid(at, at, at, indexing="ij")
    coarse = np.where(x < 0.5, -99, linear(x, y, z, time))
    fine_x, fine = (np.arange(8) + 0.5) / 16, (np.arange(16) + 0.5) / 16
    z, y, x = np.meshgrid(fine, fine, fine_x, indexing="ij")
    write(folder + "/Header",
          f"HyperCLaw-V1.1\n1\nrho\n3\n{time}\n1\n0 0 0\n1 1 1\n2\n"
          "((0,0,0) (7,7,7) (0,0,0)) ((0,0,0) (15,15,15) (0,0,0))\n3 3\n0.125 0.125 0.125\n0.0625 0.0625 0.0625\n0\n0\n"
          f"0 1 {time}\n3\n0 1\n0 1\n0 1\nLevel_0/Cell\n1 1 {time}\n3\n0 0.5\n0 1\n0 1\nLevel_1/Cell\n")
    level(folder, 0, "0,0,0", "7,7,7", coarse)
    level(folder, 1, "0,0,0", "7,15,15", linear(x, y, z, time))


# Values of cells are those of the cell that a vertex of the new grid lies in.
def of_cells(count, time):
    at = np.arange(count) / (count - 1)

    def center(v, cell):
        return np.minimum((np.floor(v / cell)), np.round(1 / cell) - 1) * cell + cell / 2

    z, y, x = np.meshgrid(at, at, at, indexing="ij")
    cell = np.where(x < 0.5, 0.0625, 0.125)
    return linear(center(x, cell), center(y, cell), center(z, cell), time)


for i, time in enumerate((0.25, 0.75)):
    plotfile(f"plt{i:05d}", time)
# 12 vertices: none of the inner ones lies on a border of cells.
expect(["plt00000", "plt00001"], np.array([of_cells(12, t) for t in (0.25, 0.75)]), times=[0.25, 0.75],
       spacing=(1 / 11, 1 / 11, 1 / 11), kind="within", array="rho", resample=[12, 12, 12])
expect("plt00000", of_cells(12, 0.25), times=[0.25], spacing=(1 / 11, 1 / 11, 1 / 11), kind="within", array="rho",
       resample=[12, 12, 12])
write("flat/Header", "HyperCLaw-V1.1\n1\nrho\n2\n0.25\n0\n0 0\n1 1\n\n((0,0) (7,7) (0,0))\n0\n0.125 0.125\n0\n0\n")
refuse("flat", "a plotfile of 2 dimensions, expected 3", resample=[4, 4, 4])


write_zone(path("zone.cgns"), 2, linear)
expect("zone.cgns", grid_values((9, 4, 5), (1, 1, 0.5)), spacing=(1, 1, 0.5), kind="within", array="Density",
       resample=[9, 4, 5])
# EnSight Gold: a block of one part, two times, as text and binary.
def ensight(case, binary):
    size, spacing = (9, 4, 5), (1, 1, 0.5)

    def written(*parts):
        out = b""
        for part in parts:
            if isinstance(part, str):
                out += part.encode().ljust(80) if binary else part.encode() + b"\n"
            elif np.asarray(part).dtype.kind == "i":
                out += np.asarray(part, "<i4").tobytes() if binary else " ".join(f"{v:10d}" for v in part).encode() + b"\n"
            else:
                out += np.asarray(part, "<f4").tobytes() if binary else b"".join(b"%12.5e\n" % v for v in np.ravel(part))
        return out

    head = ("C Binary",) if binary else ()
    write(case + "/run.geo", written(*head, "a block", "of one part", "node id off", "element id off", "part", [1], "block",
                                     "block rectilinear", list(size), *[np.arange(n) * float(s) for n, s in zip(size, spacing)]))
    for number, time in enumerate((0.25, 0.75)):
        write(f"{case}/temp_{number}.scl", written("temp", "part", [1], "block", grid_values(size, spacing, time=time)))
    write(case + "/run.case", "FORMAT\ntype: ensight gold\n\nGEOMETRY\nmodel: run.geo\n\nVARIABLE\nscalar per node: 1 temp temp_*.scl"
          "\n\nTIME\ntime set: 1\nnumber of steps: 2\nfilename start number: 0\nfilename increment: 1\ntime values: 0.25 0.75\n")
    expect(case + "/run.case", np.array([grid_values(size, spacing, time=t) for t in (0.25, 0.75)]), times=[0.25, 0.75],
           spacing=spacing, kind="within", array="temp", resample=list(size))


for binary in (False, True):
    ensight("ensight_binary" if binary else "ensight_text", binary)
write("notes.case", "a case of something else\n")
refuse("notes.case", "unknown format")
done()
