"""Formats of other programs: refused by their names, and where their values are plain, read with the options that the
refusal gives."""
import re
import struct

import h5py
import netCDF4
import numpy as np

from manifest import done, entries, expect, field, path, refuse

values = field(4, 5, 6)


def write(name, content):
    with open(path(name), "wb") as out:
        out.write(content)
    return name


def follow(name, what, advice, expected, **places):
    """The file is refused with this advice, and read with it."""
    refuse(name, f"{what}, whose values {advice} reads")
    options = {key.replace("-", "_"): text.split() for key, text in re.findall(r"--([a-z-]+)([^-]*(?:-\d[^-]*)*)", advice)}
    expect(name, expected, **places, dims=[int(d) for d in options["dims"]], type=options["type"][0],
           header_bytes=int(options["header_bytes"][0]), big_endian="big_endian" in options,
           allow_surplus="allow_surplus" in options, first_step="steps" in options,
           **({"spacing_given": [float(v) for v in options["spacing"]]} if "spacing" in options else {}))


# NumPy
for name, array, advice in [
        ("a.npy", values, "--dims 6 5 4 --type f32 --header-bytes 128"),
        ("big.npy", values.astype(">f8"), "--dims 6 5 4 --type f64 --header-bytes 128 --big-endian"),
        ("columns.npy", np.asfortranarray(field(6, 5, 4, dtype="i2")), "--dims 6 5 4 --type i16 --header-bytes 128")]:
    np.save(path(name), array)
    follow(name, "a NumPy array", advice, array.T if name == "columns.npy" else array)
np.save(path("flat.npy"), values[0])
refuse("flat.npy", "a NumPy array, expected a format that is read")
np.savez(path("a.npz"), v=values)
refuse("a.npz", "unknown format")


# FITS
def fits(name, data, bits, **more):
    cards = {"SIMPLE": "T", "BITPIX": bits, "NAXIS": data.ndim, **{f"NAXIS{i + 1}": n for i, n in enumerate(data.shape[::-1])},
             **more}
    head = "".join(f"{key:8}= {value:>20} / stated".ljust(80) for key, value in cards.items()) + "END".ljust(80)
    return write(name, head.ljust(2880).encode() + data.tobytes() + b"\0" * (-data.nbytes % 2880))


PADDED = "--header-bytes 2880 --big-endian --allow-surplus --steps 0:0"
follow(fits("a.fits", values.astype(">f4"), -32), "FITS", "--dims 6 5 4 --type f32 " + PADDED, values)
odd = field(7, 5, 9)
follow(fits("odd.fits", odd.astype(">f4"), -32), "FITS", "--dims 9 5 7 --type f32 " + PADDED, odd)
short = field(4, 5, 6, dtype=">i2")
follow(fits("a.fit", short, 16), "FITS", "--dims 6 5 4 --type i16 " + PADDED, short)
refuse(fits("scaled.fits", short, 16, BZERO=32768), "FITS, expected a format that is read")


# MRC
def mrc(name, data, mode, extended=0, order=(1, 2, 3)):
    head = bytearray(1024 + extended)
    struct.pack_into("<4i", head, 0, *data.shape[::-1], mode)
    struct.pack_into("<3i", head, 28, *data.shape[::-1])
    struct.pack_into("<3f", head, 40, *[2. * n for n in data.shape[::-1]])
    struct.pack_into("<3i", head, 64, *order)
    struct.pack_into("<i", head, 92, extended)
    head[208:214] = b"MAP \x44\x44"
    return write(name, bytes(head) + data.tobytes())


follow(mrc("a.mrc", values, 2), "MRC", "--dims 6 5 4 --type f32 --header-bytes 1024 --spacing 2 2 2 --length-unit angstrom",
       values, spacing=(2, 2, 2))
signed = field(4, 5, 6, dtype="i1")
follow(mrc("a.map", signed, 0, 512), "MRC", "--dims 6 5 4 --type i8 --header-bytes 1536 --spacing 2 2 2 --length-unit angstrom",
       signed, spacing=(2, 2, 2))
refuse(mrc("turned.mrc", values, 2, order=(3, 2, 1)), "MRC, expected a format that is read")

# Those that are only named.
for name, content, what in [
        ("a.hdf", b"\x0e\x03\x13\x01" + bytes(99), "HDF4, not HDF5: h4toh5"), ("a.grib2", b"GRIB\0\0\0\x02" + bytes(99), "GRIB"),
        ("a.mat", b"MATLAB 5.0 MAT-file".ljust(200), "a MATLAB file before version 7.3"), ("a.root", b"root\0" + bytes(99), "ROOT"),
        ("a.czi", b"ZISRAWFILE" + bytes(99), "Zeiss CZI"), ("a.lif", b"\x70\0\0\0" + bytes(99), "Leica LIF"),
        ("a.nd2", b"\xda\xce\xbe\x0a" + bytes(99), "Nikon ND2"), ("a.png", b"\x89PNG\r\n\x1a\n" + bytes(99), "a PNG picture"),
        ("a.jpg", b"\xff\xd8\xff\xe0" + bytes(99), "a JPEG picture"), ("a.vdb", b" BDV" + bytes(99), "OpenVDB"),
        ("a.jp2", b"\0\0\0\x0cjP  \r\n" + bytes(99), "a JPEG 2000 picture"), ("a.plt", b"#!TDV112" + bytes(99), "Tecplot"),
        ("a.msh", b"$MeshFormat\n", "Gmsh"), ("a.am", b"# AmiraMesh BINARY-LITTLE-ENDIAN 2.1\n", "Amira"),
        ("a.ply", b"ply\nformat ascii 1.0\n", "PLY, a surface and no volume"), ("a.stl", b"solid a\n", "STL, a surface"),
        ("a.mgz", b"\x1f\x8b\x08" + bytes(99), "MGZ"), ("a.lsm", b"II*\0" + bytes(99), "TIFF under another name: name it .tif")]:
    refuse(write(name, content), what)
with h5py.File(path("seven.mat"), "w", userblock_size=512) as file:
    file["v"] = values
with open(path("seven.mat"), "r+b") as file:
    file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\0\x02IM")
refuse("seven.mat", "a MATLAB 7.3 file, which is HDF5: name it .h5")
with open(path("seven.mat"), "rb") as file:
    expect(write("seven.h5", file.read()), values)

# Within HDF5 and NetCDF.
for name, what, fill in [
        ("enzo.h5", "Enzo's boxes", {"Grid00000001/Density": values, "Grid00000002/Density": values}),
        ("silo.h5", "Silo", {".silo/#000001": values, "_silolibinfo": 1}),
        ("bdv.h5", "BigDataViewer's", {"t00000/s00/0/cells": values, "s00/resolutions": np.ones((1, 3)),
                                       "s00/subdivisions": np.ones((1, 3))}),
        ("imaris.h5", "an Imaris file", {"DataSet/ResolutionLevel 0/TimePoint 0/Channel 0/Data": values})]:
    with h5py.File(path(name), "w") as file:
        for key, data in fill.items():
            file[key] = data
        if "imaris" in name:
            file.attrs["ImarisDataSet"] = np.array(list("ImarisDataSet"), "S1")
    refuse(name, what)
expect("bdv.h5", values, array="/t00000/s00/0/cells")
with h5py.File(path("cgns.h5"), "w") as file:
    file.attrs["label"] = np.bytes_("Root Node of HDF5 File")
    file["Base/Density/ data"] = values
refuse("cgns.h5", "CGNS, expected volumes as plain datasets; name it .cgns")
with h5py.File(path("nwb.h5"), "w") as file:
    file.attrs["nwb_version"] = "2.0"
    file["acquisition/data"] = values
refuse("nwb.h5", "--array /PATH")
expect("nwb.h5", values, array="/acquisition/data")
file = netCDF4.Dataset(path("amber.nc"), "w", format="NETCDF3_64BIT_OFFSET")
for name, length in [("frame", 5), ("atom", 50), ("spatial", 3)]:
    file.createDimension(name, length)
file.Conventions = "AMBER"
file.createVariable("coordinates", "f4", ("frame", "atom", "spatial"))[:] = 0
file.close()
refuse("amber.nc", "a trajectory of AMBER, expected volumes")
assert len(entries) > 40
done()
