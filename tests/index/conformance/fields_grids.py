"""Fields of VTK's files, XDMF, VTKHDF and meshes of simulations: see field_files.py."""
import os

import h5py
import netCDF4
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

from cgns_files import node, words, write_zone
from field_files import add, done, full, path, values

mesh = dict(resample=[4, 4, 4])


# ---- VTK XML: image data
def array(name="v", more="", inside="", kind="Float32", data=values):
    text = " ".join(str(v) for v in np.ravel(data))
    return f'<DataArray type="{kind}" Name="{name}" format="ascii" {more}>{text}{inside}</DataArray>'


def vti(attributes='Origin="0 0 0" Spacing="1 1 1"', field="", active="", arrays=None, extent="0 5 0 4 0 3", head="", cells="",
        piece=""):
    name = path(".vti")
    with open(full(name), "w") as out:
        out.write(f'<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" {head}><ImageData WholeExtent="{extent}" '
                  f'{attributes}>{field}<Piece Extent="{extent}" {piece}><PointData {active}>{arrays or array()}</PointData>'
                  f'{cells}</Piece></ImageData></VTKFile>')
    return name


def field_data(name, value="3"):
    return (f'<FieldData><DataArray type="Float64" Name="{name}" NumberOfTuples="1" format="ascii">{value}</DataArray>'
            '</FieldData>')


def key(name, value, location="vtkDataArray"):
    return f'<InformationKey name="{name}" location="{location}">{value}</InformationKey>'


kind = "VTK image data"
plain = vti()
add(kind, "WholeExtent", plain, vti(extent="1 6 0 4 0 3"))
add(kind, "Origin", plain, vti('Origin="1 0 0" Spacing="1 1 1"'))
add(kind, "Spacing", plain, vti('Origin="0 0 0" Spacing="2 1 1"'))
add(kind, "Direction", plain, vti('Origin="0 0 0" Spacing="1 1 1" Direction="0 1 0 1 0 0 0 0 1"'))
add(kind, "TimeValue", plain, vti(field=field_data("TimeValue")))
add(kind, "TIME", plain, vti(field=field_data("TIME")))
add(kind, "TimeStep", plain, vti(field=field_data("TimeStep")))
add(kind, "DataArray type", plain, vti(arrays=array(kind="Int16")))
add(kind, "NumberOfComponents", plain, vti(arrays=array(more='NumberOfComponents="3"', data=np.repeat(values, 3) + 1)), component="0")
add(kind, "UNITS_LABEL", plain, vti(arrays=array(inside=key("UNITS_LABEL", "K"))))
hidden = '<DataArray type="UInt8" Name="vtkGhostType" format="ascii">' + "2 " + "0 " * 119 + "</DataArray>"
add(kind, "vtkGhostType", plain, vti(arrays=array() + hidden))
add(kind, "FieldData", plain, vti(field=field_data("CYCLE")))
add(kind, "ComponentName0", plain, vti(arrays=array(more='ComponentName0="u"')))
add(kind, "InformationKey", plain, vti(arrays=array(inside=key("GUI_HIDE", "1", "vtkAbstractArray"))))
two = array() + array("w")
add(kind, "PointData Scalars", vti(arrays=two), vti(arrays=two, active='Scalars="w"'), array="v")
add(kind, "other attributes", plain, vti(piece='Owner="me"'))


# ---- VTK XML: unstructured meshes and others, which are resampled
def hexahedra(field="", active="", arrays=None, shift=0., cells="", kind="12", points=8):
    name = path(".vtu")
    at = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], "f8") + shift
    own = values.ravel()[:8]
    with open(full(name), "w") as out:
        out.write('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>' + field +
                  f'<Piece NumberOfPoints="8" NumberOfCells="1"><PointData {active}>{arrays or array(data=own)}</PointData>'
                  f'<CellData>{cells}</CellData><Points>'
                  + array("Points", 'NumberOfComponents="3"', data=at, kind="Float64") + "</Points><Cells>"
                  + array("connectivity", data=range(8), kind="Int64") + array("offsets", data=[8], kind="Int64")
                  + array("types", data=[kind], kind="UInt8") + "</Cells></Piece></UnstructuredGrid></VTKFile>")
    return name


kind, own = "VTK unstructured grids", values.ravel()[:8]
plain = hexahedra()
add(kind, "Points", plain, hexahedra(shift=1.), **mesh)
add(kind, "types", plain, hexahedra(kind="11"), **mesh)
add(kind, "TimeValue", plain, hexahedra(field_data("TimeValue")), **mesh)
add(kind, "UNITS_LABEL", plain, hexahedra(arrays=array(data=own, inside=key("UNITS_LABEL", "K"))), **mesh)
add(kind, "DataArray type", plain, hexahedra(arrays=array(data=own, kind="Float64")), **mesh)
add(kind, "vtkGhostType", plain, hexahedra(cells='<DataArray type="UInt8" Name="vtkGhostType" format="ascii">1</DataArray>'),
    **mesh)
add(kind, "FieldData", plain, hexahedra(field_data("CYCLE")), **mesh)
add(kind, "ComponentName0", plain, hexahedra(arrays=array(data=own, more='ComponentName0="u"')), **mesh)
add(kind, "InformationKey", plain, hexahedra(arrays=array(data=own, inside=key("GUI_HIDE", "1", "vtkAbstractArray"))), **mesh)


# ---- VTK, legacy
def legacy(title="vtk output", data="SCALARS v float 1\nLOOKUP_TABLE default\n" + " ".join(str(v) for v in values.ravel()),
           origin="0 0 0", spacing="1 1 1", more="", sizes="6 5 4", head=""):
    name = path(".vtk")
    with open(full(name), "w") as out:
        out.write(f"# vtk DataFile Version 3.0\n{title}\nASCII\nDATASET STRUCTURED_POINTS\n{head}DIMENSIONS {sizes}\n"
                  f"ORIGIN {origin}\nSPACING {spacing}\nPOINT_DATA 120\n{data}\n{more}")
    return name


kind, plain = "VTK legacy", legacy()
numbers = " ".join(str(v) for v in values.ravel())
add(kind, "title", plain, legacy("a phantom"))
add(kind, "DIMENSIONS", plain, legacy(sizes="5 6 4"))
add(kind, "ORIGIN", plain, legacy(origin="1 0 0"))
add(kind, "SPACING", plain, legacy(spacing="2 1 1"))
add(kind, "SCALARS", plain, legacy(data="SCALARS v int 1\nLOOKUP_TABLE default\n" + numbers))
add(kind, "FIELD", plain, legacy(head="FIELD FieldData 1\nTIME 1 1 double\n3\n"))
add(kind, "FIELD of other names", plain, legacy(head="FIELD FieldData 1\nCYCLE 1 1 int\n3\n"))
add(kind, "COMPONENT_NAMES", plain, legacy(more="METADATA\nCOMPONENT_NAMES\nu\n\n"))
add(kind, "INFORMATION", plain, legacy(more='METADATA\nINFORMATION 1\nNAME UNITS_LABEL LOCATION vtkDataArray\nDATA K\n\n'))

# ---- XDMF
ITEM = '<DataItem Dimensions="4 5 6" Format="HDF" NumberType="Float" Precision="4">heavy.h5:/v</DataItem>'
BINARY = '<DataItem Dimensions="4 5 6" Format="Binary" NumberType="Float" Precision="4" {}>plain.bin</DataItem>'


def xdmf(item=ITEM, center="Node", more="", shape="Scalar", topology='TopologyType="3DCoRectMesh" Dimensions="4 5 6"',
         geometry='GeometryType="Origin_DxDyDz"', origin="3 2 1", spacing="1 1 1", time="", grid="", root='Version="2.0"',
         attribute="", name="v"):
    file = path(".xmf")
    with h5py.File(full(os.path.dirname(file) + "/heavy.h5"), "w") as f:
        f["v"] = values.astype("f4")
    values.astype("f4").tofile(full(os.path.dirname(file) + "/plain.bin"))
    with open(full(file), "w") as out:
        out.write(f'<Xdmf {root}><Domain><Grid GridType="Uniform" {grid}>{time}<Topology {topology}/><Geometry {geometry}>'
                  f'<DataItem Dimensions="3">{origin}</DataItem><DataItem Dimensions="3">{spacing}</DataItem></Geometry>'
                  f'<Attribute Name="{name}" AttributeType="{shape}" Center="{center}" {attribute}>{item}</Attribute>{more}'
                  '</Grid></Domain></Xdmf>')
    return file


def collected(time, kind="Temporal"):
    name = xdmf()
    text = open(full(name)).read()
    one = text[text.index("<Grid"):text.index("</Domain>")]
    with open(full(name), "w") as out:
        out.write(text.replace(one, f'<Grid GridType="Collection" CollectionType="{kind}">{time}{one}{one}</Grid>'))
    return name


def times(how, numbers):
    return f'<Time TimeType="{how}"><DataItem Dimensions="{len(numbers.split())}">{numbers}</DataItem></Time>'


kind, plain = "XDMF", xdmf()
listed = collected(times("List", "1 2"))
add(kind, "Topology: Dimensions", plain, xdmf(topology='TopologyType="3DCoRectMesh" Dimensions="4 6 5"'))
add(kind, "Topology: TopologyType", plain, xdmf(topology='TopologyType="3DSMesh" Dimensions="4 5 6"'), refused=True)
add(kind, "Topology: Order", plain, xdmf(topology='TopologyType="3DCoRectMesh" Dimensions="4 5 6" Order="0 1"'))
add(kind, "Topology: BaseOffset", plain, xdmf(topology='TopologyType="3DCoRectMesh" Dimensions="4 5 6" BaseOffset="1"'))
add(kind, "Geometry: GeometryType", plain, xdmf(geometry='GeometryType="XYZ"'), refused=True)
add(kind, "Geometry: origin", plain, xdmf(origin="0 0 0"))
add(kind, "Geometry: spacing", plain, xdmf(spacing="2 1 1"))
add(kind, "Time: Value", plain, xdmf(time='<Time Value="3"/>'))
add(kind, "Time: List", listed, collected(times("List", "3 5")))
add(kind, "Time: HyperSlab", listed, collected(times("HyperSlab", "0 5 2")))
add(kind, "Time: Range", listed, collected(times("Range", "3 5")), refused=True)
add(kind, "Grid: CollectionType", listed, collected(times("List", "1 2"), "Spatial"), refused=True)
add(kind, "Grid: Section", plain, xdmf(grid='Section="DataItem"'))
add(kind, "Grid: Name", plain, xdmf(grid='Name="g"'))
add(kind, "Attribute: Name", plain, xdmf(name="w"))
add(kind, "Attribute: Center", plain, xdmf(center="Cell"), refused=True)
add(kind, "Attribute: Center of others", plain, xdmf(more='<Attribute Name="e" Center="Edge"><DataItem Dimensions="2">1 2'
                                                         '</DataItem></Attribute>'))
add(kind, "Attribute: AttributeType", plain, xdmf(shape="Vector"))
add(kind, "Attribute: ItemType", plain, xdmf(attribute='ItemType="FiniteElementFunction"'))
add(kind, "DataItem: Dimensions", plain, xdmf(ITEM.replace("4 5 6", "4 5 5")), refused=True)
add(kind, "DataItem: Format", plain, xdmf(ITEM.replace('"HDF"', '"TIFF"')), refused=True)
add(kind, "DataItem: ItemType", plain, xdmf(ITEM.replace("<DataItem", '<DataItem ItemType="Function"')), refused=True)
binary = xdmf(BINARY.format(""))
add(kind, "DataItem: Endian", binary, xdmf(BINARY.format('Endian="Big"')))
add(kind, "DataItem: Seek", binary, xdmf(BINARY.format('Seek="4"')), refused=True)
add(kind, "DataItem: Compression", binary, xdmf(BINARY.format('Compression="Zlib"')), refused=True)
add(kind, "DataItem: NumberType", binary, xdmf(BINARY.format("").replace('"Float"', '"Int"')))
add(kind, "DataItem: Precision", binary, xdmf(BINARY.format("").replace('Precision="4"', 'Precision="8"')), refused=True)
add(kind, "Information", plain, xdmf(more='<Information Name="units" Value="K"/>'))
add(kind, "Set", plain, xdmf(more='<Set Name="border" SetType="Node"><DataItem Dimensions="1">1</DataItem></Set>'))


# ---- VTKHDF
def vtkhdf(steps=0, arrays=("p",), root=None, more=None, at=None):
    name = path(".vtkhdf")
    with h5py.File(full(name), "w") as f:
        g = f.create_group("VTKHDF")
        g.attrs.create("Type", b"ImageData", dtype=h5py.string_dtype("ascii", 9))
        for k, v in {"Version": [2, 0], "WholeExtent": [0, 5, 0, 4, 0, 3], "Origin": [0., 0, 0], "Spacing": [1., 1, 1],
                     "Direction": [1., 0, 0, 0, 1, 0, 0, 0, 1], **(root or {})}.items():
            g.attrs[k] = v
        for array_name in arrays:
            g["PointData/" + array_name] = np.stack([values + s for s in range(steps)]).astype("f4") if steps else values.astype("f4")
        if steps:
            g["Steps/Values"] = np.arange(steps) if at is None else at
            g["Steps"].attrs["NSteps"] = steps
        if more:
            more(g)
    return name


kind, plain, timed = "VTKHDF", vtkhdf(), vtkhdf(2)
for name, value in [("WholeExtent", [1, 6, 0, 4, 0, 3]), ("Origin", [1., 0, 0]), ("Spacing", [2., 1, 1]),
                    ("Direction", [0., 1, 0, 1, 0, 0, 0, 0, 1]), ("Version", [3, 0])]:
    add(kind, name, plain, vtkhdf(root={name: value}))
add(kind, "other attributes", plain, vtkhdf(root={"Owner": "me"}))
add(kind, "Steps/Values", timed, vtkhdf(2, at=np.array([3., 7])))
add(kind, "Steps/PointDataOffsets", timed, vtkhdf(2, more=lambda g: g.create_dataset("Steps/PointDataOffsets/p", data=[1, 0])))
add(kind, "FieldData", plain, vtkhdf(more=lambda g: g.create_dataset("FieldData/CYCLE", data=[3])))
add(kind, "vtkGhostType", plain, vtkhdf(more=lambda g: g.create_dataset("PointData/vtkGhostType", data=values.astype("u1"))))
add(kind, "units", plain, vtkhdf(more=lambda g: g["PointData/p"].attrs.create("units", np.bytes_("K"))))
add(kind, "attributes of arrays", plain, vtkhdf(more=lambda g: g["PointData/p"].attrs.create("note", np.bytes_("K"))))
add(kind, "PointData: Scalars", vtkhdf(arrays="pq"), vtkhdf(arrays="pq", more=lambda g: g["PointData"].attrs.create(
    "Scalars", np.bytes_("q"))), array="p")


# ---- OpenFOAM, of one cell
def foam(dimensions="0 0 0 0 0 0 0", times=("1",), scale=1):
    def file(name, kind, text):
        os.makedirs(os.path.dirname(full(f"{case}/{name}")), exist_ok=True)
        with open(full(f"{case}/{name}"), "w") as out:
            out.write(f"FoamFile {{ version 2.0; format ascii; class {kind}; object {os.path.basename(name)}; }}\n{text}\n")

    case = os.path.dirname(path(""))
    points = [f"({scale * x} {y} {z})" for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    faces = ["4(0 4 6 2)", "4(1 3 7 5)", "4(0 1 5 4)", "4(2 6 7 3)", "4(0 2 3 1)", "4(4 5 7 6)"]
    file("constant/polyMesh/points", "vectorField", "8\n(\n" + "\n".join(points) + "\n)")
    file("constant/polyMesh/faces", "faceList", "6\n(\n" + "\n".join(faces) + "\n)")
    file("constant/polyMesh/owner", "labelList", "6\n(\n0\n0\n0\n0\n0\n0\n)")
    file("constant/polyMesh/neighbour", "labelList", "0\n(\n)")
    file("constant/polyMesh/boundary", "polyBoundaryMesh", "1\n(\nwalls { type wall; nFaces 6; startFace 0; }\n)")
    file("system/controlDict", "dictionary", "startTime 0; endTime 9; deltaT 1; writeControl timeStep; writeInterval 1;")
    for time in times:
        file(f"{time}/p", "volScalarField", f"dimensions [{dimensions}];\ninternalField nonuniform List<scalar> \n1\n(\n3\n);\n"
             "boundaryField { walls { type zeroGradient; } }")
    return case


kind, plain = "OpenFOAM", foam()
add(kind, "points", plain, foam(scale=2), **mesh)
add(kind, "times", plain, foam(times=("2",)), **mesh)
add(kind, "dimensions", plain, foam("1 -1 -2 0 0 0 0"), **mesh)


# ---- Exodus
def exodus(change=lambda data: None):
    name = path(".exo")
    image = vtk.vtkImageData()
    image.SetDimensions(3, 3, 3)
    append = vtk.vtkAppendFilter()
    append.AddInputData(image)
    append.Update()
    data = numpy_to_vtk(values.ravel()[:27].astype("f8"), deep=True)
    data.SetName("v")
    append.GetOutput().GetPointData().AddArray(data)
    writer = vtk.vtkExodusIIWriter()
    writer.SetInputData(append.GetOutput())
    writer.SetFileName(full(name))
    writer.WriteAllTimeStepsOn()
    writer.Write()
    opened = netCDF4.Dataset(full(name), "a")
    opened.setncattr("title", "")
    change(opened)
    opened.close()
    return name


def side_set(data):
    data.createDimension("num_side_sets", 1)
    data.createDimension("num_side_ss1", 1)
    for variable, dimension in [("ss_status", "num_side_sets"), ("ss_prop1", "num_side_sets"), ("elem_ss1", "num_side_ss1"),
                                ("side_ss1", "num_side_ss1")]:
        data.createVariable(variable, "i4", (dimension,))[:] = 1
    data["ss_prop1"].setncattr("name", "ID")


def node_set(data):
    data.createDimension("num_node_sets", 1)
    data.createDimension("num_nod_ns1", 1)
    for variable, dimension in [("ns_status", "num_node_sets"), ("ns_prop1", "num_node_sets"), ("node_ns1", "num_nod_ns1")]:
        data.createVariable(variable, "i4", (dimension,))[:] = 1
    data["ns_prop1"].setncattr("name", "ID")


kind, plain = "Exodus", exodus()
add(kind, "title", plain, exodus(lambda data: data.setncattr("title", "a phantom")), **mesh)
add(kind, "coordx", plain, exodus(lambda data: data["coordx"].__setitem__(slice(None), data["coordx"][:] * 2)), **mesh)
add(kind, "time_whole", plain, exodus(lambda data: data["time_whole"].__setitem__(0, 3.)), **mesh)
add(kind, "side sets", plain, exodus(side_set), **mesh)
add(kind, "node sets", plain, exodus(node_set), **mesh)


# ---- CGNS
def cgns(scale=1, data=1, where="Vertex", rind=0, **more):
    def density(x, y, z):
        at_vertices = np.pad(data * (x + y + z), rind, constant_values=-99)
        return at_vertices if where == "Vertex" else at_vertices[:2, :3, :4]

    name = path(".cgns")
    write_zone(full(name), scale, density, where, **more)
    return name


def iterative(base):
    times = node(base, "Times", "BaseIterativeData_t", "I4", np.array([1], "i4"))
    node(times, "TimeValues", "DataArray_t", "R8", np.array([2.5]))


kind, plain = "CGNS", cgns()
add(kind, "GridCoordinates_t", plain, cgns(scale=2), **mesh)
add(kind, "DataArray_t", plain, cgns(data=2), **mesh)
add(kind, "GridLocation_t", plain, cgns(where="CellCenter"), **mesh)
add(kind, "BaseIterativeData_t", plain, cgns(of_base=iterative), **mesh)
for label in ["DimensionalUnits_t", "DataClass_t", "ReferenceState_t", "FlowEquationSet_t", "ConvergenceHistory_t",
              "Axisymmetry_t", "Gravity_t", "Descriptor_t", "Family_t", "IntegralData_t", "UserDefinedData_t"]:
    add(kind, label, plain, cgns(of_base=lambda base: node(base, "More", label, "C1", words("unusual"))), **mesh)
for label in ["ZoneBC_t", "ZoneGridConnectivity_t", "RigidGridMotion_t", "ArbitraryGridMotion_t", "RotatingCoordinates_t"]:
    add(kind, label, plain, cgns(of_zone=lambda zone: node(zone, "More", label, "MT")), **mesh)
for label in ["DataConversion_t", "DimensionalExponents_t"]:
    add(kind, label, plain, cgns(of_zone=lambda zone: node(zone["Solution"]["Density"], "More", label, "R8", np.ones(2))), **mesh)
add(kind, "Rind_t", plain,
    cgns(rind=1, of_zone=lambda zone: node(zone["Solution"], "Rind", "Rind_t", "I4", np.ones(6, "i4"))), same=True, **mesh)


# ---- AMReX: a level of 4 x 4 x 4 cells
def amrex(array="rho", time="0.5", low="0 0 0", high="1 1 1", system="0", level_steps="0", scale=1,
          more=()):
    folder = os.path.dirname(path(""))
    os.makedirs(full(f"{folder}/Level_0"))
    box = "((0,0,0) (3,3,3) (0,0,0))"
    first, last = ([float(v) for v in text.split()] for text in (low, high))
    spacing = " ".join(str((b - a) / 4) for a, b in zip(first, last))
    sides = "\n".join(f"{a} {b}" for a, b in zip(first, last))
    cells = scale * np.arange(64.0)
    texts = {"Header": f"HyperCLaw-V1.1\n1\n{array}\n3\n{time}\n0\n{low}\n{high}\n\n{box}\n{level_steps}\n{spacing}\n"
                       f"{system}\n0\n0 1 {time}\n{level_steps}\n{sides}\nLevel_0/Cell\n",
             "Level_0/Cell_H": f"1\n1\n1\n0\n(1 0\n{box}\n)\n1\nFabOnDisk: Cell_D_00000 0\n\n1,1\n0,\n\n1,1\n{cells[-1]},\n",
             **{name: "text\n" for name in more}}
    for name, text in texts.items():
        with open(full(f"{folder}/{name}"), "w") as out:
            out.write(text)
    with open(full(f"{folder}/Level_0/Cell_D_00000"), "wb") as out:
        out.write(f"FAB ((8, (64 11 52 0 1 12 0 1023)),(8, (8 7 6 5 4 3 2 1))){box} 1\n".encode() + cells.tobytes())
    return folder + "/Header"


kind, plain = "AMReX", amrex()
add(kind, "variables", plain, amrex(array="T"), **mesh)
add(kind, "time", plain, amrex(time="2.5"), **mesh)
add(kind, "prob_lo", plain, amrex(low="-1 0 0"), **mesh)
add(kind, "prob_hi", plain, amrex(high="2 1 1"), **mesh)
add(kind, "FAB", plain, amrex(scale=2), **mesh)
add(kind, "coordinate system", plain, amrex(system="1"), **mesh)
add(kind, "level_steps", plain, amrex(level_steps="7"), **mesh)
add(kind, "job_info", plain, amrex(more=["job_info"]), **mesh)
add(kind, "particles", plain, amrex(more=["particles"]), **mesh)

done("fields")
