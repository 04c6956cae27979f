"""Plain arrays behind text headers, as their documents describe them: several files of MetaImage and NRRD, hex, BOV."""
import bz2
import gzip

import numpy as np

from manifest import done, expect, field, path, refuse


def write(name, content):
    with open(path(name), "wb") as out:
        out.write(content if isinstance(content, bytes) else content.encode())
    return name


values = field(6, 5, 4, dtype="i2")
moving = field(3, 6, 5, 4, dtype="i2")
for z in range(6):
    write(f"slice{z + 1:03d}.raw", values[z].tobytes())
    write(f"head{z}.raw", b"skipped" + values[z].tobytes())
    write(f"big{z}.raw", values[z].astype(">i2").tobytes())
    write(f"s{z}.gz", gzip.compress(values[z].tobytes()))
    write(f"s{z}.bz2", bz2.compress(values[z].tobytes()))
for t in range(3):
    write(f"step_{t}.raw", moving[t].tobytes())
names = "".join(f"slice{z + 1:03d}.raw\n" for z in range(6))

# MetaImage
mhd = "ObjectType = Image\nNDims = 3\nDimSize = 4 5 6\nElementType = MET_SHORT\nElementSpacing = 1 2 3\n"
placed = dict(spacing=(1, 2, 3))
expect(write("list.mhd", mhd + "ElementDataFile = LIST\n" + names), values, **placed)
expect(write("list2d.mhd", mhd + "ElementDataFile = LIST 2D\n" + names.rstrip()), values, **placed)
expect(write("pattern.mhd", mhd + "ElementDataFile = slice%03d.raw 1 6 1\n"), values, **placed)
expect(write("falling.mhd", mhd + "ElementDataFile = slice%03d.raw 6 1 -1\n"), values[::-1], **placed)
expect(write("skipped.mhd", mhd + "HeaderSize = 7\nElementDataFile = head%d.raw 0 5 1\n"), values, **placed)
expect(write("at_end.mhd", mhd + "HeaderSize = -1\nElementDataFile = head%d.raw 0 5 1\n"), values, **placed)
expect(write("msb.mhd", mhd + "BinaryDataByteOrderMSB = True\nElementDataFile = big%d.raw 0 5 1\n"), values, **placed)
expect(write("steps.mhd", mhd.replace("NDims = 3", "NDims = 4").replace("4 5 6", "4 5 6 3").replace("1 2 3", "1 2 3 0.5")
             + "ElementDataFile = step_%d.raw 0 2 1\n"), moving, times=[0, 0.5, 1], **placed)
refuse(write("short.mhd", mhd + "ElementDataFile = slice%03d.raw 1 5 1\n"), "slice001.raw: truncated")
refuse(write("missing.mhd", mhd + "ElementDataFile = slice%03d.raw 2 7 1\n"), "slice007.raw: there is no such file")
refuse(write("many.mhd", mhd + "ElementDataFile = slice%03d.raw 1 3 1\n"), "slice001.raw: truncated")
refuse(write("evil.mhd", mhd + "ElementDataFile = slice%s%n.raw 1 6 1\n"), "expected a pattern")
refuse(write("endless.mhd", mhd + "ElementDataFile = slice%d.raw 1 99999999999 1\n"), "files 1 to 99999999999")
refuse(write("empty.mhd", mhd + "ElementDataFile = LIST\n"), "expected names of files")

# NRRD
nhdr = "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 5 6\nspacings: 1 2 3\nendian: little\nencoding: raw\n"
expect(write("list.nhdr", nhdr + "data file: LIST\n" + names.rstrip()), values, **placed)
expect(write("list2.nhdr", nhdr + "datafile: LIST 2\n" + names), values, **placed)
expect(write("pattern.nhdr", nhdr + "data file: slice%03d.raw 1 6 1\n"), values, **placed)
expect(write("pattern2.nhdr", nhdr + "data file: slice%03d.raw 1 6 1 2\n"), values, **placed)
expect(write("skipped.nhdr", nhdr + "byte skip: 7\ndata file: head%d.raw 0 5 1\n"), values, **placed)
expect(write("at_end.nhdr", nhdr + "byte skip: -1\ndata file: head%d.raw 0 5 1\n"), values, **placed)
expect(write("gz.nhdr", nhdr.replace("raw", "gzip") + "data file: s%d.gz 0 5 1\n"), values, **placed)
expect(write("bz.nhdr", nhdr.replace("raw", "bzip2") + "data file: s%d.bz2 0 5 1\n"), values, **placed)
large = nhdr.replace("little", "big")
expect(write("big.nhdr", large + "data file: big%d.raw 0 5 1\n"), values, **placed)
expect(write("big.nrrd", large.encode() + b"\n" + values.astype(">i2").tobytes()), values, **placed)
# A space whose x counts to the left is turned to right-anterior-superior.
left = "space: left-anterior-superior\n"
as_ras = dict(placed, origin=(-5, 6, 7), direction=[[-1, 0, 0], [0, 1, 0], [0, 0, 1]])
expect(write("las.nhdr", nhdr + left + "axis mins: 5 6 7\ndata file: slice%03d.raw 1 6 1\n"), values, **as_ras)
expect(write("las_directions.nhdr", nhdr.replace("spacings: 1 2 3\n", "") + left + "space directions: (1,0,0) (0,2,0) (0,0,3)\n"
             "space origin: (5,6,7)\ndata file: slice%03d.raw 1 6 1\n"), values, **as_ras)
digits = values.tobytes().hex()
expect(write("hex.nrrd", nhdr.replace("raw", "hex") + "\n" + digits), values, **placed)
expect(write("lines.nrrd", nhdr.replace("raw", "hex") + "\n" +
             "\n".join(digits[i:i + 61].upper() for i in range(0, len(digits), 61)) + "\n"), values, **placed)
refuse(write("half.nrrd", nhdr.replace("raw", "hex") + "\n" + digits[:-2] + "\n \n"), "truncated", reads=True)
refuse(write("letter.nrrd", nhdr.replace("raw", "hex") + "\n" + digits[:9] + "x" + digits[10:]), "damaged hex", reads=True)
refuse(write("more.nrrd", nhdr.replace("raw", "hex") + "\n" + digits + "00"), "bytes follow", reads=True)

# BOV
bov = "TIME: 2.5\nDATA_FILE: all.dat\nDATA_SIZE: 4 5 6\nDATA_FORMAT: SHORT\nVARIABLE: \"rho\"\n" \
      "BRICK_ORIGIN: 1. 2. 3.\nBRICK_SIZE: 8. 5. 3.\n"
write("all.dat", b"1234" + values.tobytes())
write("big.dat", values.astype(">i2").tobytes())
write("vector.dat", np.stack([values, values // 2], axis=-1).tobytes())
write("packed.gz", gzip.compress(b"1234" + values.tobytes()))
centers = dict(spacing=(2, 1, 0.5), origin=(2, 2.5, 3.25), times=[2.5])
expect(write("cells.bov", bov + "BYTE_OFFSET: 4\n"), values, **centers)
expect(write("packed.bov", bov.replace("all.dat", "packed.gz") + "BYTE_OFFSET: 4\n"), values, **centers)
expect(write("nodes.bov", bov.replace("all.dat", "big.dat") + "# a comment\nCENTERING: nodal\nDATA_ENDIAN: BIG\n"), values,
       spacing=(8 / 3, 5 / 4, 3 / 5), origin=(1, 2, 3), times=[2.5])
expect(write("vector.bov", bov.replace("all.dat", "vector.dat") + "DATA_COMPONENTS: 2\n"), values // 2, component="1", **centers)
# Bricklets, a file for each, numbered with x fastest.
for number in range(4):
    x, z = number % 2 * 2, number // 2 * 3
    write("part%02d.dat" % number, values[z:z + 3, :, x:x + 2].tobytes())
parts = bov.replace("all.dat", "part%02d.dat")
expect(write("parts.bov", parts + "DATA_BRICKLETS: 2 5 3\n"), values, **centers)
expect(write("node_parts.bov", parts + "DATA_BRICKLETS: 2 5 3\nCENTERING: nodal\n"), values,
       spacing=(8 / 3, 5 / 4, 3 / 5), origin=(1, 2, 3), times=[2.5])
expect(write("cut.bov", bov + "BYTE_OFFSET: 4\nDATA_BRICKLETS: 2 5 6\n"), values, **centers)
refuse(write("odd.bov", parts + "DATA_BRICKLETS: 3 5 3\n"), "expected a divisor of 4")
refuse(write("unsaid.bov", parts), "DATA_BRICKLETS has 0 numbers")
refuse(write("few.bov", parts + "DATA_BRICKLETS: 2 5 1\n"), "at least 2 vertices")
refuse(write("short.bov", bov + "BYTE_OFFSET: 5\n"), "all.dat: truncated")
refuse(write("none.bov", "TIME: 1\n"), "not BOV")

# Computed values, as numpy.gradient has them: even vertices, and axes that point elsewhere.
wind = np.random.default_rng(3).standard_normal((6, 5, 4, 3))
steps = (0.5, 2.0, 1.5)  # z, y, x


def derivatives(values, signs=(1, 1, 1)):
    """d/dx, d/dy, d/dz"""
    along = np.gradient(values.astype("f8"), *steps)
    return [along[2 - i] * signs[i] for i in range(3)]


def vector(name, more, kind="f4"):
    head = "NRRD0004\ntype: %s\ndimension: 4\nsizes: 3 4 5 6\nendian: little\nencoding: raw\n" % \
        {"f4": "float", "f8": "double"}[kind]
    return write(name, (head + more + "\n").encode() + wind.astype(kind).tobytes())


turned = "kinds: vector space space space\nspace dimension: 3\nspace directions: none (1.5,0,0) (0,-2,0) (0,0,0.5)\n"
for name, more, signs, kind in [("even.nrrd", "kinds: vector space space space\nspacings: nan 1.5 2 0.5\n", (1, 1, 1), "f4"),
                                ("turned.nrrd", turned, (1, -1, 1), "f8")]:
    file = vector(name, more, kind)
    u, v, w = (derivatives(wind[..., i].astype(kind), signs) for i in range(3))
    where = dict(spacing=(1.5, 2, 0.5), kind="rounded", direction=[[1, 0, 0], [0, signs[1], 0], [0, 0, 1]])
    expect(file, np.sqrt((w[1] - v[2]) ** 2 + (u[2] - w[0]) ** 2 + (v[0] - u[1]) ** 2), component="vorticity", **where)
    gradient = np.array([u, v, w])
    rotation, strain = (gradient - gradient.swapaxes(0, 1)) / 2, (gradient + gradient.swapaxes(0, 1)) / 2
    expect(file, ((rotation ** 2).sum((0, 1)) - (strain ** 2).sum((0, 1))) / 2, component="q-criterion", **where)
    refuse(file, "3 components", component="gradient")

# Lists of volumes, whose axis is the fastest or the slowest: 3D Slicer says what they are.
directions = "(1,0,0) (0,2,0) (0,0,3)"


def listed(name, more, kind="list", fastest=True, labels="", units=""):
    """labels, units: of the list's axis."""
    head = "NRRD0005\ntype: short\ndimension: 4\nspace: left-posterior-superior\nendian: little\nencoding: raw\n"
    axes = (lambda one, rest: f"{one} {rest}") if fastest else (lambda one, rest: f"{rest} {one}")
    head += f"sizes: {axes(3, '4 5 6')}\nspace directions: {axes('none', directions)}\n"
    head += f"kinds: {axes(kind, 'domain domain domain')}\n"
    for key, value in (("labels", labels), ("units", units)):
        if value:
            quoted = axes(f'"{value}"', '"" "" ""')
            head += f"{key}: {quoted}\n"
    stored = moving.transpose(1, 2, 3, 0) if fastest else moving
    return write(name, (head + more + "\n").encode() + np.ascontiguousarray(stored).tobytes())


def multi_volume(tag, labels, unit="ms"):
    return f"MultiVolume.FrameIdentifyingDICOMTagName:={tag}\nMultiVolume.FrameIdentifyingDICOMTagUnits:={unit}\n" \
        f"MultiVolume.FrameLabels:={labels}\nMultiVolume.NumberOfFrames:=3\n"


for fastest in (True, False):
    at = 0 if fastest else 3
    for name, more, times, unit, note in [
            ("trigger", dict(more=multi_volume("TriggerTime", "0,33.3,100")), [0, 33.3, 100], "ms", "by TriggerTime"),
            ("position", dict(more=multi_volume("TemporalPositionIdentifier", "1,2,3", "count")), [1, 2, 3], "count",
             "by TemporalPositionIdentifier"),
            ("time kind", dict(more=multi_volume("AcquisitionTime", "0,5000,9500"), kind="time"), [0, 5000, 9500], "ms",
             "by AcquisitionTime"),
            ("few labels", dict(more=multi_volume("TriggerTime", "0,33.3")), [0, 1, 2], "", "MultiVolume.FrameLabels"),
            ("texts", dict(more=multi_volume("TriggerTime", "a,b,c")), [0, 1, 2], "", "MultiVolume.FrameLabels"),
            ("sequence", dict(more=f"axis {at} index type:=numeric\naxis {at} index values:=0.5 1.5 4\n", labels="time",
                              units="s"), [0.5, 1.5, 4], "s", "by time"),
            ("phases", dict(more=f"axis {at} index type:=numeric\naxis {at} index values:=10 20 40\n", labels="phase",
                            units="%"), [10, 20, 40], "%", "by phase"),
            ("names", dict(more=f"axis {at} index type:=text\naxis {at} index values:=rest stress late\n"), [0, 1, 2], "",
             "by index")]:
        expect(listed(f"{name} {at}.nrrd", fastest=fastest, **more), moving, times=times, unit=unit, note=note, **placed)
    for tag in ("EchoTime", "FlipAngle", "GE.B-value"):
        file = listed(f"{tag} {at}.nrrd", multi_volume(tag, "0,33.3,100"), fastest=fastest)
        refuse(file, "3 components, choose one with --component")
        expect(file, moving[1], component="1", note="MultiVolume.FrameLabels", **placed)
        expect(file, moving, extra_axis_is_time=True, **placed)
for kind in ("list", "time", "vector", "RGB-color"):
    refuse(write(f"{kind} film.nrrd", nhdr.encode() + f"kinds: domain domain {kind}\n\n".encode() + values.tobytes()),
           "2 axes of space, expected 3")

# Frames of MetaImage, as PLUS and 3D Slicer write them, with their times.
frames = "".join(f"Seq_Frame{t:04}_Timestamp = {time}\nSeq_Frame{t:04}_Status = OK\n" for t, time in enumerate((69.25, 69.5, 71)))
mha = mhd.replace("NDims = 3", "NDims = 4").replace("4 5 6", "4 5 6 3").replace("1 2 3", "1 2 3 1")
expect(write("sequence.mhd", mha + "Kinds = domain domain domain list\n" + frames + "ElementDataFile = step_%d.raw 0 2 1\n"),
       moving, times=[69.25, 69.5, 71], unit="s", note="steps by", **placed)
expect(write("untimed.mhd", mha + frames.replace("71", "x", 0).split("Seq_Frame0002")[0] +
             "ElementDataFile = step_%d.raw 0 2 1\n"), moving, times=[0, 1, 2], note="Seq_Frame0000_Timestamp", **placed)
for name, more in (("film", frames), ("film by kind", "Kinds = domain domain list\n")):
    film = write(f"{name}.mhd", mhd + more + "ElementDataFile = slice%03d.raw 1 6 1\n")
    refuse(film, "a film, 6 frames of one slice")
    expect(film, values, spacing=(1, 2, 4), spacing_given=[1, 2, 4])

scalar = write("scalar.nhdr", nhdr.replace("spacings: 1 2 3", "spacings: 1.5 2 0.5") + "data file: slice%03d.raw 1 6 1\n")
expect(scalar, np.sqrt(sum(g ** 2 for g in derivatives(values))), component="gradient", spacing=(1.5, 2, 0.5), kind="rounded")
refuse(scalar, "component", component="vorticity")
done()
