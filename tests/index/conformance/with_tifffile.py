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

# Pages in other orders, and the words that people write for units.
orders = dict(c=2, z=1, t=0)
for order in ("czt", "ctz", "zct", "ztc", "tcz", "tzc"):
    pages = np.transpose(hyper, [*(orders[axis] for axis in order[::-1]), 3, 4]).reshape(-1, 6, 7)
    text = f"ImageJ=1.53t\nimages=40\nchannels=2\nslices=4\nframes=5\norder={order}\nhyperstack=true\n"
    tifffile.imwrite(path(f"{order}.tif"), pages, photometric="minisblack", metadata=None, description=text)
    for channel in range(2):
        expect(f"{order}.tif", hyper[:, :, channel], array=f"channel {channel}")
# A run that was stopped: the whole steps are there.
for pages, steps in ((40, 5), (39, 4), (33, 4), (9, 1)):
    tifffile.imwrite(path(f"stopped{pages}.tif"), hyper.reshape(40, 6, 7)[:pages], photometric="minisblack", metadata=None,
                     description="ImageJ=1.53t\nimages=40\nchannels=2\nslices=4\nframes=5\nfinterval=0.5\n")
    expect(f"stopped{pages}.tif", hyper[:steps, :, 1], array="channel 1", times=np.arange(steps) * .5 if steps > 1 else None)
tifffile.imwrite(path("stopped7.tif"), hyper.reshape(40, 6, 7)[:7], photometric="minisblack", metadata=None,
                 description="ImageJ=1.53t\nimages=40\nchannels=2\nslices=4\nframes=5\n")
refuse("stopped7.tif", "33 of 40 planes are missing, as of a stopped run: none of its 5 steps is whole")

# ScanImage: volumes swept fast, with frames of the way back; slices one after the other.
film = field(3, 4, 2, 6, 7, dtype="i2")  # TZC
back = np.zeros((3, 1, 2, 6, 7), "i2")


def scanimage(name, pages, text, old=False):
    how = dict(description=text) if old else dict(software=text)
    tifffile.imwrite(path(name), pages.reshape(-1, 6, 7), photometric="minisblack", metadata=None, bigtiff=not old, **how)
    return name


fast = "SI.hChannels.channelSave = [1;2]\nSI.hFastZ.enable = {}\nSI.hStackManager.numSlices = 4\n"
placed = ("SI.hStackManager.stackZStepSize = -2.5\nSI.hRoiManager.imagingFovUm = [-7 -6;7 -6;7 6;-7 6]\n"
          "SI.hRoiManager.scanVolumeRate = 4\n")
in_place = dict(spacing=(2, 2, 2.5), times=np.arange(3) * .25)
for name, pages, text, where in [
        ("fast.tif", film, fast.format("true") + placed, in_place),
        ("fast_mode.tif", film, "SI.hChannels.channelSave = [1;2]\nSI.hStackManager.enable = true\n"
         "SI.hStackManager.stackMode = 'fast'\nSI.hStackManager.numSlices = 4\nSI.hStackManager.framesPerSlice = 1\n", {}),
        ("fast_1.tif", film, fast.format("1") + "SI.hFastZ.numFramesPerVolume = 4\n", {}),
        ("back.tif", np.concatenate([film, back], 1), fast.format("true") + placed +
         "SI.hStackManager.numFramesPerVolumeWithFlyback = 5\n", in_place),
        ("back_1.tif", np.concatenate([film, back], 1), fast.format("true") + "SI.hFastZ.numFramesPerVolume = 5\n", {}),
        ("slow.tif", film.transpose(1, 0, 2, 3, 4), fast.format("false") + "SI.hStackManager.framesPerSlice = 3\n", {}),
        ("averaged.tif", film.transpose(1, 0, 2, 3, 4), fast.format("false") + "SI.hStackManager.framesPerSlice = 6\n"
         "SI.hScan2D.logAverageFactor = 2\n", {}),
        ("repeated.tif", film, fast.format("false") + "SI.hStackManager.framesPerSlice = 1\n", {})]:
    for channel in range(2):
        expect(scanimage(name, pages, text), film[:, :, channel], array=f"channel {channel}", **where)
one = film[:, :, 0]
expect(scanimage("four.tif", one.transpose(1, 0, 2, 3), "scanimage.SI4.channelsSave = 1\nscanimage.SI4.stackNumSlices = 4\n"
                 "scanimage.SI4.acqNumFrames = 3\n", old=True), one)
expect(scanimage("three.tif", one.transpose(1, 0, 2, 3), "state.acq.numberOfZSlices=4\rstate.acq.numberOfFrames=3\r"
                 "state.acq.savingChannel1=1\r", old=True), one)
expect(scanimage("cut_short.tif", film.reshape(24, 6, 7)[:19], fast.format("true")), film[:2, :, 1], array="channel 1")

# OME: dimension orders, names of channels, sizes.
for order in ["TZCYX", "CTZYX", "ZCTYX"]:
    data = np.transpose(hyper, ["TZCYX".index(c) for c in order])
    tifffile.imwrite(path(f"{order}.ome.tif"), data, photometric="minisblack",
                     metadata=dict(axes=order, PhysicalSizeX=0.5, PhysicalSizeXUnit="µm", PhysicalSizeY=0.25,
                                   PhysicalSizeYUnit="µm", PhysicalSizeZ=2.0, PhysicalSizeZUnit="µm", TimeIncrement=3.0,
                                   TimeIncrementUnit="s", Channel=dict(Name=["dapi", "gfp"])))
    expect(f"{order}.ome.tif", hyper[:, :, 1], array="gfp", spacing=(0.5, 0.25, 2), times=np.arange(5) * 3.0)

# OME: several images in a file, of other sizes and types, too; a run that was stopped.
places = [field(4, 5, 6, dtype="u2"), field(3, 7, 8, dtype="u1"), field(2, 3, 2, 9, 10, dtype="f4")]
with tifffile.TiffWriter(path("places.ome.tif"), ome=True) as out:
    for i, image in enumerate(places):
        out.write(image, photometric="minisblack", metadata=dict(
            axes="ZYX" if image.ndim == 3 else "TZCYX", Name=f"Pos{i}", PhysicalSizeX=.25 * (i + 1), PhysicalSizeXUnit="µm",
            PhysicalSizeY=.5, PhysicalSizeYUnit="µm", PhysicalSizeZ=1., PhysicalSizeZUnit="µm"))
expect("places.ome.tif", places[0], spacing=(.25, .5, 1))
for i, named in [(0, "Pos0"), (0, "Image:0"), (1, "Pos1"), (1, "Image:1")]:
    expect("places.ome.tif", places[i], spacing=(.25 * (i + 1), .5, 1), array=named)
for named in ("Pos2/channel 1", "Image:2/channel 1"):
    expect("places.ome.tif", places[2][:, :, 1], spacing=(.75, .5, 1), array=named)
refuse("places.ome.tif", "Pos2/channel 0 (f32), Pos2/channel 1 (f32)", array="Image:2")
ome = ('<?xml version="1.0" encoding="UTF-8"?><OME xmlns="http://www.openmicroscopy.org/Schemas/OME/2016-06"><Image ID="Image:0">'
       '<Pixels ID="Pixels:0" DimensionOrder="XYZCT" Type="uint16" SizeX="7" SizeY="6" SizeZ="4" SizeC="1" SizeT="5" '
       'TimeIncrement="2" TimeIncrementUnit="s"><Channel ID="Channel:0:0" SamplesPerPixel="1"/>{}</Pixels></Image></OME>')
for name, there, told, steps in [("promised", 10, range(20), (0, 1)), ("described", 10, range(10), (0, 1)),
                                 ("gap", 20, [p for p in range(20) if p != 6], (0, 2, 3, 4)), ("whole", 20, range(20), range(5))]:
    planes = "".join(f'<TiffData IFD="{i}" FirstZ="{i % 4}" FirstT="{i // 4}" PlaneCount="1"/>' for i in told)
    tifffile.imwrite(path(name + ".ome.tif"), hyper[:, :, 0].reshape(20, 6, 7)[:there], photometric="minisblack", metadata=None,
                     description=ome.format(planes))
    expect(name + ".ome.tif", hyper[list(steps), :, 0], times=[2. * t for t in steps])
tifffile.imwrite(path("hopeless.ome.tif"), hyper[0, :3, 0], photometric="minisblack", metadata=None, description=ome.format(
    "".join(f'<TiffData IFD="{i}" FirstZ="{i}" PlaneCount="1"/>' for i in range(3))))
refuse("hopeless.ome.tif", "17 of 20 planes are missing, as of a stopped run: none of its 5 steps is whole")

# A file for each image, each of which describes all: the one that is opened has its own.
described = '<?xml version="1.0"?><OME xmlns="http://www.openmicroscopy.org/Schemas/OME/2016-06">' + "".join(
    f'<Image ID="Image:{i}" Name="At{i}"><Pixels ID="Pixels:{i}" DimensionOrder="XYZCT" Type="uint16" SizeX="7" SizeY="6" SizeZ="4" '
    f'SizeC="1" SizeT="1"><Channel ID="Channel:{i}:0" SamplesPerPixel="1"/><TiffData IFD="0" PlaneCount="4"><UUID '
    f'FileName="at{i}.ome.tif">urn:uuid:{i}</UUID></TiffData></Pixels></Image>' for i in range(2)) + "</OME>"
for i in range(2):
    tifffile.imwrite(path(f"at{i}.ome.tif"), hyper[i, :, 0], photometric="minisblack", metadata=None, description=described)
for i in range(2):
    expect(f"at{i}.ome.tif", hyper[i, :, 0])
    for other in range(2):
        expect(f"at{i}.ome.tif", hyper[other, :, 0], array=f"At{other}")

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
