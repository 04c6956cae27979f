"""A series of two arrays for the tests, its index, and what NumPy finds in the arrays by itself."""

import os
import subprocess
import tempfile
import unittest

import numpy as np

import isochron

PROGRAM = os.environ["ISOCHRON_PROGRAM"]
STEPS, SHAPE = 4, (20, 37, 18)  # more than one chunk along each axis, none of them whole at the end
SPACING, ORIGIN = (0.5, 0.25, 2.0), (500000.0, -2.0, 3.0)  # x, y, z


def arrays_of(step):
    """Whole numbers with many ties, and smooth values."""
    numbers = np.random.default_rng(step)
    z, y, x = np.meshgrid(*(np.linspace(-1, 1, n, dtype=np.float32) for n in SHAPE), indexing="ij")
    smooth = np.sqrt(x * x + y * y + z * z) - np.float32(0.1 * step)
    return {"rho": numbers.integers(-5, 6, SHAPE).astype(np.int16), "depth": smooth.astype(np.float32)}


def write_vti(name, step, arrays):
    z, y, x = SHAPE
    extent = f"0 {x - 1} 0 {y - 1} 0 {z - 1}"
    kinds = {"int16": "Int16", "float32": "Float32"}
    with open(name, "w") as file:
        file.write(
            '<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian">'
            f'<ImageData WholeExtent="{extent}" Origin="{ORIGIN[0]} {ORIGIN[1]} {ORIGIN[2]}" '
            f'Spacing="{SPACING[0]} {SPACING[1]} {SPACING[2]}"><FieldData>'
            f'<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{0.5 * step}</DataArray>'
            f'</FieldData><Piece Extent="{extent}"><PointData>'
        )
        for array, values in arrays.items():
            text = " ".join(repr(value.item()) for value in values.ravel())
            file.write(f'<DataArray type="{kinds[values.dtype.name]}" Name="{array}" format="ascii">{text}</DataArray>')
        file.write("</PointData></Piece></ImageData></VTKFile>")


def write_nrrd(name, values, header=""):
    """With a header that the program reads by itself."""
    kinds = {"int16": "int16", "float32": "float"}
    sizes = " ".join(str(n) for n in reversed(values.shape))
    with open(name, "wb") as file:
        file.write(
            f"NRRD0004\ntype: {kinds[values.dtype.name]}\ndimension: 3\nsizes: {sizes}\nendian: little\n"
            f"encoding: raw\n{header}\n".encode()
        )
        file.write(values.tobytes())


def active_cells(values, isovalue):
    """min < isovalue <= max over the eight vertices of each cell, one after the other."""
    corners = [
        values[dz : values.shape[0] - 1 + dz, dy : values.shape[1] - 1 + dy, dx : values.shape[2] - 1 + dx]
        for dz in (0, 1)
        for dy in (0, 1)
        for dx in (0, 1)
    ]
    lowest, highest = np.minimum.reduce(corners), np.maximum.reduce(corners)
    return np.flatnonzero((lowest < isovalue) & (isovalue <= highest)).astype(np.uint32)


def program(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


class SeriesTest(unittest.TestCase):
    """Works in a folder with a series of files, and an index of it."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.before = os.getcwd()
        os.chdir(cls.folder.name)
        cls.data = [arrays_of(step) for step in range(STEPS)]
        for step, arrays in enumerate(cls.data):
            write_vti(f"t{step}.vti", step, arrays)
        isochron.build(["t*.vti"], "run.isochron", array=["rho", "depth"]).close()

    @classmethod
    def tearDownClass(cls):
        os.chdir(cls.before)
        cls.folder.cleanup()

    def setUp(self):
        self.run_ = isochron.open("run.isochron")
