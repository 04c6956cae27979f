"""Writes a plain record (record.py) in each container. A writer makes files in a folder and gives the arguments that open them.
`lacks`: what the container has no way to say, with the place in its specification that shows it."""
import json
import os
from dataclasses import dataclass

import h5py
import netCDF4
import nibabel
import numpy as np
import pydicom
import tifffile
from pydicom.dataset import FileDataset, FileMetaDataset
from pydicom.valuerep import DSfloat

from record import METERS

CONTAINERS = {}

# Containers | what they have no way to say, in the words of the statements' needs | the place in the specification that shows it
LACKS = """
NetCDF-3, NetCDF-4, Zarr 2 xarray, Zarr 3 dimension_names | direction, frame | CF 1.11, 4: coordinates are along axes, of no body
NetCDF-3, NetCDF-4 | time dates datetime64 | netCDF User's Guide, Data Types: numbers and texts
HDF5 scales, HDF5 bare | time dates datetime64 | HDF5 1.14, H5T: the class of times is not supported
NetCDF groups, Zarr groups, HDF5 groups | direction, frame, time axis, extra axis, components, arrays, names of variables | CF 1.11, HDF5, Zarr: as without groups; a group for each step
NetCDF groups, HDF5 groups | time dates datetime64 | netCDF User's Guide, HDF5 1.14, H5T: numbers and texts
NetCDF-3, NetCDF-4 | components | CF 1.11, 3.3: a vector is a variable for each component
HDF5 scales | direction, frame | HDF5 1.14, Dimension Scales: along dimensions, of no body
HDF5 bare | time told, order, names, time axis, extra axis, direction, frame, unit other, components first | HDF5 1.14, H5S: dimensions without scales have no names
HDF5 openPMD, HDF5 openPMD 2 | uneven, descending, direction, extra axis | openPMD 1.1.0, Mesh Based Records: gridSpacing is a positive number an axis
HDF5 openPMD | unit by axis, unit other | openPMD 1.1.0, Mesh Based Records: gridUnitSI is one number, to meters
HDF5 openPMD 2 | unit other, unit any | openPMD 2.0.0, Mesh Based Records: gridUnitSI is a number for each axis, to meters
HDF5 openPMD, HDF5 openPMD 2 | names, frame | openPMD 1.1.0, Mesh Based Records: axisLabels are x, y, z in geometry cartesian
HDF5 openPMD, HDF5 openPMD 2 | time axis, time dates | openPMD 1.1.0, iterations: time is a group for each, a number in seconds
HDF5 openPMD, HDF5 openPMD 2 | values scale offset, values unit, values gaps, unit words | openPMD 1.1.0, records: unitSI alone
HDF5 openPMD, HDF5 openPMD 2 | components last | openPMD 1.1.0, vector records: a dataset for each component
HDF5 axistags | uneven, times uneven, first time, origin, descending | vigra, AxisInfo: one resolution
HDF5 axistags | unit, time unit, time dates | vigra, AxisInfo: no unit
HDF5 axistags | names, extra axis | vigra, AxisInfo: keys are x, y, z, t, c
HDF5 axistags | direction, frame, values, arrays | vigra, AxisInfo: of axes alone
HDF5 element_size_um | time told, order, names, time axis, extra axis, components first | HDF5 1.14, H5S: dimensions without scales have no names
HDF5 element_size_um | origin, interval, first time, times uneven, time unit, time dates, uneven, descending, direction, frame, unit by axis, unit words, unit other, values, arrays | ilastik, Fiji: element_size_um is three numbers
Zarr resolution, HDF5 resolution | uneven, descending, times uneven, direction, frame, names by attributes, names of variables, unit other, time dates, values | funlib.persistence: resolution, offset, units and axis_names alone
OME-Zarr 0.4, OME-Zarr 0.5 | uneven, times uneven, direction, frame, unit other pressure | NGFF 0.5, coordinateTransformations: scale and translation alone
OME-Zarr 0.4, OME-Zarr 0.5 | member | NGFF 0.5, axes: time, channel and space
OME-Zarr 0.4, OME-Zarr 0.5 | time axis, components last | NGFF 0.5, axes: time comes first, then channels, then space
OME-Zarr 0.4, OME-Zarr 0.5 | unit words, unit any, names by attributes, names of variables, unit other degrees, time dates | NGFF 0.5, axes: name, type, unit of a list
OME-Zarr 0.4, OME-Zarr 0.5 | values, arrays | NGFF 0.5, multiscales: one image of numbers as they are
XDMF | order, names, time axis, extra axis | XDMF 3, Topology: Dimensions are z, y, x
XDMF | unit, direction, frame | XDMF 3, Geometry: no units, of no body
XDMF | time unit, time dates | XDMF 3, Time: a number
XDMF | values, components first | XDMF 3, Attribute: Name, AttributeType, Center
VTK .vti, VTK .vtr, VTKHDF | unit, frame | VTK file formats: no units of length, of no body
VTK .vti, VTK .vtr, VTKHDF | time axis, time unit, time dates | VTK file formats: a file for each entry of .pvd, timestep is a number
VTK .vti, VTK .vtr, VTKHDF | names, extra axis | VTK file formats: axes are x, y, z
VTK .vti, VTK .vtr, VTKHDF | values scale, values gaps, components first | VTK file formats, DataArray: values as they are
VTK .vti, VTKHDF | uneven | VTK file formats, ImageData: Origin, Spacing, Direction
VTK .vtr | remark | VTK 9.1, vtkXMLDataReader: hands out the keys of information that VTK itself has
VTK .vtr | order, direction, descending | VTK file formats, RectilinearGrid: ascending x, y, z
NRRD | uneven, times uneven | NRRD 5, section 5, per-axis fields: one number an axis
NRRD | time dates | NRRD 5, section 5, per-axis fields: units are words of no calendar
NRRD | names, unit other, extra axis | NRRD 5, section 5, per-axis fields: labels are for people
NRRD | values scale, values gaps, arrays | NRRD 5, section 4, basic fields: one array, as it is
NIfTI-1 | uneven, times uneven | nifti1.h, pixdim and srow: one number an axis
NIfTI-1 | time axis, components last, extra axis | nifti1.h, dim: x, y, z, t, then components
NIfTI-1 | unit by axis, unit words, unit other, time dates | nifti1.h, xyzt_units: one unit of length, seconds and their parts
NIfTI-1 | names | nifti1.h, qform and sform: places are RAS, axes have no names
NIfTI-1 | remark | nifti1.h, descrip: "any text you like", which names the data and makes no note
NIfTI-1 | values gaps, values unit, arrays | nifti1.h: one array of numbers
MetaImage | uneven, times uneven | MetaIO, tags: ElementSpacing is one number an axis
MetaImage | unit by axis, unit words, unit other, time unit, time dates | MetaIO, tags: DistanceUnits is one word, mm, um or cm
MetaImage | names, time axis, components first, extra axis | MetaIO, tags: axes have no names, time is the fourth
MetaImage | values, arrays | MetaIO, tags: ElementToIntensityFunctionSlope is for display; one array
DICOM | uneven all, unit by axis, unit words, unit other | DICOM PS3.3 C.7.6.2, Image Plane: PixelSpacing in mm, of rows and columns
DICOM | names, extra axis | DICOM PS3.3 C.7.6.2, Image Plane: places in the patient, axes have no names
DICOM | time axis, time dates | DICOM PS3.3 C.7.6.18, Cardiac Synchronization: TriggerTime in ms from the R-peak
DICOM | values gaps | DICOM PS3.3 C.7.5.1.1.2, Pixel Padding: pads pictures to rectangles, is no value that is missing
DICOM | components, arrays, remark | DICOM PS3.3 C.7.6.3, Image Pixel: samples of one image
ImageJ TIFF | uneven, descending, direction, frame | ImageJ, TiffDecoder: spacing and resolution are one number an axis
ImageJ TIFF | order, names, time axis, components last, extra axis | ImageJ, TiffDecoder: planes of x and y in order czt
ImageJ TIFF | first time, times uneven, time dates | ImageJ, TiffDecoder: finterval is one number, from 0
ImageJ TIFF | unit other | ImageJ, TiffDecoder: units are lengths
ImageJ TIFF | arrays, values gaps | ImageJ, TiffDecoder: one array, no value for none
OME-TIFF | uneven, descending, direction, frame | OME-XML 2016-06, Pixels: PhysicalSize is a positive number an axis
OME-TIFF | order, names, time axis last, components last, extra axis | OME-XML 2016-06, Pixels: DimensionOrder begins with XY
OME-TIFF | unit words, unit other, unit any | OME-XML 2016-06, Pixels: PhysicalSizeUnit is one of UnitsLength
OME-TIFF | origin, time dates | OME-XML 2016-06, Plane: PositionX is of the stage, DeltaT in a unit of time
OME-TIFF | values, arrays, remark | OME-XML 2016-06, Pixels: numbers as they are
MRC, MGH, Gaussian cube, BigDataViewer | uneven, unit by axis, unit words, unit other, unit any, names, extra axis | MRC2014, MGH, cube, BDV: one step along each of three axes, in one unit
MRC, Gaussian cube, BigDataViewer | interval, first time, times uneven, time unit, time dates, time axis | MRC2014, cube, BDV: a volume, or a number of one
MGH | first time, times uneven, time dates, time axis | MGH, footer: TR in ms, from 0
MRC, MGH, Gaussian cube, BigDataViewer | values, arrays, components first, remark | MRC2014, MGH, cube, BDV: one array of numbers as they are
MRC | descending, direction, frame, components last | MRC2014, words 11 to 16: a cell along x, y and z
MGH | components last | MGH, nframes: volumes that follow each other
Gaussian cube | frame | Gaussian, cubegen: of no body
BigDataViewer | order, origin, descending, direction, frame, components last | BigDataViewer, ViewSetup: voxelSize, cells are z, y, x
EnSight | order, uneven, descending, direction, frame, unit, names, extra axis, time unit, time dates, time axis | EnSight Gold, block uniform: origin and delta along x, y and z, no units
EnSight | values, arrays, components first, components last, remark | EnSight Gold, variable files: numbers as they are
BOV | order, uneven, descending, direction, frame, unit, names, extra axis | VisIt, BOV: BRICK_ORIGIN and BRICK_SIZE along x, y, z
BOV | time unit, time dates, time axis | VisIt, BOV: TIME is a number, a file for each
BOV | values, arrays, components first | VisIt, BOV: one array, as it is
"""


@dataclass
class Container:
    write: object
    may: tuple  # patterns of notes that any file of this kind may have
    lacks: dict  # what it cannot say, and the place in the specification


def container(name, may=(), by_axis=False):
    """by_axis: it states axes one by one, and may leave out time."""

    def add(write):
        def write_axes(record, folder):
            return write(record.without_unnamed() if by_axis else record, folder)

        rows = [row.split(" | ") for row in LACKS.strip().splitlines()]
        CONTAINERS[name] = Container(write_axes, may, {need: place for containers, needs, place in rows
                                                       if name in containers.split(", ") for need in needs.split(", ")})
        return write

    return add


def attributes_of(axis):
    """As CF has them."""
    return dict({"units": axis.unit} if axis.unit else {}, **axis.attributes)


def coordinates(axis):
    """As they are stored: packed, if the attributes say so."""
    if axis.texts is not None:
        return axis.texts
    if "scale_factor" not in axis.attributes:
        return np.asarray(axis.at, "f8")
    return np.round((axis.at - axis.attributes["add_offset"]) / axis.attributes["scale_factor"]).astype("i2")


def attributes_of_values(record):
    said = dict(record.attributes)
    if record.valid:
        said["valid_range"] = np.array(record.valid, record.values.dtype)
    if record.unit:
        said["units"] = record.unit
    if record.slope != 1:
        said["scale_factor"] = record.slope
    if record.offset:
        said["add_offset"] = float(record.offset)
    if beside := [axis.variable for axis in measured(record) if axis.variable != axis.name] + list(record.curved):
        said["coordinates"] = " ".join(beside)
    return said


def measured(record):
    """The axes that have coordinates."""
    return [axis for axis in record.axes if axis.role != "c"]


def arrays_of(record):
    return {record.name: record.values, **record.others}


def asked(record, path, array=None):
    """The arguments that open it."""
    more = ["--array", array or record.name] if record.others or array else []
    return [path, *more, *(["--component", record.component] if record.axis("c") else []),
            *(["--member", record.member] if record.axis("m") else [])]


# ---- CF: names of dimensions, coordinates as arrays, attributes
def netcdf(kind):
    def write(record, folder):
        path = f"{folder}/v.nc"
        with netCDF4.Dataset(path, "w", format=kind) as file:
            for axis in record.axes:
                file.createDimension(axis.name, len(axis.at))
                stored, names, kind_of_value = coordinates(axis), (axis.name,), None
                if stored.dtype.kind == "U" and kind == "NETCDF4":
                    stored, kind_of_value = stored.astype(object), str
                elif stored.dtype.kind == "U":
                    stored = netCDF4.stringtochar(stored.astype("S"))
                    names += (f"{axis.name}_length",)
                    file.createDimension(names[1], stored.shape[1])
                variable = file.createVariable(axis.variable, kind_of_value or stored.dtype, names)
                variable.set_auto_maskandscale(False)
                variable[:] = stored
                variable.setncatts(attributes_of(axis))
            for name, values in record.curved.items():
                file.createVariable(name, "f8", [record.axis(role).name for role in "yx"])[:] = values
            for name, values in arrays_of(record).items():
                variable = file.createVariable(name, values.dtype, [axis.name for axis in record.axes],
                                               fill_value=record.fill.get("_FillValue"))
                variable.set_auto_maskandscale(False)
                variable[:] = values
                variable.setncatts(attributes_of_values(record))
                variable.setncatts({name: value for name, value in record.fill.items() if name != "_FillValue"})
        return asked(record, path)

    return write


container("NetCDF-3", by_axis=True)(netcdf("NETCDF3_CLASSIC"))
container("NetCDF-4", by_axis=True)(netcdf("NETCDF4"))


def hdf5(scales):
    def write(record, folder):
        path = f"{folder}/v.h5"
        with h5py.File(path, "w") as file:
            for axis in measured(record):
                stored = coordinates(axis)
                file[axis.variable] = stored.astype("S") if stored.dtype.kind == "U" else stored
                file[axis.variable].attrs.update(attributes_of(axis))
                if scales:
                    file[axis.variable].make_scale(axis.variable)
            for name, values in record.curved.items():
                file[name] = values
            for name, values in arrays_of(record).items():
                file[name] = values
                file[name].attrs.update(attributes_of_values(record) | record.fill)
                for i, axis in enumerate(record.axes if scales else []):
                    file[name].dims[i].label = axis.name
                    if axis.role != "c":
                        file[name].dims[i].attach_scale(file[axis.variable])
        return asked(record, path)

    return write


container("HDF5 scales", by_axis=True)(hdf5(True))
container("HDF5 bare", may=("is taken for time", "coordinates taken from"), by_axis=True)(hdf5(False))


def openpmd(version, unit_of_axes):
    def write(record, folder):
        path, space = f"{folder}/v.h5", [axis for axis in record.axes if axis.role in "xyz"]
        vector = record.axis("c") is not None
        with h5py.File(path, "w") as file:
            file.attrs.update(openPMD=np.bytes_(version), openPMDextension=np.uint32(0), basePath=np.bytes_("/data/%T/"),
                              meshesPath=np.bytes_("fields/"), iterationEncoding=np.bytes_("groupBased"),
                              iterationFormat=np.bytes_("/data/%T/"))
            for number, time in enumerate(record.axis("t").at):
                group = file.create_group(f"data/{number}")
                group.attrs.update(time=time, dt=1.0, timeUnitSI=1e-3 if record.axis("t").unit == "ms" else 1.0)
                for name, values in arrays_of(record).items():
                    volume = np.moveaxis(values, [axis.role for axis in record.axes].index("t"), 0)[number]
                    at = f"fields/{name}"
                    mesh = group.create_group(at) if vector else group.create_dataset(at, data=volume)
                    parts = [group.create_dataset(f"{at}/{c}", data=volume[i]) for i, c in enumerate("xyz")] if vector else [mesh]
                    mesh.attrs.update(geometry=np.bytes_("cartesian"), dataOrder=np.bytes_("C"), unitDimension=np.zeros(7),
                                      axisLabels=[np.bytes_(axis.name) for axis in space], timeOffset=np.float32(0),
                                      gridSpacing=[axis.step() for axis in space], gridGlobalOffset=[axis.at[0] for axis in space],
                                      gridUnitSI=unit_of_axes(space))
                    mesh.attrs.update(record.attributes)
                    for part in parts:
                        part.attrs.update(unitSI=float(record.slope), position=np.zeros(3))
        return asked(record, path, f"data/*/fields/{record.name}" if record.others else None) if not vector else \
            [path, "--array", "data/*/fields/v/y"]

    return write


def unit_of_axis(axis):
    return METERS[axis.unit]


container("HDF5 openPMD")(openpmd("1.1.0", lambda space: unit_of_axis(space[0])))
container("HDF5 openPMD 2", may=("all are given in",))(openpmd("2.0.0", lambda space: [unit_of_axis(axis) for axis in space]))


@container("HDF5 axistags", by_axis=True)
def hdf5_axistags(record, folder):
    path, flags = f"{folder}/v.h5", {"t": 8, "c": 1}
    with h5py.File(path, "w") as file:
        file["exported_data"] = record.values
        file["exported_data"].attrs["axistags"] = json.dumps({"axes": [
            {"key": axis.role, "typeFlags": flags.get(axis.role, 2), "resolution": axis.step() if axis.role != "c" else 0,
             "description": ""} for axis in record.axes]})
        file["exported_data"].attrs.update(record.attributes)
    return asked(record, path)


@container("HDF5 element_size_um", may=("is taken for time", "taken from element_size_um"), by_axis=True)
def hdf5_element_size(record, folder):
    path = f"{folder}/v.h5"
    with h5py.File(path, "w") as file:
        file["data"] = record.values
        file["data"].attrs["element_size_um"] = [record.axis(role).step() * METERS[record.axis(role).unit] / METERS["um"]
                                                 for role in "zyx"]
        file["data"].attrs.update(record.attributes)
    return asked(record, path)


# ---- Zarr
def plain_numbers(attributes):
    return {name: value if isinstance(value, (str, float)) else value.tolist() for name, value in attributes.items()}


def save_json(path, content):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as out:
        json.dump(content, out)


def zarr_2(path, values, attributes, fill=None):
    save_json(f"{path}/.zarray", dict(zarr_format=2, shape=values.shape, chunks=values.shape, dtype=values.dtype.str, order="C",
                                      fill_value=fill, compressor=None, filters=None))
    save_json(f"{path}/.zattrs", attributes)
    values.tofile(f"{path}/" + ".".join("0" * values.ndim))


def zarr_2_group(path, attributes):
    save_json(f"{path}/.zgroup", dict(zarr_format=2))
    save_json(f"{path}/.zattrs", attributes)


def zarr_3(path, values, attributes, fill=0, **more):
    kinds = {"U": ("fixed_length_utf32", dict(length_bytes=values.dtype.itemsize)),
             "M": ("numpy.datetime64", dict(unit="ns", scale_factor=1))}
    kind = kinds.get(values.dtype.kind)
    save_json(f"{path}/zarr.json", dict(
        zarr_format=3, node_type="array", shape=list(values.shape), attributes=attributes,
        data_type=dict(zip(("name", "configuration"), kind)) if kind else values.dtype.name,
        chunk_grid=dict(name="regular", configuration=dict(chunk_shape=list(values.shape))), fill_value=fill,
        chunk_key_encoding=dict(name="default", configuration=dict(separator="/")),
        codecs=[dict(name="bytes", configuration=dict(endian="little"))], **more))
    os.makedirs(f"{path}/c" + "/0" * (values.ndim - 1))
    values.tofile(f"{path}/c" + "/0" * values.ndim)


def with_coordinates(record, path, save):
    """As xarray writes it."""
    for axis in measured(record):
        save(f"{path}/{axis.variable}", coordinates(axis), attributes_of(axis), [axis.name])
    for name, values in record.curved.items():
        save(f"{path}/{name}", values, {}, [record.axis(role).name for role in "yx"])
    for name, values in arrays_of(record).items():
        said = plain_numbers(attributes_of_values(record) | record.fill)
        save(f"{path}/{name}", values, said, [axis.name for axis in record.axes])
    return asked(record, path)


@container("Zarr 2 xarray", by_axis=True)
def zarr_xarray(record, folder):
    path = f"{folder}/v.zarr"
    zarr_2_group(path, {})

    def save(where, values, attributes, names):
        fill = attributes.pop("_FillValue", None)
        zarr_2(where, values, dict(attributes, _ARRAY_DIMENSIONS=names), fill)

    return with_coordinates(record, path, save)


@container("Zarr 3 dimension_names", by_axis=True)
def zarr_dimension_names(record, folder):
    path = f"{folder}/v.zarr"
    save_json(f"{path}/zarr.json", dict(zarr_format=3, node_type="group", attributes={}))
    return with_coordinates(record, path, lambda where, values, attributes, names: zarr_3(where, values, attributes,
                                                                                          dimension_names=names))


def daisy_attributes(record):
    axes = measured(record)
    return dict(resolution=[axis.step() for axis in axes], offset=[float(axis.at[0]) for axis in axes],
                units=[axis.unit for axis in axes],
                axis_names=[axis.name + ("^" if axis.role == "c" else "") for axis in record.axes], **record.attributes)


@container("Zarr resolution", may=("taken from resolution",), by_axis=True)
def zarr_daisy(record, folder):
    zarr_2_group(f"{folder}/v.zarr", {})
    for name, values in arrays_of(record).items():
        zarr_2(f"{folder}/v.zarr/{name}", values, daisy_attributes(record))
    return asked(record, f"{folder}/v.zarr")


@container("HDF5 resolution", may=("taken from resolution",), by_axis=True)
def hdf5_daisy(record, folder):
    with h5py.File(f"{folder}/v.h5", "w") as file:
        for name, values in arrays_of(record).items():
            file[name] = values
            file[name].attrs.update(daisy_attributes(record))
    return asked(record, f"{folder}/v.h5")


OME_UNITS = {"mm": "millimeter", "um": "micrometer", "m": "meter", "s": "second", "ms": "millisecond", "degrees": "degree"}
def ome_axes(record):
    kinds = {"t": "time", "c": "channel"}
    axes = [dict(name=axis.name if axis.role in "xyz" else axis.role, type=kinds.get(axis.role, "space"),
                 **({"unit": OME_UNITS[axis.unit]} if axis.unit else {})) for axis in record.axes]
    steps = [axis.step() if axis.role != "c" else 1 for axis in record.axes]
    first = [float(axis.at[0]) if axis.role != "c" else 0 for axis in record.axes]
    return [dict(version="0.4", name="v", axes=axes, datasets=[dict(path="0", coordinateTransformations=[
        dict(type="scale", scale=steps), dict(type="translation", translation=first)])])]


def ome_asked(record, path):
    return [path, *(["--array", "c1"] if record.axis("c") else [])]


OMERO = dict(channels=[dict(label=f"c{number}") for number in range(3)])


@container("OME-Zarr 0.4", by_axis=True)
def ome_zarr_4(record, folder):
    path = f"{folder}/v.zarr"
    zarr_2_group(path, dict(multiscales=ome_axes(record), **({"omero": OMERO} if record.axis("c") else {})))
    zarr_2(f"{path}/0", record.values, record.attributes)
    return ome_asked(record, path)


@container("OME-Zarr 0.5", by_axis=True)
def ome_zarr_5(record, folder):
    path = f"{folder}/v.zarr"
    ome = dict(version="0.5", multiscales=ome_axes(record), **({"omero": OMERO} if record.axis("c") else {}))
    save_json(f"{path}/zarr.json", dict(zarr_format=3, node_type="group", attributes=dict(ome=ome)))
    names = [axis["name"] for axis in ome["multiscales"][0]["axes"]]
    zarr_3(f"{path}/0", record.values, record.attributes, dimension_names=names)
    return ome_asked(record, path)


# ---- XDMF and VTK
@container("XDMF")
def xdmf(record, folder):
    def item(values, more=""):
        return f'<DataItem Dimensions="{" ".join(map(str, np.shape(values)))}" {more} Format="XML">{numbers(values)}</DataItem>'

    space = [record.axis(role) for role in "xyz"]
    even = all(np.allclose(np.diff(axis.at), axis.step()) for axis in space)
    sizes = " ".join(str(len(axis.at)) for axis in space[::-1])
    if even:
        places = f'<Topology TopologyType="3DCoRectMesh" Dimensions="{sizes}"/><Geometry GeometryType="ORIGIN_DXDYDZ">' + \
            item([axis.at[0] for axis in space[::-1]]) + item([axis.step() for axis in space[::-1]]) + "</Geometry>"
    else:
        places = f'<Topology TopologyType="3DRectMesh" Dimensions="{sizes}"/><Geometry GeometryType="VXVYVZ">' + \
            "".join(item(axis.at) for axis in space) + "</Geometry>"
    kind = "Vector" if record.axis("c") else "Scalar"
    remarks = "".join(f'<Information Name="{name}" Value="{value}"/>' for name, value in record.attributes.items())
    grids = "".join(f'<Grid GridType="Uniform">{places}<Time Value="{time}"/>' + "".join(
        f'<Attribute Name="{name}" AttributeType="{kind}" Center="Node">'
        f'{item(values[number], more="""NumberType="Float" Precision="4" """)}{remarks}</Attribute>'
        for name, values in arrays_of(record).items()) + "</Grid>" for number, time in enumerate(record.axis("t").at))
    with open(f"{folder}/v.xmf", "w", encoding="utf-8") as out:
        out.write('<?xml version="1.0"?><Xdmf Version="3.0"><Domain><Grid GridType="Collection" CollectionType="Temporal">'
                  f"{grids}</Grid></Domain></Xdmf>")
    return asked(record, f"{folder}/v.xmf")


def numbers(values):
    return " ".join(f"{value:.17g}" for value in np.ravel(values))


def vtk_series(record, folder, kind, head, inside):
    """A .pvd with a file for each step."""
    extent = " ".join(f"0 {len(axis.at) - 1}" for axis in record.space())
    unit = f'<InformationKey name="UNITS_LABEL" location="vtkDataArray">{record.unit}</InformationKey>' if record.unit else ""
    remarks = "".join(f'<InformationKey name="{name}" location="x">{value}</InformationKey>'
                      for name, value in record.attributes.items())
    entries = ""
    for number, time in enumerate(record.axis("t").at):
        arrays = "".join(f'<DataArray type="Float32" Name="{name}" NumberOfComponents="{3 if record.axis("c") else 1}" '
                         f'format="ascii">{numbers(values[number])}{unit}{remarks}</DataArray>'
                         for name, values in arrays_of(record).items())
        file = f"v{number}.{'vti' if kind == 'ImageData' else 'vtr'}"
        with open(f"{folder}/{file}", "w", encoding="utf-8") as out:
            out.write(f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian"><{kind} WholeExtent="{extent}" {head}>'
                      f'<Piece Extent="{extent}"><PointData>{arrays}</PointData>{inside}</Piece></{kind}></VTKFile>')
        entries += f'<DataSet timestep="{time}" file="{file}"/>'
    with open(f"{folder}/v.pvd", "w", encoding="utf-8") as out:
        out.write(f'<VTKFile type="Collection" version="1.0"><Collection>{entries}</Collection></VTKFile>')
    return asked(record, f"{folder}/v.pvd")


@container("VTK .vti")
def vti(record, folder):
    steps, first = record.steps()
    lengths = [np.linalg.norm(step) for step in steps]
    across = np.transpose([step / length for step, length in zip(steps, lengths)])
    return vtk_series(record, folder, "ImageData", f'Origin="{numbers(first)}" Spacing="{numbers(lengths)}" '
                      f'Direction="{numbers(across)}"', "")


@container("VTK .vtr")
def vtr(record, folder):
    arrays = "".join(f'<DataArray type="Float64" Name="{axis.name}" format="ascii">{numbers(axis.at)}</DataArray>'
                     for axis in record.space())
    return vtk_series(record, folder, "RectilinearGrid", "", f"<Coordinates>{arrays}</Coordinates>")


@container("VTKHDF")
def vtkhdf(record, folder):
    path, (steps, first) = f"{folder}/v.vtkhdf", record.steps()
    lengths = [np.linalg.norm(step) for step in steps]
    with h5py.File(path, "w") as file:
        group = file.create_group("VTKHDF")
        group.attrs.create("Type", b"ImageData", dtype=h5py.string_dtype("ascii", 9))
        extent = np.ravel([[0, len(axis.at) - 1] for axis in record.space()])
        group.attrs.update(Version=[2, 0], WholeExtent=extent, Origin=first, Spacing=lengths, Direction=np.ravel(
            np.transpose([step / length for step, length in zip(steps, lengths)])))
        for name, values in arrays_of(record).items():
            group[f"PointData/{name}"] = values
            group[f"PointData/{name}"].attrs.update(record.attributes | ({"units": record.unit} if record.unit else {}))
        group["Steps/Values"] = np.asarray(record.axis("t").at, "f8")
        group["Steps"].attrs["NSteps"] = len(record.axis("t").at)
    return asked(record, path)


# ---- Medical
@container("NRRD", by_axis=True)
def nrrd(record, folder):
    path, fastest, (steps, first) = f"{folder}/v.nrrd", record.axes[::-1], record.steps()
    vectors = iter(f"({','.join(map(repr, map(float, step)))})" for step in steps)
    kinds = {"t": "time", "c": "vector"}
    time = record.axis("t")
    spaces = {"ras": "right-anterior-superior", "lps": "left-posterior-superior"}
    lines = ["type: " + {"f4": "float", "i2": "short"}[record.values.dtype.str[1:]], f"dimension: {len(fastest)}",
             "space: " + spaces[record.frame] if record.frame else "space dimension: 3",
             "sizes: " + " ".join(str(len(axis.at)) for axis in fastest),
             "kinds: " + " ".join(kinds.get(axis.role, "domain") for axis in fastest),
             "labels: " + " ".join(f'"{axis.name}"' for axis in fastest),
             "space directions: " + " ".join(next(vectors) if axis.role in "xyz" else "none" for axis in fastest),
             f"space origin: ({','.join(map(repr, map(float, first)))})",
             "space units: " + " ".join(f'"{record.axis(role).unit}"' for role in "xyz"),
             "spacings: " + " ".join(str(axis.step()) if axis is time else "NaN" for axis in fastest),
             "axis mins: " + " ".join(str(axis.at[0]) if axis is time else "NaN" for axis in fastest),
             "units: " + " ".join(f'"{axis.unit if axis is time else ""}"' for axis in fastest),
             "endian: little", "encoding: raw"]
    if record.unit:
        lines.append(f"sample units: {record.unit}")
    lines += [f"{name}:={value}" for name, value in record.attributes.items()]
    with open(path, "wb") as out:
        out.write(("NRRD0005\n" + "\n".join(lines) + "\n\n").encode() + record.values.tobytes())
    return asked(record, path)


@container("NIfTI-1")
def nifti(record, folder):
    path, (steps, first) = f"{folder}/v.nii", record.steps("ras")
    values, time = record.values, record.axis("t")
    header = nibabel.Nifti1Header()
    if record.axis("c"):
        values = values.swapaxes(0, 1)  # time is the fourth axis of a file, its components are the fifth
        header.set_intent("vector")
    header.set_data_dtype(values.dtype)
    header.set_data_shape(values.shape[::-1])
    header.set_sform(np.vstack([np.transpose([*steps, first]), [0, 0, 0, 1]]), "scanner")
    codes = {"": 0, "mm": 2, "um": 3, "m": 1, "s": 8, "ms": 16}
    header["xyzt_units"] = codes[record.axis("x").unit] | codes[time.unit]
    header["toffset"], header["pixdim"][4] = time.at[0], time.step()
    header["descrip"] = "; ".join(f"{name}: {value}" for name, value in record.attributes.items())
    header.set_slope_inter(record.slope, record.offset)
    header["vox_offset"], header["magic"] = 352, b"n+1"
    with open(path, "wb") as out:
        out.write(header.binaryblock + bytes(4) + values.tobytes())
    return asked(record, path)


@container("MetaImage")
def metaimage(record, folder):
    steps, first = record.steps("lps")
    time, lengths = record.axis("t"), [np.linalg.norm(step) for step in steps]
    matrix = np.eye(4)
    matrix[:3, :3] = [step / length for step, length in zip(steps, lengths)]
    kind = {"f4": "MET_FLOAT", "i2": "MET_SHORT"}[record.values.dtype.str[1:]]
    lines = ["ObjectType = Image", "NDims = 4", "DimSize = " + " ".join(str(len(axis.at)) for axis in [*record.space(), time]),
             "BinaryData = True", "BinaryDataByteOrderMSB = False", f"TransformMatrix = {numbers(matrix)}",
             f"Offset = {numbers([*first, time.at[0]])}", f"ElementSpacing = {numbers([*lengths, time.step()])}",
             f"DistanceUnits = {record.axis('x').unit}", f"ElementNumberOfChannels = {3 if record.axis('c') else 1}",
             f"ElementType = {kind}"]
    lines += [f"{name} = {value}" for name, value in record.attributes.items()]
    with open(f"{folder}/v.mha", "wb") as out:
        out.write(("\n".join(lines) + "\nElementDataFile = LOCAL\n").encode() + record.values.tobytes())
    return asked(record, f"{folder}/v.mha")


def decimals(values):
    return [DSfloat(float(value), auto_format=True) for value in values]


@container("DICOM", may=("steps by TriggerTime",))
def dicom(record, folder):
    steps, first = record.steps("lps", "mm")
    columns, rows = [np.linalg.norm(step) for step in steps[:2]]
    slow = record.space()[2]
    along = steps[2] / np.linalg.norm(steps[2])
    ratio = slow.in_unit("mm")[0] / slow.at[0] if slow.at[0] else 1
    values = record.volumes()
    for t, time in enumerate(record.axis("t").in_unit("ms")):
        for s in range(values.shape[1]):
            meta = FileMetaDataset()
            meta.MediaStorageSOPClassUID = "1.2.840.10008.5.1.4.1.1.4"
            meta.MediaStorageSOPInstanceUID = f"1.2.826.0.1.3680043.9.{t + 1}.{s + 1}"
            meta.TransferSyntaxUID = pydicom.uid.ExplicitVRLittleEndian
            data = FileDataset(None, {}, file_meta=meta, preamble=b"\0" * 128)
            data.is_little_endian, data.is_implicit_VR = True, False
            data.SOPClassUID, data.SOPInstanceUID = meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID
            data.SeriesInstanceUID, data.Modality, data.SeriesDescription = "1.2.826.0.1.3680043.9.9", "MR", "v"
            data.Rows, data.Columns, data.SamplesPerPixel = *values.shape[2:], 1
            data.PhotometricInterpretation, data.BitsAllocated, data.BitsStored, data.HighBit = "MONOCHROME2", 16, 16, 15
            data.PixelRepresentation = 1
            data.PixelData = values[t, s].astype("<i2").tobytes()
            data.PixelSpacing = decimals([rows, columns])
            data.ImageOrientationPatient = decimals([*(steps[0] / columns), *(steps[1] / rows)])
            data.ImagePositionPatient = decimals(first + abs(slow.at[s] - slow.at[0]) * ratio * along)
            data.TriggerTime, data.InstanceNumber = *decimals([time]), t * values.shape[1] + s + 1
            if record.slope != 1:
                data.RescaleSlope, data.RescaleIntercept = record.slope, record.offset
            if record.unit:
                data.Units = record.unit
            if record.fill:
                data.PixelPaddingValue = int(record.fill["_FillValue"])
            data.save_as(f"{folder}/{t}_{s}.dcm", write_like_original=False)
    return asked(record, folder)


# ---- Images
@container("ImageJ TIFF")
def imagej(record, folder):
    x, y, z = (record.axis(role) for role in "xyz")
    units = dict(unit=x.unit) if x.unit == y.unit == z.unit else dict(unit=x.unit, yunit=y.unit, zunit=z.unit)
    said = dict(axes="TZYX", spacing=z.step(), finterval=record.axis("t").step(), tunit=record.axis("t").unit,
                xorigin=-x.at[0] / x.step(), yorigin=-y.at[0] / y.step(), zorigin=-z.at[0] / z.step(), **units,
                **record.attributes)
    values = record.values
    if record.axis("c"):
        said["axes"], values = "TZCYX", values.transpose(0, 2, 1, 3, 4)
    if record.slope != 1 or record.unit:  # integers, calibrated by a straight line
        said.update(cf=0, c0=record.offset - 32768 * record.slope, c1=record.slope, vunit=record.unit or "Gray Value")
        values = (values.astype("i4") + 32768).astype("u2")
    tifffile.imwrite(f"{folder}/v.tif", values, imagej=True, resolution=(1 / x.step(), 1 / y.step()), metadata=said)
    return [f"{folder}/v.tif", *(["--array", "channel 1"] if record.axis("c") else [])]


@container("OME-TIFF")
def ome_tiff(record, folder):
    roles = "".join(axis.role for axis in record.axes)
    time = record.axis("t")
    said = dict(axes=roles.upper(), TimeIncrement=time.step(), TimeIncrementUnit=time.unit)
    for role in "xyz":
        axis = record.axis(role)
        said[f"PhysicalSize{role.upper()}"] = axis.step()
        said[f"PhysicalSize{role.upper()}Unit"] = {"um": "\u00b5m"}.get(axis.unit, axis.unit)
    planes = [len(axis.at) for axis in record.axes if axis.role in "tzc"]
    of_planes = np.indices(planes)[[role for role in roles if role in "tzc"].index("t")].ravel()
    if time.at[0] or not np.allclose(np.diff(time.at), time.step()):
        del said["TimeIncrement"], said["TimeIncrementUnit"]
        said["Plane"] = dict(DeltaT=[float(time.at[t]) for t in of_planes], DeltaTUnit=[time.unit] * len(of_planes))
    if record.axis("c"):
        said["Channel"] = dict(Name=["c0", "c1", "c2"])
    tifffile.imwrite(f"{folder}/v.ome.tif", record.values, photometric="minisblack", metadata=said)
    return [f"{folder}/v.ome.tif", *(["--array", "c1"] if record.axis("c") else [])]


@container("BOV")
def bov(record, folder):
    space = [record.axis(role) for role in "xyz"]
    files = []
    for number, time in enumerate(record.axis("t").at):
        record.values[number].tofile(f"{folder}/v{number}.bin")
        files.append(f"{folder}/v{number}.bov")
        remarks = "".join(f"{name}: {value}\n" for name, value in record.attributes.items())
        with open(files[-1], "w", encoding="utf-8") as out:
            out.write(f"TIME: {time}\nDATA_FILE: v{number}.bin\nDATA_SIZE: {' '.join(str(len(axis.at)) for axis in space)}\n"
                      f"DATA_FORMAT: FLOAT\nVARIABLE: v\nDATA_ENDIAN: LITTLE\nCENTERING: nodal\n"
                      f"BRICK_ORIGIN: {numbers([axis.at[0] for axis in space])}\n"
                      f"BRICK_SIZE: {numbers([axis.at[-1] - axis.at[0] for axis in space])}\n"
                      f"DATA_COMPONENTS: {3 if record.axis('c') else 1}\n{remarks}")
    return [*files, *asked(record, "")[1:]]


# ---- Formats of one field each
def write_steps(record, folder, ending, write):
    """A file for each step."""
    files = []
    for number, values in enumerate(record.volumes()):
        files.append(f"{folder}/v{number}.{ending}")
        write(files[-1], values)
    return [*files, *asked(record, "")[1:]]


@container("MRC")
def mrc(record, folder):
    def write(path, values):
        space = [record.axis(role) for role in "xyz"]
        cell = [axis.step() * METERS[axis.unit] / METERS["angstrom"] * len(axis.at) for axis in space]
        origin = [axis.in_unit("angstrom")[0] for axis in space]
        header = np.zeros(256, "<i4")
        header[:4] = *values.shape[::-1], {"f4": 2, "i2": 1}[values.dtype.str[1:]]
        header[7:10] = [len(axis.at) for axis in space]
        header[10:16] = np.array([*cell, 90, 90, 90], "<f4").view("<i4")
        header[16:19] = ["xyz".index(axis.role) + 1 for axis in record.space()]
        header[27], header[52], header[53] = 20140, int.from_bytes(b"MAP ", "little"), 0x4444
        header[49:52] = np.array(origin, "<f4").view("<i4")
        with open(path, "wb") as out:
            out.write(header.tobytes() + values.tobytes())

    return write_steps(record, folder, "mrc", write)


@container("MGH")
def mgh(record, folder):
    steps, first = record.steps("ras", "mm")
    values, sizes = record.values, [len(axis.at) for axis in record.space()]
    lengths = [np.linalg.norm(step) for step in steps]
    head = np.array([1, *sizes, len(values), {"f4": 3, "i2": 4}[values.dtype.str[1:]], 0], ">i4").tobytes()
    places = [*lengths, *np.ravel([step / length for step, length in zip(steps, lengths)]),
              *(first + sum(step * size / 2 for step, size in zip(steps, sizes)))]
    head += np.array(1, ">i2").tobytes() + np.array(places, ">f4").tobytes()
    interval = record.axis("t").step() * (1e3 if record.axis("t").unit == "s" else 1)
    with open(f"{folder}/v.mgh", "wb") as out:
        out.write(head.ljust(284, b"\0") + values.astype(values.dtype.newbyteorder(">")).tobytes()
                  + np.array([interval, 0, 0, 0, 0], ">f4").tobytes())
    return asked(record, f"{folder}/v.mgh")


@container("Gaussian cube")
def cube(record, folder):
    steps, first = record.steps("", "angstrom")
    components = 3 if record.axis("c") else 1

    def write(path, values):
        lines = ["title", "another", f"0 {numbers(first)} {components}"]
        lines += [f"{-len(axis.at)} {numbers(step)}" for axis, step in reversed(list(zip(record.space(), steps)))]
        with open(path, "w", encoding="utf-8") as out:
            out.write("\n".join([*lines, numbers(values)]) + "\n")

    return write_steps(record, folder, "cube", write)


@container("BigDataViewer", may=("stores unsigned values as i16",))
def bigdataviewer(record, folder):
    size = numbers([record.axis(role).step() for role in "xyz"])
    with h5py.File(f"{folder}/v.h5", "w") as file:
        file["s00/resolutions"], file["s00/subdivisions"] = np.ones((1, 3)), np.array([[8, 8, 8]])
        for number, values in enumerate(record.volumes()):
            file[f"t{number:05d}/s00/0/cells"] = values.astype("i2")
    with open(f"{folder}/v.xml", "w", encoding="utf-8") as out:
        out.write(f'<SpimData version="0.2"><SequenceDescription><ViewSetups><ViewSetup><id>0</id><voxelSize><unit>'
                  f'{record.axis("x").unit}</unit><size>{size}</size></voxelSize></ViewSetup></ViewSetups>'
                  "</SequenceDescription></SpimData>")
    return asked(record, f"{folder}/v.h5")


@container("EnSight", may=("resampled", "array v "))
def ensight(record, folder):
    """Read as a mesh: it is sampled at its own vertices."""
    space, time = [record.axis(role) for role in "xyz"], record.axis("t")
    sizes = [len(axis.at) for axis in space]

    def column(values):
        return "".join(f"{value:12.5e}\n" for value in np.ravel(values))

    with open(f"{folder}/v.geo", "w", encoding="utf-8") as out:
        out.write(f"a\nb\nnode id off\nelement id off\npart\n{1:10d}\nblock\nblock uniform\n" + "".join(
            f"{size:10d}" for size in sizes) + "\n" + column([axis.at[0] for axis in space] + [axis.step() for axis in space]))
    for number, values in enumerate(record.volumes()):
        with open(f"{folder}/v.scl{number:03d}", "w", encoding="utf-8") as out:
            out.write(f"v\npart\n{1:10d}\nblock\n" + column(values))
    with open(f"{folder}/v.case", "w", encoding="utf-8") as out:
        out.write("FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: v.geo\nVARIABLE\nscalar per node: v v.scl***\nTIME\ntime set: 1\n"
                  f"number of steps: {len(time.at)}\nfilename start number: 0\nfilename increment: 1\n"
                  f"time values: {numbers(time.at)}\n")
    return [f"{folder}/v.case", "--resample", *sizes]


# ---- A group for each step, with its time in an array of one value
def in_groups(record, save):
    """save(group, name, values, attributes, names of dimensions)"""
    space = [axis for axis in record.axes if axis.role != "t"]
    for axis in space:
        save("", axis.variable, coordinates(axis), attributes_of(axis), [axis.name])
    time = record.axis("t")
    for number, values in enumerate(record.volumes()):
        save(f"step{number}", record.name, values, attributes_of_values(record) | record.fill, [axis.name for axis in space])
        if time.name:
            save(f"step{number}", "time", coordinates(time)[number:number + 1], attributes_of(time), [])


@container("NetCDF groups")
def netcdf_groups(record, folder):
    with netCDF4.Dataset(f"{folder}/v.nc", "w") as file:
        for axis in record.axes:
            if axis.role != "t":
                file.createDimension(axis.name, len(axis.at))

        def save(group, name, values, attributes, names):
            text = values.dtype.kind == "U"
            variable = (file.createGroup(group) if group else file).createVariable(
                name, str if text else values.dtype, names, fill_value=attributes.get("_FillValue"))
            variable.set_auto_maskandscale(False)
            variable[...] = values.astype(object)[0] if text else values if names else values[0]
            variable.setncatts({name: value for name, value in attributes.items() if name != "_FillValue"})

        in_groups(record, save)
    return [f"{folder}/v.nc"]


@container("HDF5 groups")
def hdf5_groups(record, folder):
    with h5py.File(f"{folder}/v.h5", "w") as file:
        def save(group, name, values, attributes, names):
            where = f"{group}/{name}"
            file[where] = values.astype("S") if values.dtype.kind == "U" else values
            file[where].attrs.update(attributes)
            if not group:
                file[where].make_scale(name)
            for i, label in enumerate(names if group else []):
                file[where].dims[i].label = label
                file[where].dims[i].attach_scale(file[label])

        in_groups(record, save)
    return [f"{folder}/v.h5"]


@container("Zarr groups")
def zarr_groups(record, folder):
    zarr_2_group(f"{folder}/v.zarr", {})

    def save(group, name, values, attributes, names):
        if group:
            zarr_2_group(f"{folder}/v.zarr/{group}", {})
        said = plain_numbers(attributes)
        zarr_2(f"{folder}/v.zarr/{group}/{name}", values, dict(said, _ARRAY_DIMENSIONS=names or ["one"]),
               said.pop("_FillValue", None))

    in_groups(record, save)
    return [f"{folder}/v.zarr"]
