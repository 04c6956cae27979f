"""Series for `isochron export`, and what VTK and the formats' own rules say of the exported files.

    exported_with_vtk.py make FOLDER          writes FOLDER/t0.vti and t1.vti with two arrays
    exported_with_vtk.py check FOLDER         compares FOLDER/out.* with vtkFlyingEdges3D
"""
import json
import re
import struct
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

ISOVALUES = (0.25, -0.4)
SPACING = np.array([0.5, 2.0, 1.25])
ORIGIN = np.array([10.0, -20.0, 30.0])
SHAPE = (19, 17, 23)  # z, y, x


def values(step):
    z, y, x = np.meshgrid(*[np.arange(n) for n in SHAPE], indexing="ij")
    return (np.sin(0.4 * x + 0.2 * step) + np.cos(0.5 * y) * np.sin(0.3 * z)).astype("f4")


def colors():
    z, y, x = np.meshgrid(*[np.arange(n) for n in SHAPE], indexing="ij")
    return (x + 2.0 * y - 3.0 * z).astype("f4")  # linear, so that interpolation is exact


def image(step):
    made = vtk.vtkImageData()
    made.SetDimensions(*SHAPE[::-1])
    made.SetSpacing(*SPACING)
    made.SetOrigin(*ORIGIN)
    for name, array in (("v", values(step)), ("c", colors())):
        scalars = numpy_to_vtk(array.ravel(), deep=True)
        scalars.SetName(name)
        made.GetPointData().AddArray(scalars)
    made.GetPointData().SetActiveScalars("v")
    return made


def make(folder):
    for step in range(2):
        writer = vtk.vtkXMLImageDataWriter()
        writer.SetFileName(f"{folder}/t{step}.vti")
        writer.SetInputData(image(step))
        writer.Write()


def wanted(step, isovalue):
    contour = vtk.vtkFlyingEdges3D()
    contour.SetInputData(image(step))
    contour.SetValue(0, isovalue)
    contour.Update()
    return triangles_of(contour.GetOutput())


def triangles_of(poly):
    """Corners of all triangles: (n, 3, 3)."""
    points = vtk_to_numpy(poly.GetPoints().GetData()).astype("f8")
    cells = vtk_to_numpy(poly.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return points[cells]


def outlines(triangles):
    """The cells that triangles lie in, and for each the vector area of its polygons, which only their outlines
    decide: a polygon of more than three corners may be cut into triangles in several ways."""
    places = (triangles - ORIGIN) / SPACING
    cells = np.floor(places.mean(axis=1)).astype("i8")
    area = np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])
    found, which = np.unique(cells, axis=0, return_inverse=True)
    return found, np.stack([np.bincount(which.ravel(), area[:, axis]) for axis in range(3)], axis=1)


def compare(name, found, expected, tolerance=1e-4):
    assert len(found) == len(expected) > 300, (name, len(found), len(expected))
    (cells, areas), (their_cells, their_areas) = outlines(found), outlines(expected)
    assert np.array_equal(cells, their_cells), name
    assert np.abs(areas - their_areas).max() < tolerance, (name, np.abs(areas - their_areas).max())
    for axis in range(3):  # and all corners are where they are in VTK's surface
        places = [np.sort(np.unique(np.round(t.reshape(-1, 3), 9), axis=0)[:, axis]) for t in (found, expected)]
        assert len(places[0]) == len(places[1]) and np.abs(places[0] - places[1]).max() < 1e-5 * SPACING[axis], name


def read(reader, name):
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput()


def linear(srgb):
    """Light of 8-bit sRGB, by IEC 61966-2-1."""
    c = srgb / 255
    return np.where(c <= .04045, c / 12.92, ((c + .055) / 1.055) ** 2.4)


def check_glb(name, steps):
    """Returns the colors of the vertices."""
    colors = []
    with open(name, "rb") as file:
        content = file.read()
    magic, version, length = struct.unpack("<III", content[:12])
    assert (magic, version, length) == (0x46546C67, 2, len(content)), name
    size, kind = struct.unpack("<II", content[12:20])
    assert kind == 0x4E4F534A and size % 4 == 0
    document = json.loads(content[20:20 + size])
    bytes_, kind = struct.unpack("<II", content[20 + size:28 + size])
    binary = content[28 + size:]
    assert kind == 0x004E4942 and bytes_ == len(binary) == document["buffers"][0]["byteLength"]
    types = {5126: "<f4", 5125: "<u4", 5121: "u1"}
    shapes = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}

    def array(number):
        accessor = document["accessors"][number]
        view = document["bufferViews"][accessor["bufferView"]]
        assert view["byteOffset"] % 4 == 0
        dtype, width = np.dtype(types[accessor["componentType"]]), shapes[accessor["type"]]
        assert view["byteLength"] == accessor["count"] * width * dtype.itemsize
        assert view["byteOffset"] + view["byteLength"] <= len(binary)
        found = np.frombuffer(binary, dtype, accessor["count"] * width, view["byteOffset"])
        return found.reshape(-1, width), accessor

    for mesh in document["meshes"]:
        part = mesh["primitives"][0]
        places, accessor = array(part["attributes"]["POSITION"])
        assert np.array_equal(places.min(0), np.float32(accessor["min"]))
        assert np.array_equal(places.max(0), np.float32(accessor["max"]))
        normals, _ = array(part["attributes"]["NORMAL"])
        assert np.allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-3)
        corners, _ = array(part["indices"])
        assert corners.max() < len(places)
        colors.append(array(part["attributes"]["COLOR_0"])[0][:, :3])
    root = document["nodes"][0]
    shown = [document["nodes"][i] for i in root["children"]]
    assert len(shown) == steps
    if steps > 1:
        assert [node.get("scale", [1, 1, 1])[0] for node in shown] == [1] + [0] * (steps - 1)
        animation = document["animations"][0]
        for time in np.arange(steps) / 10 + 0.05:  # in the middle of each step one is shown
            scales = []
            for channel in animation["channels"]:
                sampler = animation["samplers"][channel["sampler"]]
                times, _ = array(sampler["input"])
                scale, _ = array(sampler["output"])
                scales.append(scale[np.searchsorted(times[:, 0], time, side="right") - 1, 0])
            assert scales == [1.0 if abs(k / 10 + 0.05 - time) < 1e-6 else 0.0 for k in range(steps)], scales
    return np.concatenate(colors)


def check_usda(name, expected):
    """Returns the colors of the vertices of each step."""
    colors = [[], []]
    text = open(name).read()
    assert text.startswith("#usda 1.0\n")
    bare = re.sub(r'"(\\.|[^"\\])*"', '""', text)
    for open_, close in ("()", "[]", "{}"):
        assert bare.count(open_) == bare.count(close)
    meshes = text.split("def Mesh ")[1:]
    assert len(meshes) == len(ISOVALUES)
    for surface, mesh in enumerate(meshes):
        def samples(attribute):
            block = re.search(re.escape(attribute) + r"\.timeSamples = \{\n(.*?)\n        \}", mesh, re.S)
            return [np.array([float(number) for number in re.findall(r"[-+0-9.e]+", line.split(": ", 1)[1])])
                    for line in block.group(1).split("\n")]
        points, faces, counts = (samples(a) for a in ("point3f[] points", "int[] faceVertexIndices",
                                                      "int[] faceVertexCounts"))
        assert len(points) == len(faces) == len(counts) == 2
        for step in range(2):
            assert (counts[step] == 3).all() and counts[step].sum() == len(faces[step])
            places = points[step].reshape(-1, 3)
            compare(f"usda {surface} {step}", places[faces[step].astype("i8").reshape(-1, 3)],
                    expected[step][surface])
            colors[step].append(samples("color3f[] primvars:displayColor")[step].reshape(-1, 3))
    return [np.concatenate(of_step) for of_step in colors]


def check(folder):
    expected = [[wanted(step, isovalue) for isovalue in ISOVALUES] for step in range(2)]
    usda = check_usda(f"{folder}/usda.usda", expected)
    for step in range(2):
        both = np.concatenate(expected[step])
        ply = read(vtk.vtkPLYReader(), f"{folder}/ply_{step:04}.ply")
        compare("ply", triangles_of(ply), both)
        # The normals point to the side of lower values, as the triangles do.
        corners = triangles_of(ply)
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals = vtk_to_numpy(ply.GetPointData().GetNormals())
        cells = vtk_to_numpy(ply.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        flat = np.linalg.norm(across, axis=1) < 1e-6
        assert ((across * normals[cells[:, 0]]).sum(1)[~flat] > 0).mean() > 0.98
        compare("obj", triangles_of(read(vtk.vtkOBJReader(), f"{folder}/obj_{step:04}.obj")), both)
        for surface in range(2):
            stl = read(vtk.vtkSTLReader(), f"{folder}/stl_surface{surface + 1}_{step:04}.stl")
            # The reader merges equal points and drops triangles without an area.
            area = expected[step][surface]
            size = np.linalg.norm(np.cross(area[:, 1] - area[:, 0], area[:, 2] - area[:, 0]), axis=1)
            assert abs(stl.GetNumberOfCells() - len(area)) <= (size < 1e-6).sum()
        vtp = read(vtk.vtkXMLPolyDataReader(), f"{folder}/vtp_{step:04}.vtp")
        compare("vtp", triangles_of(vtp), both)
        points = vtk_to_numpy(vtp.GetPoints().GetData()).astype("f8")
        found = vtk_to_numpy(vtp.GetPointData().GetArray("c"))
        assert np.allclose(found, ((points - ORIGIN) / SPACING) @ [1, 2, -3], atol=1e-3)
        assert set(vtk_to_numpy(vtp.GetPointData().GetArray("surface"))) == {0, 1}
        # Colors are sRGB, but those of glTF and USD are linear light.
        srgb = vtk_to_numpy(vtp.GetPointData().GetArray("color"))
        assert len(np.unique(srgb, axis=0)) > 50
        assert np.array_equal(vtk_to_numpy(ply.GetPointData().GetArray("RGB")), srgb)
        obj = [line.split()[4:7] for line in open(f"{folder}/obj_{step:04}.obj") if line.startswith("v ")]
        assert np.allclose(np.array(obj, "f8") * 255, srgb, atol=.1)
        assert np.abs(usda[step] - linear(srgb)).max() < 1e-6
        assert np.abs(check_glb(f"{folder}/glb_{step:04}.glb", 1) / 255 - linear(srgb)).max() < .51 / 255
        reader = vtk.vtkGLTFReader()
        blocks = read(reader, f"{folder}/glb_{step:04}.glb").NewIterator()
        blocks.InitTraversal()
        cells = 0
        while not blocks.IsDoneWithTraversal():
            cells += blocks.GetCurrentDataObject().GetNumberOfCells()
            blocks.GoToNextItem()
        assert cells == len(both)
    collection = open(f"{folder}/vtp.pvd").read()
    assert re.findall(r'file="([^"]+)"', collection) == ["vtp_0000.vtp", "vtp_0001.vtp"]
    check_glb(f"{folder}/glb-animation.glb", 2)


if __name__ == "__main__":
    {"make": make, "check": check}[sys.argv[1]](sys.argv[2])
