"""Fields of volumes: see field_files.py."""
import os
import struct

import h5py
import netCDF4
import numpy as np
import pydicom
import tifffile
import zarr
from pydicom.dataset import FileDataset, FileMetaDataset
from pydicom.uid import ExplicitVRLittleEndian, generate_uid

from field_files import add, done, full, path, values


# ---- NRRD
def nrrd(head="", data=None, drop=(), **change):
    name = path(".nrrd")
    data = values.astype("f4") if data is None else data
    lines = {"type": "float", "dimension": "3", "sizes": "6 5 4", "encoding": "raw", "endian": "little", **change}
    text = "NRRD0005\n" + "".join(f"{k}: {v}\n" for k, v in lines.items() if k not in drop) + head + "\n"
    with open(full(name), "wb") as out:
        out.write(text.encode() + data.tobytes())
    return name


plain = nrrd()
four = values.astype("f4").reshape(2, 2, 5, 6)
for field, text in [
        ("space", "space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"),
        ("space dimension", "space dimension: 3\nspace directions: (2,0,0) (0,1,0) (0,0,1)\n"),
        ("space directions", "space dimension: 3\nspace directions: (0,2,0) (1,0,0) (0,0,1)\n"),
        ("space origin", "space dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (1,2,3)\n"),
        ("space units", 'space dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace units: "mm" "mm" "um"\n'),
        ("spacings", "spacings: 1 2 3\n"), ("axis mins", "axis mins: 3 0 0\n"),
        ("axis maxs", "axis mins: 0 0 0\naxis maxs: 12 10 12\n"),
        ("centers", "axis mins: 0 0 0\naxis maxs: 10 8 9\ncenters: node node node\n"),
        ("units", 'units: "mm" "mm" "cm"\n'), ("labels", 'labels: "a" "b" "c"\n'),
        ("sample units", 'sample units: "K"\n'), ("thicknesses", "thicknesses: NaN NaN 2\n"),
        ("measurement frame", "space dimension: 3\nmeasurement frame: (0,1,0) (1,0,0) (0,0,1)\n"),
        ("old min", "old min: -5\n"), ("old max", "old max: 5\n"), ("content", "content: a phantom\n"),
        ("block size", "block size: 4\n"), ("key:=value", "modality:=MR\n")]:
    add("NRRD", field, plain, nrrd(text))
add("NRRD", "line skip", plain, nrrd("line skip: 1\n", data=np.frombuffer(b"x\n" + values.astype("f4").tobytes(), "u1")),
    same=True)
add("NRRD", "byte skip", plain, nrrd("byte skip: 4\n", data=np.append(np.float32(9), values.astype("f4").ravel())), same=True)
add("NRRD", "endian", plain, nrrd(endian="big"))
add("NRRD", "encoding", plain, nrrd(encoding="ascii", data=np.frombuffer(
    " ".join(str(v) for v in (values + 1).ravel()).encode(), "u1")))
add("NRRD", "type", plain, nrrd(type="int"))
add("NRRD", "sizes", plain, nrrd(sizes="5 6 4"))
add("NRRD", "dimension", plain, nrrd(dimension="4", sizes="6 5 2 2"))
add("NRRD", "kinds", nrrd(dimension="4", sizes="6 5 2 2", data=four),
    nrrd("kinds: space space space list\n", dimension="4", sizes="6 5 2 2", data=four), component="0")
name = path(".nhdr")
with open(full(name), "w") as out:
    out.write("NRRD0005\ntype: float\ndimension: 3\nsizes: 6 5 4\nencoding: raw\nendian: little\ndata file: other.raw\n")
(values.astype("f4") + 1).tofile(full(os.path.dirname(name) + "/other.raw"))
add("NRRD", "data file", plain, name)


# ---- MetaImage
def meta(**change):
    name = path(".mha")
    lines = {"ObjectType": "Image", "NDims": "3", "DimSize": "6 5 4", "ElementType": "MET_FLOAT", **change}
    with open(full(name), "wb") as out:
        out.write(("".join(f"{k} = {v}\n" for k, v in lines.items()) + "ElementDataFile = LOCAL\n").encode())
        out.write(values.astype("f4").tobytes())
    return name


plain = meta()
for field, value in [
        ("TransformMatrix", "0 1 0 1 0 0 0 0 1"), ("Rotation", "0 1 0 1 0 0 0 0 1"), ("Orientation", "0 1 0 1 0 0 0 0 1"),
        ("Offset", "1 2 3"), ("Position", "1 2 3"), ("Origin", "1 2 3"), ("CenterOfRotation", "1 0 0"),
        ("AnatomicalOrientation", "RAI"), ("ElementSpacing", "1 2 3"), ("ElementSize", "1 2 3"), ("DistanceUnits", "um"),
        ("Comment", "a phantom"), ("Name", "x"), ("ID", "3"), ("ParentID", "4"), ("Color", "1 0 0 1"),
        ("AcquisitionDate", "2020.01.02"), ("Modality", "MET_MOD_MR"), ("SequenceID", "1 2 3 4"), ("ElementMin", "-5"),
        ("ElementMax", "5"), ("ElementNBits", "12"), ("ElementToIntensityFunctionSlope", "2"),
        ("ElementToIntensityFunctionOffset", "3"), ("BinaryDataByteOrderMSB", "True"), ("ElementByteOrderMSB", "True"),
        ("ElementType", "MET_INT"), ("DimSize", "5 6 4"), ("ElementNumberOfChannels", "2"), ("CompressedData", "True"),
        ("BinaryData", "False"), ("NDims", "4")]:
    change = {field: value}
    if field == "ElementNumberOfChannels":
        change["DimSize"] = "6 5 2"
    add("MetaImage", field, plain, meta(**change), refused=field in ("CompressedData", "BinaryData", "NDims"),
        **({"component": "0"} if "Channels" in field else {}))
name = path(".mhd")
with open(full(name), "w") as out:
    out.write("NDims = 3\nDimSize = 6 5 4\nElementType = MET_FLOAT\nHeaderSize = 4\nElementDataFile = other.raw\n")
np.append(np.float32(9), (values.astype("f4") + 1).ravel()).tofile(full(os.path.dirname(name) + "/other.raw"))
add("MetaImage", "HeaderSize", plain, name)
add("MetaImage", "ElementDataFile", plain, name)


# ---- NIfTI-1, by hand: so that a field is what the standard calls it.
def nifti(change=(), steps=1, extension=b"\0\0\0\0"):
    head = bytearray(348)
    struct.pack_into("<i", head, 0, 348)
    struct.pack_into("<8h", head, 40, 4, 6, 5, 4, steps, 1, 1, 1)
    struct.pack_into("<hh", head, 70, 16, 32)
    struct.pack_into("<8f", head, 76, 1, 1, 1, 1, 1, 1, 1, 1)
    struct.pack_into("<f", head, 108, 352)
    struct.pack_into("<h", head, 254, 1)
    for row, offset in enumerate((280, 296, 312)):
        struct.pack_into("<4f", head, offset, *[float(row == c) for c in range(4)])
    head[344:348] = b"n+1\0"
    for form, offset, *value in change:
        struct.pack_into(form, head, offset, *value)
    name = path(".nii")
    with open(full(name), "wb") as out:
        out.write(bytes(head) + extension + np.tile(values.astype("f4").ravel(), steps).tobytes())
    return name


plain, timed = nifti(), nifti(steps=2)
for field, change in [
        ("dim", [("<8h", 40, 3, 5, 6, 4, 1, 1, 1, 1)]), ("datatype", [("<hh", 70, 8, 32)]),
        ("scl_slope", [("<f", 112, 2)]), ("scl_inter", [("<f", 112, 1), ("<f", 116, 5)]),
        ("xyzt_units", [("<B", 123, 3)]), ("sform", [("<4f", 280, 2, 0, 0, 7)]),
        ("qform", [("<h", 254, 0), ("<h", 252, 1), ("<6f", 256, 0, 0, 1, 1, 2, 3)]),
        ("qform beside sform", [("<h", 252, 1), ("<6f", 256, 0, 0, 1, 1, 2, 3)]),
        ("dim_info", [("<B", 39, 57)]), ("intent_code", [("<h", 68, 3)]), ("intent_name", [("16s", 328, b"t-test")]),
        ("slice_start", [("<h", 74, 1)]), ("slice_end", [("<h", 120, 3)]), ("slice_code", [("<B", 122, 1)]),
        ("slice_duration", [("<f", 132, 0.1)]), ("cal_max", [("<f", 124, 9)]), ("cal_min", [("<f", 128, -9)]),
        ("descrip", [("80s", 148, b"a phantom")]), ("aux_file", [("24s", 228, b"other")])]:
    add("NIfTI", field, plain, nifti(change))
add("NIfTI", "pixdim", nifti([("<h", 254, 0)]), nifti([("<h", 254, 0), ("<f", 80, 2)]))
add("NIfTI", "toffset", timed, nifti([("<f", 136, 5)], steps=2))


# ---- BOV
def bov(**change):
    name = path(".bov")
    values.astype("f4").tofile(full(os.path.dirname(name) + "/v.raw"))
    (values + 1).astype("f4").tofile(full(os.path.dirname(name) + "/w.raw"))
    lines = {"DATA_FILE": "v.raw", "DATA_SIZE": "6 5 4", "DATA_FORMAT": "FLOAT", "VARIABLE": '"v"',
             "BRICK_ORIGIN": "0 0 0", "BRICK_SIZE": "6 5 4", **change}
    with open(full(name), "w") as out:
        out.write("".join(f"{k}: {v}\n" for k, v in lines.items()))
    return name


plain = bov()
for field, value in [("TIME", "3.5"), ("DATA_FILE", "w.raw"), ("DATA_SIZE", "5 6 4"), ("DATA_FORMAT", "INT"),
                     ("VARIABLE", '"w"'), ("DATA_ENDIAN", "BIG"), ("CENTERING", "nodal"), ("BRICK_ORIGIN", "1 2 3"),
                     ("BRICK_SIZE", "12 5 4"), ("DATA_COMPONENTS", "2"), ("HAS_BOUNDARY", "true")]:
    add("BOV", field, plain, bov(**{field: value}),
        **(dict(component="0", refused=True) if field == "DATA_COMPONENTS" else {}))
add("BOV", "BYTE_OFFSET", plain, bov(BYTE_OFFSET="4"), refused=True)


# ---- MRC
def mrc(drop=(), data=None, **change):
    name = path(".mrc")
    at = {"NX": (0, "3i", 6, 5, 4), "MODE": (12, "i", 2), "NXSTART": (16, "3i", 0, 0, 0), "MX": (28, "3i", 6, 5, 4),
          "CELLA": (40, "3f", 12, 10, 8), "CELLB": (52, "3f", 90, 90, 90), "MAPC": (64, "3i", 1, 2, 3), "ISPG": (88, "i", 1),
          "NSYMBT": (92, "i", 0), "IMOD": (152, "2i", 0, 0), "ORIGIN": (196, "3f", 0, 0, 0), "MAP": (208, "4s", b"MAP "),
          "NLABL": (220, "i80s", 0, b"")}
    head = bytearray(1024)
    for key, (offset, kind, *default) in at.items():
        struct.pack_into("<" + kind, head, offset, *change.get(key, default))
    with open(full(name), "wb") as out:
        out.write(bytes(head) + b"e" * change.get("NSYMBT", [0])[0] + (values.astype("f4") if data is None else data).tobytes())
    return name


plain = mrc()
for field, value in [("NX", (5, 6, 4)), ("NXSTART", (1, 2, 3)), ("MX", (12, 5, 4)), ("CELLA", (24, 10, 8)),
                     ("CELLB", (90, 90, 120)), ("MAPC", (3, 2, 1)), ("ORIGIN", (1, 2, 3))]:
    add("MRC", field, plain, mrc(**{field: value}))
add("MRC", "MODE", plain, mrc(MODE=[1], data=values.astype("i2")))
add("MRC", "NSYMBT", plain, mrc(NSYMBT=[80]), same=True)
add("MRC", "ISPG 401", plain, mrc(ISPG=[401], MX=(6, 5, 2)))
small = values.astype("u1")
add("MRC", "imodFlags", mrc(MODE=[0], data=small), mrc(MODE=[0], data=small, IMOD=(1146047817, 0)))
add("MRC", "NXSTART beside ORIGIN", mrc(ORIGIN=(1, 2, 3)), mrc(ORIGIN=(1, 2, 3), NXSTART=(1, 2, 3)))
add("MRC", "LABEL", plain, mrc(NLABL=(1, b"Created by a test")))
add("MRC", "extended header", plain, mrc(NSYMBT=[80]))


# ---- TIFF: tags, ImageJ's lines, OME-XML
def tiff(end=".tif", data=None, **how):
    name = path(end)
    tifffile.imwrite(full(name), values.astype("u2") if data is None else data,
                     **{"photometric": "minisblack", "metadata": None, **how})
    return name


plain = tiff()
add("TIFF", "Orientation", plain, tiff(extratags=[(274, "H", 1, 4, True)]))
add("TIFF", "PhotometricInterpretation", plain, tiff(photometric="miniswhite"))
add("TIFF", "ColorMap", tiff(data=values.astype("u1")),
    tiff(data=values.astype("u1"), photometric="palette", colormap=np.zeros((3, 256), "u2")))
add("TIFF", "XResolution and ResolutionUnit", plain, tiff(resolution=(4, 2), resolutionunit="CENTIMETER"))
add("TIFF", "XPosition", plain, tiff(extratags=[(286, "2I", 1, (5, 1), True)]))
add("TIFF", "YPosition", plain, tiff(extratags=[(287, "2I", 1, (5, 1), True)]))
add("TIFF", "ModelPixelScale", plain, tiff(extratags=[(33550, "d", 3, (2., 2., 2.), True)]))
add("TIFF", "ModelTiepoint", plain, tiff(extratags=[(33922, "d", 6, (0., 0., 0., 1., 2., 3.), True)]))
add("TIFF", "GDAL_NODATA", plain, tiff(extratags=[(42113, "s", 0, "7", True)]))
lsm = bytearray(500)
struct.pack_into("<2I8i6d", lsm, 0, 0x0400494C, 500, 6, 5, 4, 1, 1, 2, 3, 3, 1e-6, 2e-6, 3e-6, 0, 0, 0)
add("TIFF", "CZ_LSMINFO", plain, tiff(extratags=[(34412, "B", 500, bytes(lsm), True)]))
add("TIFF", "Software of ScanImage", plain, tiff(metadata=None, software="SI.hChannels.channelSave = 1\nSI.hFastZ.enable = true\n"
                                                 "SI.hStackManager.numSlices = 2\n"))
add("TIFF", "SampleFormat", plain, tiff(data=values.astype("i2")))
add("TIFF", "BitsPerSample", plain, tiff(data=values.astype("u1")))
add("TIFF", "SamplesPerPixel", plain, tiff(data=np.stack([values + 1] * 3, -1).astype("u2"), photometric="rgb"), component="0")


def imagej(text, resolution=(4, 2)):
    return tiff(description="ImageJ=1.53t\nimages=4\nslices=4\n" + text, resolution=resolution)


plain = imagej("unit=um\n")
for field, text in [("unit", "unit=mm\n"), ("yunit", "unit=um\nyunit=nm\n"), ("zunit", "unit=um\nzunit=nm\nspacing=1500\n"),
                    ("spacing", "unit=um\nspacing=3\n"), ("xorigin", "unit=um\nxorigin=10\n"),
                    ("yorigin", "unit=um\nyorigin=10\n"), ("zorigin", "unit=um\nzorigin=2\n"),
                    ("cf, c0 and c1", "unit=um\ncf=0\nc0=-32768.0\nc1=2.0\n"), ("cf (curves)", "unit=um\ncf=4\nc0=1\nc1=2\n"),
                    ("vunit", "unit=um\ncf=0\nc0=0\nc1=1\nvunit=HU\n"), ("inverty", "unit=um\ninverty=true\n"),
                    ("fps", "unit=um\nfps=4.0\n")]:
    add("ImageJ", field, plain, imagej(text))
add("ImageJ", "XResolution", plain, imagej("unit=um\n", resolution=(8, 2)))
add("ImageJ", "IJMetadata", tiff(description="ImageJ=1.53t\nimages=4\nslices=4\n"), tiff(description="ImageJ=1.53t\nimages=4\nslices=4\n", extratags=[
    (50838, "I", 2, (12, 8), True), (50839, "B", 20, b"IJIJlabl\0\0\0\1" + b"\0a\0b\0c\0d", True)]))
hyper = "ImageJ=1.53t\nimages=4\nunit=um\n"
stack = tiff(description=hyper)
add("ImageJ", "slices, frames and channels", stack, tiff(description=hyper + "slices=2\nframes=2\n"))
frames = hyper + "slices=2\nframes=2\n"
add("ImageJ", "order", tiff(description=frames), tiff(description=frames + "order=tcz\n"))
add("ImageJ", "finterval", tiff(description=frames), tiff(description=frames + "finterval=0.5\n"))
add("ImageJ", "tunit", tiff(description=frames + "finterval=0.5\n"),
    tiff(description=frames + "finterval=0.5\ntunit=min\n"))


def ome(pixels="", inside="", image="", sizes='SizeC="1" SizeT="1" SizeZ="4"', order="XYZCT"):
    text = ('<?xml version="1.0" encoding="UTF-8"?><OME xmlns="http://www.openmicroscopy.org/Schemas/OME/2016-06">'
            f'<Image ID="Image:0">{image}<Pixels ID="Pixels:0" DimensionOrder="{order}" Type="uint16" SizeX="6" SizeY="5" '
            f'{sizes} PhysicalSizeX="1" PhysicalSizeY="1" PhysicalSizeZ="1" {pixels}>'
            f'<Channel ID="Channel:0:0"/><TiffData/>{inside}</Pixels></Image></OME>')
    for name in ("PhysicalSizeX", "PhysicalSizeY", "PhysicalSizeZ"):
        if name + "=" in pixels:
            text = text.replace(f' {name}="1"', "", 1)
    return tiff(".ome.tif", description=text.encode())


plain = ome()
for field, pixels in [(f"PhysicalSize{a}", f'PhysicalSize{a}="3"') for a in "XYZ"] + [
        (f"PhysicalSize{a}Unit", f'PhysicalSize{a}Unit="nm"') for a in "XYZ"]:
    add("OME-TIFF", field, plain, ome(pixels))
sizes = 'SizeC="1" SizeT="2" SizeZ="2"'
timed = ome(sizes=sizes)
add("OME-TIFF", "TimeIncrement", timed, ome('TimeIncrement="2"', sizes=sizes))
add("OME-TIFF", "TimeIncrementUnit", ome('TimeIncrement="2"', sizes=sizes),
    ome('TimeIncrement="2" TimeIncrementUnit="min"', sizes=sizes))
add("OME-TIFF", "DimensionOrder", timed, ome(sizes=sizes, order="XYTZC"))
add("OME-TIFF", "SizeZ, SizeC and SizeT", plain, timed)
planes = "".join(f'<Plane TheC="0" TheT="{t}" TheZ="{z}" DeltaT="{5 * t}"/>' for t in range(2) for z in range(2))
add("OME-TIFF", "Plane DeltaT", timed, ome(inside=planes, sizes=sizes))
add("OME-TIFF", "Plane PositionX", plain, ome(inside='<Plane TheC="0" TheT="0" TheZ="0" PositionX="7"/>'))
add("OME-TIFF", "StageLabel", plain, ome(image='<StageLabel Name="s" X="3"/>'))


# ---- OME-Zarr 0.4, of version 2 of Zarr, which zarr 3 writes where it is asked to
VERSION_2 = dict(zarr_format=2) if int(zarr.__version__.split(".")[0]) >= 3 else {}


def ngff(units=("micrometer",) * 3, scale=(1, 1, 1), translation=None, image=None, axes="zyx"):
    name = path(".zarr")
    group = zarr.open_group(full(name), mode="w", **VERSION_2)
    group.create_dataset("0", shape=values.shape, data=values.astype("f4"), chunks=(2, 5, 6), dtype="f4")
    transforms = [{"type": "scale", "scale": list(scale)}]
    if translation:
        transforms.append({"type": "translation", "translation": list(translation)})
    multiscale = {"version": "0.4", "axes": [{"name": n, "type": "space", "unit": u} for n, u in zip(axes, units)],
                  "datasets": [{"path": "0", "coordinateTransformations": transforms}]}
    if image:
        multiscale["coordinateTransformations"] = [{"type": "scale", "scale": list(image)}]
    group.attrs["multiscales"] = [multiscale]
    return name


plain = ngff()
add("OME-Zarr", "axes: unit", plain, ngff(("nanometer", "micrometer", "micrometer")))
add("OME-Zarr", "scale", plain, ngff(scale=(3, 1, 1)))
add("OME-Zarr", "translation", plain, ngff(translation=(3, 1, 1)))
add("OME-Zarr", "multiscales: scale", plain, ngff(image=(3, 1, 1)))


# ---- NetCDF, CF conventions
def netcdf(where="v", dtype="f4", time=False, **attributes):
    name = path(".nc")
    data = netCDF4.Dataset(full(name), "w")
    fill = attributes.pop("_FillValue", None)
    dimensions = [("time", 2)] * time + [("z", 2 if time else 4), ("y", 5), ("x", 6)]
    for axis, length in dimensions:
        data.createDimension(axis, length)
        data.createVariable(axis, "f8", (axis,))[:] = np.arange(length)
    if time:
        data["time"].units = "hours"
    field = data.createVariable("v", dtype, [axis for axis, _ in dimensions], fill_value=fill)
    field.set_auto_maskandscale(False)
    field[:] = values.reshape([length for _, length in dimensions]).astype(dtype)
    for key, value in attributes.items():
        data[where].setncattr(key, value)
    data.close()
    return name


plain, short, timed = netcdf(), netcdf(dtype="i2"), netcdf(time=True)
for field, value in [("units", "K"), ("scale_factor", 2.), ("add_offset", 3.), ("missing_value", np.float32(values[0, 0, 0])),
                     ("valid_min", np.float32(50)), ("valid_max", np.float32(50)),
                     ("valid_range", np.array([50, 100], "f4")), ("grid_mapping", "crs"), ("cell_methods", "time: mean"),
                     ("cell_measures", "area: a"), ("ancillary_variables", "e"), ("flag_values", np.array([1, 2], "f4")),
                     ("flag_masks", np.array([1, 2], "i4")), ("flag_meanings", "a b"), ("standard_error_multiplier", 2.)]:
    add("NetCDF (CF)", field, plain, netcdf(**{field: value}))
add("NetCDF (CF)", "_FillValue", plain, netcdf(_FillValue=np.float32(values[0, 0, 0])))
add("NetCDF (CF)", "_Unsigned", netcdf(dtype="i1"), netcdf(dtype="i1", _Unsigned="true"))
add("NetCDF (CF)", "coordinates: units", plain, netcdf("x", units="m"))
add("NetCDF (CF)", "coordinates: axis", plain, netcdf("x", axis="Z"))
add("NetCDF (CF)", "coordinates: positive", netcdf("z", axis="Z"), netcdf("z", axis="Z", positive="down"))
add("NetCDF (CF)", "time: units", timed, netcdf("time", time=True, units="days since 2000-01-01"))
add("NetCDF (CF)", "time: calendar", netcdf("time", time=True, units="days since 2000-01-01"),
    netcdf("time", time=True, units="days since 2000-01-01", calendar="360_day"))




def curved(named):
    name = netcdf()
    data = netCDF4.Dataset(full(name), "a")
    data.createVariable("lon", "f8", ("y", "x"))[:] = 1
    if named:
        data["v"].coordinates = "lon"
    data.close()
    return name


add("NetCDF (CF)", "coordinates (two-dimensional)", curved(False), curved(True))


# ---- openPMD
def openpmd(time=1., **attributes):
    name = path(".h5")
    with h5py.File(full(name), "w") as f:
        f.attrs["openPMD"], f.attrs["basePath"], f.attrs["meshesPath"] = b"1.1.0", b"/data/%T/", b"fields/"
        f.attrs["iterationEncoding"] = b"groupBased"
        for step in range(2):
            g = f.create_group(f"data/{step}")
            g.attrs["time"], g.attrs["timeUnitSI"] = step * 1., time
            d = g.create_dataset("fields/rho", data=values.astype("f4") + step)
            for key, value in {"axisLabels": np.array(["z", "y", "x"], "S1"), "gridSpacing": np.ones(3),
                               "gridGlobalOffset": np.zeros(3), "gridUnitSI": 1., "unitSI": 1., "position": np.zeros(3),
                               "dataOrder": np.bytes_("C"), "geometry": np.bytes_("cartesian"), **attributes}.items():
                d.attrs[key] = value
    return name


plain = openpmd()
for field, value in [("gridSpacing", np.array([1., 2, 3])), ("gridGlobalOffset", np.array([1., 2, 3])), ("gridUnitSI", 1e-6),
                     ("unitSI", 2.), ("position", np.array([.5, .5, .5])), ("geometry", np.bytes_("thetaMode")),
                     ("geometryParameters", np.bytes_("m=2")), ("timeOffset", .5),
                     ("axisLabels", np.array(["x", "y", "z"], "S1"))]:
    add("openPMD", field, plain, openpmd(**{field: value}))
add("openPMD", "timeUnitSI", plain, openpmd(time=1e-3))


# ---- DICOM
def dicom(**change):
    name = path("")
    os.makedirs(full(name))
    uid = generate_uid()
    for z in range(4):
        meta = FileMetaDataset()
        meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = "1.2.840.10008.5.1.4.1.1.4", generate_uid()
        meta.TransferSyntaxUID = ExplicitVRLittleEndian
        d = FileDataset(None, {}, file_meta=meta, preamble=b"\0" * 128)
        d.SOPClassUID, d.SOPInstanceUID = meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID
        d.Modality, d.SeriesInstanceUID, d.StudyInstanceUID, d.InstanceNumber = "CT", uid, "1.2.3", z + 1
        d.Rows, d.Columns, d.PixelSpacing, d.ImageOrientationPatient = 5, 6, [1, 1], [1, 0, 0, 0, 1, 0]
        d.ImagePositionPatient, d.SamplesPerPixel, d.PhotometricInterpretation = [0, 0, z], 1, "MONOCHROME2"
        d.BitsAllocated = d.BitsStored = 16
        d.HighBit, d.PixelRepresentation = 15, 1
        d.PixelData = values[z].astype("<i2").tobytes()
        for key, value in change.items():
            setattr(d, key, value(z) if callable(value) else value)
        d.is_little_endian, d.is_implicit_VR = True, False
        d.save_as(full(f"{name}/{z}.dcm"), write_like_original=False)
    return name


plain = dicom()
for field, value in [("RescaleSlope", 2), ("RescaleIntercept", -5), ("PixelSpacing", [2, 3]),
                     ("ImagePositionPatient", lambda z: [1, 2, 3 * z]), ("ImageOrientationPatient", [0, 1, 0, 1, 0, 0]),
                     ("PixelPaddingValue", int(values[0, 0, 0])), ("PixelRepresentation", 0)]:
    change = {field: value}
    if field.startswith("Rescale"):
        change = {"RescaleSlope": 1, "RescaleIntercept": 0, **change}
    add("DICOM", field, plain, dicom(**change))

done("fields")
