"""A run as xarray's Dataset: lazily, with coordinates, units and calendar."""

import subprocess
import sys
import unittest

import numpy as np
import xarray

import isochron
from made_series import ORIGIN, SPACING, STEPS, SeriesTest


class Dataset(SeriesTest):
    def test_has_the_arrays_and_their_places(self):
        data = self.run_.to_xarray()
        self.assertEqual(list(data.data_vars), ["rho", "depth"])
        self.assertEqual(data["rho"].dims, ("time", "z", "y", "x"))
        self.assertEqual(data["rho"].dtype, np.int16)
        np.testing.assert_array_equal(data["time"], self.run_.times)
        for number, axis in enumerate("xyz"):
            expected = ORIGIN[number] + SPACING[number] * np.arange(data.sizes[axis])
            np.testing.assert_allclose(data[axis], expected)
        np.testing.assert_array_equal(data["depth"].values, [arrays["depth"] for arrays in self.data])

    def test_reads_what_is_asked_for(self):
        data = self.run_.to_xarray()
        asked = []
        values = self.run_.values

        def watched(*of, **more):
            asked.append(of)
            return values(*of, **more)

        self.run_.values = watched
        part = data["rho"].isel(time=2, z=slice(3, 9, 2), x=4)
        self.assertEqual(asked, [])
        np.testing.assert_array_equal(part.values, self.data[2]["rho"][3:9:2, :, 4])
        self.assertEqual([of[0] for of in asked], [2])
        np.testing.assert_array_equal(
            data["rho"].isel(time=[3, 1], y=[0, 5, 2]).values, [self.data[i]["rho"][:, [0, 5, 2]] for i in (3, 1)]
        )
        self.assertEqual(data["rho"].isel(time=slice(2, 2)).values.shape[0], 0)

    def test_units_and_calendar_are_attributes_of_cf(self):
        days = np.arange(3.0)
        with_dates = xarray.Dataset(
            {"rho": (("time", "z", "y", "x"), np.random.default_rng(2).random((3, 4, 5, 6), dtype=np.float32))},
            {
                "time": ("time", days, {"units": "days since 2000-02-28", "calendar": "360_day", "axis": "T"}),
                **{axis: (axis, np.arange(float(n)), {"units": "m", "axis": axis.upper()})
                   for axis, n in zip("zyx", (4, 5, 6))},
            },
        )
        with_dates["rho"].attrs["units"] = "kg m-3"
        with_dates.to_netcdf("dates.nc")
        run = isochron.build("dates.nc", "dates.isochron", array="rho")
        self.assertEqual((run.time_unit, run.unit), ("days since 2000-02-28 (360_day)", "kg m-3"))
        data = run.to_xarray()
        self.assertEqual(data["time"].attrs, {"units": "days since 2000-02-28", "calendar": "360_day"})
        self.assertEqual(data["rho"].attrs["units"], "kg m-3")
        np.testing.assert_array_equal(data["rho"], with_dates["rho"])
        self.assertEqual(STEPS, len(self.run_))


class Engine(SeriesTest):
    def test_opens_an_index_as_a_dataset(self):
        self.assertIn("isochron", xarray.backends.list_engines())
        for options in ({"engine": "isochron"}, {"engine": "isochron", "chunks": {"time": 1}}, {}):
            with xarray.open_dataset("run.isochron", **options) as data:
                self.assertEqual(list(data.data_vars), ["rho", "depth"])
                self.assertEqual(data.depth.dims, ("time", "z", "y", "x"))
                np.testing.assert_array_equal(data.depth.sel(time=0.5), self.data[1]["depth"])
                np.testing.assert_array_equal(data.rho.isel(x=3, time=[0, 2]), [self.data[i]["rho"][..., 3] for i in (0, 2)])
        with xarray.open_dataset("run.isochron", engine="isochron", drop_variables=["rho"]) as data:
            self.assertEqual(list(data.data_vars), ["depth"])
        with self.assertRaises(FileNotFoundError):
            xarray.open_dataset("none.isochron", engine="isochron")

    def test_gives_dates_and_the_coordinates_that_the_files_had(self):
        levels = np.array([1000.0, 850, 700, 500])
        made = xarray.DataArray(
            np.random.default_rng(2).random((3, 4, 5, 6), dtype=np.float32),
            {"time": np.array(["2000-02-28", "2000-02-29", "2000-03-01"], "M8[ns]"),
             "plev": ("plev", levels, {"units": "hPa"}), "lat": ("lat", 50.0 - np.arange(5), {"units": "degrees_north"}),
             "lon": ("lon", 7.0 + np.arange(6), {"units": "degrees_east"})},
            ("time", "plev", "lat", "lon"), "t", {"units": "K"})
        run = made.isochron.build("dates.isochron")
        with xarray.open_dataset("dates.isochron", engine="isochron") as data:
            np.testing.assert_array_equal(data.time, made.time)
            np.testing.assert_array_equal(data.t, made)
            np.testing.assert_allclose(data.plev, levels)
            self.assertEqual((data.plev.dims, data.plev.units), (("z",), "hPa"))
            np.testing.assert_array_equal(data.lat, made.lat)
            np.testing.assert_array_equal(data.lon, made.lon)
            self.assertEqual(float(data.t.sel(time="2000-02-29").isel(z=0, y=0, x=0)), float(made[1, 0, 0, 0]))
            np.testing.assert_array_equal(data.t.isel(time=1).isochron.cells(0.5), run.cells(0.5, 1))
        with xarray.open_dataset("dates.isochron", engine="isochron", decode_times=False) as data:
            self.assertEqual(data.time.attrs, {"units": run.time_unit})
        np.testing.assert_array_equal(run.to_xarray(decode_times=True).time, made.time)

    def test_arrays_know_their_index(self):
        with xarray.open_dataset("run.isochron", engine="isochron") as data:
            self.assertEqual(data.isochron.run.arrays, ("rho", "depth"))
            for found in (data.depth.sel(time=1).isochron.cells(0.5), data.depth.isochron.cells(0.5, step=2),
                          data.depth.isochron.cells(0.5, time=1)):
                np.testing.assert_array_equal(found, self.run_.cells(0.5, 2, array="depth"))
            mesh = data.rho.isel(time=3).isochron.mesh(0.5, normals=True, values="depth")
            np.testing.assert_array_equal(mesh.values, self.run_.mesh(0.5, 3, values="depth").values)
            for call, line in (
                (lambda: (2 * data.rho).isochron.run, "not a computed one"),
                (lambda: data.rho.isel(x=slice(3, 9)).isochron.cells(0, step=0), "expected the whole grid"),
                (lambda: data.rho.isochron.cells(0), "4 steps: expected time or step"),
                (lambda: data.rho.isel(time=[1, 2]).isochron.cells(0), "2 of 4 steps"),
                (lambda: self.run_.to_xarray()[["rho"]].drop_vars("rho").isochron.run, "has no arrays of an index"),
            ):
                with self.assertRaisesRegex(isochron.Error, line):
                    call()

    def test_arrays_that_were_changed_are_not_taken_for_the_index(self):
        def in_place(data):
            data.load()[..., 0] = 99

        def where_it_is_read(data):
            data[{"x": 0}] = 99  # before anything is loaded

        changes = {
            "nothing": None, "load": lambda data: data.load(), "rename": lambda data: data.rename("other"),
            "transpose": lambda data: data.transpose("x", "y", "z", ...), "chunk": lambda data: data.chunk({"x": 5}),
            "copy": lambda data: data.copy(data=2 * data.values), "roll": lambda data: data.roll(x=3),
            "dask": lambda data: data.chunk({"x": 5}).roll(x=3), "shift": lambda data: data.astype(float).shift(x=1),
            "flip": lambda data: data.isel(x=slice(None, None, -1)), "sort": lambda data: data.sortby("y", ascending=False),
            "places": lambda data: data.assign_coords(x=2 * data.x), "load[]": in_place, "[]": where_it_is_read,
        }  # fmt: skip
        same = ("nothing", "load", "rename", "transpose", "chunk")
        for name, change in changes.items():
            for moment in ({"time": 1}, {}):
                data = xarray.open_dataset("run.isochron", engine="isochron").depth.isel(moment)
                changed = change(data) if change else data
                changed = data if changed is None else changed
                with self.subTest(change=name, moment=moment):
                    ask = {} if moment else {"step": 1}
                    if name in same:
                        np.testing.assert_array_equal(changed.isochron.cells(0.5, **ask), self.run_.cells(0.5, 1, array="depth"))
                    else:
                        with self.assertRaisesRegex(isochron.Error, "were changed|a computed one"):
                            changed.isochron.cells(0.5, **ask)
        isovalues = xarray.DataArray([0.25, 0.5])
        for found, one in zip(self.run_.cells(isovalues, array="depth"), isovalues):
            np.testing.assert_array_equal(found, self.run_.cells(one, array="depth"))

    def test_xarray_is_not_imported_for_who_does_not_use_it(self):
        for code in ("import isochron, sys; assert 'xarray' not in sys.modules; import xarray; xarray.DataArray([1]).isochron",
                     "import xarray, isochron; xarray.DataArray([1]).isochron"):
            subprocess.run([sys.executable, "-c", code], check=True)


if __name__ == "__main__":
    unittest.main()
