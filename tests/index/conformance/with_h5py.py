"""HDF5 by h5py: plain datasets, VTKHDF, openPMD."""
import h5py

from manifest import done, expect, field, path, refuse
import numcodecs
import numpy as np

# Types, byte orders, layouts and filters.
for name, dtype, how in [("f32.h5", "<f4", {}), ("f64_be.h5", ">f8", {}), ("i16_be.h5", ">i2", {}),
                         ("u8.hdf5", "u1", dict(chunks=(2, 3, 4))), ("half.h5", "<f2", {}),
                         ("gzip.h5", "<f4", dict(chunks=(3, 5, 6), compression="gzip", shuffle=True, fletcher32=True)),
                         ("lzf.h5", "<i4", dict(chunks=True, compression="lzf")),
                         ("bzip2.h5", "<f8", dict(chunks=(2, 5, 6), compression=307)),
                         ("lz4.h5", "<f4", dict(chunks=(2, 5, 6), compression=32004)),
                         ("scaleoffset.h5", "<i2", dict(chunks=True, scaleoffset=0)),
                         ("u32.h5", "<u4", {}), ("compact.h5", "<i1", {})]:
    values = field(4, 5, 6, dtype=dtype)
    if "scaleoffset" in how and h5py.version.hdf5_version_tuple >= (1, 14, 5):
        values >>= 1  # HDF5 1.14.5 and 1.14.6 cannot read all the bits of a type
    with h5py.File(path(name), "w") as f:
        f.create_dataset("fields/rho", data=values, **how)
        f["text"] = "not a volume"
        f["line"] = np.arange(9.0)
        read = f["fields/rho"][...]
    expect(name, read)
    expect(name, read, array="/fields/rho")
    expect(name, read, array="rho")

# Filters that h5py only knows by their numbers.
for name, number, codec in [("zstd.h5", 32015, numcodecs.Zstd()), ("blosc.h5", 32001, numcodecs.Blosc("lz4"))]:
    values = field(4, 5, 6)
    with h5py.File(path(name), "w") as f:
        properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        properties.set_chunk((4, 5, 6))
        properties.set_filter(number, h5py.h5z.FLAG_OPTIONAL, (0, 0, 4, 480))
        dataset = h5py.h5d.create(f.id, b"rho", h5py.h5t.NATIVE_FLOAT, h5py.h5s.create_simple((4, 5, 6)), properties)
        dataset.write_direct_chunk((0, 0, 0), bytes(codec.encode(values)))
    expect(name, values)
with h5py.File(path("unknown.h5"), "w") as f:
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_chunk((4, 5, 6))
    properties.set_filter(444, h5py.h5z.FLAG_OPTIONAL, ())
    h5py.h5d.create(f.id, b"rho", h5py.h5t.NATIVE_FLOAT, h5py.h5s.create_simple((4, 5, 6)), properties)
refuse("unknown.h5", "/rho is packed by filter 444, which is not installed")

# Several datasets: one has to be chosen.
with h5py.File(path("several.h5"), "w") as f:
    a, b = field(3, 4, 5), field(2, 3, 4, dtype="i2")
    f["a"], f["deep/er/b"] = a, b
    f["deep/er/flag"] = np.ones((2, 3, 4), dtype=bool)
    f["soft"] = h5py.SoftLink("/deep/er/b")
    f["complex"] = np.zeros((3, 3, 3), dtype="c8")
refuse("several.h5", "several arrays, choose one with --array: /a (f32, 3 x 4 x 5), /deep/er/b (i16, 2 x 3 x 4)")
refuse("several.h5", "no array /none", array="/none")
refuse("several.h5", "complex", array="/complex")
expect("several.h5", a, array="a")
expect("several.h5", b, array="b")
expect("several.h5", b, array="/soft")
expect("several.h5", np.ones((2, 3, 4)), array="flag")

# Four dimensions, components, and what cannot be told apart.
series, vectors, planes = field(7, 3, 4, 5), field(3, 4, 5, 3), field(3, 8, 9, 5)
both = field(6, 3, 4, 5, 2)
with h5py.File(path("four.h5"), "w") as f:
    f["t/series"], f["t/time"] = series, np.arange(7) * 0.5
    f["t/time"].attrs["units"] = "s"
    f["vectors"], f["planes"], f["both"] = vectors, planes, both
    f.create_dataset("chunked", data=series, chunks=(4, 2, 2, 3), compression="gzip")
    f["single"] = series[:1]
expect("four.h5", series, array="series", times=np.arange(7) * 0.5)
expect("four.h5", series, array="chunked")
expect("four.h5", series[0], array="single")
refuse("four.h5", "its first axis may be time", array="vectors")
expect("four.h5", vectors[..., 1], array="vectors", component="1")
expect("four.h5", np.sqrt((vectors.astype("f8") ** 2).sum(-1)).astype("f4"), array="vectors", component="magnitude")
expect("four.h5", planes[2], array="planes", component="2")
expect("four.h5", planes, array="planes", extra_axis_is_time=True)
expect("four.h5", both[..., 0], array="both", component="0")

# Dates as text, of fixed and of varying length, and as rows of characters.
for name, texts, steps_apart in [
        ("fixed", np.array([b"2020-01-31_00:00:00", b"2020-01-31_06:00:00", b"2020-02-01_00:00:00"]), [0, 21600, 86400]),
        ("varying", ["2020-01-31T00:00:00", "2020-01-31T06:00:00", "2020-02-01T00:00:00"], [0, 21600, 86400]),
        ("rows", np.array([list(day) for day in ("30/01/2020", "31/01/2020", "01/02/2020")], "S1"), [0, 86400, 172800])]:
    with h5py.File(path(name + ".h5"), "w") as f:
        f["v"] = series[:3]
        f["time"] = texts
    expect(name + ".h5", series[:3], array="v", times=steps_apart, extra_axis_is_time=True)

# A group for each step, in natural order, with times.
with h5py.File(path("steps.h5"), "w") as f:
    steps = field(3, 2, 3, 4)
    for number, step, time in zip([2, 10, 1], steps[[1, 2, 0]], [0.2, 1.0, 0.1]):
        f[f"step_{number}/rho"], f[f"step_{number}/u"] = step, step + 1
        f[f"step_{number}"].attrs["time"] = time
        f[f"rho_{number:04d}"] = step
expect("steps.h5", steps, array="rho", times=[0.1, 0.2, 1.0])
expect("steps.h5", steps, array="/step_*/rho", times=[0.1, 0.2, 1.0])
expect("steps.h5", steps, array="/rho_*")
expect("steps.h5", steps[1], array="/step_2/rho")
refuse("steps.h5", "no array matches /x_*", array="/x_*")

# A file for each step.
for i in range(3):
    with h5py.File(path(f"run_{i}.h5"), "w") as f:
        f["rho"] = steps[i]
        f.attrs["time"] = i * 2.0
expect([f"run_{i}.h5" for i in range(3)], steps, times=[0, 2, 4])

# Positions by attributes.
values = field(3, 4, 5)
with h5py.File(path("dx.h5"), "w") as f:
    f["rho"] = values
    f.attrs["dx"], f.attrs["dy"], f.attrs["dz"] = 0.1, 0.2, 0.3
expect("dx.h5", values, spacing=(0.1, 0.2, 0.3))

# VTKHDF: image data, of one step and of several.
points, vectors, cells = field(3, 4, 5), field(3, 4, 5, 3), field(2, 3, 4)
for name, steps in [("image.vtkhdf", 0), ("temporal.vtkhdf", 4)]:
    with h5py.File(path(name), "w") as f:
        g = f.create_group("VTKHDF")
        g.attrs["Version"] = [2, 0]
        g.attrs.create("Type", b"ImageData", dtype=h5py.string_dtype("ascii", 9))
        g.attrs["WholeExtent"], g.attrs["Origin"] = [0, 4, 0, 3, 0, 2], [1.0, 2.0, 3.0]
        g.attrs["Spacing"], g.attrs["Direction"] = [0.5, 1.0, 2.0], [1.0, 0, 0, 0, 1, 0, 0, 0, 1]
        if steps:
            series = field(steps, 3, 4, 5)
            g["PointData/p"] = series
            g["Steps/Values"] = np.array([0, 0.5, 1.5, 2.0])
            g["Steps"].attrs["NSteps"] = steps
        else:
            g["PointData/p"], g["PointData/v"], g["CellData/c"] = points, vectors, cells
where = dict(spacing=(0.5, 1, 2), origin=(1, 2, 3))
with h5py.File(path("temporal.vtkhdf")) as f, h5py.File(path("offsets.vtkhdf"), "w") as out:  # steps in an order of their own
    f.copy("VTKHDF", out)
    out["VTKHDF/Steps/PointDataOffsets/p"] = np.array([2, 0, 3, 1])
expect("offsets.vtkhdf", series[[2, 0, 3, 1]], times=[0, 0.5, 1.5, 2.0], **where)
refuse("image.vtkhdf", "several arrays, choose one with --array: c (f32, cell data), p (f32), v (f32 x 3)")
expect("image.vtkhdf", points, array="p", **where)
expect("image.vtkhdf", vectors[..., 2], array="v", component="2", **where)
padded = np.pad(cells.astype("f8"), 1, constant_values=np.nan)
around = np.stack([padded[z:z + 3, y:y + 4, x:x + 5] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
expect("image.vtkhdf", np.nanmean(around, axis=0).astype("f4"), array="c", kind="rounded", **where)
expect("temporal.vtkhdf", series, times=[0, 0.5, 1.5, 2.0], **where)
with h5py.File(path("grid.vtkhdf"), "w") as f:
    f.create_group("VTKHDF").attrs.create("Type", b"UnstructuredGrid", dtype=h5py.string_dtype("ascii", 16))
refuse("grid.vtkhdf", "VTKHDF of type UnstructuredGrid, expected ImageData")

# openPMD: axes as their labels say, iterations as steps.
mesh = field(2, 3, 4, 5, dtype="f8")
for order in ["C", "F"]:
    with h5py.File(path(f"openpmd_{order}.h5"), "w") as f:
        f.attrs["openPMD"], f.attrs["basePath"] = "1.1.0", "/data/%T/"
        for number, time, data in zip([0, 100], [0.0, 5.0], mesh):
            iteration = f.create_group(f"data/{number}")
            iteration.attrs["time"], iteration.attrs["timeUnitSI"] = time, 2.0
            e = iteration.create_group("fields/E")
            e.attrs["dataOrder"], e.attrs["gridUnitSI"] = order, 0.5
            def along(of_dimensions):
                return of_dimensions[::-1] if order == "F" else of_dimensions
            e.attrs["axisLabels"] = np.array(along([b"x", b"y", b"z"]))
            e.attrs["gridSpacing"] = along([2.0, 4.0, 8.0])
            e.attrs["gridGlobalOffset"] = along([1.0, 2.0, 3.0])
            e["x"] = data
            e["x"].attrs["unitSI"], e["x"].attrs["position"] = 10.0, along([0.5, 0.0, 0.0])
    # The slowest dimension is x: the first index axis runs along z.
    expect(f"openpmd_{order}.h5", mesh * 10, times=[0, 10], spacing=(4, 2, 1), origin=(1.0, 1.0, 1.5),
           direction=[[0, 0, 1], [0, 1, 0], [1, 0, 0]])
done()
