"""CGNS on HDF5: a structured zone of 5 x 4 x 3 vertices."""
import h5py
import numpy as np


def node(parent, name, label, kind, data=None):
    group = parent.create_group(name, track_order=True)
    group.attrs.create("name", np.bytes_(name.ljust(32, "\0")), dtype="S33")
    group.attrs.create("label", np.bytes_(label.ljust(32, "\0")), dtype="S33")
    group.attrs.create("type", np.bytes_(kind), dtype="S3")
    group.attrs.create("flags", np.array([1], "i4"))
    if data is not None:
        group.create_dataset(" data", data=data)
    return group


def words(value):
    return np.frombuffer(value.encode(), "i1")


def write_zone(name, scale, density, where="Vertex", of_base=lambda base: None, of_zone=lambda zone: None):
    """scale: the distance of vertices along x; density: of x, y and z, values at `where`."""
    with h5py.File(name, "w", track_order=True, libver=("earliest", "v108")) as file:
        file.attrs.create("name", np.bytes_("HDF5 MotherNode".ljust(32, "\0")), dtype="S33")
        file.attrs.create("label", np.bytes_("Root Node of HDF5 File".ljust(32, "\0")), dtype="S33")
        file.attrs.create("type", np.bytes_("MT"), dtype="S3")
        file.create_dataset(" format", data=words("IEEE_LITTLE_32"))
        file.create_dataset(" hdf5version", data=words("HDF5 Version 1.10.8".ljust(33, "\0")))
        node(file, "CGNSLibraryVersion", "CGNSLibraryVersion_t", "R4", np.array([3.3], "f4"))
        base = node(file, "Base", "CGNSBase_t", "I4", np.array([3, 3], "i4"))
        of_base(base)
        zone = node(base, "Zone", "Zone_t", "I4", np.array([[5, 4, 3], [4, 3, 2], [0, 0, 0]], "i4"))
        node(zone, "ZoneType", "ZoneType_t", "C1", words("Structured"))
        places = node(zone, "GridCoordinates", "GridCoordinates_t", "MT")
        z, y, x = np.meshgrid(np.arange(3.0), np.arange(4.0), scale * np.arange(5.0), indexing="ij")
        for axis, at in zip("XYZ", (x, y, z)):
            node(places, "Coordinate" + axis, "DataArray_t", "R8", at)
        solution = node(zone, "Solution", "FlowSolution_t", "MT")
        node(solution, "GridLocation", "GridLocation_t", "C1", words(where))
        node(solution, "Density", "DataArray_t", "R8", density(x, y, z))
        of_zone(zone)
