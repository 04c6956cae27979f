#!/usr/bin/env python3
"""Checks GLB files against the rules of glTF 2.0 that a loader relies on, with no library for glTF:

    gltf_check.py FILE.glb ...

Chunks, alignment, references, bounds of views and accessors, the stated minima and maxima, corners
below the number of vertices, normals of length 1, animations that ascend. What EXT_meshopt_compression
packs is unpacked by libmeshoptimizer. Prints a line for each file, and ends with 1 at the first fault."""
import ctypes
import ctypes.util
import json
import struct
import sys

import numpy

TYPES = {5120: numpy.int8, 5121: numpy.uint8, 5122: numpy.int16, 5123: numpy.uint16,
         5125: numpy.uint32, 5126: numpy.float32}
SHAPES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
KNOWN = {"KHR_mesh_quantization", "EXT_meshopt_compression"}
PACKED = "EXT_meshopt_compression"


def expect(holds, what):
    if not holds:
        raise SystemExit(f"{NAME}: {what}")


def unpacked(packed, buffer):
    """The bytes of a packed view."""
    begin, length = packed["byteOffset"], packed["byteLength"]
    expect(begin + length <= len(buffer), "a packed view leaves its buffer")
    expect(begin % 4 == 0, "a packed view is not aligned")
    library = ctypes.CDLL(ctypes.util.find_library("meshoptimizer"))
    count, stride = packed["count"], packed["byteStride"]
    out = ctypes.create_string_buffer(count * stride)
    decode = {"ATTRIBUTES": library.meshopt_decodeVertexBuffer,
              "TRIANGLES": library.meshopt_decodeIndexBuffer}[packed["mode"]]
    expect(packed["mode"] != "ATTRIBUTES" or (stride % 4 == 0 and stride <= 256), "a stride")
    expect(packed["mode"] != "TRIANGLES" or (stride in (2, 4) and count % 3 == 0), "triangles")
    source = bytes(buffer[begin:begin + length])
    result = decode(out, ctypes.c_size_t(count), ctypes.c_size_t(stride), source,
                    ctypes.c_size_t(length))
    expect(result == 0, f"a packed view does not unpack: {result}")
    return out.raw


def read(path):
    """Document, binary chunk."""
    data = open(path, "rb").read()
    magic, version, length = struct.unpack_from("<4sII", data, 0)
    expect(magic == b"glTF" and version == 2, "no GLB of version 2")
    expect(length == len(data), "the length in the header")
    chunks, at = [], 12
    while at < len(data):
        size, kind = struct.unpack_from("<I4s", data, at)
        expect(size % 4 == 0, "a chunk's length is no multiple of 4")
        expect(at + 8 + size <= len(data), "a chunk leaves the file")
        chunks.append((kind, data[at + 8:at + 8 + size]))
        at += 8 + size
    kinds = [kind for kind, _ in chunks]
    expect(kinds in ([b"JSON"], [b"JSON", b"BIN\0"]), f"chunks {kinds}")
    return json.loads(chunks[0][1]), chunks[1][1] if len(chunks) > 1 else b""


def views_of(document, binary):
    buffers = document.get("buffers", [])
    contents = [binary if i == 0 else None for i in range(len(buffers))]
    if buffers:
        expect(0 <= len(binary) - buffers[0]["byteLength"] <= 3, "the length of the buffer")
    for other in buffers[1:]:
        expect(other.get("extensions", {}).get(PACKED, {}).get("fallback"), "a buffer of nothing")
    views = []
    for view in document.get("bufferViews", []):
        begin, length = view.get("byteOffset", 0), view["byteLength"]
        expect(length > 0, "an empty view")
        expect(begin + length <= buffers[view["buffer"]]["byteLength"], "a view leaves its buffer")
        packed = view.get("extensions", {}).get(PACKED)
        if packed:
            raw = unpacked(packed, contents[packed["buffer"]])
            expect(len(raw) == length, "the length of a view")
        else:
            raw = contents[view["buffer"]][begin:begin + length]
        views.append((view, raw))
    return views


def accessors_of(document, views):
    arrays = []
    for accessor in document.get("accessors", []):
        view, raw = views[accessor["bufferView"]]
        kind = numpy.dtype(TYPES[accessor["componentType"]])
        width, count = SHAPES[accessor["type"]], accessor["count"]
        begin, stride = accessor.get("byteOffset", 0), view.get("byteStride", width * kind.itemsize)
        expect(count > 0, "an accessor of nothing")
        expect(accessor.get("normalized", False) is False or kind.kind in "iu", "normalized floats")
        expect((view.get("byteOffset", 0) + begin) % kind.itemsize == 0, "an accessor's alignment")
        if "byteStride" in view:
            expect(4 <= stride <= 252 and stride % 4 == 0, f"a stride of {stride}")
        expect(begin + (count - 1) * stride + width * kind.itemsize <= len(raw),
               "an accessor leaves its view")
        rows = numpy.ndarray((count, width), kind, raw, begin, (stride, kind.itemsize))
        if kind.kind == "f":
            expect(numpy.isfinite(rows).all(), "a number that is none")
        for name, of in (("min", numpy.min), ("max", numpy.max)):
            if name in accessor:
                stated = numpy.array(accessor[name], numpy.float64)
                expect((numpy.float32(stated) == of(rows, 0).astype(numpy.float32)).all(),
                       f"{name} {stated}, found {of(rows, 0)}")
        arrays.append((accessor, rows, view))
    return arrays


def meshes(document, arrays):
    triangles = 0
    for mesh in document.get("meshes", []):
        for part in mesh["primitives"]:
            places, at, _ = arrays[part["attributes"]["POSITION"]]
            expect("min" in places and "max" in places, "places without bounds")
            for name, number in part["attributes"].items():
                accessor, rows, view = arrays[number]
                expect(accessor["count"] == places["count"], f"{name} of other vertices")
                expect(view["target"] == 34962, f"the target of {name}")
                if name == "NORMAL":
                    scale = 127.0 if rows.dtype == numpy.int8 else 1.0
                    length = numpy.linalg.norm(rows / scale, axis=1)
                    near = 0.02 if scale > 1 else 1e-5
                    expect((abs(length - 1) < near).all(), "a normal whose length is not 1")
            corners, index, view = arrays[part["indices"]]
            expect(view["target"] == 34963, "the target of corners")
            expect(corners["count"] % 3 == 0, "corners of no whole triangles")
            expect(int(index.max()) < places["count"], "a corner of no vertex")
            expect(part["material"] < len(document["materials"]), "a material that is not there")
            triangles += corners["count"] // 3
    return triangles


def nodes(document):
    all_nodes, seen = document["nodes"], []
    waiting = list(document["scenes"][document["scene"]]["nodes"])
    while waiting:
        number = waiting.pop()
        expect(number < len(all_nodes), "a node that is not there")
        expect(number not in seen, "a node with two parents")
        seen.append(number)
        node = all_nodes[number]
        expect(node.get("children") != [] and node.get("mesh", 0) < len(document.get("meshes", [0])),
               "a node's children or mesh")
        waiting += node.get("children", [])
    expect(len(seen) == len(all_nodes), "a node outside of the scene")


def animations(document, arrays):
    for animation in document.get("animations", []):
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            times, values = arrays[sampler["input"]][1], arrays[sampler["output"]][1]
            expect((numpy.diff(times[:, 0]) > 0).all() and times[0, 0] >= 0, "times do not ascend")
            expect(len(times) == len(values), "as many values as times")
            expect("min" in arrays[sampler["input"]][0], "times without bounds")


def check(path):
    document, binary = read(path)
    expect(document["asset"]["version"] == "2.0", "the version")
    used = set(document.get("extensionsUsed", []))
    expect(used <= KNOWN, f"extensions {used}")
    expect(set(document.get("extensionsRequired", [])) <= used, "required and not used")
    for name, value in document.items():
        expect(value != [], f"{name} is empty")
    arrays = accessors_of(document, views_of(document, binary))
    nodes(document)
    animations(document, arrays)
    print(f"{path}: {meshes(document, arrays)} triangles")


for NAME in sys.argv[1:]:
    check(NAME)
