"""Names that other packages have for what is here: whoever asks for one is told what it is called."""

from __future__ import annotations

from collections.abc import Mapping

MESH = {
    **dict.fromkeys(("n_points", "number_of_points"), "len(mesh.points)"),
    **dict.fromkeys(("n_cells", "n_faces", "n_faces_strict", "number_of_cells"), "len(mesh.faces)"),
    **dict.fromkeys(("vertices", "verts"), "mesh.points, or mesh.places in the data's coordinates"),
    **dict.fromkeys(("triangles", "cells", "simplices", "regular_faces"), "mesh.faces"),
    **dict.fromkeys(("save", "write"), "run.export(name, isovalue), or mesh.to_pyvista().save(name)"),
    **dict.fromkeys(("compute_normals", "point_normals"), "mesh.normals, of run.mesh(isovalue, normals=True)"),
    **dict.fromkeys(("point_data", "scalars"), "mesh.values, of run.mesh(isovalue, values=name)"),
    **dict.fromkeys(("decimate", "decimate_pro", "simplify"), "run.export(name, isovalue, simplify=distance)"),
    **dict.fromkeys(("connectivity", "split_bodies"), "run.pieces(isovalue, step)"),
    "volume": "run.measure(isovalue, step)['volume']",
    "plot": "mesh.to_pyvista().plot()",
}

RUN = {
    **dict.fromkeys(("contour", "isosurface", "marching_cubes", "surface"), "run.mesh(isovalue, step)"),
    **dict.fromkeys(("sel", "isel", "interp", "coords", "to_dataset"), "run.to_xarray(), which has it"),
    **dict.fromkeys(("slice", "data", "read", "load"), "run.values(step, z, y, x)"),
    **dict.fromkeys(("min", "max"), "run.range()"),
    **dict.fromkeys(("plot", "show", "picture"), "run.render({'step': 7, 'isovalue': 0.5})"),
    **dict.fromkeys(("variables", "data_vars", "array_names"), "run.arrays"),
    **dict.fromkeys(("save", "write"), "run.export(name, isovalue)"),
    **dict.fromkeys(("n_steps", "number_of_steps"), "len(run)"),
    **dict.fromkeys(("time", "steps"), "run.times"),
    **dict.fromkeys(("sample_over_line", "line"), "run.profile(a, b)"),
    "dims": "run.shape",
}

DATA = {
    **dict.fromkeys(("contour", "isosurface", "surface"), "data.isochron.mesh(isovalue)"),
    **dict.fromkeys(("measure", "measures", "pieces", "profile", "export", "render", "change"), "data.isochron.run, which has it"),
    "open": "data.isochron.run",
}


def unknown(thing: object, name: str, known: Mapping[str, str]) -> AttributeError:
    line = f"{type(thing).__name__!r} object has no attribute {name!r}"
    return AttributeError(f"{line}: here it is {known[name]}" if name in known else line)
