"""Other people's files in tests/data/formats, each read by the library of its format."""
import bz2
import gzip
import os
import warnings
import zlib

import h5py
import netCDF4
import nibabel
import numpy as np
import tifffile
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from manifest import done, expect, refuse

warnings.simplefilter("ignore")
formats = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "data", "formats")


def real(name):
    return os.path.join(formats, name)


def content(name):
    with open(real(name), "rb") as file:
        return file.read()


# VTK: every array but the flags; of vectors a component and the length.
reader = vtk.vtkXMLImageDataReader()
reader.SetFileName(real("flow.vti"))
reader.Update()
flow = reader.GetOutput()
where = dict(spacing=flow.GetSpacing(), origin=flow.GetOrigin())
refuse(real("flow.vti"), "several arrays, choose one with --array: FlowDensity (f64)")
for number in range(flow.GetPointData().GetNumberOfArrays()):
    array = flow.GetPointData().GetArray(number)
    name, values = array.GetName(), vtk_to_numpy(array)
    if name == "vtkGhostType":
        continue
    if array.GetNumberOfComponents() == 1:
        expect(real("flow.vti"), values.reshape(10, 10, 10), array=name, **where)
        continue
    expect(real("flow.vti"), values[:, 1].reshape(10, 10, 10), array=name, component="1", **where)
    expect(real("flow.vti"), np.sqrt((values ** 2).sum(1)).reshape(10, 10, 10), array=name, component="magnitude",
           kind="rounded", **where)

# nibabel, which works in the same space.
for name in ("example4d.nii.gz", "functional.nii", "anatomical.nii", "BallBinary30x30x30.nii.gz"):
    image = nibabel.load(real(name))
    steps = image.affine[:3, :3]
    lengths = np.linalg.norm(steps, axis=0)
    values = np.transpose(np.asarray(image.dataobj, dtype="f8"))
    zooms = image.header.get_zooms()
    times = np.arange(len(values)) * zooms[3] if values.ndim == 4 and zooms[3] > 0 else None
    placed = image.header["qform_code"] > 0 or image.header["sform_code"] > 0
    expect(real(name), values, spacing=lengths if placed else zooms[:3], origin=image.affine[:3, 3] if placed else (0, 0, 0),
           direction=(steps / lengths).T.tolist() if placed else None, times=times, kind="rounded")
refuse(real("5D_small.nii"), "5D_small.nii: ")

# NRRD and MetaImage: plain values behind text, by numpy.
ball = np.frombuffer(content("BallBinary30x30x30.raw"), "<i2").reshape(30, 30, 30)
for name in ("BallBinary30x30x30.nhdr", "BallBinary30x30x30.nrrd", "BallBinary30x30x30_gz.nrrd",
             "BallBinary30x30x30_bz2.nrrd"):
    expect(real(name), ball)
body = {name: content(name).split(b"\n\n", 1)[1] for name in ("BallBinary30x30x30_gz.nrrd", "BallBinary30x30x30_bz2.nrrd")}
assert gzip.decompress(body["BallBinary30x30x30_gz.nrrd"]) == ball.tobytes()
assert bz2.decompress(body["BallBinary30x30x30_bz2.nrrd"]) == ball.tobytes()
refuse(real("BallBinary30x30x30_nifti.nhdr"), "352 bytes follow the values", reads=True)
for name, message in (("test1d_ascii.nrrd", "1 dimensions"), ("test2d_ascii.nrrd", "2 dimensions"),
                      ("test_customFields.nrrd", "1 dimensions")):
    refuse(real(name), message)
lung = content("3DCT_lung_baseline_small.mha")
header, packed = lung.split(b"ElementDataFile = LOCAL\n", 1)
header = dict(line.split(" = ", 1) for line in header.decode().splitlines())
sizes = [int(n) for n in header["DimSize"].split()]
expect(real("3DCT_lung_baseline_small.mha"), np.frombuffer(zlib.decompress(packed), "<i2").reshape(sizes[::-1]),
       spacing=[float(n) for n in header["ElementSpacing"].split()], origin=[float(n) for n in header["Offset"].split()])

# NetCDF: positions are those of the coordinate variables, z upwards.
for name, array, scale, up in (("foam.ocean.nc", "V", 100, 1), ("vinth2p.nc", "T", 10, -1)):
    with netCDF4.Dataset(real(name)) as file:
        x, y, z = (file[axis][:].astype("f8").filled() for axis in ("lon", "lat", "lev"))
        z = up * z / scale
        values = np.ma.filled(file[array][:].astype("f8"), np.nan)
        times = file["time"][:]
    axes = (x, y, z)
    expect(real(name), values, origin=[at[0] for at in axes], times=times, positions=[at.tolist() for at in axes],
           spacing=[abs(at[-1] - at[0]) / (len(at) - 1) for at in axes], direction=[[1, 0, 0], [0, 1, 0], [0, 0, up]])
with netCDF4.Dataset(real("small_theta_colpex.nc")) as file:
    name = "air_potential_temperature"
    along = file[name].dimensions
    z, y, x = (file[dimension][:].astype("f8").filled() for dimension in along[-3:])
    z = z / 100
    times = file[along[0]][:]
    values = np.ma.filled(file[name][:].astype("f8"), np.nan)
    expect(real("small_theta_colpex.nc"), values, origin=(x[0], y[0], z[0]), times=times,
           positions=[x.tolist(), y.tolist(), z.tolist()], spacing=[(at[-1] - at[0]) / (len(at) - 1) for at in (x, y, z)])

# openPMD: the first dimension is x.
with h5py.File(real("example-femm-3d.h5")) as file:
    mesh = file["data/1/meshes/B"]
    order = [label.decode() for label in mesh.attrs["axisLabels"]]
    unit = mesh.attrs["gridUnitSI"]
    offset = dict(zip(order, mesh.attrs["gridGlobalOffset"] * unit))
    refuse(real("example-femm-3d.h5"), "several arrays, choose one with --array: /data/1/meshes/B/x (f64, 47 x 47 x 47)")
    for component in mesh:
        data = mesh[component]
        expect(real("example-femm-3d.h5"), data[...] * data.attrs["unitSI"], array=data.name, times=[0],
               spacing=(mesh.attrs["gridSpacing"] * unit)[::-1], origin=[offset[axis] for axis in "xyz"],
               direction=[[float(axis == label) for axis in "xyz"] for label in order[::-1]])

# ImageJ: resolution is pixels for each unit.
for name in ("xyz_8bit_calibrated_anisotropic__mri_head.tif", "xyz_calibrated_16bit__golgi_bfa.tif"):
    with tifffile.TiffFile(real(name)) as file:
        tags = file.pages[0].tags
        width, height = (tags[tag].value[1] / tags[tag].value[0] for tag in ("XResolution", "YResolution"))
        expect(real(name), file.asarray(), spacing=(width, height, file.imagej_metadata["spacing"]))
done()
