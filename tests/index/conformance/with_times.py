"""Times in every container that has arrays of them: units, calendars and fill values after CF and its relatives. Dates are
those of cftime; of months and years, which cftime does not count, they are told from the calendar."""
import cftime
import h5py
import netCDF4
import numpy as np
import zarr

from manifest import done, expect, field, path

VERSION_2 = dict(zarr_format=2) if int(zarr.__version__.split(".")[0]) >= 3 else {}
NAMES = "time", "z", "y", "x"
FILL = 9.969209968386869e36


def netcdf(form):
    def write(name, values, times, attributes):
        with netCDF4.Dataset(path(name + ".nc"), "w", format=form) as out:
            for dimension, length in zip(NAMES, values.shape):
                out.createDimension(dimension, None if dimension == "time" else length)
            time = out.createVariable("time", times.dtype, "time", fill_value=attributes.get("_FillValue"))
            time.setncatts({k: v for k, v in attributes.items() if k != "_FillValue"})
            time.set_auto_mask(False)
            time[:] = times
            out.createVariable("v", "f4", NAMES)[:] = values
        return name + ".nc"
    return write


def hdf5(with_scale):
    def write(name, values, times, attributes):
        with h5py.File(path(name + ".h5"), "w") as out:
            out["v"], out["time"] = values, times
            out["time"].attrs.update(attributes)
            if with_scale:
                out["time"].make_scale()
                out["v"].dims[0].attach_scale(out["time"])
        return name + ".h5"
    return write


def zarr2(name, values, times, attributes):
    name += ".zarr"
    zarr.open_group(path(name), mode="w", **VERSION_2)
    for array, data, dimensions, more in (("v", values, NAMES, {}), ("time", times, NAMES[:1], attributes)):
        made = zarr.create(store=path(f"{name}/{array}"), shape=data.shape, dtype=data.dtype, chunks=data.shape,
                           fill_value=None, **VERSION_2)
        made[...] = data
        made.attrs.update(_ARRAY_DIMENSIONS=list(dimensions), **{k: v if isinstance(v, str) else float(v) for k, v in more.items()})
    return name


CONTAINERS = dict(classic=netcdf("NETCDF3_CLASSIC"), netcdf4=netcdf("NETCDF4"), hdf5=hdf5(False), scale=hdf5(True), zarr=zarr2)
number = 0


def row(times, attributes, left=None, dates=None, **more):
    """left: the times that are left. dates: of all of them."""
    global number
    if dates:
        dates = [date + " 00:00:00"[len(date) - 10:] for date in dates]
    times = times if isinstance(times, np.ndarray) else np.array(times, "f8")
    for container, write in CONTAINERS.items():
        values = field(len(times), 5, 6, 7)
        number += 1
        name = write(f"{container}_{number}", values, times, attributes)
        left_here = times if left is None else left
        expect(name, values[:len(left_here)], times=left_here, array="v", dates=dates, **more)


# Calendars, in the names of CF and FMS.
for calendar, known in [("standard", "standard"), ("GREGORIAN", "standard"), ("proleptic_gregorian", "proleptic_gregorian"),
                        ("julian", "julian"), ("JULIAN", "julian"), ("noleap", "noleap"), ("NO_LEAP", "noleap"),
                        ("365_day", "noleap"), ("all_leap", "all_leap"), ("366_day", "all_leap"), ("360_day", "360_day"),
                        ("THIRTY_DAY_MONTHS", "360_day")]:
    for unit, times in [("days since 1900-02-27", [0, 1, 2, 3, 4, 400]), ("hours since 0001-12-30 12:00", [0., 12, 24, 36, 8760, 1e5]),
                        ("seconds since 1582-10-04 23:59:59", [0., 1, 61, 86400, 1e6, 1e9])]:
        dates = [f"{d.year:04}" + d.strftime("-%m-%d %H:%M:%S") for d in cftime.num2date(times, unit, known)]
        row(times, dict(units=unit, calendar=calendar), dates=dates)

# Months and years.
row([0, 1, 2, 12, 13], dict(units="months since 1979-01-01", calendar="standard"),
    dates=["1979-01-01", "1979-02-01", "1979-03-01", "1980-01-01", "1980-02-01"], note="months of the calendar")
row([0, .5, 1, 1.5, 2], dict(units="Months since 2001-01-31 06:00", calendar="noleap"),
    dates=["2001-01-31 06:00", "2001-02-14 06:00", "2001-02-28 06:00", "2001-03-15 18:00", "2001-03-31 06:00"])
row([0, 1, 2, 3, 3.5], dict(units="months since 2000-01-01", calendar="360_day"),
    dates=["2000-01-01", "2000-02-01", "2000-03-01", "2000-04-01", "2000-04-16"])
row([0, 1, 2, 3, 4], dict(units="years since 1999-03-01"),
    dates=["1999-03-01", "2000-03-01", "2001-03-01", "2002-03-01", "2003-03-01"])

# What is no date is said to be none.
row([0., 1, 2, 3, 4], dict(units="days since 0000-00-00"), note="are no dates")
row([0., 1, 2, 3, 4], dict(units="days since 2000-01-01", calendar="martian"), note="are no dates")
row([0., 1, 2, 3, 4], dict(units="days since the beginning"))
row([20000228., 20000229.5, 20000301, 20000302, 20001231], dict(units="day as %Y%m%d.%f", calendar="standard"),
    left=[0, 1.5, 2, 3, 307], dates=["2000-02-28", "2000-02-29 12:00", "2000-03-01", "2000-03-02", "2000-12-31"])

# A stopped run: the last records have no time.
days = dict(units="days since 2000-01-01")
for missing, attributes in [(FILL, {}), (-9999., dict(_FillValue=-9999.)), (1e20, dict(missing_value=1e20)), (np.nan, {})]:
    row([0., 1, 2, 3, missing], {**days, **attributes}, left=[0, 1, 2, 3], note="step 4 has no time")
    row([5., 6, 7, missing, missing], {**days, **attributes}, left=[5, 6, 7], note="steps 3 to 4 have no time")
row(np.array([0, 1, 2, 3, -2147483647], "i4"), days, left=[0, 1, 2, 3], note="step 4 has no time")
# A fill value that is a time among others is that time.
row([0., 1, 2, 3, 4], {**days, "_FillValue": 0.}, left=[0, 1, 2, 3, 4])
row([-9999., 1, 2, 3, 4], {**days, "missing_value": -9999.}, left=[-9999, 1, 2, 3, 4])
row([FILL] * 5, days, left=[0, 1, 2, 3, 4], note="steps have no times")
done()
