"""XDMF 2 and 3 as their documents describe them, with values in HDF5 files that h5py writes."""
import h5py
import numpy as np

from manifest import done, expect, field, path, refuse

moving = field(3, 4, 5, 6)
cells = field(3, 4, 5)
vector = field(4, 5, 6, 3)
wide = field(2, 8, 5, 6, dtype="i2")
with h5py.File(path("heavy.h5"), "w") as file:
    for t in range(3):
        file[f"step{t}/rho"] = moving[t]
    file["cells"] = cells
    file["flat"] = moving[0].ravel()
    file["one_more"] = moving[1][None]
    file["vector"] = vector
    file["wide"] = wide
    file["x"], file["y"], file["z"] = [0, 1, 3, 6, 10, 15.0], [0, 1, 2, 3, 4.5], [1, 2, 4, 8.0]
moving[2].astype(">f4").tofile(path("plain.bin"))

EVEN = """<Topology TopologyType="3DCoRectMesh" Dimensions="4 5 6"/>
<Geometry GeometryType="Origin_DxDyDz"><DataItem Dimensions="3" Format="XML">3 2 1</DataItem>
<DataItem Dimensions="3" Format="XML">0.5 0.25 2</DataItem></Geometry>"""
STRETCHED = """<Topology Type="3DRectMesh" NumberOfElements="4 5 6"/><Geometry Type="VXVYVZ">
<DataItem Dimensions="6" Format="HDF">heavy.h5:/x</DataItem><DataItem Dimensions="5" Format="HDF">heavy.h5:/y</DataItem>
<DataItem Dimensions="4">1 2 4 8</DataItem></Geometry>"""
even = dict(origin=(1, 2, 3), spacing=(2, 0.25, 0.5))


def write(name, grids, head=""):
    with open(path(name), "w") as out:
        out.write(f'<?xml version="1.0"?>\n{head}<Xdmf Version="2.0"><Domain>{grids}</Domain></Xdmf>')
    return name


def item(place, dimensions="4 5 6", more='Format="HDF" NumberType="Float" Precision="4"'):
    return f'<DataItem Dimensions="{dimensions}" {more}>{place}</DataItem>'


def attribute(data, name="rho", center="Node"):
    return f'<Attribute Name="{name}" AttributeType="Scalar" Center="{center}">{data}</Attribute>'


def grid(content, places=EVEN, more='GridType="Uniform"'):
    return f'<Grid Name="g" {more}>{places}{content}</Grid>'


def temporal(grids, more=""):
    return f'<Grid GridType="Collection" CollectionType="Temporal">{more}{grids}</Grid>'


steps = [attribute(item(f"heavy.h5:/step{t}/rho")) for t in range(3)]
expect(write("one.xmf", grid(steps[0])), moving[0], **even)
expect(write("timed.xdmf", grid('<Time Value="2.5"/>' + steps[1])), moving[1], times=[2.5], **even)
series = temporal("".join(grid(f'<Time Value="{t * 0.5 + 1}"/>' + steps[t]) for t in range(3)))
expect(write("series.xmf", series), moving, times=[1, 1.5, 2], **even)
listed = '<Time TimeType="List"><DataItem Dimensions="3">1 4 9</DataItem></Time>'
expect(write("listed.xmf", temporal("".join(grid(s) for s in steps), listed)), moving, times=[1, 4, 9], **even)
slab = '<Time TimeType="HyperSlab"><DataItem Dimensions="3">1 0.25 3</DataItem></Time>'
expect(write("slab.xmf", temporal("".join(grid(s) for s in steps), slab)), moving, times=[1, 1.25, 1.5], **even)
expect(write("beside.xmf", "".join(grid(f'<Time Value="{t}"/>' + steps[t]) for t in range(3))), moving, times=[0, 1, 2], **even)
expect(write("stretched.xmf", grid(steps[0], STRETCHED)), moving[0], origin=(0, 0, 1), spacing=(3, 4.5 / 4, 7 / 3),
       positions=[[0, 1, 3, 6, 10, 15], [0, 1, 2, 3, 4.5], [1, 2, 4, 8]])
expect(write("flat.xmf", grid(attribute(item("heavy.h5:/one_more")))), moving[1], **even)
both = grid(attribute(item("heavy.h5:/vector", "4 5 6 3"), "v") + steps[0])
refuse(write("both.xmf", both), "v")
expect("both.xmf", vector[..., 2], array="v", component="2", **even)
expect("both.xmf", moving[0], array="rho", **even)
# Cells are averaged to vertices.
mean = np.zeros((4, 5, 6))
count = np.zeros((4, 5, 6))
for dz in (0, 1):
    for dy in (0, 1):
        for dx in (0, 1):
            mean[dz:dz + 3, dy:dy + 4, dx:dx + 5] += cells
            count[dz:dz + 3, dy:dy + 4, dx:dx + 5] += 1
expect(write("cells.xmf", grid(attribute(item("heavy.h5:/cells", "3 4 5"), center="Cell"))), mean / count, kind="rounded",
       **even)
# A part of a dataset; numbers in the document and in a plain file; references; entities.
part = '<DataItem ItemType="HyperSlab" Dimensions="4 5 6"><DataItem Dimensions="3 4">1 3 0 0  1 1 1 1  1 4 5 6</DataItem>' + \
    item("heavy.h5:/wide", "2 8 5 6", 'Format="HDF" NumberType="Int" Precision="2"') + "</DataItem>"
expect(write("part.xmf", grid(attribute(part))), wide[1, 3:7], **even)
expect(write("plain.xmf", grid(attribute(item("plain.bin", more='Format="Binary" Endian="Big"')))), moving[2], **even)
text = item(" ".join(str(v) for v in wide[0, :4].ravel()), more='Format="XML" NumberType="Int" Precision="2"')
expect(write("text.xmf", grid(attribute(text))), wide[0, :4], **even)
refer = "".join(f'<{kind} Reference="/Xdmf/Domain/Grid[1]/Grid[1]/{kind}"/>' for kind in ("Topology", "Geometry"))
expect(write("refer.xmf", temporal(grid('<Time Value="0"/>' + steps[0]) + grid('<Time Value="1"/>' + steps[1], refer))),
       moving[:2], times=[0, 1], **even)
expect(write("entity.xmf", grid(attribute(item("&heavy;:/step1/rho"))),
             '<!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" [<!ENTITY heavy "heavy.h5">]>\n'), moving[1], **even)
# Blocks of one grid, which share a plane of vertices or none, and documents that include others.


def block(first, end, data, name="rho", center="Node", more=""):
    places = EVEN.replace('"4 5 6"', f'"{end - first} 5 6"').replace(">3 2 1<", f">{3 + 0.5 * first} 2 1<")
    layers = end - first - (center == "Cell")
    part = f'<DataItem ItemType="HyperSlab" Dimensions="{layers} 5 6"><DataItem Dimensions="3 3">{first} 0 0 1 1 1 ' \
        f'{layers} 5 6</DataItem>{item(data)}</DataItem>'
    if center == "Cell":
        part = part.replace("5 6", "4 5").replace(f'"{4} 4 5"', '"3 4 5"')
    return grid(more + attribute(part, name, center), places)


def spatial(grids):
    return f'<Grid GridType="Collection" CollectionType="Spatial">{grids}</Grid>'


rho = [f"heavy.h5:/step{t}/rho" for t in range(3)]
expect(write("sharing.xmf", spatial(block(2, 4, rho[0]) + block(0, 3, rho[0]))), moving[0], **even)
expect(write("apart.xmf", temporal("".join(spatial(block(0, 2, rho[t], more=f'<Time Value="{t}"/>') + block(2, 4, rho[t]))
                                           for t in range(3)))), moving, times=[0, 1, 2], **even)
expect(write("cell_blocks.xmf", spatial(block(0, 2, "heavy.h5:/cells", center="Cell") +
                                        block(1, 4, "heavy.h5:/cells", center="Cell"))), mean / count, kind="rounded", **even)
include = '<xi:include xmlns:xi="http://www.w3.org/2001/XInclude" href="%s"%s/>'
expect(write("including.xmf", temporal("".join(include % (name, "") for name in ("one.xmf", "timed.xdmf")))), moving[:2], **even)
pointed = include % ("series.xmf", ' xpointer="xpointer(//Xdmf/Domain/Grid/Grid[3])"')
expect(write("pointed.xmf", pointed), moving[2], times=[2], **even)
dates = "".join(grid(f'<Time Value="2000-02-{28 + t // 2}T{t % 2 * 12}:00:00Z"/>' + steps[t]) for t in range(3))
expect(write("dates.xmf", temporal(dates)), moving, times=[0, 43200, 86400], **even)
# A run that was stopped: the document is ahead of its datasets.
behind = attribute(item("heavy.h5:/step3/rho")), attribute(item("later.h5:/rho"))
for number, missing in enumerate([behind[:1], behind[1:], behind]):
    expect(write(f"stopped{number}.xmf", temporal("".join(grid(f'<Time Value="{t}"/>' + step) for t, step in enumerate(
        [*steps, *missing])))), moving, times=[0, 1, 2], note="3 of", **even)
# What is refused.
refuse(write("hole.xmf", spatial(block(0, 1, rho[0]) + block(2, 4, rho[0]))), "at least 2 vertices")
refuse(write("gap.xmf", spatial(block(0, 2, "heavy.h5:/cells", center="Cell") +
                                block(2, 4, "heavy.h5:/cells", center="Cell"))), "without values")
refuse(write("self.xmf", include % ("self.xmf", "")), "which includes it")
refuse(write("nowhere.xmf", include % ("one.xmf", ' xpointer="xpointer(/Xdmf/Domain/Grid[2])"')), "has no grid")
expect(write("flat2.xmf", grid(attribute(item("heavy.h5:/flat")))), moving[0], **even)
refuse(write("blocks.xmf", f'<Grid GridType="Collection" CollectionType="Spatial">{grid(steps[0]) * 2}</Grid>'),
       "begins where")
refuse(write("curved.xmf", grid(steps[0], EVEN.replace("3DCoRectMesh", "3DSMesh"))), "3DSMesh")
refuse(write("gone.xmf", grid(attribute(item("heavy.h5:/none")))), "holds no dataset /none")
refuse(write("no_file.xmf", grid(attribute(item("no.h5:/none")))), "no.h5")
refuse(write("short.xmf", grid(attribute(item("heavy.h5:/cells")))), "is not of the shape", reads=True)
refuse(write("lying.xmf", grid(attribute(item("1 2 3", more='Format="XML"')))), "5 bytes of numbers as text, expected 120")
refuse(write("beyond_end.xmf", grid(attribute(item("plain.bin", more='Format="Binary" Seek="8"')))), "truncated")
refuse(write("stride.xmf", grid(attribute(part.replace("1 1 1 1", "1 1 1 2")))), "stride 2")
refuse(write("beyond.xmf", grid(attribute(part.replace("1 3 0 0", "1 5 0 0")))), "a HyperSlab of 4 from 5 on")
refuse(write("loop.xmf", '<Grid Reference="/Xdmf/Domain/Grid"/>'), "which is not in it")
refuse(write("other.xmf", temporal(grid(steps[0]) + grid(steps[1], STRETCHED))), "is not as in step 0")
refuse(write("cut.xmf", "<Grid>"), "damaged XML")
for value in ("2000-02-28T25:00:00", "1.5 s", ""):
    refuse(write("no_time.xmf", temporal(grid(f'<Time Value="{value}"/>' + steps[0]))), "expected a number or a date")
done()
