"""TIFF by tifffile: plain pages, ImageJ, OME, folders of slices and stacks."""
import os

import numpy as np
import tifffile

from manifest import done, expect, field, path, refuse

stack = field(4, 5, 6, dtype="u2")
for name, dtype, how in [
        ("plain.tif", "u2", {}), ("u8.tif", "u1", {}), ("i16.tif", "i2", {}), ("f32.tif", "f4", {}),
        ("f64.tiff", "f8", {}), ("u32.tif", "u4", {}), ("i8.tif", "i1", {}),
        ("big_endian.tif", "i2", dict(byteorder=">")), ("bigtiff.tif", "f4", dict(bigtiff=True)),
        ("bigtiff_be.btf", "f4", dict(bigtiff=True, byteorder=">")),
        ("deflate.tif", "f4", dict(compression="zlib", predictor=True)),
        ("lzw.tif", "u2", dict(compression="lzw")), ("packbits.tif", "u1", dict(compression="packbits")),
        ("tiled.tif", "u2", dict(tile=(16, 16))), ("tiled_deflate.tif", "f4", dict(tile=(16, 16), compression="zlib")),
        ("strips.tif", "u2", dict(rowsperstrip=2)), ("minisblack.tif", "u1", dict(photometric="minisblack"))]:
    values = field(4, 20, 19, dtype=dtype)
    try:
        tifffile.imwrite(path(name), values, metadata=None, **{"photometric": "minisblack", **how})
    except (ValueError, KeyError, RuntimeError, ImportError):  # without imagecodecs it cannot write it
        continue
    expect(name, tifffile.imread(path(name)))

# Colors: components of each pixel, together or apart.
colors = field(4, 7, 8, 3, dtype="u1")
tifffile.imwrite(path("rgb.tif"), colors, photometric="rgb", metadata=None)
expect("rgb.tif", colors[..., 1], component="1")
expect("rgb.tif", np.sqrt((colors.astype("f8") ** 2).sum(-1)).astype("f4"), component="magnitude")
refuse("rgb.tif", "has 3 components, choose one with --component 0 to 2")
tifffile.imwrite(path("apart.tif"), np.moveaxis(colors, -1, 1), photometric="rgb", planarconfig="separate",
                 metadata=None)
expect("apart.tif", colors[..., 2], component="2")

# ImageJ: channels, slices, frames, sizes and times, also behind one directory.
hyper = field(5, 4, 2, 6, 7, dtype="u2")  # TZCYX
tifffile.imwrite(path("imagej.tif"), hyper, imagej=True, resolution=(4.0, 2.0),
                 metadata=dict(axes="TZCYX", spacing=1.5, unit="um", finterval=0.25))
where = dict(spacing=(0.25, 0.5, 1.5), times=np.arange(5) * 0.25)
refuse("imagej.tif", "several arrays, choose one with --array: channel 0 (u16), channel 1 (u16)")
expect("imagej.tif", hyper[:, :, 0], array="channel 0", **where)
expect("imagej.tif", hyper[:, :, 1], array="channel 1", **where)
with open(path("imagej.tif"), "rb") as f, open(path("one_directory.tif"), "wb") as out:
    out.write(f.read())
with tifffile.TiffFile(path("imagej.tif")) as f:
    where_next = f.pages[0].offset
with open(path("one_directory.tif"), "r+b") as f:  # as ImageJ writes stacks beyond 4 GB
    f.seek(where_next)
    entries = int.from_bytes(f.read(2), tifffile.TiffFile(path("imagej.tif")).byteorder.replace("<", "little").replace(">", "big"))
    f.seek(where_next + 2 + 12 * entries)
    f.write(bytes(4))
expect("one_directory.tif", hyper[:, :, 1], array="channel 1", **where)
tifffile.imwrite(path("frames.tif"), hyper[:, 0, 0], imagej=True, metadata=dict(axes="TYX", finterval=2.0))
expect("frames.tif", hyper[:, 0, 0])

# OME: dimension orders, names of channels, sizes.
for order in ["TZCYX", "CTZYX", "ZCTYX"]:
    data = np.transpose(hyper, ["TZCYX".index(c) for c in order])
    tifffile.imwrite(path(f"{order}.ome.tif"), data, photometric="minisblack",
                     metadata=dict(axes=order, PhysicalSizeX=0.5, PhysicalSizeXUnit="µm", PhysicalSizeY=0.25,
                                   PhysicalSizeYUnit="µm", PhysicalSizeZ=2.0, PhysicalSizeZUnit="µm", TimeIncrement=3.0,
                                   TimeIncrementUnit="s", Channel=dict(Name=["dapi", "gfp"])))
    expect(f"{order}.ome.tif", hyper[:, :, 1], array="gfp", spacing=(0.5, 0.25, 2), times=np.arange(5) * 3.0)

# Slices and stacks of their own files.
for i in range(4):
    tifffile.imwrite(path(f"slice_{i + 8}.tif"), stack[i], metadata=None)
expect([f"slice_{i + 8}.tif" for i in (2, 0, 3, 1)], stack)
refuse(["slice_8.tif", "slice_9.tif", "slice_11.tif"], "slice 11 follows 9")
series = field(3, 4, 5, 6, dtype="u1")
for t in range(3):
    tifffile.imwrite(path(f"t{t:02d}.tif"), series[t], photometric="minisblack", metadata=None)
    for c in range(2):
        for z in range(4):
            tifffile.imwrite(path(f"run_t{t}_c{c}_z{z:03d}.tif"), series[t, z] // (c + 1), metadata=None)
expect([f"t{t:02d}.tif" for t in range(3)], series)
names = [f"run_t{t}_c{c}_z{z:03d}.tif" for t in range(3) for c in range(2) for z in range(4)]
refuse(names, "files of several channels, choose one with --array: channel 0, channel 1")
expect(names, series, array="channel 0")
expect(names, series // 2, array="channel 1")
# A folder for each step, whose name may be repeated in the files' names, or for each channel.
for t in range(3):
    for z in range(4):
        for name in (f"folders/t{t:02d}/z{z:03d}.tif", f"plain/{t}/{z:03d}.tif", f"twice/t{t}/scan_t{t}_z{z}.tif",
                     f"colors/ch{t}/{z:04d}.tif"):
            os.makedirs(os.path.dirname(path(name)), exist_ok=True)
            tifffile.imwrite(path(name), series[t, z], metadata=None)
for name in ("folders", "plain", "twice"):
    expect(name, series)
expect("colors", series[1], array="channel 1")
with open(path("colors/notes.txt"), "w") as f:
    f.write("a folder as users have it")
refuse(names[:-1], "3 slices in step 2, the first has 4", array="channel 1")
refuse(["slice_8.tif", "t00.tif"], "names that differ in more than numbers")

# tifffile's own: four axes are told by a shape.
tifffile.imwrite(path("shaped.tif"), series, photometric="minisblack")
expect("shaped.tif", series)
for name, how in [("half.tif", {}), ("half_be.tif", dict(byteorder=">")), ("half_tiled.tif", dict(tile=(16, 16)))]:
    half = field(3, 4, 5).astype("f2")
    half[0, 0, :4] = [6e-8, -np.inf, np.nan, 65504]
    tifffile.imwrite(path(name), half, photometric="minisblack", metadata=None, **how)
    expect(name, half.astype("f4"))
tifffile.imwrite(path("flat.tif"), stack[0], metadata=None)
refuse("flat.tif", "6x5x1 vertices, needs at least 2 vertices per axis")
done()
