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
           **{key + "_given": [float(v) for v in options[key]] for key in ("spacing", "origin") if key in options})


# NumPy
for name, array, advice in [
        ("a.npy", values, "--dims 6 5 4 --type f32 --header-bytes 128"),
        ("big.npy", values.astype(">f8"), "--dims 6 5 4 --type f64 --header-bytes 128 --big-endian"),
        ("columns.npy", np.asfortranarray(field(6, 5, 4, dtype="i2")), "--dims 6 5 4 --type i16 --header-bytes 128")]:
    np.save(path(name), array)
    follow(name, "a NumPy array", advice, array.T if name == "columns.npy" else array)
np.save(path("flat.npy"), values[0])
refuse("flat.npy", "a NumPy array, expected a format that is read")
truth = field(4, 5, 6, dtype="u1") > 99
np.save(path("truth.npy"), truth)
follow("truth.npy", "a NumPy array", "--dims 6 5 4 --type u8 --header-bytes 128", truth)
moving = field(3, 4, 5, 6)
np.save(path("steps.npy"), moving)
follow("steps.npy", "a NumPy array", "--dims 6 5 4 --type f32 --header-bytes 128", moving)
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
where = dict(CDELT1=2.0, CDELT2=3.0, CDELT3=0.5, CRVAL1=10.0, CRVAL2=-20.0, CRVAL3=30.0, CRPIX1=1.0, CRPIX2=2.0, CRPIX3=0.5)
follow(fits("placed.fits", values.astype(">f4"), -32, **where), "FITS",
       "--dims 6 5 4 --type f32 " + PADDED + " --spacing 2 3 0.5 --origin 10 -23 30.25", values, spacing=(2, 3, .5),
       origin=(10, -23, 30.25))
follow(fits("meters.fits", values.astype(">f4"), -32, **where, CUNIT1="'mm'", CUNIT2="'mm'", CUNIT3="'mm'"), "FITS",
       "--dims 6 5 4 --type f32 " + PADDED + " --spacing 2 3 0.5 --origin 10 -23 30.25 --length-unit mm", values,
       spacing=(2, 3, .5), origin=(10, -23, 30.25))
refuse(fits("left.fits", values.astype(">f4"), -32, **{**where, "CDELT1": -2.0}),
       PADDED + " reads, without its CDELT1 CDELT2 CDELT3 CRPIX1 CRPIX2 CRPIX3 CRVAL1 CRVAL2 CRVAL3")
refuse(fits("turned.fits", values.astype(">f4"), -32, CD1_1=1.0, PC1_2=0.5, BLANK=-1), "reads, without its BLANK CD1_1 PC1_2")
short = field(4, 5, 6, dtype=">i2")
follow(fits("a.fit", short, 16), "FITS", "--dims 6 5 4 --type i16 " + PADDED, short)
refuse(fits("scaled.fits", short, 16, BZERO=32768), "FITS, expected a format that is read")


# Those that are only named.
for name, content, what in [
        ("a.hdf", b"\x0e\x03\x13\x01" + bytes(99), "h4toh5 IN OUT.h5 makes HDF5 of it"),
        ("a.grib2", b"GRIB\0\0\0\x02" + bytes(99), "cdo -f nc copy IN OUT.nc makes NetCDF of it"),
        ("a.mat", b"MATLAB 5.0 MAT-file".ljust(200), "a MATLAB file before version 7.3"), ("a.root", b"root\0" + bytes(99), "ROOT"),
        ("a.czi", b"ZISRAWFILE" + bytes(99), "Zeiss CZI, expected a format that is read: NRRD, NIfTI, VTK, HDF5 or another one of the guide's; bfconvert"), ("a.lif", b"\x70\0\0\0" + bytes(99), "Leica LIF"),
        ("a.nd2", b"\xda\xce\xbe\x0a" + bytes(99), "Nikon ND2"), ("a.png", b"\x89PNG\r\n\x1a\n" + bytes(99), "a PNG picture"),
        ("a.jpg", b"\xff\xd8\xff\xe0" + bytes(99), "a JPEG picture"), ("a.vdb", b" BDV" + bytes(99), "OpenVDB"),
        ("a.jp2", b"\0\0\0\x0cjP  \r\n" + bytes(99), "a JPEG 2000 picture"), ("a.plt", b"#!TDV112" + bytes(99), "Tecplot"),
        ("a.msh", b"$MeshFormat\n", "Gmsh"), ("a.am", b"# AmiraMesh BINARY-LITTLE-ENDIAN 2.1\n", "Amira"),
        ("a.ply", b"ply\nformat ascii 1.0\n", "PLY, a surface and no volume"), ("a.stl", b"solid a\n", "STL, a surface"),
        ("a.dm3", b"\0\0\0\x03" + bytes(99), "Gatan DM3, expected"), ("a.oib", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "bfconvert"),
        ("a.par", b"# === DATA DESCRIPTION FILE ===", "dcm2niix"), ("a.rda", b">>> Begin of header <<<", "spec2nii"),
        ("a.head", b"type = string-attribute", "3dAFNItoNIFTI"),
        ("a.BRIK.gz", b"\x1f\x8b\x08" + bytes(99), "3dAFNItoNIFTI"), ("attributes.json", b"{}", "N5"),
        ("a.dat.gz", b"\x1f\x8b\x08" + bytes(99), "gzip -dc IN > OUT"),
        ("a.nrrd", b"\x1f\x8b\x08" + bytes(99), "nrrd by its name, its content is compressed by gzip"),
        # A known end, and another program's content: both are said.
        ("picture.tif", b"\x89PNG\r\n\x1a\n" + bytes(999), "tiff by its name, its content is a PNG picture"),
        ("picture.raw", b"\x89PNG\r\n\x1a\n" + bytes(999), "raw by its name, its content is a PNG picture"),
        ("lens.nii", b"ZISRAWFILE" + bytes(999), "nifti by its name, its content is Zeiss CZI"),
        ("weather.nc", b"GRIB\0\0\0\x02" + bytes(999), "netcdf by its name, its content is GRIB"),
        ("cells.mha", b"\xda\xce\xbe\x0a" + bytes(999), "metaimage by its name, its content is Nikon ND2")]:
    refuse(write(name, content), what)
with h5py.File(path("seven.mat"), "w", userblock_size=512) as file:
    file["v"] = values
with open(path("seven.mat"), "r+b") as file:
    file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\0\x02IM")
expect("seven.mat", values)
with open(path("seven.mat"), "rb") as file:
    expect(write("seven.h5", file.read()), values)
for block in (1024, 2048):
    with h5py.File(path(f"block{block}"), "w", userblock_size=block) as file:
        file["v"] = values
    expect(f"block{block}", values)

# NetCDF under the name of HDF5, without coordinates.
for form in ("NETCDF3_CLASSIC", "NETCDF3_64BIT_DATA", "NETCDF4"):
    file = netCDF4.Dataset(path(form + ".h5"), "w", format=form)
    for name, length in zip("zyx", values.shape):
        file.createDimension(name, length)
    file.createVariable("rho", "f4", tuple("zyx"))[:] = values
    file.close()
    expect(form + ".h5", values)

# Within HDF5 and NetCDF.
for name, what, fill in [
        ("enzo.h5", "Enzo's boxes", {"Grid00000001/Density": values, "Grid00000002/Density": values}),
        ("silo.h5", "Silo", {".silo/#000001": values, "_silolibinfo": 1}),
        ("imaris.h5", "an Imaris file", {"DataSet/ResolutionLevel 0/TimePoint 0/Channel 0/Data": values})]:
    with h5py.File(path(name), "w") as file:
        for key, data in fill.items():
            file[key] = data
        if "imaris" in name:
            file.attrs["ImarisDataSet"] = np.array(list("ImarisDataSet"), "S1")
    refuse(name, what)
# BigDataViewer: time points, setups and levels; the .xml beside it has the size of the voxels.
views, half = field(3, 4, 6, 8, dtype="u2"), field(3, 2, 3, 4, dtype="u2")
for name, setups, xml in [("bdv", 1, True), ("bdv_setups", 2, True), ("bdv_alone", 1, False)]:
    with h5py.File(path(name + ".h5"), "w") as file:
        for setup in range(setups):
            file[f"s{setup:02}/resolutions"] = np.array([[1, 1, 1], [2, 2, 2]], "f8")
            file[f"s{setup:02}/subdivisions"] = np.array([[16, 16, 16]] * 2, "i4")
            for time in range(3):
                file[f"t{time:05}/s{setup:02}/0/cells"] = views[time] // (setup + 1)
                file[f"t{time:05}/s{setup:02}/1/cells"] = half[time]
    if xml:
        write(name + ".xml", ('<?xml version="1.0"?><SpimData version="0.2"><SequenceDescription><ViewSetups>' + "".join(
            f"<ViewSetup><id>{setup}</id><size>8 6 4</size><voxelSize><unit>\u00b5m</unit><size>{setup + .25} 0.5 1.5</size></voxelSize>"
            "</ViewSetup>" for setup in range(setups)) + "</ViewSetups></SequenceDescription></SpimData>").encode())
expect("bdv.h5", views, spacing=(.25, .5, 1.5))
refuse("bdv.xml", "BigDataViewer's description")
expect("bdv.h5", half, spacing=(.5, 1, 3), origin=(.125, .25, .75), array="/t*/s00/1/cells")
expect("bdv.h5", views[1], spacing=(.25, .5, 1.5), array="/t00001/s00/0/cells")
refuse("bdv_setups.h5", "choose one with --array: '/t*/s00/0/cells', '/t*/s01/0/cells'")
expect("bdv_setups.h5", views // 2, spacing=(1.25, .5, 1.5), array="/t*/s01/0/cells")
expect("bdv_alone.h5", views)
# Athena++: blocks of a mesh, which are cells, in any order.
def athena(name, values, levels=0, leave_out=0, **attributes):
    """values: [variable][z][y][x], in blocks of half of their sizes."""
    half = np.array(values.shape[:0:-1]) // 2
    blocks = [(i, j, k) for k in (0, 1) for j in (1, 0) for i in (0, 1)][leave_out:]
    faces = [np.linspace(0, 2 * n * step, 2 * n + 1) for n, step in zip(half, (.5, .25, 2))]
    with h5py.File(path(name), "w") as file:
        file.attrs.update(dict(NumMeshBlocks=len(blocks), MeshBlockSize=half, Time=2.5, DatasetNames=np.array([b"prim"]),
                               VariableNames=np.array([b"rho", b"press"]), NumVariables=np.array([2]),
                               Coordinates=np.bytes_("cartesian")) | attributes)
        file["LogicalLocations"], file["Levels"] = np.array(blocks, "i8"), np.array([levels] + [0] * (len(blocks) - 1))
        for axis, at in enumerate(faces):
            centers = (at[1:] + at[:-1]) / 2
            file[f"x{axis + 1}v"] = [centers[half[axis] * block[axis]:half[axis] * (block[axis] + 1)] for block in blocks]
        cut = [tuple(slice(n * b, n * (b + 1)) for n, b in zip(half[::-1], block[::-1])) for block in blocks]
        file["prim"] = np.array([[one[each] for each in cut] for one in values])


meshes = field(2, 6, 8, 10)
athena("blocks.athdf", meshes)
for number, name in enumerate(("rho", "press")):
    expect("blocks.athdf", meshes[number], array=name, spacing=(.5, .25, 2), origin=(.25, .125, 1), note="put together from 8 blocks")
athena("round.athdf", meshes, Coordinates=np.bytes_("spherical_polar"))
expect("round.athdf", meshes[0], array="rho", spacing=(.5, .25, 2), origin=(.25, .125, 1), note="spherical_polar")
athena("levels.athdf", meshes, levels=1)
refuse("levels.athdf", "blocks of 2 levels of refinement, expected one; yt's covering_grid", array="rho")
athena("missing.athdf", meshes, leave_out=1)
refuse("missing.athdf", "7 blocks, expected 2 x 2 x 2", array="rho")

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
