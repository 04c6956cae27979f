"""Public files, read by isochron and by other programs' libraries.

    public.py record ROOT FILE...       prints a line of PUBLIC.tsv for each, by an independent decode (nibabel, pydicom,
                                        netCDF4, tifffile, h5py, VTK, and numpy for NRRD and MetaImage)
    public.py check PROGRAM ROOT [TSV]  compares what isochron reads with PUBLIC.tsv, of the files that are there

ROOT has a folder OWNER+NAME for each repository, with its files at that commit. A line of PUBLIC.tsv: repository, commit, path,
licence, options, vertices along x, y and z, spacing, times (of the first and the last step), three isovalues, and the numbers of
active cells of the first step; or, where the file is no volume, `refused` and a part of the one line that says so."""
import collections
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
import zlib

import numpy as np

TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "PUBLIC.tsv")
Volume = collections.namedtuple("Volume", "options values spacing times")  # values of the first step, [z][y][x]


class NoVolume(Exception):
    """Its text is in the line that refuses the file."""


def nifti(path):
    import nibabel
    image = nibabel.load(path)
    data = image.dataobj
    shape = [n for n in image.shape]
    if len(shape) < 3 or min(shape[:3]) < 2:
        raise NoVolume("dimensions" if len(shape) < 3 else "vertices")
    if len([n for n in shape[3:] if n > 1]) > 1 or image.get_data_dtype().kind not in "iuf":
        raise NoVolume("expected")
    first = np.asarray(data[..., 0] if len(shape) == 4 else data[...], "f8").reshape(shape[:3])
    spacing = np.sqrt((image.affine[:3, :3] ** 2).sum(0))
    if not (image.header["sform_code"] or image.header["qform_code"]):
        spacing = np.array([v if v else 1 for v in image.header["pixdim"][1:4]])
    steps = shape[3] if len(shape) > 3 else 1
    step = float(image.header["pixdim"][4])
    times = [float(image.header["toffset"]) + i * step for i in (0, steps - 1)] if steps > 1 and step > 0 else None
    return Volume("", first.transpose(2, 1, 0), spacing, times)


NRRD_TYPES = {"float": "f4", "double": "f8", "short": "i2", "ushort": "u2", "unsigned short": "u2", "uchar": "u1", "int": "i4",
              "unsigned char": "u1", "int32": "i4", "uint8": "u1", "uint8_t": "u1", "int16": "i2", "uint16": "u2", "uint": "u4",
              "unsigned int": "u4", "int16_t": "i2"}


def nrrd(path):
    import bz2
    whole = open(path, "rb").read()
    head, _, data = whole.partition(b"\n\n")
    if b"\r\n\r\n" in whole and len(whole.partition(b"\r\n\r\n")[0]) < len(head):
        head, _, data = whole.partition(b"\r\n\r\n")
    field = dict(re.split(r":=?\s*", line.strip(), maxsplit=1) for line in head.decode("latin1").splitlines()[1:]
                 if ":" in line and not line.startswith("#"))
    field = {re.sub(r"\s", "", k.lower()): v for k, v in field.items()}
    sizes = [int(n) for n in field["sizes"].split()]
    kinds = field.get("kinds", "").split()
    if len(sizes) != 3 or min(sizes) < 2 or any(k in ("vector", "list", "RGB-color") for k in kinds):
        raise NoVolume("")
    if "datafile" in field:
        name = os.path.join(os.path.dirname(path), field["datafile"])
        if not os.path.exists(name):
            raise NoVolume("cannot be opened")
        data = open(name, "rb").read()
    encoding = field["encoding"].lower()
    skip = int(field.get("byteskip", 0))
    kind = np.dtype(NRRD_TYPES[field["type"].lower()]).newbyteorder(">" if field.get("endian") == "big" else "<")
    count = int(np.prod(sizes))
    if encoding in ("gzip", "gz"):
        data = zlib.decompressobj(31).decompress(data)
    elif encoding in ("bzip2", "bz2"):
        data = bz2.decompress(data)
    if encoding in ("ascii", "text", "txt"):
        values = np.array(data.split(), "f8")
    else:
        values = np.frombuffer(data[-count * kind.itemsize:] if skip == -1 else data[skip:], kind, count)
    if "spacedirections" in field:
        rows = re.findall(r"\(([^)]*)\)", field["spacedirections"])
        spacing = [np.linalg.norm([float(v) for v in row.split(",")]) for row in rows]
    else:
        spacing = [float(v) for v in field.get("spacings", "1 1 1").split()]
    return Volume("", values.reshape(sizes[::-1]).astype("f8"), [1 if np.isnan(v) else v for v in spacing], None)


META_TYPES = {"MET_UCHAR": "u1", "MET_CHAR": "i1", "MET_USHORT": "u2", "MET_SHORT": "i2", "MET_INT": "i4", "MET_UINT": "u4",
              "MET_FLOAT": "f4", "MET_DOUBLE": "f8"}


def meta(path):
    whole = open(path, "rb").read()
    end = re.search(rb"ElementDataFile *= *([^\r\n]*)\r?\n?", whole)
    field = dict(re.findall(r"(\w+) *= *([^\r\n]*)", whole[:end.start()].decode("latin1")))
    sizes = [int(n) for n in field["DimSize"].split()]
    if len(sizes) != 3 or min(sizes) < 2 or int(field.get("ElementNumberOfChannels", 1)) > 1:
        raise NoVolume("")
    name = end[1].decode().strip()
    if name.lower() == "local":
        data = whole[end.end():]
    elif "%" in name or name == "LIST" or not os.path.exists(os.path.join(os.path.dirname(path), name)):
        raise NoVolume("")
    else:
        data = open(os.path.join(os.path.dirname(path), name), "rb").read()
    if field.get("CompressedData", "False") == "True":
        data = zlib.decompress(data)
    big = field.get("BinaryDataByteOrderMSB", field.get("ElementByteOrderMSB", "False")) == "True"
    kind = np.dtype(META_TYPES[field["ElementType"]]).newbyteorder(">" if big else "<")
    values = np.frombuffer(data, kind, int(np.prod(sizes)), max(int(field.get("HeaderSize", 0)), 0))
    spacing = [float(v) for v in field.get("ElementSpacing", field.get("ElementSize", "1 1 1")).split()]
    return Volume("", values.reshape(sizes[::-1]).astype("f8"), spacing, None)


def dicom(path):
    import pydicom
    names = [os.path.join(path, name) for name in os.listdir(path)] if os.path.isdir(path) else [path]
    read = [pydicom.dcmread(name, force=True) for name in names]
    if len(read) > 1:  # but for reports among them
        read = [one for one in read if "ImagePositionPatient" in one]
    if "PixelData" not in read[0]:
        raise NoVolume("")
    if read[0].get("SamplesPerPixel", 1) > 1:
        raise NoVolume("")
    if len(read) > 1:
        across = np.cross(*np.reshape([float(v) for v in read[0].ImageOrientationPatient], (2, 3)))
        at = [float(np.dot(across, [float(v) for v in one.ImagePositionPatient])) for one in read]
        order = np.argsort(at)
        slices = np.stack([read[i].pixel_array for i in order]).astype("f8")
        between = float(np.mean(np.diff(np.sort(at))))
    else:
        slices = read[0].pixel_array.astype("f8")
        between = None
    if slices.ndim != 3:
        raise NoVolume("")
    first = read[0]
    slices = slices * float(first.get("RescaleSlope", first.get("DoseGridScaling", 1)) or 1) + float(first.get("RescaleIntercept", 0) or 0)
    spacing = [float(v) for v in first.get("PixelSpacing", [])][::-1]
    return Volume("", slices, spacing + [between] if spacing and between else None, None)


def netcdf(path):
    import netCDF4
    data = netCDF4.Dataset(path)
    for name, variable in data.variables.items():
        if "bounds" in name or variable.dtype == str or np.dtype(variable.dtype).kind not in "iuf":
            continue
        time = [i for i, d in enumerate(variable.dimensions)
                if "time" in d.lower() or "since" in str(getattr(data.variables.get(d), "units", ""))]
        left = [i for i, n in enumerate(variable.shape) if n != 1 and i not in time]
        if len(left) != 3 or len(time) > 1 or min(variable.shape[i] for i in left) < 2:
            continue
        values = variable[tuple(0 if i in time or n == 1 else slice(None) for i, n in enumerate(variable.shape))]
        values = np.ma.filled(np.ma.asarray(values).astype("f8"), np.nan)
        return Volume(f"--array {shlex.quote(name)}", values, None, None)
    raise NoVolume("")


def tiff(path):
    import tifffile
    with tifffile.TiffFile(path) as file:
        series = file.series[0]
        axes, shape = series.axes, series.shape
        left = "".join(a for a, n in zip(axes, shape) if n > 1)
        if len(left) != 3 or left[1:] != "YX" or left[0] not in "ZIQ":
            raise NoVolume("")
        values = series.asarray().reshape([n for n in shape if n > 1]).astype("f8")
        scaled = file.imagej_metadata or {}
        step = scaled.get("spacing")
        tags = file.pages[0].tags
        x = tags["XResolution"].value if "XResolution" in tags and scaled.get("unit") else None
        spacing = [x[1] / x[0], None, step] if x and x[0] and step else None
        return Volume("", values, spacing, None)


def hdf5(path):
    import h5py
    found = []
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.append((name, item.shape)) if isinstance(item, h5py.Dataset) and len(
            [n for n in item.shape if n > 1]) == 3 and len(item.shape) == 3 and item.dtype.kind in "iuf" else None)
        if not found:
            raise NoVolume("")
        name = sorted(found)[0][0]
        scale = float(file[name].attrs.get("unitSI", 1))
        return Volume(f"--array /{name}", file[name][...].astype("f8") * scale, None, None)


def with_all_arrays(reader):
    """A reader of legacy files, which else reads the first array of each kind."""
    for kind in ("Scalars", "Vectors", "Normals", "Tensors", "ColorScalars", "TCoords", "Fields"):
        getattr(reader, f"ReadAll{kind}On")()
    return reader


def vtk_image(path):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    vtk.vtkObject.GlobalWarningDisplayOff()
    if path.endswith(".vtk"):
        reader = with_all_arrays(vtk.vtkDataSetReader())
    else:
        reader = vtk.vtkXMLImageDataReader() if path.endswith(".vti") else vtk.vtkXMLRectilinearGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput() if not path.endswith(".vtk") else reader.GetOutputDataObject(0)
    if not isinstance(grid, (vtk.vtkImageData, vtk.vtkRectilinearGrid)):
        raise NoVolume("expected")
    size = grid.GetDimensions()
    arrays = [grid.GetPointData().GetArray(i) for i in range(grid.GetPointData().GetNumberOfArrays())]
    arrays = [a for a in arrays if a and a.GetNumberOfComponents() == 1 and a.GetName() not in ("vtkGhostType", "vtkGhostLevels")]
    if min(size) < 2 or not arrays:
        raise NoVolume("")
    name = arrays[0].GetName()
    spacing = grid.GetSpacing() if isinstance(grid, vtk.vtkImageData) else None
    return Volume(f"--array {shlex.quote(name)}" if name else "", vtk_to_numpy(arrays[0]).reshape(size[::-1]).astype("f8"), spacing,
                  None)


def mesh(path):
    """By VTK itself, onto 12 x 12 x 12 vertices."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    vtk.vtkObject.GlobalWarningDisplayOff()
    if path.endswith(".vtk"):
        reader = with_all_arrays(vtk.vtkUnstructuredGridReader())
    elif path.endswith((".vtu", ".vts")):
        reader = vtk.vtkXMLUnstructuredGridReader() if path.endswith(".vtu") else vtk.vtkXMLStructuredGridReader()
    else:
        reader = vtk.vtkExodusIIReader()
        reader.ApplyDisplacementsOff()
    reader.SetFileName(path)
    reader.UpdateInformation()
    times = None
    if isinstance(reader, vtk.vtkExodusIIReader):
        reader.SetAllArrayStatus(vtk.vtkExodusIIReader.NODAL, 1)
        info = reader.GetOutputInformation(0)
        key = vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        if info.Has(key):
            times = [info.Get(key, i) for i in (0, info.Length(key) - 1)]
    reader.Update()
    filter = vtk.vtkResampleToImage()
    filter.SetInputDataObject(reader.GetOutputDataObject(0))
    filter.SetSamplingDimensions(12, 12, 12)
    filter.Update()
    image = filter.GetOutput()
    arrays = [image.GetPointData().GetArray(i) for i in range(image.GetPointData().GetNumberOfArrays())]
    arrays = [a for a in arrays if a and a.GetNumberOfComponents() == 1 and not a.GetName().startswith("vtk")
              and not a.GetName().endswith("Id")]
    if not arrays or min(image.GetSpacing()) <= 0:
        raise NoVolume("")
    inside = vtk_to_numpy(image.GetPointData().GetArray("vtkValidPointMask")) != 0
    values = np.where(inside, vtk_to_numpy(arrays[0]).astype("f8"), np.nan).reshape(12, 12, 12)
    return Volume(f"--resample 12 12 12 --array {shlex.quote(arrays[0].GetName())}", values, image.GetSpacing(), times)


def zarr_folder(path):
    import zarr
    group = zarr.open(path, "r")
    for name, array in group.arrays():
        if array.ndim == 3 and min(array.shape) > 1 and array.dtype.kind in "iuf":
            return Volume(f"--array {name}", array[:].astype("f8"), None, None)
    raise NoVolume("")


def decoder_of(path):
    name = path.lower()
    if name.endswith(".vtk") and b"UNSTRUCTURED_GRID" in open(path, "rb").read(400):
        return mesh
    for ends, decode in [((".nii", ".nii.gz", ".hdr"), nifti), ((".nrrd", ".nhdr"), nrrd), ((".mha", ".mhd"), meta),
                         ((".nc", ".nc4", ".cdf"), netcdf), ((".tif", ".tiff"), tiff), ((".h5", ".hdf5"), hdf5),
                         ((".vti", ".vtr", ".vtk"), vtk_image), ((".zarr",), zarr_folder),
                         ((".vtu", ".vts", ".e", ".exo", ".ex2"), mesh)]:
        if name.endswith(ends):
            return decode
    return dicom


def active_cells(values, isovalue):
    corners = [values[slice(z, values.shape[0] - 1 + z), slice(y, values.shape[1] - 1 + y), slice(x, values.shape[2] - 1 + x)]
               for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    with np.errstate(invalid="ignore"):
        low, high = np.minimum.reduce(corners), np.maximum.reduce(corners)  # NaN where one is
        return int(((low < isovalue) & (isovalue <= high)).sum())


def numbers(values):
    return " ".join("-" if v is None else f"{v:.9g}" for v in values) if values is not None else "-"


def record(root, names):
    for name in names:
        repository = name.split("/")[0]
        path = os.path.join(root, name)
        commit, licence = open(os.path.join(root, repository, ".source")).read().split("\t")
        start = [repository.replace("+", "/"), commit, name.partition("/")[2], licence.strip()]
        try:
            volume = decoder_of(path)(path)
            finite = volume.values[np.isfinite(volume.values)]
            if not finite.size:
                continue  # nothing to count
        except NoVolume as error:
            print("\t".join(start + ["-", "refused", str(error) or "-"] + ["-"] * 3))
            continue
        except Exception as error:  # the library cannot read it, either
            print(f"{name}: {type(error).__name__} {error}", file=sys.stderr)
            continue
        low, high = finite.min(), finite.max()
        isovalues = [float(f"{low + part * (high - low):.5g}") for part in (0.2, 0.5, 0.8)]
        print("\t".join(start + [volume.options or "-", numbers(volume.values.shape[::-1]), numbers(volume.spacing),
                                 numbers(volume.times), numbers(isovalues),
                                 numbers([active_cells(volume.values, v) for v in isovalues])]), flush=True)


def run(program, *arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def close(a, b):
    return abs(a - b) <= 1e-5 * max(abs(a), abs(b))


def judge(program, path, row, folder):
    """What is wrong; empty if nothing is, `refused` if the line says that it is no volume."""
    options = [] if row["options"] == "-" else shlex.split(row["options"])
    index = os.path.join(folder, "file.isochron")
    status, out, err = run(program, "build", path, *options, "-o", index, "--quiet", "--force")
    if row["vertices"] == "refused":
        one_line = status != 0 and err.count("\n") == 1 and (row["spacing"] == "-" or row["spacing"] in err)
        return "refused" if one_line else f"expected a refusal: {err or 'read'}"
    if status:
        return err.strip()
    info = json.loads(run(program, "info", index, "--json")[1])
    wrong = []
    wanted = [int(v) for v in row["vertices"].split()]
    if sorted(info["vertices"]) != sorted(wanted):
        wrong.append(f"vertices {info['vertices']}, expected {wanted}")
    for axis, wanted in enumerate(row["spacing"].split() if row["spacing"] != "-" else []):
        if wanted != "-" and not close(info["spacing"][axis], float(wanted)):
            wrong.append(f"spacing {info['spacing']}, expected {row['spacing']}")
    times = [float(v) for v in row["times"].split()] if row["times"] != "-" else []
    if times and not (close(info["times"][0], times[0]) and close(info["times"][-1], times[1])):
        wrong.append(f"times {info['times'][0]} to {info['times'][-1]}, expected {row['times']}")
    for isovalue, count in zip(row["isovalues"].split(), row["cells"].split()):
        status, out, err = run(program, "query", index, "--step", "0", f"--isovalue={isovalue}", "--json", "--repeat", "0")
        got = json.loads(out)["active_cells"] if status == 0 else err
        if got != int(count):
            wrong.append(f"{got} active cells at {isovalue}, expected {count}")
    return "; ".join(wrong)


def check(program, root, table=TABLE):
    keys = ["repository", "commit", "path", "licence", "options", "vertices", "spacing", "times", "isovalues", "cells"]
    rows = [dict(zip(keys, line.rstrip("\n").split("\t"))) for line in open(table) if not line.startswith("#")]
    found, by_repository = collections.Counter(), collections.defaultdict(collections.Counter)
    with tempfile.TemporaryDirectory() as folder:
        for row in rows:
            path = os.path.join(root, row["repository"].replace("/", "+"), row["path"])
            if not os.path.exists(path):
                found["not there"] += 1
                continue
            said = judge(program, path, row, folder)
            result = "read right" if not said else said if said == "refused" else "wrong"
            found[result] += 1
            by_repository[row["repository"]][result] += 1
            if said and said != "refused":
                print(f"{row['repository']} {row['path']}: {said}")
    for repository, counts in sorted(by_repository.items()):
        print(f"{repository:<34}" + ", ".join(f"{count:>3} {what}" for what, count in sorted(counts.items())))
    print("all: " + ", ".join(f"{count} {what}" for what, count in sorted(found.items())))
    return found["wrong"] > 0 or not (found["read right"] or found["refused"])


if __name__ == "__main__":
    if sys.argv[1] == "record":
        record(sys.argv[2], sys.argv[3:])
    else:
        sys.exit(check(*sys.argv[2:]))
