"""Writes image data by VTK in all its types, encodings, packings and byte orders, and what VTK's own reader reads of them.

    python3 vti_by_vtk.py FOLDER

Prints a line for each array of each file: its name, the array, and the file with the expected values, which are those
that a series has of them: of u32, i64 and u64 as f64."""

import itertools
import pathlib
import sys

import numpy as np
import vtk
from vtk.util import numpy_support

FOLDER = pathlib.Path(sys.argv[1])
EXTENT = (2, 6, -1, 2, 0, 2)
TYPES = ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"]
WIDE = {"u4", "i8", "u8"}
MODES = {"ascii": vtk.vtkXMLWriter.Ascii, "inline": vtk.vtkXMLWriter.Binary, "raw": vtk.vtkXMLWriter.Appended,
         "base64": vtk.vtkXMLWriter.Appended}
PACKINGS = {"plain": vtk.vtkXMLWriter.NONE, "zlib": vtk.vtkXMLWriter.ZLIB, "lz4": vtk.vtkXMLWriter.LZ4,
            "lzma": vtk.vtkXMLWriter.LZMA}


def values(kind, count, mode):
    if kind.startswith("f"):
        numbers = np.linspace(-3, 7, count).astype(kind)
        numbers[1] = np.finfo(kind).max
        numbers[2] = np.finfo(kind).tiny
        if mode != "ascii":  # VTK does not read again all that it writes as text
            numbers[3:6] = np.nan, np.inf, -np.inf
        return numbers
    limits = np.iinfo(kind)
    # Whole numbers that f64 has exactly.
    low, high = (limits.min, limits.max) if limits.bits < 64 else (max(limits.min, -2**53), 2**53)
    numbers = np.array([low + (high - low) // (count - 1) * i for i in range(count)], dtype=kind)
    numbers[-1] = high
    return numbers


def image(kind, mode):
    data = vtk.vtkImageData()
    data.SetExtent(*EXTENT)
    data.SetOrigin(10, 20, 30)
    data.SetSpacing(0.5, 1, 2)
    data.SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1)
    for name, count, fields in (("p", 60, data.GetPointData()), ("q", 60, data.GetPointData()),
                                ("c", 24, data.GetCellData())):
        array = numpy_support.numpy_to_vtk(values(kind, count, mode)[::-1 if name == "q" else 1].copy(), deep=True)
        array.SetName(name)
        fields.AddArray(array)
    time = vtk.vtkDoubleArray()
    time.SetName("TimeValue")
    time.InsertNextValue(2.5)
    data.GetFieldData().AddArray(time)
    return data


def write(name, kind, mode, packing, big, wide, pieces):
    writer = vtk.vtkXMLImageDataWriter()
    writer.SetFileName(str(FOLDER / name))
    writer.SetInputData(image(kind, mode))
    writer.SetDataMode(MODES[mode])
    writer.SetEncodeAppendedData(mode == "base64")
    writer.SetCompressorType(PACKINGS[packing])
    writer.SetBlockSize(64)  # several blocks, of which the last is shorter
    writer.SetNumberOfPieces(pieces)
    if big:
        writer.SetByteOrderToBigEndian()
    else:
        writer.SetByteOrderToLittleEndian()
    if wide:
        writer.SetHeaderTypeToUInt64()
    else:
        writer.SetHeaderTypeToUInt32()
    assert writer.Write()


def tell(name, kind):
    reader = vtk.vtkXMLImageDataReader()
    reader.SetFileName(str(FOLDER / name))
    reader.Update()
    read = reader.GetOutput()
    for array, fields in (("p", read.GetPointData()), ("q", read.GetPointData()), ("c", read.GetCellData())):
        numbers = numpy_support.vtk_to_numpy(fields.GetArray(array))
        assert numbers.dtype == np.dtype(kind)
        if array == "c":  # a vertex has the mean of the cells around it
            cells = numbers.astype("f8").reshape(2, 3, 4)
            padded = np.pad(cells, 1, constant_values=np.nan)
            around = np.stack([padded[z:z + 3, y:y + 4, x:x + 5] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
            if np.isfinite(cells).all() and not kind.startswith("f"):
                expected = np.nanmean(around, axis=0)
                expected = expected.astype("f4" if np.dtype(kind).itemsize < 4 else "f8")
            else:
                continue
        else:
            expected = numbers.astype("f8") if kind in WIDE else numbers
        out = f"{name}.{array}.bin"
        (FOLDER / out).write_bytes(np.ascontiguousarray(expected).tobytes())
        print(name, array, out)


for kind, mode, packing, big, wide in itertools.product(TYPES, MODES, PACKINGS, (False, True), (False, True)):
    if mode == "ascii" and (packing != "plain" or big or wide):
        continue
    name = f"{kind}_{mode}_{packing}_{'big' if big else 'little'}_{64 if wide else 32}.vti"
    write(name, kind, mode, packing, big, wide, 1)
    tell(name, kind)
for mode, packing in itertools.product(MODES, PACKINGS):
    if mode == "ascii" and packing != "plain":
        continue
    name = f"pieces_{mode}_{packing}.vti"
    write(name, "i2", mode, packing, False, True, 3)
    tell(name, "i2")
