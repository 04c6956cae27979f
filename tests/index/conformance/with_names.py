"""Names that say where data are and when they were: paths as Windows writes them, and groups with numbers for their steps, in
every container that has them."""
import json
import os

import h5py
import netCDF4
import numpy as np
import zarr

from manifest import done, expect, field, path, refuse

VERSION_2 = dict(zarr_format=2) if int(zarr.__version__.split(".")[0]) >= 3 else {}


def write(name, text):
    os.makedirs(os.path.dirname(path(name)), exist_ok=True)
    with open(path(name), "w") as out:
        out.write(text)


# ---- Paths with backslashes
values = field(2, 4, 5, 6)
numbers = lambda v: " ".join(repr(float(x)) for x in v.ravel())
IMAGE = '<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian"><ImageData WholeExtent="0 5 0 4 0 3" Origin="0 0 0" ' \
        'Spacing="1 1 1"><Piece Extent="0 5 0 4 0 3"><PointData><DataArray type="Float32" Name="v" format="ascii">' \
        '{}</DataArray></PointData></Piece></ImageData></VTKFile>'
for i in range(2):
    write(f"named/data/a_{i}.vti", IMAGE.format(numbers(values[i])))
    values[i].tofile(path(f"named/data/a_{i}.raw"))
with h5py.File(path("named/data/a.h5"), "w") as out:
    out["v"] = values[0]
write("named/l.pvd", '<VTKFile type="Collection" version="0.1"><Collection>' + "".join(
    f'<DataSet timestep="{i / 2}" part="0" file="data\\a_{i}.vti"/>' for i in range(2)) + "</Collection></VTKFile>")
expect("named/l.pvd", values, times=[0, .5])
write("named/l.vti.series", json.dumps(dict(files=[dict(name=f"data\\a_{i}.vti", time=i / 4) for i in range(2)])))
expect("named/l.vti.series", values, times=[0, .25])
write("named/l.pvti", '<VTKFile type="PImageData" version="0.1"><PImageData WholeExtent="0 5 0 4 0 3" GhostLevel="0" Origin="0 0 0" '
      'Spacing="1 1 1"><PPointData><PDataArray type="Float32" Name="v"/></PPointData>'
      '<Piece Extent="0 5 0 4 0 3" Source="data\\a_0.vti"/></PImageData></VTKFile>')
expect("named/l.pvti", values[0])
write("named/l.bov", 'DATA_FILE: data\\a_0.raw\nDATA_SIZE: 6 5 4\nDATA_FORMAT: FLOAT\nVARIABLE: "v"\nCENTERING: nodal\n'
      "BRICK_ORIGIN: 0 0 0\nBRICK_SIZE: 5 4 3\n")
expect("named/l.bov", values[0])
write("named/l.mhd", "NDims = 3\nDimSize = 6 5 4\nElementType = MET_FLOAT\nElementDataFile = data\\a_0.raw\n")
expect("named/l.mhd", values[0])
write("named/l.nhdr", "NRRD0004\ntype: float\ndimension: 3\nsizes: 6 5 4\nencoding: raw\nendian: little\ndata file: data\\a_0.raw\n")
expect("named/l.nhdr", values[0])
for name, item in [("h5", '<DataItem Format="HDF" Dimensions="4 5 6" NumberType="Float" Precision="4">data\\a.h5:/v</DataItem>'),
                   ("raw", '<DataItem Format="Binary" Endian="Little" Dimensions="4 5 6" NumberType="Float" Precision="4">data\\a_0.raw</DataItem>')]:
    write(f"named/{name}.xmf", '<Xdmf Version="3.0"><Domain><Grid GridType="Uniform"><Topology TopologyType="3DCoRectMesh" '
          'Dimensions="4 5 6"/><Geometry GeometryType="ORIGIN_DXDYDZ"><DataItem Dimensions="3" Format="XML">0 0 0</DataItem>'
          '<DataItem Dimensions="3" Format="XML">1 1 1</DataItem></Geometry><Attribute Name="v" Center="Node">' + item +
          "</Attribute></Grid></Domain></Xdmf>")
    expect(f"named/{name}.xmf", values[0])


# ---- Groups for steps
def hdf5(name, arrays, attributes):
    with h5py.File(path(name + ".h5"), "w") as out:
        for where, data in arrays.items():
            out[where] = data
        for where, time in attributes.items():
            out[where].attrs["time"] = time
    return name + ".h5"


def netcdf(name, arrays, attributes):
    with netCDF4.Dataset(path(name + ".nc"), "w") as out:
        for dimension, length in zip("zyx", (4, 5, 6)):
            out.createDimension(dimension, length)
        for where, data in arrays.items():
            out.createVariable(where, "f4", tuple("zyx"))[:] = data
        for where, time in attributes.items():
            out[where].time = time
    return name + ".nc"


def zarr2(name, arrays, attributes):
    name += ".zarr"
    zarr.open_group(path(name), mode="w", **VERSION_2)
    for where, data in arrays.items():
        for end in [i for i, c in enumerate(where) if c == "/"]:
            zarr.open_group(path(f"{name}/{where[:end]}"), mode="a", **VERSION_2)
        zarr.create(store=path(f"{name}/{where}"), shape=data.shape, dtype=data.dtype, chunks=data.shape, fill_value=0,
                    **VERSION_2)[...] = data
    for where, time in attributes.items():
        zarr.open_group(path(f"{name}/{where}"), mode="a", **VERSION_2).attrs["time"] = time
    return name


CONTAINERS = dict(hdf5=hdf5, netcdf=netcdf, zarr=zarr2)
number = 0


def groups(names, times=None, attributes={}, others=(), says=None, only=CONTAINERS, **options):
    """names: of the steps' arrays, in their order. says: they are refused with these words."""
    global number
    for container in only:
        number += 1
        data = field(len(names), 4, 5, 6)
        arrays = dict(zip(names, data)) | {other: field(4, 5, 6) for other in others}
        shuffled = sorted(arrays, key=lambda name: name[::-1])
        name = CONTAINERS[container](f"{container}_{number}", {n: arrays[n] for n in shuffled}, attributes)
        if says:
            for say in says:
                refuse(name, say, **options)
        else:
            expect(name, data, times=times if times is not None else range(len(names)), **options)


groups([f"Time:  {t:.5E} y/P" for t in (0, 2, 10, 25)], [0, 2, 10, 25], time_unit="y")
groups([f"t{t}s/v" for t in (0, 2.5, 10)], [0, 2.5, 10], time_unit="s")
groups([f"time={t}/v" for t in (0, .25, 1.5)], [0, .25, 1.5])
groups([f"{t} ms/v" for t in (5, 20, 100)], [5, 20, 100], time_unit="ms")
groups([f"step_{t}/v" for t in (2, 10, 100)])
groups([f"{t}/fields/v" for t in (2, 10, 100)])
groups([f"it{t}/v" for t in (1, 2, 10)], [.1, .2, .9], {"it1": .1, "it2": .2, "it10": .9})
# Two numbers, of which a word tells one.
for outer, inner in [("t{}", "channel{}"), ("channel{}", "t{}"), ("TimePoint {}", "Channel {}"), ("step{}", "run{}"), ("{}", "c{}"),
                     ("frame_{}", "level_{}")]:
    first_is_time = outer[0] not in "c"
    place = lambda t, c: f"{(outer if first_is_time else outer).format(t if first_is_time else c)}/" \
                         f"{inner.format(c if first_is_time else t)}/v"
    pattern = f"{outer.format('*' if first_is_time else 1)}/{inner.format(1 if first_is_time else '*')}/v"
    groups([place(t, 1) for t in (0, 2, 10)], others=[place(t, 0) for t in (0, 2, 10)], only=["hdf5"], array="/" + pattern)
    groups([place(t, 1) for t in (0, 2, 10)], others=[place(t, 0) for t in (0, 2, 10)], only=["netcdf", "zarr"], array=pattern)
# Attributes tell it where words do not.
groups([f"a{a}/b0/v" for a in range(3)], [0, 1.5, 7], {"a0": 0, "a1": 1.5, "a2": 7}, others=[f"a{a}/b1/v" for a in range(3)],
       only=["hdf5"], array="/a*/b0/v")
# Where both are possible both are named.
groups([f"a{a}/b{b}/v" for a in range(2) for b in range(3)], only=["hdf5"],
       says=["may count the steps: --array '/a*/b0/v' or --array '/a0/b*/v'"])
groups([f"a{a}/b{b}/v" for a in range(2) for b in range(3)], only=["netcdf", "zarr"],
       says=["may count the steps: --array 'a*/b0/v' or --array 'a0/b*/v'"])
# Channels and levels alone count no steps.
for name in ("channel{}/v", "level_{}/v", "resolution{}/v"):
    groups([name.format(i) for i in range(2)], says=["choose one with --array"])
# Brackets of a name stand for themselves beside `*`.
groups([f"Time:  {t:.5E} h/Pressure [Pa]" for t in (0, 3)], [0, 3], only=["hdf5", "zarr"], array="/Time:*/Pressure [Pa]")
done()
