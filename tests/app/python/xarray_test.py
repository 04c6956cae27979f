"""A run as xarray's Dataset: lazily, with coordinates, units and calendar."""

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


if __name__ == "__main__":
    unittest.main()
