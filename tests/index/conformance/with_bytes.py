"""Formats written byte by byte, as their documents describe them: MRC, MGH, Gaussian's cube, MetaMorph's and Zeiss' TIFF."""
import gzip
import itertools
import struct

import numpy as np

from manifest import done, expect, field, path, refuse


def write(name, content, compressed=False):
    with (gzip.open if compressed else open)(path(name), "wb") as out:
        out.write(content)
    return name


# ---- MRC
def cell_edges(lengths, angles):
    """The edges as in the PDB, each a row."""
    a, b, c = lengths
    alpha, beta, gamma = np.radians(angles)
    x = (np.cos(alpha) - np.cos(beta) * np.cos(gamma)) / np.sin(gamma)
    return np.array([[a, 0, 0], [b * np.cos(gamma), b * np.sin(gamma), 0],
                     [c * np.cos(beta), c * x, c * np.sqrt(1 - np.cos(beta) ** 2 - x ** 2)]])


def mrc(name, data, mode=2, *, end="<", order=(1, 2, 3), start=(0, 0, 0), origin=(0, 0, 0), samples=None,
        lengths=(12, 20, 28), angles=(90, 90, 90), extended=0, group=1, imod=None, greatest=0., word=b"MAP ", stamp=True,
        compressed=False, more=b""):
    head = bytearray(1024)
    sizes = data.shape[2::-1] if data.ndim == 3 else data.shape[-2::-1]
    struct.pack_into(end + "10i", head, 0, *sizes, mode, *start, *(samples or [sizes[order.index(i)] for i in (1, 2, 3)]))
    struct.pack_into(end + "6f3i3f2i", head, 40, *lengths, *angles, *order, 0., greatest, 0., group, extended)
    struct.pack_into(end + "3f", head, 196, *origin)
    head[208:212] = word
    if stamp:
        head[212:214] = b"DD" if end == "<" else b"\x11\x11"
    if imod is not None:
        struct.pack_into(end + "2i", head, 152, 1146047817, imod)
    body = data.astype(data.dtype.newbyteorder(end)).tobytes()
    return write(name, bytes(head) + b"e" * extended + body + more, compressed)


def places(data, order=(1, 2, 3), start=(0, 0, 0), origin=(0, 0, 0), samples=None, lengths=(12, 20, 28), angles=(90, 90, 90)):
    """Where the header puts the vertices: a row for each axis of the file, fastest first."""
    sizes = data.shape[2::-1]
    samples = samples or [sizes[order.index(i)] for i in (1, 2, 3)]
    edges = cell_edges(lengths, angles)
    steps = np.array([edges[i - 1] / samples[i - 1] for i in order])
    spacing = np.linalg.norm(steps, axis=1)
    at = np.array(origin, "f8") if np.any(origin) else np.array(start) @ steps
    return dict(spacing=spacing, direction=(steps / spacing[:, None]).tolist(), origin=at)


values = field(4, 5, 6)
modes = [(0, field(4, 5, 6, dtype="i1")), (1, field(4, 5, 6, dtype="i2")), (2, values), (6, field(4, 5, 6, dtype="u2")),
         (12, values.astype("f2"))]
for (mode, data), end, compressed in itertools.product(modes, "<>", (False, True)):
    name = f"mode{mode}{'le' if end == '<' else 'be'}.{'map.gz' if compressed else 'mrc'}"
    expect(mrc(name, data, mode, end=end, extended=80, compressed=compressed), data, **places(data))
for number, order in enumerate(itertools.permutations((1, 2, 3))):
    for kind, placed in enumerate([dict(), dict(start=(10, 20, 30)), dict(start=(10, -20, 30), origin=(20., 40., 60.)),
                                   dict(angles=(90, 120, 90), start=(1, 2, 3)), dict(angles=(80, 75, 110), origin=(1., 2., 3.)),
                                   dict(samples=(24, 48, 96), start=(-5, 0, 5))]):
        name = mrc(f"order{number}_{kind}.map", values, order=order, end="<>"[kind % 2], **placed)
        expect(name, values, **places(values, order=order, **placed))
large = field(4, 5, 6, dtype="u1")
for name, how, data in [("imod.rec", dict(imod=0), large), ("imod_signed.rec", dict(imod=1), large.view("i1")),
                        ("greatest.rec", dict(greatest=250.), large), ("small.st", dict(greatest=100.), large.view("i1"))]:
    expect(mrc(name, data, 0, **how), data, **places(data))
expect(mrc("old.map", values, word=b"\0\0\0\0", stamp=False), values, **places(values))
expect(mrc("unstamped.mrc", values, end=">", stamp=False), values, **places(values))
expect(mrc("without_axes.mrc", values, order=(1, 2, 3)), values, **places(values))
expect(mrc("named_otherwise.dat", values), values, **places(values))
expect(mrc("compressed.map", values, compressed=True), values, **places(values))
expect(mrc("no_cell.mrc", values, lengths=(0, 0, 0)), values)
volumes = field(3, 4, 5, 6)
expect(mrc("volumes.mrcs", volumes.reshape(12, 5, 6), samples=(6, 5, 4), group=401), volumes, spacing=(2, 4, 7))
expect(mrc("images.mrcs", values, samples=(6, 5, 1), group=0, lengths=(12, 20, 7)), values, spacing=(2, 4, 7))
colors = field(4, 5, 6, 3, dtype="u1")
expect(mrc("colors.mrc", colors, 16), colors[..., 1], component="1", **places(values))
waves = field(4, 5, 6, 2)
expect(mrc("waves.mrc", waves, 4), waves[..., 0], component="0", **places(values))
expect(mrc("surplus.mrc", values, more=b"tail"), values, allow_surplus=True, **places(values))
refuse("surplus.mrc", "4 bytes follow the values of the 1 step that the header has")
refuse(mrc("bits.mrc", values, 101), "MRC of mode 101, expected 0, 1, 2, 3, 4, 6, 12 or 16")
refuse(mrc("twice.mrc", values, order=(1, 2, 2), samples=(6, 5, 4)), "not MRC: 6 x 5 x 4 values of mode 2, axes 1 2 2")
refuse(mrc("flat_cell.mrc", values, angles=(30, 30, 90)), "expected those of a parallelepiped")
refuse(mrc("uneven.mrcs", values, samples=(6, 5, 3), group=401), "expected a multiple of MZ, 3")
refuse(write("short.mrc", b"short"), "truncated: 5 bytes, an MRC header has 1024")
refuse(write("notes.map", b"no map of a molecule"), "unknown format")
refuse(write("philips.rec", bytes(4000)), "Philips PAR/REC")


# ---- MGH, by nibabel, and by hand what it does not write
import nibabel  # noqa: E402

affine = np.array([[0, -2, 0, 5], [3, 0, 0, 6], [0, 0, -4, 7], [0, 0, 0, 1.]])
for name, dtype, steps in [("brain.mgz", "u1", 1), ("brain.mgh", "i2", 1), ("brain_i4.mgh", "i4", 1), ("float.mgz", "f4", 3),
                           ("run.mgh", "i2", 3)]:
    data = field(steps, 4, 5, 6, dtype=dtype)
    image = nibabel.MGHImage(data.transpose(3, 2, 1, 0) if steps > 1 else data[0].transpose(2, 1, 0), affine)
    if steps > 1:
        image.header.set_zooms((3, 2, 4, 2500.))
    image.to_filename(path(name))
    expect(name, data, spacing=(3, 2, 4), direction=[[0, 1, 0], [-1, 0, 0], [0, 0, -1]], origin=(5, 6, 7),
           times=np.arange(3) * 2500. if steps > 1 else None)


def mgh(name, data, kind, good=0, version=1):
    return write(name, struct.pack(">7ih", version, *data.shape[::-1], 1, kind, 0, good).ljust(284, b"\0") + data.tobytes())


unsigned = field(4, 5, 6, dtype=">u2")
expect(mgh("coronal.mgh", unsigned, 10), unsigned, direction=[[-1, 0, 0], [0, 0, -1], [0, 1, 0]], origin=(3, -2, 2.5))
refuse(mgh("bits.mgh", unsigned, 5), "MGH of type 5, expected 0, 1, 3, 4 or 10; FreeSurfer's mri_convert")
refuse(mgh("later.mgh", unsigned, 10, version=2), "not MGH: version 2, expected 1")


# ---- Gaussian's cube
def cube(name, data, steps=((.5, 0, 0), (0, .6, 0), (0, 0, .7)), unit=1, atoms=2, values_at=None, orbitals=None):
    sizes = data.shape[:3]
    lines = ["title", "second title",
             f"{-atoms if orbitals else atoms:5d} 1.0 -2.0 3.5" + (f" {values_at:4d}" if values_at else "")]
    lines += [f"{unit * n:5d} " + " ".join(f"{v:.6f}" for v in step) for n, step in zip(sizes, steps)]
    lines += [f" {i + 1} 1.0 0.0 0.0 {i}.0" for i in range(atoms)]
    if orbitals:
        lines.append(" ".join(str(v) for v in (len(orbitals), *orbitals)))
    for row in data.reshape(sizes[0] * sizes[1], -1):
        lines += [" ".join(f"{v: .17E}" for v in row[i:i + 6]) for i in range(0, len(row), 6)]
    return write(name, "\n".join(lines).encode() + b"\n")


density = field(6, 5, 4, dtype="f8")  # [x][y][z]
turned = dict(direction=[[0, 0, 1], [0, 1, 0], [1, 0, 0]], spacing=(.7, .6, .5), origin=(1, -2, 3.5))
expect(cube("rho.cube", density), density, **turned)
expect(cube("angstrom.cub", density, unit=-1), density, **turned)
expect(cube("no_atoms.cube", density, atoms=0), density, **turned)
oblique = np.array([[.3, .4, 0], [0, .6, 0], [0, .8, .6]])
lengths = np.linalg.norm(oblique, axis=1)
expect(cube("oblique.cube", density, steps=oblique), density, spacing=lengths[::-1], origin=(1, -2, 3.5),
       direction=(oblique / lengths[:, None])[::-1].tolist())
several = field(6, 5, 4, 2, dtype="f8")
expect(cube("gradient.cube", several, values_at=2), several[..., 1], component="1", **turned)
expect(cube("orbitals.cube", several, orbitals=(7, 9)), several[..., 0], component="0", **turned)
refuse(write("one.cube", b"title"), "not a Gaussian cube, or truncated: no second title")
refuse(write("colors.cube", b"TITLE \"x\"\nLUT_3D_SIZE 2\n0 0 0\n"), "not a Gaussian cube")


# ---- TIFF of microscopes, whose tags no library writes
def tiff(name, pages, tags=(), thumbnails=False, at=None):
    """Little-endian pages of one strip each. tags: (number, type, count, bytes) of the first page. at: bytes behind it all,
    by the places that the tags name as `None`."""
    out = bytearray(b"II*\0\0\0\0\0")
    link = 4
    for number, page in enumerate(pages):
        for small in ([False, True] if thumbnails else [False]):
            page_data = np.zeros((3, 3), page.dtype) if small else page
            samples = page_data.shape[0] if page_data.ndim == 3 else 1
            strips = len(out)
            out += page_data.tobytes()
            planes = [strips + i * (page_data.nbytes // samples) for i in range(samples)]
            entries = [(254, 4, 1, struct.pack("<I", int(small))), (256, 4, 1, struct.pack("<I", page_data.shape[-1])),
                       (257, 4, 1, struct.pack("<I", page_data.shape[-2])),
                       (258, 3, samples, struct.pack(f"<{samples}H", *[8 * page.dtype.itemsize] * samples)),
                       (259, 3, 1, struct.pack("<H", 1)), (262, 3, 1, struct.pack("<H", 1)),
                       (273, 4, samples, struct.pack(f"<{samples}I", *planes)), (277, 3, 1, struct.pack("<H", samples)),
                       (278, 4, 1, struct.pack("<I", page_data.shape[-2])),
                       (279, 4, samples, struct.pack(f"<{samples}I", *[page_data.nbytes // samples] * samples)),
                       (284, 3, 1, struct.pack("<H", 2 if samples > 1 else 1))]
            if number == 0 and not small:
                entries += list(tags)
            listed = b""
            for tag, kind, count, value in sorted(entries):
                if len(value) > 4:
                    where, value = len(out), value
                    out += value
                    value = struct.pack("<I", where)
                listed += struct.pack("<HHI", tag, kind, count) + value.ljust(4, b"\0")
            struct.pack_into("<I", out, link, len(out))
            out += struct.pack("<H", len(entries)) + listed
            link = len(out)
            out += bytes(4)
    return write(name, bytes(out))


def lsm_record(z, t, scan=0, interval=0., position=0):
    record = bytearray(500)
    struct.pack_into("<2I7i", record, 0, 0x0400494C, 500, 6, 5, z, 1, t, 1, 3)
    struct.pack_into("<6dH", record, 40, .25e-6, .5e-6, 1.5e-6, 1e-6, 2e-6, 3e-6, scan)
    struct.pack_into("<d", record, 112, interval)
    struct.pack_into("<2i", record, 264, position, 0)
    return bytes(record)


planes = field(3, 4, 5, 6, dtype="u1")
zeiss = dict(spacing=(.25, .5, 1.5), origin=(1, 2, 3))


def lsm(name, pages, record):
    return tiff(name, pages, [(34412, 1, len(record), record)], thumbnails=True)


expect(lsm("z.lsm", planes[0], lsm_record(4, 1)), planes[0], **zeiss)
expect(lsm("zt.lsm", planes.reshape(12, 5, 6), lsm_record(4, 3, 4, 2.5)), planes, times=[0, 2.5, 5], **zeiss)
expect(lsm("tz.lsm", planes.transpose(1, 0, 2, 3).reshape(12, 5, 6), lsm_record(4, 3, 3, 2.5)), planes, times=[0, 2.5, 5], **zeiss)
expect(lsm("stopped.lsm", planes.reshape(12, 5, 6)[:9], lsm_record(4, 3, 4, 2.5)), planes[:2], times=[0, 2.5], **zeiss)
two = field(4, 2, 5, 6, dtype="u2")
expect(lsm("channels.lsm", two, lsm_record(4, 1)), two[:, 1], component="1", **zeiss)
refuse(lsm("positions.lsm", planes[0], lsm_record(4, 1, position=3)), "LSM of 3 positions and 1 tiles")
refuse(lsm("hopeless.lsm", planes[0][:2], lsm_record(4, 2)), "truncated: 2 pages, a step has 4 slices")


def stk(name, data, distance, properties=()):
    plane = b"".join(struct.pack("<6I", int(distance * 1000), 1000, 2454000, 1000 * i, 0, 0) for i in range(len(data)))
    made = tiff(name, [data[0]], [(33629, 5, len(data), plane), *properties])
    # The planes follow the first one, which is all that the directory knows.
    with open(path(name), "rb") as file:
        content = file.read()
    first = data[0].nbytes
    moved = bytearray(content[:8] + data.tobytes() + content[8 + first:])
    shift = data.nbytes - first
    directory = struct.unpack_from("<I", moved, 4)[0] + shift
    struct.pack_into("<I", moved, 4, directory)
    for i in range(struct.unpack_from("<H", moved, directory)[0]):
        tag, kind, count = struct.unpack_from("<HHI", moved, directory + 2 + 12 * i)
        if tag in (33628, 33629):
            struct.pack_into("<I", moved, directory + 10 + 12 * i, struct.unpack_from("<I", moved, directory + 10 + 12 * i)[0] + shift)
    return write(name, bytes(moved))


expect(stk("z.stk", planes[0], 1.5), planes[0])
done()
