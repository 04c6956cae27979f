"""A surface as arrays, and as other packages have it."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._elsewhere import MESH, unknown


class Mesh(tuple[NDArray[Any], NDArray[np.uint32]]):
    """The points (N, 3) and the triangles (M, 3) of a surface, as a pair: `points, faces = run.mesh(...)`.

    It also has what else was asked for, and `origin`, which points of single precision count from.
    """

    normals: NDArray[np.float32] | None
    values: NDArray[np.float32] | None
    origin: tuple[float, float, float]
    isovalue: float
    values_name: str

    def __new__(
        cls,
        points: NDArray[Any],
        faces: NDArray[np.uint32],
        *,
        normals: NDArray[np.float32] | None = None,
        values: NDArray[np.float32] | None = None,
        origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
        isovalue: float = float("nan"),
        values_name: str = "values",
    ) -> Mesh:
        mesh = super().__new__(cls, (points, faces))  # type: ignore[arg-type]
        mesh.normals = normals
        mesh.values = values
        mesh.origin = origin
        mesh.isovalue = isovalue
        mesh.values_name = values_name
        return mesh

    @property
    def points(self) -> NDArray[Any]:
        """(N, 3), along x, y and z, less `origin`."""
        points: NDArray[Any] = self[0]
        return points

    @property
    def faces(self) -> NDArray[np.uint32]:
        """(M, 3), numbers of points, counter-clockwise as seen from the side of lower values."""
        return self[1]

    @property
    def places(self) -> NDArray[np.float64]:
        """The points in the data's coordinates: (N, 3), in double precision."""
        places: NDArray[np.float64] = np.add(self.points, self.origin, dtype=np.float64)
        return places

    @property
    def area(self) -> float:
        """Of all triangles, in the square of the unit of length."""
        a, b, c = (self.points[self.faces[:, corner]].astype(np.float64) for corner in range(3))
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)

    @property
    def bounds(self) -> tuple[float, float, float, float, float, float]:
        """Least and greatest place along x, y and z, as VTK orders them; NaN without a point."""
        if not len(self.points):
            return (float("nan"),) * 6
        low, high = self.places.min(0), self.places.max(0)
        return float(low[0]), float(high[0]), float(low[1]), float(high[1]), float(low[2]), float(high[2])

    def to_vtk(self) -> Any:
        """As vtkPolyData, in the data's coordinates, with the normals and the values that the mesh has.

        Needs the package vtk (Debian: python3-vtk9).
        """
        support = import_module("vtkmodules.util.numpy_support")
        model = import_module("vtkmodules.vtkCommonDataModel")
        numpy_to_vtk, numpy_to_ids = support.numpy_to_vtk, support.numpy_to_vtkIdTypeArray
        surface, triangles = model.vtkPolyData(), model.vtkCellArray()
        points = import_module("vtkmodules.vtkCommonCore").vtkPoints()
        points.SetData(numpy_to_vtk(self._placed(), deep=True))
        starts = np.arange(0, 3 * len(self.faces) + 1, 3, dtype=np.int64)
        triangles.SetData(
            numpy_to_ids(starts, deep=True),
            numpy_to_ids(self.faces.ravel().astype(np.int64), deep=True),
        )
        surface.SetPoints(points)
        surface.SetPolys(triangles)
        if self.normals is not None:
            normals = numpy_to_vtk(self.normals, deep=True)
            normals.SetName("Normals")
            surface.GetPointData().SetNormals(normals)
        if self.values is not None:
            values = numpy_to_vtk(self.values, deep=True)
            values.SetName(self.values_name)
            surface.GetPointData().SetScalars(values)
        return surface

    def to_pyvista(self) -> Any:
        """As pyvista.PolyData, which plots it: `run.mesh(0.5).to_pyvista().plot()`. Needs the package pyvista."""
        return import_module("pyvista").PolyData(self.to_vtk())

    def _placed(self) -> NDArray[Any]:
        if self.points.dtype == np.float64 or not any(self.origin) or not len(self.points):
            return self.places.astype(self.points.dtype)
        placed = self.places
        single: NDArray[Any] = placed.astype(np.float32)
        # Double precision where single would round the shape away.
        close = np.abs(single - placed).max(initial=0) <= 1e-6 * np.ptp(self.points, axis=0).max(initial=0)
        return single if close else placed

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            raise unknown(self, name, MESH)

    def __reduce__(self) -> tuple[Any, ...]:
        return _made, (self[0], self[1], self.__dict__)

    def __repr__(self) -> str:
        return f"<isochron.Mesh at {self.isovalue:g}: {len(self.points)} points, {len(self.faces)} triangles>"

    def _repr_html_(self) -> str:
        more = [name for name, there in (("normals", self.normals), (self.values_name, self.values)) if there is not None]
        low, high = (self.places.min(0), self.places.max(0)) if len(self.points) else (np.zeros(0), np.zeros(0))
        from ._html import table

        return table(
            f"Surface at {self.isovalue:g}",
            {
                "points": f"{len(self.points):,}",
                "triangles": f"{len(self.faces):,}",
                "with": ", ".join(more) or "no normals",
                "from": ", ".join(f"{at:g}" for at in low),
                "to": ", ".join(f"{at:g}" for at in high),
            },
        )


def _made(points: NDArray[Any], faces: NDArray[np.uint32], more: dict[str, Any]) -> Mesh:
    return Mesh(points, faces, **more)
