"""Moments, isovalues and arguments as people write them, and what comes back."""

import ast
import copy
import datetime
import os
import pickle
import re
import subprocess
import unittest
import warnings
from fractions import Fraction

import numpy as np
import xarray

import isochron
from made_series import ORIGIN, SHAPE, STEPS, SeriesTest, active_cells, program

WHOLE = [int, np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64, np.asarray]
REAL = [float, np.float16, np.float32, np.float64, np.longdouble, Fraction, lambda value: np.asarray(float(value))]


class Scalars(SeriesTest):
    def everything(self, isovalue, step, fraction, size):
        """What each function answers to these numbers."""
        run = self.run_
        yield "cells", run.cells(isovalue, step, fraction=fraction)
        yield "cells of a list", run.cells([isovalue, isovalue], step, fraction=fraction)
        yield "cells of a step", run[step].cells(isovalue, fraction=fraction)
        yield "cells of a level", run.cells(isovalue, step, level=step)
        yield "change", run.change(isovalue, step, step, isovalue, fraction=fraction, to_fraction=fraction)
        yield "mesh", tuple(run.mesh(isovalue, step, fraction=fraction, normals=True))
        yield "mesh of a step", tuple(run[step].mesh(isovalue))
        yield "values", run.values(step, step, slice(step, size, step), step, fraction=fraction)
        yield "first crossings", run.first_crossings(isovalue)
        yield "step at", run.step_at(step)
        yield "time", run.cells(isovalue, time=step)

    def test_of_numpy_are_numbers(self):
        expected = dict(self.everything(1, 1, 16, 9))
        self.assertEqual(len(expected), 11)
        for kind in WHOLE:
            for name, answer in self.everything(kind(1), kind(1), kind(16), kind(9)):
                with self.subTest(name, kind=kind):
                    np.testing.assert_equal(answer, expected[name])
        for kind in REAL:
            for name, answer in self.everything(kind(1), 1, kind(16) / 65536, 9):
                with self.subTest(name, kind=kind):
                    np.testing.assert_equal(answer, expected[name])

    def test_isovalues_that_are_no_numbers_are_refused_everywhere(self):
        run = self.run_
        for value in (np.nan, np.inf, -np.inf, np.float32("nan"), "7", None, b"7", [1, np.nan], object()):
            for call in (run.cells, run[0].cells, run.mesh, run[0].mesh, run.change, run.first_crossings,
                         lambda isovalue: run.export("e.ply", isovalue), lambda isovalue: run.change(1, to_isovalue=isovalue)
                         if isovalue is not None else run.cells(isovalue)):
                with self.subTest(value=value), self.assertRaisesRegex(isochron.Error, "isovalue: expected a (finite )?number, got"):
                    call(value)

    def test_arguments_of_other_kinds_are_errors_of_ours(self):
        run = self.run_
        for call, kind, line in (
            (lambda: run.cells(0, 1.5), TypeError, "step: expected a whole number, got 1.5"),
            (lambda: run.cells(0, "1"), TypeError, "step: expected a whole number, got '1'"),
            (lambda: run.cells(0, level=9), IndexError, "level 9, expected 0 to 2"),
            (lambda: run.cells(0, 4), IndexError, "run.isochron: step 4, expected 0 to 3"),
            (lambda: run.mesh(0, -1), IndexError, "step -1, expected 0 to 3"),
            (lambda: run.values(99), IndexError, "step 99, expected 0 to 3"),
            (lambda: run.measure(0, 4), IndexError, "step 4, expected 0 to 3"),
            (lambda: run.change(0, 0, 4), IndexError, "step 4, expected 0 to 3"),
            (lambda: run.cells(0, 3, fraction=0.5), ValueError, "fraction 0.5 after step 3, which is the last one"),
            (lambda: run.cells(0, fraction=65536), ValueError, "fraction 65536, expected 0 to 65535"),
            (lambda: run.cells(0, array="height"), ValueError, "no array height, expected rho, depth"),
            (lambda: run.values(x=np.arange(900)), TypeError, r"got array\(\[ 0, .* 1"),
            (lambda: run.render({"isovalue": np.nan}), ValueError, "state: expected finite numbers"),
            (lambda: run.render({"isovalue": {1}}), TypeError, "state: set is no value of a command"),
            (lambda: run.cells(0, array=7), ValueError, "array: expected a name, got 7"),
            (lambda: run.cells(0, fraction="half"), ValueError, "fraction: expected a number, got 'half'"),
            (lambda: run.values(0, 99), IndexError, "z: vertex 99, expected -20 to 19"),
            (lambda: run.values(0, "a"), TypeError, "z: expected a whole number"),
            (lambda: run.mesh(0, values="height"), ValueError, "values: expected the name of an array"),
            (lambda: run.mesh(0, dtype=int), TypeError, "dtype: expected float32 or float64, got int64"),
            (lambda: run[99], IndexError, "step 99, expected 0 to 3"),
            (lambda: run["a"], TypeError, "step: expected a whole number, got 'a'"),
            (lambda: run.render(size=(640, "a")), TypeError, "size: expected a whole number, got 'a'"),
            (lambda: run.render("none.json"), FileNotFoundError, "none.json: there is no such file"),
            (lambda: run.render("t0.vti"), isochron.Error, "t0.vti: expected a session that the program saved"),
            (lambda: isochron.open("none.isochron"), FileNotFoundError, "none.isochron: there is no such file"),
            (lambda: isochron.build("none.vti", "n.isochron"), FileNotFoundError, "none.vti: there is no such file"),
            (lambda: isochron.build("none*.vti", "n.isochron"), FileNotFoundError, r"none\*.vti: no file matches"),
            (lambda: isochron.build("t0.vti", "n.isochron", append=True), FileNotFoundError, "no index to append to"),
            (lambda: isochron.build("t0.vti", "no/such/n.isochron", array="rho"), FileNotFoundError, "there is no folder no/such"),
            (lambda: isochron.connect("none.sock"), FileNotFoundError, "none.sock: nobody listens there"),
        ):
            with self.subTest(line), self.assertRaisesRegex(kind, line) as raised:
                call()
            self.assertIsInstance(raised.exception, isochron.Error)
            self.assertEqual(str(pickle.loads(pickle.dumps(raised.exception))), str(raised.exception))


class Moments(SeriesTest):
    def test_a_share_has_a_decimal_point(self):
        run = self.run_
        for share, parts in ((0.5, 32768), (0.25, 16384), (1 / 65536, 1), (np.float32(0.75), 49152), (0.0, 0), (Fraction(1, 8), 8192)):
            np.testing.assert_array_equal(run.cells(0.5, 1, fraction=share), run.cells(0.5, 1, fraction=parts))
            np.testing.assert_array_equal(run.values(1, fraction=share), run.values(1, fraction=parts))
            np.testing.assert_array_equal(run[1].mesh(0.5, fraction=share)[0], run.mesh(0.5, 1, fraction=parts)[0])
        np.testing.assert_array_equal(run.cells(0.5, 1, fraction=1.0), run.cells(0.5, 2))
        self.assertEqual(run.values(1, fraction=1).dtype, np.float64)  # one 65536th
        for wrong in (1.5, -0.1, 32768.0, float("nan")):
            with self.assertRaisesRegex(isochron.Error, "^fraction: expected a"):
                run.cells(0.5, fraction=wrong)

    def test_times_are_steps_or_lie_between(self):
        run = self.run_  # at 0, 0.5, 1 and 1.5
        for time, step, fraction in ((0, 0, 0), (0.5, 1, 0), (1.5, 3, 0), (0.25, 0, 0.5), (0.875, 1, 0.75), (np.float32(1), 2, 0)):
            np.testing.assert_array_equal(run.cells(0.5, time=time), run.cells(0.5, step, fraction=fraction))
            np.testing.assert_array_equal(run.values(time=time, array="depth"), run.values(step, fraction=fraction, array="depth"))
            np.testing.assert_array_equal(run.mesh(0.5, time=time)[0], run.mesh(0.5, step, fraction=fraction)[0])
        added, removed = run.change(0.5, time=0.25, to_time=1)
        before, after = run.cells(0.5, 0, fraction=0.5), run.cells(0.5, 2)
        np.testing.assert_array_equal(added, np.setdiff1d(after, before))
        np.testing.assert_array_equal(removed, np.setdiff1d(before, after))
        self.assertEqual([run.step_at(time) for time in (0, 0.2, 0.3, 9)], [0, 0, 1, 3])
        for time in (-0.1, 1.6):
            with self.assertRaisesRegex(isochron.Error, f"run.isochron: time {time}, expected 0 to 1.5"):
                run.cells(0, time=time)
        for more in ({"step": 1}, {"fraction": 0.5}):
            with self.assertRaisesRegex(isochron.Error, "time: expected without step and fraction"):
                run.cells(0, time=1, **more)

    def test_times_may_be_dates(self):
        values = np.random.default_rng(1).random((4, 3, 4, 5))
        daily = isochron.build(values, "daily.isochron", times=[0, 1, 2, 30], time_unit="days since 2000-02-28")
        for date in ("2000-02-29 12:00", "2000-02-29T12:00:00", np.datetime64("2000-02-29T12"), datetime.datetime(2000, 2, 29, 12),
                     datetime.datetime(2000, 2, 29, 13, tzinfo=datetime.timezone(datetime.timedelta(hours=1))),
                     xarray.DataArray(np.datetime64("2000-02-29T12:00:00", "ns"))):
            np.testing.assert_array_equal(daily.values(time=date), daily.values(1, fraction=0.5))
        np.testing.assert_array_equal(daily.values(time="2000-02-29"), daily.values(1))
        np.testing.assert_array_equal(daily.values(time=datetime.date(2000, 2, 29)), daily.values(1))
        with self.assertRaisesRegex(isochron.Error, "time: expected a date such as .*, got soon"):
            daily.cells(0.5, time="soon")
        with self.assertRaisesRegex(isochron.Error, "time: 2000-01-01 is a date, expected a number"):
            self.run_.cells(0.5, time="2000-01-01")
        months = isochron.build(values, "months.isochron", times=[0, 1, 2, 30], time_unit="days since 2000-02-28 (360_day)")
        np.testing.assert_array_equal(months.values(time="2000-02-30"), months.values(2))
        import cftime

        date = cftime.datetime(2000, 3, 28, calendar="360_day")
        np.testing.assert_array_equal(months.values(time=date), months.values(3))
        seconds = isochron.build(values, "seconds.isochron", times=[0, 60, 120, 180], time_unit="s")
        np.testing.assert_array_equal(seconds.values(time=np.timedelta64(1, "m")), seconds.values(1))
        np.testing.assert_array_equal(seconds.values(time=datetime.timedelta(minutes=1.5)), seconds.values(1, fraction=0.5))


class More(SeriesTest):
    def test_several_isovalues_are_a_list(self):
        for values in ([0.3, 1], (0.3, 1), np.array([0.3, 1], np.float32)):
            for found, value in zip(self.run_.cells(values, 1, array="depth"), (0.3, 1)):
                np.testing.assert_array_equal(found, active_cells(self.data[1]["depth"], np.float32(value)
                                                                  if isinstance(values, np.ndarray) else value))
            self.assertEqual([mesh.isovalue for mesh in self.run_.mesh(values, 1)], [float(value) for value in values])
        self.assertEqual(self.run_.cells([], 1), [])
        for step in self.run_:
            self.assertEqual(len(step.cells([0, 1])), 2)

    def test_normals_point_to_lower_values(self):
        mesh = self.run_.mesh(0.75, 1, array="depth", dtype=np.float64, normals=True)  # of a sphere
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, rtol=1e-5)
        middle = np.array(ORIGIN) + (np.array(SHAPE[::-1]) - 1) / 2 * self.run_.spacing[::-1]
        self.assertGreater((np.einsum("ij,ij->i", mesh.normals, middle - mesh.points) > 0).mean(), 0.99)
        self.assertEqual(mesh.normals.dtype, np.float32)
        self.assertIsNone(self.run_.mesh(0.75, 1, array="depth").normals)

    def test_a_mesh_has_the_values_of_another_array(self):
        mesh = self.run_.mesh(0.5, 1, array="rho", values="depth", dtype=np.float64)
        places = (mesh.points - ORIGIN) / self.run_.spacing[::-1]
        low, high = np.floor(places + 1e-9).astype(int), np.ceil(places - 1e-9).astype(int)
        ends = [self.data[1]["depth"][tuple(at.T[::-1])] for at in (low, high)]
        self.assertTrue(((np.minimum(*ends) - 1e-5 <= mesh.values) & (mesh.values <= np.maximum(*ends) + 1e-5)).all())

    def test_a_mesh_is_a_pair_and_goes_into_vtk(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy

        for dtype in (np.float32, np.float64):
            mesh = self.run_.mesh(0.75, 1, array="depth", normals=True, values="rho", dtype=dtype)
            points, faces = mesh
            self.assertIs(points, mesh.points)
            again = pickle.loads(pickle.dumps(mesh))
            for one, other in zip((*mesh, mesh.normals, mesh.values, mesh.origin), (*again, again.normals, again.values, again.origin)):
                np.testing.assert_array_equal(one, other)
            surface = mesh.to_vtk()
            np.testing.assert_array_equal(vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3), faces)
            placed = points + (np.array(ORIGIN) if dtype == np.float32 else 0.0)
            np.testing.assert_allclose(vtk_to_numpy(surface.GetPoints().GetData()), placed, rtol=1e-12)
            np.testing.assert_allclose(mesh.places, placed)
            np.testing.assert_array_equal(vtk_to_numpy(surface.GetPointData().GetNormals()), mesh.normals)
            np.testing.assert_array_equal(vtk_to_numpy(surface.GetPointData().GetArray("rho")), mesh.values)
            self.assertIn("points", mesh._repr_html_())
        empty = self.run_.mesh(99, 1)
        self.assertEqual((empty.to_vtk().GetNumberOfPolys(), empty.area), (0, 0))
        self.assertIn("0", empty._repr_html_())

    def test_the_area_is_that_of_the_triangles(self):
        mass = __import__("vtk").vtkMassProperties()
        mesh = self.run_.mesh(0.5, 1, array="depth")
        mass.SetInputData(mesh.to_vtk())
        self.assertAlmostEqual(mesh.area / mass.GetSurfaceArea(), 1, places=5)

    def test_levels_of_detail(self):
        run = self.run_
        self.assertEqual(run.levels, ((20, 37, 18), (11, 19, 10), (6, 10, 6)))
        for level, shape in enumerate(run.levels):
            values = run.values(1, level=level, array="depth")
            self.assertEqual(values.shape, shape)
            np.testing.assert_array_equal(run.cells(0.5, 1, level=level, array="depth"), active_cells(values, 0.5))
            np.testing.assert_array_equal(run.values(1, slice(2, 5), -1, level=level, array="depth"), values[2:5, -1])
            mesh = run.mesh(0.5, 1, level=level, array="depth", normals=True)
            self.assertEqual(len(mesh.normals), len(mesh.points))
            self.assertLessEqual(mesh.places.max(0)[0], ORIGIN[0] + 0.5 * 17)

    def test_first_crossings_are_those_of_the_steps(self):
        for array, isovalue in (("depth", 0.75), ("rho", 0)):
            active = np.zeros((STEPS, (SHAPE[0] - 1) * (SHAPE[1] - 1) * (SHAPE[2] - 1)), bool)
            for step in range(STEPS):
                active[step, active_cells(self.data[step][array], isovalue)] = True
            expected = np.where(active.any(0), 0.5 * active.argmax(0), np.nan)
            found = self.run_.first_crossings(isovalue, array=array)
            np.testing.assert_array_equal(found.ravel(), expected)
            blended = self.run_.first_crossings(isovalue, array=array, blended=True)
            self.assertTrue((blended <= found)[~np.isnan(found)].all())
            first = np.unravel_index(np.nanargmin(np.where(blended > 0, blended, np.nan)), blended.shape)
            number = np.ravel_multi_index(first, blended.shape)
            self.assertIn(number, self.run_.cells(isovalue, time=blended[first] + 1e-9, array=array))
            self.assertNotIn(number, self.run_.cells(isovalue, time=max(0, blended[first] - 0.5 / 65536), array=array))

    def test_names_of_other_packages_lead_to_ours(self):
        mesh = self.run_.mesh(0.5, array="depth")
        data = self.run_.to_xarray().depth
        for thing, name, ours in (
            (mesh, "n_points", "len(mesh.points)"),
            (mesh, "plot", "mesh.to_pyvista().plot()"),
            (mesh, "save", "run.export"),
            (self.run_, "contour", "run.mesh"),
            (self.run_, "sel", "run.to_xarray()"),
            (data.isochron, "contour", "data.isochron.mesh"),
        ):
            with self.assertRaisesRegex(AttributeError, f"has no attribute '{name}': here it is {re.escape(ours)}"):
                getattr(thing, name)
        with self.assertRaisesRegex(AttributeError, "has no attribute 'nonsense'$"):
            mesh.nonsense
        self.assertFalse(hasattr(self.run_, "__array__"))
        copied = copy.deepcopy(mesh)
        np.testing.assert_array_equal(copied.points, mesh.points)

    def test_bounds_are_as_vtk_has_them(self):
        mesh = self.run_.mesh(0.5, array="depth")
        np.testing.assert_allclose(mesh.bounds, mesh.to_vtk().GetBounds(), rtol=1e-7)
        self.assertTrue(np.isnan(self.run_.mesh(99, array="depth").bounds).all())

    def test_data_that_are_no_index_are_told_with_the_call_that_makes_one(self):
        os.makedirs("of others", exist_ok=True)
        with open("of others/it's.nc", "w") as file:
            file.write("no index")
        with self.assertRaises(isochron.Error) as refused:
            isochron.open("of others/it's.nc")
        call = re.search(r"isochron\.build\((.*)\) makes an index of data$", str(refused.exception))
        self.assertEqual(ast.literal_eval(f"({call[1]})"), ("of others/it's.nc", "it's.isochron"))
        with self.assertRaisesRegex(isochron.ArgumentError, "path: expected no null character"):
            isochron.open("a\0.isochron")

    def test_an_export_may_be_of_one_step(self):
        said = self.run_.export("one.ply", 0.5, step=np.int64(2), array="depth")
        self.assertEqual((said["files"], said["steps"]), (["one.ply"], [2]))
        with self.assertRaisesRegex(isochron.ArgumentError, "step: expected without steps"):
            self.run_.export("one.ply", 0.5, step=1, steps=2)

    def test_exports_are_those_of_the_program(self):
        asked = {"array": "depth", "crop": {"x": slice(2, 9)}, "normals": False, "double": True}
        said = self.run_.export("a.ply", [0.3, np.float32(0.75)], steps=slice(0, 3, 2), **asked)
        self.assertEqual((said["files"], said["steps"]), (["a_0000.ply", "a_0002.ply"], [0, 2]))
        ran = program("export", "run.isochron", "--array", "depth", "--isovalue", 0.3, "--isovalue", 0.75, "--steps", "0:2:2",
                      "--crop", "2:8,0:36,0:19", "--no-normals", "--precision", "double", "-o", "b.ply")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        for step in ("0000", "0002"):
            with open(f"a_{step}.ply", "rb") as one, open(f"b_{step}.ply", "rb") as other:
                self.assertEqual(one.read(), other.read())
        half = self.run_.export("h.vtp", 0.5, time=0.25, array="depth", color_by="rho", range=(0, np.int8(1)))
        self.assertEqual((half["steps"], half["fraction"]), ([0], 32768))
        with self.assertRaisesRegex(isochron.Error, "h.vtp: exists already; force=True replaces it"):
            self.run_.export("h.vtp", 0.5, time=0.25)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            self.run_.export("far.ply", 1e9, steps=0)
        self.assertIn("lies beyond the data", str(told[0].message))
        self.assertEqual(told[0].filename, __file__)

    def test_notebooks_show_what_there_is(self):
        shown = self.run_._repr_html_()
        for word in ("rho, depth", "18 x 37 x 20", "4, 0 to 1.5", "run.isochron"):
            self.assertIn(word, shown)
        self.assertNotIn("<script>", isochron.build(self.data[0]["rho"], "a.isochron", array="<script>")._repr_html_())

    def test_types_are_checked_strictly(self):
        with open("typed.py", "w") as file:
            file.write(TYPED)
        with open("mypy.ini", "w") as file:  # to read xarray's own types takes five times as long as all else
            file.write("[mypy]\nstrict = True\n[mypy-xarray.*]\nfollow_imports = skip\n"
                       "[mypy-isochron._xarray]\ndisallow_subclassing_any = False\n")
        package = os.path.dirname(os.path.realpath(isochron.__file__))
        ran = subprocess.run(["mypy", "--no-incremental", package, "typed.py"], capture_output=True, text=True,
                             env=os.environ | {"MYPYPATH": os.path.dirname(package)})
        self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)


TYPED = """
import numpy as np
from numpy.typing import NDArray

import isochron

run: isochron.Run = isochron.build(np.zeros((4, 5, 6)), "a.isochron", spacing=(1, 2, np.float32(3)))
cells: NDArray[np.uint32] = run.cells(np.float32(0.5), np.int64(1), fraction=0.5)
several: list[NDArray[np.uint32]] = run.cells([0.5, 1], time="2000-01-01")
mesh: isochron.Mesh = run.mesh(0.5, normals=True)
points, faces = mesh
meshes: list[isochron.Mesh] = run[0].mesh(np.array([1, 2]))
count: int = run.export("a.ply", 0.5, steps=slice(0, 3))["cells"]
"""


if __name__ == "__main__":
    unittest.main()
