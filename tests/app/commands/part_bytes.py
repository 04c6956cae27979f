"""Counts the bytes that `isochron info` and its readers read of a file for a crop of an eighth of it: at most 1.2 times the
eighth, besides what they read for the smallest crop. Usage: part_bytes.py PROGRAM, in an empty folder."""
import subprocess
import sys

import h5py
import netCDF4
import numpy as np
import zarr

program, n, chunk = sys.argv[1], 128, (16, 16, 16)
values = np.random.default_rng(1).random((n, n, n)).astype("f4")
values.tofile("a.raw")
with open("a.mha", "wb") as out:
    out.write(f"NDims = 3\nDimSize = {n} {n} {n}\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n".encode() + values.tobytes())
with h5py.File("a.h5", "w") as file:
    file.create_dataset("v", data=values, chunks=chunk)
with h5py.File("rows.h5", "w") as file:
    file.create_dataset("v", data=values)
# Of version 2, which zarr 3 writes where it is asked to.
version_2 = dict(zarr_format=2) if int(zarr.__version__.split(".")[0]) >= 3 else {}
zarr.open_group("a.zarr", mode="w", **version_2).create_dataset("v", shape=values.shape, data=values, dtype="f4",
                                                                chunks=chunk, compressor=None)
data = netCDF4.Dataset("a.nc", "w")
for axis in "zyx":
    data.createDimension(axis, n)
data.createVariable("v", "f4", tuple("zyx"), chunksizes=chunk)[:] = values
data.close()
# The library reads classic files in blocks of 256 bytes, at least two of them: rows of some length tell.
for model in ("NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET"):
    data = netCDF4.Dataset(f"{model}.nc", "w", format=model)
    for axis, length in zip("zyx", (32, 64, 1024)):
        data.createDimension(axis, length)
    data.createVariable("v", "f4", tuple("zyx"))[:] = values.reshape(32, 64, 1024)
    data.close()


def bytes_so_far():
    """Of this process and of those that it, or they, waited for."""
    with open("/proc/self/io") as counts:
        return int(next(line for line in counts if line.startswith("rchar")).split()[1])


def bytes_of(name, crop):
    raw = ["--dims", str(n), str(n), str(n), "--type", "f32"] if name.endswith(".raw") else []
    before = bytes_so_far()
    done = subprocess.run([program, "info", name, *raw, "--crop", crop], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return bytes_so_far() - before


wrong = 0
cubes = ("32:95,32:95,32:95", "0:63,64:127,32:95")
long_rows = ("256:767,16:47,8:23", "0:511,32:63,8:23")
for name, crops in [(name, cubes) for name in ("a.raw", "a.mha", "a.h5", "rows.h5", "a.zarr", "a.nc")] + [
        (name, long_rows) for name in ("NETCDF3_CLASSIC.nc", "NETCDF3_64BIT_OFFSET.nc")]:
    for crop in crops:
        ratio = (bytes_of(name, crop) - bytes_of(name, "64:65,32:33,16:17")) / (values.nbytes / 8)
        print(f"{name} {crop}: {ratio:.3f} times the eighth")
        wrong += not 0.9 < ratio < 1.2
sys.exit(wrong > 0)
