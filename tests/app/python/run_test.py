"""What a run answers, against scans by NumPy, the program's own answers, and VTK's contour."""

import copy
import json
import os
import pickle
import unittest
from fractions import Fraction

import numpy as np

import isochron
from made_series import ORIGIN, SHAPE, SPACING, STEPS, SeriesTest, active_cells, program, write_nrrd


class Description(SeriesTest):
    def test_says_what_the_files_say(self):
        run = self.run_
        self.assertEqual(run.arrays, ("rho", "depth"))
        self.assertEqual(run.shape, (STEPS, *SHAPE))
        self.assertEqual(run.times.tolist(), [0, 0.5, 1, 1.5])
        self.assertEqual(run.spacing, SPACING[::-1])
        self.assertEqual(run.origin, ORIGIN)
        self.assertEqual(run.direction, ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
        self.assertEqual(run.range(), (-5, 5))
        self.assertEqual(len(run), STEPS)
        self.assertEqual(run.path, "run.isochron")
        self.assertIn("rho, depth", repr(run))

    def test_units_are_those_of_the_index(self):
        write_nrrd("u.nrrd", self.data[0]["depth"], 'space dimension: 3\nspace units: "mm" "mm" "mm"\n'
                   "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n")
        info = isochron.build("u.nrrd", "u.isochron")
        self.assertEqual((info.length_unit, info.unit, info.time_unit), ("mm", "", ""))
        said = json.loads(program("info", "u.isochron", "--json").stdout)
        self.assertEqual(said["length_unit"], "mm")

    def test_times_cannot_be_changed(self):
        with self.assertRaises(ValueError):
            self.run_.times[0] = 7



class Instants(SeriesTest):
    """What lies between two steps, against exact fractions."""

    def blends(self, array, step, fraction):
        """N times the blended values, exactly; None where one of the two is not finite."""
        both = zip(self.data[step][array].ravel(), self.data[step + 1][array].ravel())
        return [
            (65536 - fraction) * Fraction(float(a)) + fraction * Fraction(float(b))
            if np.isfinite(a) and np.isfinite(b) else None
            for a, b in both
        ]

    def test_cells_are_those_of_exact_fractions(self):
        shape = self.data[0]["depth"].shape
        corners = [tuple(slice(d, n - 1 + d) for d, n in zip((i, j, k), shape))
                   for i in (0, 1) for j in (0, 1) for k in (0, 1)]
        for array, step, fraction in [("rho", 0, 1), ("rho", 2, 32768), ("depth", 1, 22222), ("depth", 2, 65535)]:
            blends = self.blends(array, step, fraction)
            there = next(blend for blend in blends[1234:] if blend is not None)
            for isovalue in [0.5, float(there / 65536), np.nextafter(float(there / 65536), 9)]:
                with self.subTest(array=array, step=step, fraction=fraction, isovalue=isovalue):
                    limit = 65536 * Fraction(float(isovalue))
                    above = np.array([b is not None and b >= limit for b in blends]).reshape(shape)
                    missing = np.array([b is None for b in blends]).reshape(shape)
                    some = np.logical_or.reduce([above[c] for c in corners])
                    every = np.logical_and.reduce([above[c] for c in corners])
                    bad = np.logical_or.reduce([missing[c] for c in corners])
                    expected = np.flatnonzero(some & ~every & ~bad)
                    found = self.run_.cells(isovalue, step, fraction=fraction, array=array)
                    np.testing.assert_array_equal(found, expected)
                    program("query", "run.isochron", "--isovalue", repr(float(isovalue)), "--step", step, "--fraction",
                            fraction, "--array", array, "--ids", "cells.bin", "--force")
                    np.testing.assert_array_equal(np.fromfile("cells.bin", "<u4"), expected)

    def test_values_are_those_of_exact_fractions_rounded_down(self):
        for array, step, fraction in [("rho", 0, 1), ("rho", 2, 32768), ("depth", 1, 22222), ("depth", 2, 65535)]:
            with self.subTest(array=array, step=step, fraction=fraction):
                found = self.run_.values(step, fraction=fraction, array=array)
                self.assertEqual(found.dtype, np.float64)
                self.assertEqual(found.shape, self.data[step][array].shape)
                for value, blend in zip(found.ravel().tolist(), self.blends(array, step, fraction)):
                    if blend is None:
                        self.assertTrue(np.isnan(value))
                        continue
                    self.assertLessEqual(65536 * Fraction(value), blend)
                    self.assertGreater(65536 * Fraction(float(np.nextafter(value, np.inf))), blend)
                part = self.run_.values(step, slice(1, 5), -1, slice(None, None, -2), fraction=fraction, array=array)
                np.testing.assert_array_equal(part, found[1:5, -1, ::-2])
        with self.assertRaisesRegex(isochron.Error, "fraction 65536, expected 0 to 65535"):
            self.run_.values(0, fraction=65536)

    def test_changes_are_differences_of_sets(self):
        added, removed = self.run_.change(0.5, 1, fraction=100, to_fraction=60000)
        before, after = self.run_.cells(0.5, 1, fraction=100), self.run_.cells(0.5, 1, fraction=60000)
        np.testing.assert_array_equal(added, np.setdiff1d(after, before))
        np.testing.assert_array_equal(removed, np.setdiff1d(before, after))

    def test_the_last_step_has_none_after_it(self):
        with self.assertRaisesRegex(isochron.Error, f"fraction 1 after step {STEPS - 1}, which is the last one"):
            self.run_.cells(0.5, STEPS - 1, fraction=1)
        with self.assertRaisesRegex(isochron.Error, "fraction 65536, expected 0 to 65535"):
            self.run_.cells(0.5, 0, fraction=65536)


class Cells(SeriesTest):
    def test_are_those_of_a_scan(self):
        for step in range(STEPS):
            for array, isovalues in {"rho": [-5, -4.5, 0, 0.25, 5, 6], "depth": [0.3, 0.75, 1.25]}.items():
                values = self.data[step][array]
                for isovalue in [*isovalues, float(values.flat[1234])]:
                    with self.subTest(step=step, array=array, isovalue=isovalue):
                        found = self.run_.cells(isovalue, step, array=array)
                        np.testing.assert_array_equal(found, active_cells(values, isovalue))

    def test_are_those_of_the_program(self):
        for step, isovalue, array in [(0, 0, "rho"), (3, 0.5, "depth")]:
            ran = program("query", "run.isochron", "--isovalue", isovalue, "--step", step, "--array", array, "--ids",
                          "cells.bin", "--force")
            self.assertEqual(ran.returncode, 0, ran.stderr)
            np.testing.assert_array_equal(self.run_.cells(isovalue, step, array=array), np.fromfile("cells.bin", "<u4"))

    def test_are_an_array_of_their_own_that_stays(self):
        with isochron.open("run.isochron") as run:
            cells = run.cells(0, 1)
        self.assertEqual(cells.dtype, np.uint32)
        self.assertFalse(cells.flags.writeable)
        with self.assertRaises(ValueError):
            cells[0] = 1
        with self.assertRaises(ValueError):
            cells.flags.writeable = True
        again = self.run_.cells(0, 1)
        del run
        np.testing.assert_array_equal(cells, again)
        self.assertFalse(np.shares_memory(cells, again))

    def test_the_first_array_and_the_first_step_are_meant_where_none_is_named(self):
        np.testing.assert_array_equal(self.run_.cells(1), self.run_.cells(1, step=0, array="rho"))

    def test_of_values_that_are_scaled(self):
        import h5py

        cases = [("rho", 0.5, 10.0, 10.5), ("depth", 0.125, 1e9, 1e9 + 0.0625)]  # which single precision does not hold
        for name, slope, intercept, isovalue in cases:
            with h5py.File(f"{name}.nc", "w") as file:  # as NetCDF packs values
                stored = file.create_dataset(name, data=self.data[0][name])
                stored.attrs["scale_factor"], stored.attrs["add_offset"] = slope, intercept
                for number, axis_name in enumerate("zyx"):
                    axis = file.create_dataset(axis_name, data=np.arange(SHAPE[number], dtype=np.float64))
                    axis.make_scale(axis_name)
                    stored.dims[number].attach_scale(axis)
            run = isochron.build(f"{name}.nc", f"{name}.isochron", array=name)
            expected = self.data[0][name].astype(np.float64) * slope + intercept
            with self.subTest(array=name):
                for values in (run.values(0), run[0].values(), run.to_xarray()[name].values[0]):
                    self.assertEqual(values.dtype, np.float64)
                    np.testing.assert_array_equal(values, expected)
                np.testing.assert_array_equal(run.cells(isovalue), active_cells(expected, isovalue))


class Changes(SeriesTest):
    def test_turn_one_set_into_the_other(self):
        cases = [(0, 1, 0, None), (0, 1, 3, None), (0, 2, None, 1), (0.25, 3, 0, 5), (6, 0, 1, 0)]
        for isovalue, step, to_step, to_isovalue in cases:
            for array in ("rho", "depth"):
                with self.subTest(isovalue=isovalue, step=step, to_step=to_step, to_isovalue=to_isovalue):
                    added, removed = self.run_.change(isovalue, step, to_step, to_isovalue, array=array)
                    before = self.run_.cells(isovalue, step, array=array)
                    after = self.run_.cells(
                        isovalue if to_isovalue is None else to_isovalue,
                        step if to_step is None else to_step,
                        array=array,
                    )
                    np.testing.assert_array_equal(added, np.setdiff1d(after, before))
                    np.testing.assert_array_equal(removed, np.setdiff1d(before, after))
                    self.assertEqual((added.dtype, added.flags.writeable), (np.uint32, False))


class Values(SeriesTest):
    def test_are_those_of_the_files(self):
        for step, arrays in enumerate(self.data):
            for array, values in arrays.items():
                found = self.run_.values(step, array=array)
                self.assertEqual(found.dtype, values.dtype)
                np.testing.assert_array_equal(found, values)

    def test_parts_are_cut_as_numpy_cuts_them(self):
        everything = slice(None)
        for cut in [
            (slice(10, 20), everything, everything),
            (slice(15, 17), slice(15, 17), slice(15, 17)),  # the corners of eight chunks
            (slice(3, 17, 2), 4, slice(None, None, -1)),
            (slice(17, 2, -3), slice(-5, None), slice(0, -1)),
            (-1, -1, -1),
            (np.int64(2), slice(5, 5), everything),
            (slice(30, 40), everything, 0),
        ]:
            with self.subTest(cut=cut):
                for array in ("rho", "depth"):
                    found = self.run_.values(2, *cut, array=array)
                    np.testing.assert_array_equal(found, self.data[2][array][cut])

    def test_of_an_index_that_refers_to_its_files(self):
        ran = program("build", "t0.vti", "t1.vti", "--array", "depth", "--refer", "-o", "refers.isochron")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        cut = (slice(3, 18), slice(30, None), 5)
        np.testing.assert_array_equal(isochron.open("refers.isochron").values(1, *cut), self.data[1]["depth"][cut])

    def test_a_vertex_that_is_not_there(self):
        with self.assertRaisesRegex(IndexError, "y: vertex 37, expected -37 to 36"):
            self.run_.values(0, 0, 37)

    def test_a_part_reads_the_chunks_in_which_it_lies(self):
        write_nrrd("large.nrrd", np.random.default_rng(5).random((128, 128, 128), dtype=np.float32))
        isochron.build("large.nrrd", "large.isochron").close()

        def read_for(*cut):
            with isochron.open("large.isochron") as run:
                before = run._array(None).read_bytes()
                run.values(0, *cut)
                return run._array(None).read_bytes() - before

        whole = read_for()
        self.assertGreater(whole, 128**3)
        self.assertLess(read_for(slice(20, 30)), whole / 4)  # one layer of chunks of eight
        self.assertLess(read_for(20, 20, slice(20, 30)), whole / 50)


class Meshes(SeriesTest):
    def test_share_their_points(self):
        points, faces = self.run_.mesh(0.5, 1, array="depth")
        self.assertEqual((points.dtype, faces.dtype), (np.float32, np.uint32))
        self.assertEqual((points.shape[1], faces.shape[1]), (3, 3))
        np.testing.assert_array_equal(np.unique(faces), np.arange(len(points)))
        self.assertTrue(points.flags.writeable)

    def test_points_count_from_the_origin_or_are_absolute(self):
        near, faces = self.run_.mesh(0.5, 1, array="depth")
        absolute, same = self.run_.mesh(0.5, 1, array="depth", dtype=np.float64)
        np.testing.assert_array_equal(faces, same)
        self.assertEqual(absolute.dtype, np.float64)
        # 500,000 from zero a float is 0.03 apart from the next; the points are exact to a millionth of a voxel.
        np.testing.assert_allclose(near + np.float64(self.run_.origin), absolute, rtol=0, atol=1e-5)
        index = (absolute - ORIGIN) / SPACING
        cells = self.run_.cells(0.5, 1, array="depth")
        for corner in (index[faces].min(axis=1), index[faces].max(axis=1)):
            self.assertTrue((corner >= -1e-6).all() and (corner <= np.array(SHAPE[::-1]) - 1 + 1e-6).all())
        at = np.floor(index[faces].mean(axis=1)).astype(int)
        z, y, x = SHAPE
        self.assertEqual(set(cells), set((at[:, 2] * (y - 1) + at[:, 1]) * (x - 1) + at[:, 0]))

    def test_turn_their_front_to_lower_values(self):
        points, faces = self.run_.mesh(0.5, 0, array="depth", dtype=np.float64)
        a, b, c = (points[faces[:, i]] for i in range(3))
        center = np.array(ORIGIN) + (np.array(SHAPE[::-1]) - 1) / 2 * SPACING  # where values are lowest
        outward = np.einsum("ij,ij->i", np.cross(b - a, c - a), (a + b + c) / 3 - center)
        self.assertLess((outward > 0).mean(), 0.01)

    def test_turn_their_front_to_lower_values_on_a_mirrored_grid_too(self):
        for last in ("0,0,1", "0,0,-1"):
            write_nrrd("turned.nrrd", self.data[0]["depth"], "space dimension: 3\n"
                       f"space directions: (1,0,0) (0,1,0) ({last})\nspace origin: (0,0,0)\n")
            if os.path.exists("turned.isochron"):
                os.remove("turned.isochron")
            run = isochron.build("turned.nrrd", "turned.isochron")
            handed = np.linalg.det(run.direction)
            points, faces = run.mesh(0.5, dtype=np.float64)
            corners = points[faces]
            volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
            self.assertAlmostEqual(handed, 1 if last == "0,0,1" else -1)
            self.assertLess(volume, -100)  # a closed surface whose front is inside, where values are lower

    def test_are_those_of_vtk(self):
        import vtk
        from vtk.util import numpy_support

        image = vtk.vtkImageData()
        image.SetDimensions(*SHAPE[::-1])
        image.SetSpacing(*SPACING)
        image.GetPointData().SetScalars(numpy_support.numpy_to_vtk(self.data[1]["depth"].ravel(), deep=True))
        contour = vtk.vtkFlyingEdges3D()
        contour.SetInputData(image)
        contour.SetValue(0, 0.5)
        contour.ComputeNormalsOff()
        contour.Update()
        theirs = numpy_support.vtk_to_numpy(contour.GetOutput().GetPoints().GetData())
        points, faces = self.run_.mesh(0.5, 1, array="depth")
        self.assertEqual(len(faces), contour.GetOutput().GetNumberOfPolys())
        self.assertEqual(len(points), len(theirs))

        def in_order(rows):
            rounded = np.round(rows.astype(np.float64), 3)
            return rows[np.lexsort(rounded.T)]

        np.testing.assert_allclose(in_order(points), in_order(theirs), rtol=0, atol=2e-3)
        # What PyVista's from_regular_faces does with them.
        cells = vtk.vtkCellArray()
        corners = numpy_support.numpy_to_vtkIdTypeArray(faces.ravel().astype(np.int64), deep=True)
        starts = numpy_support.numpy_to_vtkIdTypeArray(np.arange(0, faces.size + 1, 3, dtype=np.int64), deep=True)
        cells.SetData(starts, corners)
        surface = vtk.vtkPolyData()
        place = vtk.vtkPoints()
        place.SetData(numpy_support.numpy_to_vtk(points, deep=True))
        surface.SetPoints(place)
        surface.SetPolys(cells)
        area, their_area = vtk.vtkMassProperties(), vtk.vtkMassProperties()
        area.SetInputData(surface)
        their_area.SetInputData(contour.GetOutput())
        self.assertAlmostEqual(area.GetSurfaceArea() / their_area.GetSurfaceArea(), 1, places=5)

    def test_without_cells_are_empty(self):
        points, faces = self.run_.mesh(99)
        self.assertEqual((points.shape, faces.shape), ((0, 3), (0, 3)))

    def test_another_type_is_refused(self):
        with self.assertRaisesRegex(TypeError, "dtype: expected float32 or float64, got int32"):
            self.run_.mesh(0, dtype=np.int32)


class Use(SeriesTest):
    def test_a_run_is_closed_behind_its_block(self):
        with isochron.open("run.isochron") as run:
            run.cells(0)
        with self.assertRaisesRegex(isochron.Error, "^run.isochron: is closed$"):
            run.cells(0)
        run.close()

    def test_a_run_is_pickled_as_its_path(self):
        again = pickle.loads(pickle.dumps(self.run_))
        np.testing.assert_array_equal(again.cells(0, 2), self.run_.cells(0, 2))
        self.assertLess(len(pickle.dumps(self.run_)), 200)
        self.assertEqual(copy.copy(self.run_).path, "run.isochron")

    def test_a_pickle_is_opened_from_any_folder(self):
        pickles = pickle.dumps(self.run_), pickle.dumps(self.run_[2])
        expected = self.run_.cells(0, 2)
        os.chdir("/")
        try:
            run, step = map(pickle.loads, pickles)
        finally:
            os.chdir(self.folder.name)
        self.assertEqual(run.path, "run.isochron")
        np.testing.assert_array_equal(run.cells(0, 2), expected)
        np.testing.assert_array_equal(step.cells(0), expected)

    def test_steps_are_counted_as_those_of_a_list(self):
        self.assertEqual([self.run_[0].number, self.run_[-1].number], [0, STEPS - 1])
        self.assertEqual(self.run_[3].time, 1.5)
        with self.assertRaisesRegex(IndexError, "run.isochron: step 4, expected 0 to 3"):
            self.run_[4]

    def test_a_path_may_be_a_path(self):
        import pathlib

        self.assertEqual(isochron.open(pathlib.Path("run.isochron")).path, "run.isochron")

    def test_names_are_documented(self):
        for name in isochron.__all__:
            self.assertTrue(getattr(isochron, name).__doc__, name)
        for of in (isochron.Run, isochron.Step):
            for name, what in vars(of).items():
                if not name.startswith("_"):
                    self.assertTrue(what.__doc__, f"{of.__name__}.{name}")
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(isochron.__file__), "py.typed")))


if __name__ == "__main__":
    unittest.main()
