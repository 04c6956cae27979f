"""Follows the advice of messages: a command that fails or notes something, and the command that its words name. Usage:
advice.py PROGRAM SOURCES, in an empty folder."""
import glob
import os
import re
import shlex
import subprocess
import sys

import h5py
import netCDF4
import numpy as np
import tifffile
import zarr

program, sources = sys.argv[1:]
values = np.random.default_rng(5).integers(0, 200, (4, 5, 6)).astype("f4")
followed, wrong = [], []


def run(*arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def write(name, content):
    os.makedirs(os.path.dirname(name) or ".", exist_ok=True)
    with open(name, "wb") as out:
        out.write(content if isinstance(content, bytes) else content.encode())
    return name


def follow(given, said, *ways, gives="", gone=False, build=False):
    """`given`: arguments of `info`, or of `build`, whose only line, or a note of it, holds `said`. Each of `ways` is the advice
    as it is written there, with what the user puts in the place of words in capitals, or behind it; then `info` has `gives`,
    and, if `gone`, the note no more."""
    given = shlex.split(given)
    build_it = ["build", *given, "-o", "out.isochron", "--quiet", "--force"]
    status, out, err = run(*build_it) if build else run("info", *given)
    text = out if status == 0 else err
    if said not in text or (status and err.count("\n") != 1):
        return wrong.append(f"{given}: {text!r}, expected {said!r}")
    followed.append(said)
    for advice, *fills in ways:
        if advice not in text:
            wrong.append(f"{given}: {text!r} does not say {advice!r}")
        words = advice
        for fill in fills:
            words = re.sub(r"\b[A-Z]{1,2}\b(?: [A-Z]{2}\b)*|$", " " + fill + " ", words, count=1)
        if build:
            status, out, err = run(*build_it, *shlex.split(words))
            if status == 0:
                status, out, err = run("info", "out.isochron")
        else:
            status, out, err = run("info", *given, *shlex.split(words))
        if status or gives not in out or (gone and said in out):
            wrong.append(f"{given} {words}: {out}{err}, expected {gives!r}")


def hdf5(name, fill, **attributes):
    with h5py.File(name, "w") as file:
        for key, data in fill.items():
            file[key] = data
        for key, value in attributes.items():
            file.attrs[key] = value
    return name


def netcdf(name, x=range(6), units="m", times=None, time_units="s", names="v", **attributes):
    data = netCDF4.Dataset(name, "w")
    axes = [("time", times)] * (times is not None) + [("z", range(4)), ("y", range(5)), ("x", x)]
    for axis, at in axes:
        data.createDimension(axis, len(at))
        variable = data.createVariable(axis, "f8", (axis,))
        variable[:] = list(at)
        variable.units = time_units if axis == "time" else units if axis == "z" else "m"
    for one in names.split():
        data.createVariable(one, "f4", [axis for axis, _ in axes])[:] = values
    data.setncatts(attributes)
    data.close()
    return name


def nrrd(name, data, lines=""):
    kind = {"f4": "float", "i2": "short", "u1": "uchar"}[data.dtype.str[1:]]
    sizes = " ".join(str(n) for n in data.shape[::-1])
    return write(name, f"NRRD0005\ntype: {kind}\ndimension: {data.ndim}\nsizes: {sizes}\nencoding: raw\nendian: little\n"
                 f"{lines}\n".encode() + data.tobytes())


def vti(name, time=None, data=values):
    time = "" if time is None else ('<FieldData><DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">'
                                    f"{time}</DataArray></FieldData>")
    return write(name, '<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian"><ImageData WholeExtent="0 5 0 4 0 3" '
                 f'Origin="0 0 0" Spacing="1 1 1">{time}<Piece Extent="0 5 0 4 0 3"><PointData><DataArray type="Float32" '
                 f'Name="v" format="ascii">{" ".join(str(v) for v in np.ravel(data))}</DataArray></PointData></Piece>'
                 "</ImageData></VTKFile>")


def rectilinear(name, x):
    def array(at):
        return f'<DataArray type="Float64" format="ascii">{" ".join(str(v) for v in at)}</DataArray>'

    return write(name, '<VTKFile type="RectilinearGrid" version="1.0" byte_order="LittleEndian"><RectilinearGrid WholeExtent='
                 '"0 5 0 4 0 3"><Piece Extent="0 5 0 4 0 3"><PointData><DataArray type="Float32" Name="v" format="ascii">'
                 f'{" ".join(str(v) for v in values.ravel())}</DataArray></PointData><Coordinates>{array(x)}{array(range(5))}'
                 f"{array(range(4))}</Coordinates></Piece></RectilinearGrid></VTKFile>")


def zarr_group(name, **arrays):
    """Of version 2, which zarr 3 writes where it is asked to."""
    group = zarr.open_group(name, mode="w", **(dict(zarr_format=2) if int(zarr.__version__.split(".")[0]) >= 3 else {}))
    for array, held in arrays.items():
        group.create_dataset(array, shape=held.shape, data=held, dtype=held.dtype)


def tetrahedra(name, size):
    """One of size 1, one of another size."""
    at = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1] + [v * size + 2 for v in (0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)]
    return write(name, "# vtk DataFile Version 3.0\nvtk output\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
                 + " ".join(str(v) for v in at) + "\nCELLS 2 10\n4 0 1 2 3\n4 4 5 6 7\nCELL_TYPES 2\n10\n10\nPOINT_DATA 8\n"
                 "SCALARS v float 1\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\n")


# ---- arrays and components
two = {"u": values, "w": values + 1}
zarr_group("two.zarr", u=values, w=values)
for name, first in [(hdf5("two.h5", two), "/u"), (netcdf("two.nc", names="u w"), "u"), ("two.zarr", "u")]:
    status, out, err = run("build", name, "-o", "two.isochron", "--quiet")
    if "several arrays, choose one with --array: " not in err and "choose one" not in err:
        wrong.append(f"{name}: {err}")
    for choice in (["--array", first], ["--all-arrays"], ["--array", "[uw]"]):
        status, out, err = run("build", name, "-o", "two.isochron", "--quiet", "--force", *choice)
        held = run("info", "two.isochron", "--json")[1]
        if status or ('"w"' in held or '"/w"' in held) != (choice[0] == "--all-arrays" or choice[1] == "[uw]"):
            wrong.append(f"{name} {choice}: {err}{held}")
followed.append("several arrays, choose one with --array: {}; --all-arrays takes all of one shape")
four = hdf5("four.h5", {"v": np.zeros((3, 4, 5, 6), "f4")})
for advice, gives in [("--extra-axis-is-time", "3, "), ("--component 0", "v.0")]:
    follow(four, "its first axis may be time (--extra-axis-is-time) or an axis components (--component 0, 1, ... or magnitude)",
           (advice,), gives=gives, build=True)
zarr_group("four.zarr", v=np.zeros((3, 4, 5, 6), "f4"))
for advice, gives in (("--extra-axis-is-time", "6 x 5 x 4"), ("--component 0", "5 x 4 x 3")):
    follow("four.zarr", "its first axis may be time (--extra-axis-is-time) or an axis components (--component 0, 1, ... or "
           "magnitude)", (advice,), gives=gives, build=True)
follow(nrrd("list.nrrd", np.zeros((3, 4, 5, 6), "f4"), "kinds: space space space space\n"),
       ": --extra-axis-is-time reads it as time, --component N takes one of it", ("--extra-axis-is-time",),
       ("--component N", "1"), gives="6 x 5 x 4", build=True)
follow(hdf5("groups.h5", {f"t{i}/v": np.zeros((9, 7, 5, 6), "f4") for i in range(2)}),
       "groups holds several steps, choose one with --array /t0/v", ("--array /t0/v",), gives="9, ")
followed += ["groups holds several steps, choose one with --array", "' or --array '"]
follow(hdf5("nwb.h5", {"a/data": values}, nwb_version="2.0"), "--array /PATH reads one of its datasets all the same",
       ("--array /PATH".replace("/PATH", ""), "/a/data"), gives="6 x 5 x 4")
follow(hdf5("both.h5", {f"a{i}/b{j}/v": values for i in range(2) for j in range(2)}),
       "the numbers of several groups may count the steps: --array '", ("--array '/a*/b0/v'",), gives="steps         2")
os.makedirs("channels")
for c in range(2):
    for z in range(4):
        tifffile.imwrite(f"channels/c{c}_z{z}.tif", values[z].astype("u2"))
status, out, err = run("info", "channels/*.tif")
if "files of several channels, choose one with --array: channel 0, channel 1" not in err or \
        run("info", "channels/*.tif", "--array", "channel 1")[0]:
    wrong.append(f"channels: {out}{err}")
followed.append(": files of several channels, choose one with --array:")

# ---- arrays that may be the steps or the components of one
names = {f"{name}_{i}": values + i for name in ("rho", "T") for i in range(3)} | {f"E{c}": values for c in "xyz"}
hdf5("family.h5", names | {"rho_mean": values})
netcdf("family.nc", names=" ".join(names))
zarr_group("family.zarr", **names)
hdf5("mean.h5", {f"rho_{i}": values for i in range(3)} | {"rho_mean": values})
for given, array, gives in [(f"family.{ending}", f"{begins}{name}", gives.format(begins))
                            for ending, begins in (("h5", "/"), ("nc", ""), ("zarr", ""))
                            for name, gives in (("T_*", "steps         3"), (f"Ex,{begins}Ey,{begins}Ez", "{0}Ez.magnitude"))] + \
        [("mean.h5", "/rho_[0-9]*", "steps         3")]:
    build = ["build", given, "-o", "family.isochron", "--quiet", "--force"]
    status, out, err = run(*build)
    words = f"--array {shlex.quote(array)} takes "
    if not status or words not in err.splitlines()[-1] or run(*build, "--array", array)[0] or \
            gives not in run("info", "family.isochron")[1]:
        wrong.append(f"{given} {words}: {err}{run('info', 'family.isochron')}")
followed += ["; --array '{}{}*' takes {} as the steps of one", "; --array {} takes the length of a vector"]

# ---- sizes, types, what is left over
raw = write("plain.dat", values.tobytes())
follow(raw, "or raw values with --dims and --type", ("--dims", "6 5 4 --type f32"), gives="6 x 5 x 4")
write("folder/plain.dat", values.tobytes())
follow("folder", "raw values need --dims and --type", ("--dims", "6 5 4 --type f32"), gives="6 x 5 x 4")
follow(write("alone.raw", values.tobytes()), "raw values need --dims NX NY NZ and --type",
       ("--dims", "6 5 4 --type f32"), gives="6 x 5 x 4")
write("longer.raw", values.tobytes() + b"12345")
follow("longer.raw --dims 6 5 4 --type f32", "(--allow-surplus leaves the last bytes out)", ("--allow-surplus",), gives="6 x 5 x 4")
follow(nrrd("surplus.nrrd", values, "") and write("surplus.nrrd", open("surplus.nrrd", "rb").read() + bytes(8)),
       "(--allow-surplus reads it)", ("--allow-surplus",), gives="6 x 5 x 4")
nrrd("type_1.nrrd", values)
nrrd("type_2.nrrd", values.astype("i2"))
follow("'type_*.nrrd'", "--type f32 reads both as f32", ("--type f32",), gives="2, times")
nrrd("half.nrrd", values + .5)
status, out, err = run("build", "half.nrrd", "--type", "i16", "-o", "half.isochron", "--quiet")
if ": --type f32 or f64 keeps it" not in err or run("build", "half.nrrd", "--type", "f32", "-o", "half.isochron", "--quiet")[0]:
    wrong.append(f"half.nrrd: {out}{err}")
followed.append(": --type f32 or f64 keeps it")
for name, bytes_of in [("array.npy", None)]:
    np.save(name, values)
    follow(name, "--dims 6 5 4 --type f32 --header-bytes 128 reads", ("--dims 6 5 4 --type f32 --header-bytes 128",),
           gives="6 x 5 x 4")

# ---- places
follow(netcdf("back.nc", x=[0, 2, 1, 3, 4, 5]), "(--spacing does without them)", ("--spacing", "1 1 1"), gives="6 x 5 x 4")
follow(netcdf("degrees.nc", units="degrees"), "--spacing sets other proportions", ("--spacing", "1 1 1"), gives="1 x 1 x 1", gone=True)
follow(netcdf("unlike.nc", units="K"), "units differ", ("--spacing", "1 1 1"), gives="1 x 1 x 1", gone=True)
data = netCDF4.Dataset("wrf.nc", "w")
for axis, n in zip(("bottom_top", "south_north", "west_east"), values.shape):
    data.createDimension(axis, n)
data.createVariable("v", "f4", ("bottom_top", "south_north", "west_east"))[:] = values
data.DX, data.DY = 1000., 500.
data.close()
follow("wrf.nc", "attributes say DX 1000 and DY 500: --spacing 1000 500 DZ", ("--spacing 1000 500 DZ", "100"),
       gives="1000 x 500 x 100")
data = netCDF4.Dataset("runs.nc", "w")
for axis, n in zip(("member", "z", "y", "x"), (3, 4, 5, 6)):
    data.createDimension(axis, n)
data.createVariable("v", "f4", ("member", "z", "y", "x"))[:] = np.stack([values, values + 1000, values])
data.close()
follow("runs.nc", "v has 3 members along member, choose one with --member 0 to 2", ("--member", "1"), gives="1000 to 1199",
       build=True)
follow("wrf.nc --member 1", "has no axis of members, --member names one", build=True)
still = zarr.open_group("still.zarr", mode="w")
still.create_dataset("0", data=np.stack([values] * 3))
still.attrs["multiscales"] = [dict(axes=[dict(name="t", type="time")] + [dict(name=name, type="space") for name in "zyx"],
                                   datasets=[dict(path="0", coordinateTransformations=[dict(type="scale", scale=[0, 1, 1, 1])])])]
follow("still.zarr", "steps are 0 apart by the file: their times are not used (--time-step)", ("--time-step", "5"), gives="to 10")
with h5py.File("spaced.h5", "w") as file:
    file["v"] = values
    file["v"].attrs["spacing"] = [1., 2., 3.]
follow("spaced.h5", "an attribute may be the spacing, in either order: 1 2 3 (--spacing)", ("--spacing", "3 2 1"), gives="3 x 2 x 1",
       gone=True)
tifffile.imwrite("inches.tif", values.astype("u2"), photometric="minisblack", metadata=None, resolution=(4, 2),
                 resolutionunit="CENTIMETER")
follow("inches.tif", "pixels for each cm (--spacing, --length-unit)", ("--spacing", ".25 .5 1 --length-unit cm"),
       gives="0.25 x 0.5 x 1", gone=False)
with h5py.File("unlike.h5", "w") as file:
    file["v"] = values
    for axis, (name, unit) in enumerate([("z", "K"), ("y", "m"), ("x", "m")]):
        file[name] = np.arange(values.shape[axis])
        file[name].attrs["units"] = unit
        file[name].make_scale(name)
        file["v"].dims[axis].attach_scale(file[name])
follow("unlike.h5", "--spacing sets other proportions", ("--spacing", "1 1 1"), gives="1 x 1 x 1", gone=True)

# ---- grids that are not regular
status, out, err = run("info", rectilinear("uneven.vtr", [0, 1, 3, 6, 10, 15]), "--resample", "9", "5", "4")
if status or "is not uniform" in out:
    wrong.append(f"uneven.vtr: {out}{err}")
rectilinear("finest.vtr", [0, 1e-8, 3, 6, 10, 15])
status, out, err = run("info", "finest.vtr", "--resample-by-cell")
if "--resample NX NY NZ says how many" not in err or run("info", "finest.vtr", "--resample", "9", "5", "4")[0]:
    wrong.append(f"finest.vtr: {out}{err}")
followed.append("expected fewer; --resample NX NY NZ says how many")
follow(tetrahedra("mesh.vtk", 1), "--resample NX NY NZ makes a regular grid of it, --resample-by-cell one as fine as its smallest",
       ("--resample NX NY NZ", "7 7 7"), ("--resample-by-cell",), gives="vertices")
tetrahedra("tiny.vtk", 1e-6)
status, out, err = run("info", "tiny.vtk", "--resample-by-cell")
if "; --resample NX NY NZ says how many" not in err or run("info", "tiny.vtk", "--resample", "7", "7", "7")[0]:
    wrong.append(f"tiny.vtk: {out}{err}")
followed.append("{:.0f}; --resample NX NY NZ says how many")
status, out, err = run("info", "half.nrrd", "--component", "vorticity")
if "--component gradient is for scalars" not in err or run("info", "half.nrrd", "--component", "gradient")[0]:
    wrong.append(f"curl of a scalar: {out}{err}")
followed.append("--component gradient is for scalars")

hdf5("run.exo", {"v": values})
status, out, err = run("info", "run.exo")
if "--resample NX NY NZ or --resample-by-cell makes one of it" not in err:  # followed with whole files by with_meshes.py
    wrong.append(f"run.exo: {out}{err}")
followed.append("a mesh, expected a regular grid; --resample NX NY NZ or --resample-by-cell makes one of it")
text = ('<?xml version="1.0"?><OME xmlns="http://www.openmicroscopy.org/Schemas/OME/2016-06"><Image ID="Image:0"><Pixels '
        'ID="Pixels:0" DimensionOrder="XYZCT" Type="uint16" SizeX="6" SizeY="5" SizeZ="4" SizeC="1" SizeT="1" PhysicalSizeX="1" '
        'PhysicalSizeY="1" PhysicalSizeZ="1" PhysicalSizeZUnit="pixel"><Channel ID="Channel:0:0"/><TiffData/></Pixels></Image>'
        "</OME>")
tifffile.imwrite("pixels.ome.tif", values.astype("u2"), photometric="minisblack", metadata=None, description=text)
follow("pixels.ome.tif", "units differ: x um, y um, z pixel; --spacing sets other proportions", ("--spacing", "1 1 2"),
       gives="1 x 1 x 2")
hdf5("views.h5", {f"s{setup:02}/{name}": np.ones((1, 3)) for setup in (0, 1) for name in ("resolutions", "subdivisions")} |
     {f"t{time:05}/s{setup:02}/0/cells": values.astype("i2") for time in (0, 1) for setup in (0, 1)})
setups, chosen = "several setups of BigDataViewer, choose one with --array", ("--array", "/t*/s01/0/cells")
if setups not in run("build", "views.h5", "-o", "views.isochron", "--quiet")[2] or \
        run("build", "views.h5", "-o", "views.isochron", "--quiet", *chosen)[0]:
    wrong.append("views.h5")
followed.append(setups)
hdf5("five.h5", {"v": np.zeros((5, 6, 7, 8, 3), "f4")})
status, out, err = run("build", "five.h5", "-o", "five.isochron", "--quiet")
if "expected three axes, time, and components with --component" not in err or \
        run("build", "five.h5", "-o", "five.isochron", "--quiet", "--component", "1")[0]:
    wrong.append(f"five.h5: {out}{err}")
followed.append("expected three axes, time, and components with --component")

nrrd("list.nrrd", np.ones((5, 4, 5, 6), "f4"), "kinds: space space space list\n")
for advice, gives in [("--component 0", ".0"), ("--component magnitude", "magnitude"), ("--extra-axis-is-time", "steps         5")]:
    follow("list.nrrd", "has 5 components, choose one with --component 0 to 4 or --component magnitude; --extra-axis-is-time reads "
           "them as steps", (advice,), gives=gives, build=True)

# ---- times
for i, name in enumerate(("02-01-2020", "01-02-2020")):
    nrrd(f"either_{name}.nrrd", values + i)
follow("'either_*.nrrd'", "--dates dmy or --dates mdy makes dates of them", ("--dates dmy",), gives="read as day-month-year", gone=True)
follow("'either_*.nrrd'", "--dates dmy or --dates mdy makes dates of them", ("--dates mdy",), gives="names have dates", gone=True)
netcdf("since.nc", times=[0, 1], time_units="days since 02-01-2000")
for advice, date in (("--dates dmy", "2000-01-02"), ("--dates mdy", "2000-02-01")):
    follow("since.nc", "(--dates dmy, --dates mdy)", (advice,), gives=date, gone=True)
vti("time_1.vti", 0)
vti("time_2.vti")
follow("'time_*.vti'", "; --time-step sets them all", ("--time-step", "2"), gives="times 0 to 2")
netcdf("unit_1.nc", times=[0, 1], time_units="s")
netcdf("unit_2.nc", times=[2, 3], time_units="K")
follow("'unit_*.nc'", "--time-step sets them all", ("--time-step", "2"), gives="times 0 to 6")
for i in (1, 2, 4):
    nrrd(f"gap_{i}.nrrd", values)
follow("'gap_*.nrrd'", "--times-from-names takes the numbers as times", ("--times-from-names",), gives="times 1 to 4", gone=True)
for i, name in enumerate(("a_1", "b_1")):
    nrrd(f"same/{name}.nrrd", values)
write("again.pvd", '<VTKFile type="Collection"><Collection>' + "".join(
    f'<DataSet timestep="{t}" file="time_{n}.vti"/>' for t, n in ((0, 1), (1, 1), (1, 2))) + "</Collection></VTKFile>")
follow("again.pvd", "(--keep-first: the first)", ("--keep-first",), gives="2, times", gone=True)

for day in ("2020-01-02", "2020-01-10", "2019-12-31"):
    nrrd(f"day_{day}.nrrd", values)
follow("'day_*.nrrd'", "the files' names have dates; --times-from-names takes them as times", ("--times-from-names",),
       gives="times 2019-12-31 to 2020-01-10", gone=True)
given = ["day_2019-12-31.nrrd", "day_2020-01-02.nrrd", "--times-from-names", "--time-unit"]
status, out, err = run("info", *given, "s")
unit = re.search(r"`(hours since [-0-9]+)`", err)
if not unit or "times 2019-12-31 to 2020-01-02" not in run("info", *given, unit[1])[1]:
    wrong.append(f"{given}: {out}{err}{run('info', *given, unit[1] if unit else '')}")
followed.append("expected a unit with a date for the dates of")
for folder, name in (("left", "a_1"), ("right", "b_1")):
    nrrd(f"{folder}/{name}.nrrd", values)
given = ["left/a_1.nrrd", "right/b_1.nrrd"]
status, out, err = run("info", *given, "--times-from-names")
if "without --times-from-names their names order them" not in err or run("info", *given)[0]:
    wrong.append(f"{given}: {out}{err}")
followed.append("without --times-from-names")

# ---- values of other formats, behind their headers
np.save("big.npy", values.astype(">f4"))
np.save("little.npy", values.astype("<u2"))
cards = ["SIMPLE  =                    T", "BITPIX  =                  -32", "NAXIS   =                    3",
         "NAXIS1  =                    6", "NAXIS2  =                    5", "NAXIS3  =                    4", "END"]
data = values.astype(">f4").tobytes()
write("sky.fits", "".join(card.ljust(80) for card in cards).ljust(2880).encode() + data + bytes(-len(data) % 2880))
for name, gives in [("big.npy", "values        0 to 199"), ("little.npy", "type          u16"), ("sky.fits", "6 x 5 x 4")]:
    status, out, err = run("info", name)
    found = re.search(r"whose values (--.*) reads", err)
    if not found:
        wrong.append(f"{name}: {out}{err}")
        continue
    status, out, err = run("info", name, *shlex.split(found[1]))
    if status or gives not in out:
        wrong.append(f"{name} {found[1]}: {out}{err}, expected {gives!r}")
followed += [" --big-endian", "--header-bytes {}", "--length-unit angstrom", "--steps 0:0"]

# ---- several files, other names, other folders
write("list.pvd", '<VTKFile type="Collection"><Collection><DataSet timestep="0" file="time_1.vti"/></Collection></VTKFile>')
status, out, err = run("info", "list.pvd", "time_2.vti")
if "names its files itself, and 1 more is given: give it alone, or leave it out" not in err or run("info", "list.pvd")[0] or \
        run("info", "time_2.vti")[0]:
    wrong.append(f"list.pvd: {out}{err}")
run("build", "gap_1.nrrd", "-o", "gap.isochron", "--quiet")
status, out, err = run("info", "gap.isochron", "gap_2.nrrd")
advice = re.search(r"`isochron (build FILES -o INDEX --append)`", err)
if not advice or run(*shlex.split(advice[1].replace("FILES", "gap_1.nrrd gap_2.nrrd").replace("INDEX", "gap.isochron")))[0] or \
        '"steps": 2' not in run("info", "gap.isochron", "--json")[1].replace('"steps":2', '"steps": 2'):
    wrong.append(f"gap.isochron: {out}{err}")
followed.append("FILES -o INDEX --append` adds files to it")
with h5py.File("seven.mat", "w", userblock_size=512) as file:
    file["v"] = values
with open("seven.mat", "r+b") as file:
    file.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\0\x02IM")
tifffile.imwrite("stack.lsm", values.astype("u2"), photometric="minisblack", metadata=None)
for name in ("seven.mat", "stack.lsm"):  # the content counts
    status, out, err = run("info", name)
    if status or "6 x 5 x 4" not in out:
        wrong.append(f"{name}: {out}{err}")

# ---- what programs write by default says nothing that would be noted
def vtk_files():
    import vtk
    from vtk.util import numpy_support
    image = vtk.vtkImageData()
    image.SetDimensions(6, 5, 4)
    for name in ("p", "T"):
        held = numpy_support.numpy_to_vtk(values.ravel(), deep=True)
        held.SetName(name)
        held.GetRange()
        image.GetPointData().AddArray(held)
    image.GetPointData().SetActiveScalars("T")
    vectors = numpy_support.numpy_to_vtk(np.stack([values.ravel()] * 3, 1), deep=True)
    vectors.SetName("U")
    for i in range(3):
        vectors.SetComponentName(i, "XYZ"[i])
    image.GetPointData().SetVectors(vectors)
    whole = vtk.vtkImageCast()
    whole.SetInputData(image)
    whole.SetOutputScalarTypeToUnsignedShort()
    whole.Update()
    for writer, name, data in [(vtk.vtkXMLImageDataWriter(), "silent.vti", image), (vtk.vtkXMLPImageDataWriter(), "silent.pvti", image),
                               (vtk.vtkStructuredPointsWriter(), "silent.vtk", image), (vtk.vtkMetaImageWriter(), "silent.mha", image),
                               (vtk.vtkTIFFWriter(), "silent.tif", whole.GetOutput())]:
        writer.SetFileName(name)
        writer.SetInputData(data)
        writer.Write()
        yield name


def silent_files():
    import nibabel
    import xarray
    yield from vtk_files()
    yield hdf5("silent.h5", {"p": values}, title="a run")
    yield netcdf("silent.nc", times=[0, 1], Conventions="CF-1.8", title="a run", history="made", institution="here")
    tifffile.imwrite("silent_imagej.tif", values.astype("u2")[:, None], imagej=True, metadata=dict(axes="ZCYX", mode="grayscale", min=0., max=9.))
    tifffile.imwrite("silent.ome.tif", values.astype("u2"), metadata=dict(axes="ZYX"))
    tifffile.imwrite("silent_itk.tif", values.astype("u2"), photometric="minisblack", metadata=None, software="InsightToolkit",
                     resolution=(25.4, 25.4), resolutionunit="INCH")
    yield from ("silent_imagej.tif", "silent.ome.tif", "silent_itk.tif")
    image = nibabel.Nifti1Image(values.T, np.diag([1, 1, 2, 1]))
    image.header["descrip"], image.header["cal_max"], image.header["aux_file"] = b"FSL5.0", 9, b"none"
    for name in ("silent.nii", "silent.nii.gz"):
        nibabel.save(image, name)
        yield name
    xarray.DataArray(values, dims=list("zyx"), coords=dict(z=range(4), y=range(5), x=range(6)), name="p").to_netcdf("silent_xarray.nc")
    yield "silent_xarray.nc"
    yield nrrd("silent_itk.nrrd", values, "space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: "
               "(0,0,0)\nkinds: domain domain domain\nmeasurement frame: (1,0,0) (0,1,0) (0,0,1)\ncontent: a run\n"
               "ITK_InputFilterName:=NrrdImageIO\n")
    yield write("silent_itk.mha", b"ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = "
                b"False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nCenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\n"
                b"ElementSpacing = 1 1 1\nITK_InputFilterName = MetaImageIO\nDimSize = 6 5 4\nElementType = MET_FLOAT\n"
                b"ElementDataFile = LOCAL\n" + values.tobytes())


for name in silent_files():
    status, out, err = run("info", name)
    if status or re.search("^note", out, re.MULTILINE):
        wrong.append(f"{name}: {out}{err}, expected no note")
    status, out, err = run("build", name, "-o", "silent.isochron", "--force", "--all-arrays")
    if status or "note" in out + err:
        wrong.append(f"{name}: {out}{err}, expected no note of the build")

# ---- every option that a message of the readers names is in a case above, or is no advice
NO_ADVICE = [
    "expected positive numbers", "expected a positive number", "expected less than", "expected a volume of less than", "stride 0",
    "expected vertices of", "expected steps of", "expected one of the two", "as in t_0030.vti", "expected one of them",
    "takes no", "as large as --dims and --type", "more than {} objects",  # takes minutes to make
    "--help", "--version", "expected magnitude", "--component {} of {}", "DX {:g}", "another fence",
    "name it .cgns",  # needs a whole CGNS file: with_foreign.py has its line
    # with_bytes.py, with_tifffile.py, with_h5py.py and with_dicom_frames.py follow these
    "a film, {} frames", "are the phases of one scan", "images: {} is read", "the field of view",
    "(--origin)", "CZ_LSMINFO", "originator",  # names of options behind what a file states
    "times-from-names cannot", "spaces the steps evenly",
    "--array {}; the groups", "-expected", "given with", "--steps {}:{}:{}", "h4toh5"]
texts = []
for name in glob.glob(sources + "/index/readers/formats/**/*.cpp", recursive=True) + glob.glob(sources + "/index/readers/decoders/**/*.cpp",
                                                                                       recursive=True):
    code = re.sub(r"//[^\n]*", "", open(name).read())
    for literal in re.findall(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', code):
        text = "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', literal))
        if re.search(r"(?<![-\w])--[a-z]", text):
            texts.append((os.path.basename(name), text))
for name, text in texts:
    pieces = [piece for piece in re.split(r"\{[^}]*\}", text) if "--" in piece]
    known = any(piece.strip(" ;:") in said or said in piece for piece in pieces for said in followed)
    if not known and not any(other in text for other in NO_ADVICE):
        wrong.append(f"{name}: nobody follows {text!r}")
print("\n".join(wrong) or f"{len(followed)} followed, {len(texts)} named")
sys.exit(bool(wrong))
