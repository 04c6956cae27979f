"""Zarr version 2 by zarr and version 3, sharding included, after its specification with numcodecs; OME-Zarr 0.4, 0.5."""
import json
import os
import struct
import zipfile

import numcodecs
import numpy as np
import zarr

from manifest import done, expect, field, folder, path, refuse

# zarr 3 writes version 2 where it is asked to.
VERSION_2 = dict(zarr_format=2) if int(zarr.__version__.split(".")[0]) >= 3 else {}


def group_of(where):
    zarr.open_group(path(where), mode="w", **VERSION_2)


def array_of(where, shape, dtype, chunks=None, compressor=numcodecs.Blosc(), fill_value=0, **how):
    return zarr.create(store=path(where), shape=shape, dtype=dtype, chunks=chunks or shape, compressor=compressor,
                       fill_value=fill_value, **VERSION_2, **how)


def save(where, values, chunks=None, **how):
    array = array_of(where, values.shape, values.dtype, chunks, **how)
    array[...] = values
    return array


for name, dtype, how in [("f4", "<f4", {}), ("be", ">i2", dict(compressor=numcodecs.Zlib())),
                         ("u1", "u1", dict(compressor=numcodecs.Zstd())), ("lz4", "<f8", dict(compressor=numcodecs.LZ4())),
                         ("bz2", "<i4", dict(compressor=numcodecs.BZ2())), ("gzip", "<u2", dict(compressor=numcodecs.GZip())),
                         ("raw", "<f4", dict(compressor=None)), ("fortran", "<f4", dict(order="F")),
                         ("shuffled", "<f4", dict(compressor=numcodecs.Zlib(), filters=[numcodecs.Shuffle(4)])),
                         ("nested", "<i8", dict(dimension_separator="/")),
                         ("blosc_zstd", "<f4", dict(compressor=numcodecs.Blosc("zstd", shuffle=2)))]:
    values = field(5, 6, 7, dtype="i2" if dtype == "<i8" else dtype).astype(dtype)
    save(f"{name}.zarr", values, (2, 4, 3), **how)
    expect(f"{name}.zarr", zarr.open(path(f"{name}.zarr"), mode="r")[...])

# Groups, missing chunks, a zip file.
group_of("group.zarr")
group_of("group.zarr/deep")
a, b = field(3, 4, 5), field(7, 3, 4, 5)
save("group.zarr/a", a)
save("group.zarr/deep/b", b, (3, 2, 2, 5))
holes = array_of("group.zarr/holes", (4, 4, 4), "f4", (2, 2, 2), fill_value=9)
holes[0:2, 0:2, 0:2] = 1
refuse("group.zarr", "choose one with --array: a (f32, 3 x 4 x 5), deep/b (f32, 7 x 3 x 4 x 5), holes (f32, 4 x 4 x 4)")
expect("group.zarr", a, array="a")
expect("group.zarr", b, array="/deep/b")
expect("group.zarr", holes[...], array="holes")
for method, name in [(zipfile.ZIP_STORED, "stored.zip"), (zipfile.ZIP_DEFLATED, "deflated.zarr.zip")]:
    with zipfile.ZipFile(path(name), "w", method) as out:
        for base, _, files in os.walk(path("group.zarr")):
            for file in files:
                full = os.path.join(base, file)
                out.write(full, os.path.relpath(full, path("group.zarr")))
    expect(name, b, array="deep/b")


def write(where, text):
    os.makedirs(os.path.dirname(path(where)), exist_ok=True)
    with open(path(where), "wb") as out:
        out.write(text if isinstance(text, bytes) else json.dumps(text).encode())


def crc32c(data):
    table = []
    for i in range(256):
        for _ in range(8):
            i = i >> 1 ^ (0x82F63B78 if i & 1 else 0)
        table.append(i)
    value = 0xFFFFFFFF
    for byte in data:
        value = table[(value ^ byte) & 255] ^ value >> 8
    return struct.pack("<I", value ^ 0xFFFFFFFF)


def chunks_of(values, shape):
    """Every chunk, padded at the borders."""
    for at in np.ndindex(*[-(-n // c) for n, c in zip(values.shape, shape)]):
        part = values[tuple(slice(i * c, (i + 1) * c) for i, c in zip(at, shape))]
        yield at, np.pad(part, [(0, c - n) for c, n in zip(shape, part.shape)])


KINDS = {"gzip": numcodecs.GZip(), "zstd": numcodecs.Zstd(), "blosc": numcodecs.Blosc("lz4")}


def encode(chunk, codecs):
    for name in codecs:
        if name == "transpose":
            chunk = np.ascontiguousarray(np.transpose(chunk, (2, 0, 1)))
        elif name in ("little", "big"):
            chunk = chunk.astype(chunk.dtype.newbyteorder("<" if name == "little" else ">")).tobytes()
        elif name == "crc32c":
            chunk = chunk + crc32c(chunk)
        else:
            chunk = bytes(KINDS[name].encode(chunk))
    return chunk


def described(codecs):
    all_of = []
    for name in codecs:
        if name == "transpose":
            all_of.append(dict(name=name, configuration=dict(order=[2, 0, 1])))
        elif name in ("little", "big"):
            all_of.append(dict(name="bytes", configuration=dict(endian=name)))
        else:
            all_of.append(dict(name=name, configuration={}))
    return all_of


def version_3(where, values, chunk, codecs, inner=None, at_start=False, **more):
    description = dict(zarr_format=3, node_type="array", shape=list(values.shape), data_type=values.dtype.name,
                       chunk_grid=dict(name="regular", configuration=dict(chunk_shape=list(chunk))),
                       chunk_key_encoding=dict(name="default", configuration=dict(separator="/")), fill_value=0,
                       codecs=described(codecs), attributes={}, **more)
    if inner:
        description["codecs"] = [dict(name="sharding_indexed", configuration=dict(
            chunk_shape=list(inner), codecs=described(codecs), index_codecs=described(["little", "crc32c"]),
            index_location="start" if at_start else "end"))]
    write(f"{where}/zarr.json", description)
    for at, part in chunks_of(values, chunk):
        if inner:
            body, entries = b"", []
            offset = 16 * int(np.prod([c // i for c, i in zip(chunk, inner)])) + 4 if at_start else 0
            for _, small in chunks_of(part, inner):
                if not small.any():
                    entries.append((2**64 - 1, 2**64 - 1))
                    continue
                data = encode(small, codecs)
                entries.append((offset + len(body), len(data)))
                body += data
            index = b"".join(struct.pack("<QQ", *entry) for entry in entries)
            index += crc32c(index)
            data = index + body if at_start else body + index
        else:
            data = encode(part, codecs)
        write(f"{where}/c/" + "/".join(map(str, at)), data)


values = field(5, 6, 7)
values[:2, :2, :2] = 0
for name, codecs, inner, start in [("v3", ["little"], None, False), ("v3_gzip", ["big", "gzip"], None, False),
                                   ("v3_zstd_crc", ["little", "zstd", "crc32c"], None, False),
                                   ("v3_transposed", ["transpose", "little", "blosc"], None, False),
                                   ("v3_shards", ["little", "zstd"], (2, 2, 2), False),
                                   ("v3_shards_start", ["little", "blosc"], (2, 2, 2), True)]:
    version_3(f"{name}.zarr", values, (4, 4, 4), codecs, inner, start)
    expect(f"{name}.zarr", values)

# OME-Zarr: names, units, scales of both levels, labels of channels.
image = field(3, 2, 4, 5, 6, dtype="u2")
multiscales = [dict(axes=[dict(name="t", type="time", unit="second"), dict(name="c", type="channel")] +
                    [dict(name=n, type="space", unit="micrometer") for n in "zyx"],
                    datasets=[dict(path="0", coordinateTransformations=[
                        dict(type="scale", scale=[0.5, 1, 2, 0.5, 0.25]),
                        dict(type="translation", translation=[1.0, 0, 10, 20, 30])])],
                    coordinateTransformations=[dict(type="scale", scale=[2, 1, 1, 1, 1])])]
omero = dict(channels=[dict(label="dapi"), dict(label="gfp")])
where = dict(spacing=(0.25, 0.5, 2), origin=(30, 20, 10), times=[2, 3, 4])
save("ome4.zarr/0", image, (1, 1, 2, 5, 6), dimension_separator="/")
write("ome4.zarr/.zgroup", dict(zarr_format=2))
write("ome4.zarr/.zattrs", dict(multiscales=multiscales, omero=omero))
version_3("ome5.zarr/0", image, (1, 2, 4, 4, 4), ["little"])
write("ome5.zarr/zarr.json", dict(zarr_format=3, node_type="group",
                                  attributes=dict(ome=dict(version="0.5", multiscales=multiscales, omero=omero))))
for name in ["ome4.zarr", "ome5.zarr"]:
    refuse(name, "choose one with --array: dapi (u16), gfp (u16)")
    expect(name, image[:, 1], array="gfp", **where)

# Each array of an image, named by its path, is placed by the group around it: bioformats2raw's images, levels, labels.
def image_in(where, scale, version, path_of_level="0", labels=("dapi", "gfp")):
    said = dict(multiscales=[dict(axes=multiscales[0]["axes"], datasets=[
        dict(path=path_of_level, coordinateTransformations=[dict(type="scale", scale=[1, 1, *scale])]),
        dict(path="half", coordinateTransformations=[dict(type="scale", scale=[1, 1, *(2 * s for s in scale)]),
                                                     dict(type="translation", translation=[0, 0, 1, 2, 3])])])],
        omero=dict(channels=[dict(label=label) for label in labels]))
    if version == 2:
        write(f"{where}/.zgroup", dict(zarr_format=2))
        write(f"{where}/.zattrs", said)
    else:
        write(f"{where}/zarr.json", dict(zarr_format=3, node_type="group", attributes=dict(ome=dict(version="0.5", **said))))


for version in (2, 3):
    root = f"bioformats2raw_{version}.zarr"
    if version == 2:
        write(f"{root}/.zgroup", dict(zarr_format=2))
        write(f"{root}/.zattrs", {"bioformats2raw.layout": 3})
    else:
        write(f"{root}/zarr.json", dict(zarr_format=3, node_type="group", attributes=dict(ome={"version": "0.5", "bioformats2raw.layout": 3})))
    for group, scale in (("0", (1.5, .5, .25)), ("1", (3, 2, 1)), ("A/1/0", (4, 5, 6))):
        for part in range(len(group.split("/")) - 1):
            inner = "/".join(group.split("/")[:part + 1])
            write(f"{root}/{inner}/" + (".zgroup" if version == 2 else "zarr.json"),
                  dict(zarr_format=2) if version == 2 else dict(zarr_format=3, node_type="group", attributes={}))
        image_in(f"{root}/{group}", scale, version)
        for level in ("0", "half"):
            place = f"{root}/{group}/{level}"
            if version == 2:
                save(place, image, (1, 1, 2, 5, 6))
            else:
                version_3(place, image, (1, 2, 4, 4, 4), ["little"])
            put = dict(spacing=[s * (2 if level == "half" else 1) for s in scale[::-1]],
                       origin=(3, 2, 1) if level == "half" else (0, 0, 0))
            if group != "1":
                refuse(root, f"{group}/{level} (u16, 3 x 2 x 4 x 5 x 6)")
            expect(root, image[:, 0], array=f"{group}/{level}", component="0", **put)
            expect(f"{root}/{group}", image[:, 1], array=f"{level}" if level == "half" else "gfp",
                   **(dict(component="1") if level == "half" else {}), **put)

# Damage: in what describes, and in chunks.
for name, key, text, message in [
        ("bad_json", ".zarray", b"{", "is no JSON object"), ("bad_shape", ".zarray", dict(zarr_format=2), "damaged description"),
        ("bomb", ".zarray", dict(zarr_format=2, shape=[60000] * 3, chunks=[60000] * 3, dtype="<f8", order="C",
                                 compressor=None, fill_value=0), "chunks of 60000 x 60000 x 60000 values"),
        ("codec", ".zarray", dict(zarr_format=2, shape=[4] * 3, chunks=[4] * 3, dtype="<f8", order="C",
                                  compressor=dict(id="lossy"), fill_value=0), "packed by lossy"),
        ("empty", ".zgroup", dict(zarr_format=2), "holds no array of three dimensions")]:
    write(f"{name}.zarr/{key}", text)
    refuse(f"{name}.zarr", message)
save("cut.zarr", values)
with open(path("cut.zarr/0.0.0"), "r+b") as f:
    f.truncate(60)
refuse("cut.zarr", "damaged: blosc cannot decode it", reads=True)
version_3("cut_shard.zarr", values, (4, 4, 4), ["little", "zstd"], (2, 2, 2))
with open(path("cut_shard.zarr/c/0/0/0"), "r+b") as f:
    f.truncate(100)
refuse("cut_shard.zarr", "c/0/0/0", reads=True)
done()
