"""An index built of arrays is the one that the same data in a NetCDF file give."""

import datetime
import os
import tempfile
import unittest

import h5py
import numpy as np
import xarray

import isochron
from made_series import active_cells

SHAPE = (3, 6, 7, 9)  # t, z, y, x
RANDOM = np.random.default_rng(5)


def data_array(values=None, dims=("time", "z", "y", "x"), attrs=None, **coords):
    """coords: axis=(values, attributes)"""
    if values is None:
        values = RANDOM.random(SHAPE[-len(dims):], dtype=np.float32)
    return xarray.DataArray(values, {name: (dims_of(name, dims), *of) for name, of in coords.items()}, dims, "rho", attrs)


def dims_of(name, dims):
    return name if name in dims else ()


def even(length, first=0.0, step=1.0):
    return first + step * np.arange(float(length))


PLEV = np.array([1000.0, 850, 700, 500, 300, 200])
GRID = {"lev": (PLEV, {"units": "hPa"}), "lat": (even(7, 60, -2.5), {"units": "degrees_north"}),
        "lon": (even(9, 5, 2.5), {"units": "degrees_east"})}
METERS = {axis: (even(n, 2, step), {"units": "m"}) for axis, n, step in (("z", 6, 3.0), ("y", 7, 0.5), ("x", 9, 0.25))}
GEO = ("time", "lev", "lat", "lon")
DATES = {"units": "days since 2000-02-28", "calendar": "360_day"}

CASES = {
    "no coordinates": lambda: data_array(),
    "one step": lambda: data_array(dims=("z", "y", "x"), **METERS),
    "one step with a time": lambda: data_array(dims=("z", "y", "x"), **METERS, time=(np.float64(7.5), {"units": "s"})),
    "a dimension of one step": lambda: data_array(RANDOM.random((1, *SHAPE[1:])), **METERS, time=([4.0], {"units": "s"})),
    "even in meters": lambda: data_array(attrs={"units": "kg m-3"}, **METERS, time=(even(3, 1, 0.5), {"units": "s"})),
    "uneven": lambda: data_array(**{**METERS, "z": (even(6) ** 2, {"units": "m"})}),
    "descending": lambda: data_array(**{**METERS, "y": (even(7, 9, -0.5), {"units": "m"}), "x": (even(9, 3, -1), {"units": "m"})}),
    "pressure, latitudes from north": lambda: data_array(dims=GEO, **GRID, time=(even(3), {"units": "hours since 1970-01-01"})),
    "pressure in pascals that rises": lambda: data_array(dims=GEO, **{**GRID, "lev": (100 * PLEV[::-1], {"units": "Pa"})}),
    "depth that counts down": lambda: data_array(
        dims=("time", "depth", "lat", "lon"), lat=GRID["lat"], lon=GRID["lon"],
        depth=(even(6, 5, 10), {"units": "m", "positive": "down"})),
    "units that differ": lambda: data_array(**{**METERS, "z": (even(6), {"units": "km"})}),
    "axes by their attributes": lambda: data_array(
        dims=("time", "c", "b", "a"), c=(even(6), {"axis": "X", "units": "m"}), b=(even(7), {"axis": "Z", "units": "m"}),
        a=(even(9), {"axis": "Y", "units": "m"})),
    "x slowest": lambda: data_array(dims=("x", "y", "z"), **{a: (even(n), {"units": "m"}) for a, n in zip("xyz", SHAPE[1:])}),
    "time last": lambda: data_array(RANDOM.random((6, 7, 9, 3)), dims=("z", "y", "x", "time"), **METERS,
                                    time=(even(3), {"units": "s"})),
    "time by another name": lambda: data_array(RANDOM.random((6, 3, 7, 9)), dims=("z", "when", "y", "x"), **METERS,
                                               when=(even(3), {"units": "hours since 1990-01-01"})),
    "time that only its place tells": lambda: data_array(dims=("n", "z", "y", "x"), **METERS),
    "a calendar": lambda: data_array(dims=GEO, **GRID, time=(even(3), DATES)),
    "longitudes across the date line": lambda: data_array(dims=GEO, **{**GRID, "lon": (
        np.array([160.0, 170, 180, -170, -160, -150, -140, -130, -120]), {"units": "degrees_east"})}),
    "spacing of single precision": lambda: data_array(**{**METERS, "x": (np.float32(0.1) * np.arange(9, dtype=np.float32), {})}),
    **{f"values {kind}": (lambda kind=kind: data_array((100 * RANDOM.random(SHAPE)).astype(kind), **METERS))
       for kind in ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8", ">f4", ">i2")},
    "missing values": lambda: data_array(np.where(RANDOM.random(SHAPE) < 0.1, np.nan, RANDOM.random(SHAPE)), **METERS),
    "a valid range": lambda: data_array(RANDOM.random(SHAPE), attrs={"valid_range": np.array([0.1, 0.9])}, **METERS),
    "packed, as stored": lambda: data_array(
        RANDOM.integers(-50, 50, SHAPE).astype(np.int16), attrs={"scale_factor": 0.01, "add_offset": 7.0}, **METERS),
    "packed with gaps, as stored": lambda: data_array(
        RANDOM.integers(-9, 9, SHAPE).astype(np.int16), attrs={"scale_factor": 0.5, "_FillValue": np.int16(-3)}, **METERS),
    "gaps and limits, as stored": lambda: data_array(
        RANDOM.integers(-9, 9, SHAPE).astype(np.int16),
        attrs={"missing_value": np.int16(2), "valid_min": np.int16(-6), "valid_max": np.int16(7)}, **METERS),
    "real limits of packed integers": lambda: data_array(
        RANDOM.integers(-9, 9, SHAPE).astype(np.int16), attrs={"scale_factor": 0.5, "valid_range": np.array([-2.0, 3.5])}, **METERS),
}


def said_by(run):
    """All that a run says, but for the names of its sources."""
    about = dict(run._array(None).description())
    levels = [[axis.tolist() for axis in level] for level in about.pop("levels")]
    return {**about, "levels": levels, "times": run.times.tolist()}


class FolderTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def expect_same(self, one, other):
        self.assertEqual(said_by(one), said_by(other))
        for step in range(len(other)):
            np.testing.assert_array_equal(one.values(step), other.values(step))


class Xarray(FolderTest):
    def test_means_what_it_means_in_a_file(self):
        for name, make in CASES.items():
            with self.subTest(name):
                data = make()
                stored = data.to_dataset()
                if stored.rho.dtype.kind == "f" and "_FillValue" not in stored.rho.attrs:
                    stored.rho.encoding["_FillValue"] = stored.rho.dtype.type(np.nan)
                stored.to_netcdf("a.nc", engine="netcdf4")
                of_file = isochron.build("a.nc", "file.isochron", array="rho")
                self.expect_same(isochron.build(data, "array.isochron"), of_file)
                self.expect_same(isochron.build(data.chunk(3), "dask.isochron"), of_file)
                self.expect_same(data.isochron.build("accessor.isochron"), of_file)
                for options in ({}, {"mask_and_scale": False, "decode_times": False}):
                    with xarray.open_dataset("a.nc", **options) as opened:  # which reads when it is asked
                        again = isochron.build(opened, "opened.isochron", array="rho")
                        if options or data.dtype.kind == "f" or not set(data.attrs) & {"scale_factor", "missing_value"}:
                            self.expect_same(again, of_file)

    def test_options_mean_what_they_mean_for_files(self):
        data = data_array(dims=GEO, **GRID, time=(even(3), DATES)).to_dataset()
        data["T"] = data.rho * 2
        data.to_netcdf("a.nc")
        for options in (
            {"crop": {"x": slice(2, 7), "y": slice(0, 7), "z": slice(1, 5)}},
            {"crop": np.s_[1:5, 0:7, 2:7]},
            {"crop": "2:6,0:6,1:4"},
            {"stride": 2}, {"stride": (1, 2, 3)}, {"stride": "3,2,1"}, {"stride": {"x": 3, "y": 2, "z": 1}},
            {"steps": slice(0, 3, 2)}, {"steps": "0:2:2"}, {"steps": range(1, 3)}, {"steps": np.int64(1)},
            {"spacing": (3, 2, np.float32(0.5))}, {"spacing": {"z": 3, "y": 2, "x": 0.5}, "origin": (1, 2, np.int16(3))},
            {"time_step": 0.25, "time_unit": "s", "length_unit": "mm", "value_unit": "K"},
            {"times": [1, 2.5, np.float32(4)]}, {"times": np.array(["2001-01-01", "2001-01-02", "2001-02-01"], "M8[D]")},
            {"type": "f64"}, {"type": np.float64}, {"component": "gradient"},
            {"tiers": "none"}, {"tiers": ["bricks", "tree"]}, {"codec": "zstd"}, {"lattice": 16}, {"threads": 1},
        ):
            with self.subTest(**options):
                of_file = isochron.build("a.nc", "file.isochron", array="rho", **options)
                self.expect_same(isochron.build(data, "array.isochron", array="rho", **options), of_file)
                self.assertEqual(os.path.getsize("array.isochron") // 4096, os.path.getsize("file.isochron") // 4096)

    def test_several_arrays(self):
        data = data_array(**METERS).to_dataset()
        data["T"] = 2 * data.rho
        for options in ({"array": ["rho", "T"]}, {"all_arrays": True}, {"array": "*"}):
            run = isochron.build(data, "all.isochron", **options)
            self.assertEqual(run.arrays, ("rho", "T"))
            np.testing.assert_array_equal(run.values(1, array="T"), data["T"].values[1])
        colored = isochron.build(data, "colored.isochron", array="rho", color="T")
        self.assertEqual(colored.arrays, ("rho",))
        with self.assertRaisesRegex(isochron.Error, r"^xarray.Dataset: .*rho.*T.*array") as raised:
            isochron.build(data, "which.isochron")
        self.assertNotIn("--", str(raised.exception))
        vector = isochron.build(data, "vector.isochron", array="rho,T")
        np.testing.assert_allclose(vector.values(0), np.sqrt(5) * data.rho.values[0], rtol=1e-6)

    def test_a_list_has_an_array_for_each_step(self):
        data = data_array(**METERS, time=(even(3, 2), {"units": "s"}))
        steps = [data.isel(time=step) for step in range(3)]
        self.expect_same(isochron.build(steps, "list.isochron"), isochron.build(data, "array.isochron"))

    def test_appends_the_steps_that_are_not_there(self):
        data = data_array(**METERS, time=(even(3, 2), {"units": "s"}))
        isochron.build(data.isel(time=slice(0, 2)), "a.isochron").close()
        asked = []
        run = isochron.build(data, "a.isochron", append=True, progress=lambda *of: asked.append(of))
        self.expect_same(run, isochron.build(data, "b.isochron"))
        isochron.build(data, "a.isochron", append=True).close()  # there is nothing to add
        with self.assertRaisesRegex(isochron.Error, "a.isochron: cannot be appended to"):
            isochron.build(data.isel(time=slice(1, 3)), "a.isochron", append=True)
        with self.assertRaisesRegex(isochron.Error, "a.isochron: cannot be appended to"):
            isochron.build(data + 1, "a.isochron", append=True)

    def test_what_cannot_be_indexed_is_said_in_the_words_of_python(self):
        data = data_array(**METERS)
        for given, options, line in (
            (data.isel(z=0), {}, "no array with three dimensions of more than one vertex"),
            (data.expand_dims(member=2), {}, r"isel\(member=0\) takes one of member"),
            (data.astype(complex), {}, "values of type complex128, expected real numbers"),
            (data, {"array": "height"}, "height"),
            (data, {"refer": True}, "refer: is for files"),
            (data, {"dims": (9, 7, 6)}, "dims: is for files"),
            (data, {"crop": {"x": slice(5, 99), "q": slice(3)}}, "crop: expected slices along z, y and x"),
            (data, {"crop": "0:99,0:1,0:1"}, "crop 0:99 along x, expected vertices of 0:8"),
            (data, {"steps": slice(5, 9)}, "steps: expected at least one of 0 to 2"),
            (data, {"stride": 0}, "stride 0"),
            (data, {"spacing": (1, 2)}, "spacing: expected 3 numbers"),
            (data, {"spacing": (1, 2, -1)}, "spacing: expected a positive number, got -1"),
            (data, {"type": "f16"}, "type: expected one of i8"),
            (data, {"component": 1}, "component 1"),
            (data, {"times": [1, 2]}, "times: 2 given, expected 3"),
            (data, {"times": [1, 2, 2]}, "times: expected numbers that increase"),
            (data, {"tiers": "leaves"}, "tiers: leaves: expected none, or some of"),
            (data, {"codec": "gzip"}, "codec: expected one of none, lz4, zstd, got gzip"),
            (data.assign_coords(x=RANDOM.random(9)), {}, "x"),
            ({"a": data.values, "b": data.values[:2]}, {"array": "a"}, "b: 2 along time, expected 3"),
            (data.values[..., :1], {}, "expected three dimensions|no array with three"),
            (data.values[:0], {}, "no values along time"),
            ([], {}, "expected an array|no files"),
            (7, {}, "expected names of files or arrays, got 7"),
            (iter([data.values]), {}, "expected a list of them"),
        ):
            with self.subTest(line), self.assertRaisesRegex(isochron.Error, line) as raised:
                isochron.build(given, "a.isochron", **options)
            self.assertNotIn("--", str(raised.exception))
            self.assertNotIn("/tmp", str(raised.exception))
            self.assertEqual(os.listdir(), [])


class Arrays(FolderTest):
    def setUp(self):
        super().setUp()
        self.values = RANDOM.random(SHAPE, dtype=np.float32)

    def test_of_many_kinds(self):
        import dask.array

        values = self.values
        with h5py.File("a.h5", "w") as file:
            stored = file.create_dataset("rho", data=values)
            for given in (
                values, values.copy(order="F"), values[:, ::-1][:, ::-1], values.astype(">f4"), list(values),
                np.moveaxis(np.ascontiguousarray(np.moveaxis(values, 0, -1)), -1, 0), stored, np.ma.array(values),
                dask.array.from_array(values, chunks=(1, 3, 7, 9)), dask.array.from_array(values, chunks=(2, 6, 7, 5)),
                [dask.array.from_array(step) for step in values], {"rho": values}, np.asarray(values).view(np.memmap),
            ):
                with self.subTest(type=type(given)):
                    run = isochron.build(given, "a.isochron", array="rho", spacing=(3, 2, 1))
                    self.assertEqual((run.arrays, run.spacing, run.shape), (("rho",), (3, 2, 1), SHAPE))
                    for step in range(SHAPE[0]):
                        np.testing.assert_array_equal(run.values(step), values[step])
        one = isochron.build(values[0], "one.isochron")
        self.assertEqual((one.arrays, one.shape), (("values",), (1, *SHAPE[1:])))

    def test_no_number_stands_for_a_missing_one(self):
        for value in (9.96921e36, -9999, 1e20):
            self.values[1, 2, 3, 4] = value
            run = isochron.build(self.values, "a.isochron")
            np.testing.assert_array_equal(run.values(1), self.values[1])
        whole = self.values.astype(np.int16)
        whole[0, 0, 0, 0] = -32767
        np.testing.assert_array_equal(isochron.build(whole, "b.isochron").values(0), whole[0])

    def test_masked_values_are_missing(self):
        for kind, found in ((np.float32, np.float32), (np.int16, np.float32), (np.int32, np.float64)):
            masked = np.ma.array((99 * self.values).astype(kind), mask=self.values < 0.1)
            run = isochron.build(masked, "a.isochron")
            self.assertEqual(run.values(0).dtype, found)
            np.testing.assert_array_equal(run.values(0), masked[0].astype(found).filled(np.nan))

    def test_types_that_no_index_has_are_converted(self):
        for given, kind in ((self.values.astype(np.float16), np.float32), (self.values > 0.5, np.uint8),
                            ((99 * self.values).astype(np.int64), np.float64), (self.values.astype(np.longdouble), np.float64)):
            run = isochron.build(given, "a.isochron")
            self.assertEqual(run.values(0).dtype, kind)
            np.testing.assert_array_equal(run.values(0), given[0].astype(kind))
        with self.assertRaisesRegex(isochron.Error, "64-bit integer without an exact float64"):
            isochron.build(np.full(SHAPE, 2**62 + 1), "a.isochron")

    def test_cells_are_those_of_a_scan(self):
        run = isochron.build(self.values, "a.isochron")
        for step in range(SHAPE[0]):
            np.testing.assert_array_equal(run.cells(0.5, step), active_cells(self.values[step], 0.5))

    def test_each_step_is_read_once_and_alone(self):
        class Watched:
            shape, dtype = SHAPE, np.dtype(np.float32)

            def __init__(self, values):
                self.values, self.asked = values, []

            def __getitem__(self, step):
                self.asked.append(step)
                return self.values[step]

        watched = Watched(self.values)
        isochron.build(watched, "a.isochron").close()
        self.assertEqual(sorted(watched.asked), [0, 1, 2])

    def test_what_an_array_raises_is_raised(self):
        class Broken:
            shape, dtype = SHAPE, np.dtype(np.float32)

            def __getitem__(self, step):
                raise ZeroDivisionError("of the array")

        with self.assertRaisesRegex(ZeroDivisionError, "of the array"):
            isochron.build(Broken(), "a.isochron")
        self.assertEqual(os.listdir(), [])

    def test_names_are_those_of_the_arrays(self):
        dims = ("t", "z", "y", "x")
        for name, found in (("my rho", "my rho"), ("a/b", "a_b"), (7, "7"), ("ρ", "ρ"), (None, "values"), ("time", "time")):
            run = isochron.build(xarray.DataArray(self.values, dims=dims, name=name), "a.isochron")
            self.assertEqual(run.arrays, (found,))
        self.assertEqual(isochron.build(xarray.DataArray(self.values, dims=dims), "a.isochron", array="rho").arrays, ("rho",))

    def test_steps_are_put_in_the_order_of_their_times(self):
        data = xarray.DataArray(self.values, {"time": [3.0, 1, 2]}, ("time", "z", "y", "x"))
        run = isochron.build(data, "a.isochron")
        self.assertEqual(run.times.tolist(), [1, 2, 3])
        np.testing.assert_array_equal(run.values(2), self.values[0])
        self.assertIn("xarray.DataArray: its steps are put in the order of their times: 1 follows 3", run.notes)

    def test_times_are_numbers_or_dates(self):
        for times, numbers, unit in (
            ([0, 0.5, 2], [0, 0.5, 2], ""),
            (np.array([3, 4, 5], np.int16), [3, 4, 5], ""),
            (np.array(["2000-02-28", "2000-02-29", "2000-03-01"], "M8[D]"), [0, 86400, 172800], "seconds since 2000-02-28"),
            ([datetime.datetime(1999, 12, 31, hour) for hour in (1, 2, 4)], [0, 3600, 10800], "seconds since 1999-12-31 01:00:00"),
        ):
            run = isochron.build(self.values, "a.isochron", times=times)
            self.assertEqual((run.times.tolist(), run.time_unit), (numbers, unit))

    def test_raw_files_are_described_as_on_the_command_line(self):
        for step, values in enumerate(self.values):
            with open(f"t{step}.raw", "wb") as file:
                file.write(b"head" + values.astype(">f4").tobytes())
        run = isochron.build("t*.raw", "raw.isochron", dims=(9, 7, np.int64(6)), type="f32", big_endian=True, header_bytes=4,
                             spacing=(3, 2, 1), origin=(7, 8, 9), times=[1, 2, 4], time_unit="s", length_unit="mm")
        same = isochron.build(self.values, "array.isochron", spacing=(3, 2, 1), origin=(7, 8, 9), times=[1, 2, 4],
                              time_unit="s", length_unit="mm")
        self.assertEqual((run.origin, run.times.tolist()), ((7, 8, 9), [1, 2, 4]))
        for step in range(3):
            np.testing.assert_array_equal(run.values(step), same.values(step))
        refers = isochron.build("t*.raw", "refers.isochron", dims=(9, 7, 6), type="f32", big_endian=True, header_bytes=4, refer=True)
        np.testing.assert_array_equal(refers.values(2), self.values[2])
        self.assertLess(os.path.getsize("refers.isochron"), os.path.getsize("raw.isochron"))


if __name__ == "__main__":
    unittest.main()
