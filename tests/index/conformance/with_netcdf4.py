"""NetCDF in its four formats by netCDF4: types, packed and missing values, groups, filters, times of several calendars."""
import netCDF4
import numpy as np

from manifest import done, expect, field, path

moving = field(3, 4, 5, 6)
where = dict(origin=(10, 20, 5), spacing=(0.5, 2, 3))


def new(name, kind="NETCDF4", times=(0, 1, 2.5), units="hours since 2009-09-09 17:00:00", calendar=None):
    file = netCDF4.Dataset(path(name), "w", format=kind)
    for dimension, length in (("time", None), ("z", 4), ("y", 5), ("x", 6)):
        file.createDimension(dimension, length)
    for i, dimension in enumerate("xyz"):
        axis = file.createVariable(dimension, "f8", (dimension,))
        axis.units = "m"
        axis[:] = where["origin"][i] + where["spacing"][i] * np.arange(len(file.dimensions[dimension]))
    time = file.createVariable("time", "f8", ("time",))
    time.units = units
    if calendar:
        time.calendar = calendar
    time[:] = times
    return file


def add(group, values, name="rho", kind="f4", **how):
    variable = group.createVariable(name, kind, ("time", "z", "y", "x"), **how)
    variable[:] = values
    return variable


for number, kind in enumerate(("NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET", "NETCDF3_64BIT_DATA", "NETCDF4", "NETCDF4_CLASSIC")):
    with new(f"kind{number}.nc", kind) as file:
        add(file, moving)
    expect(f"kind{number}.nc", moving, times=[0, 1, 2.5], **where)
for kind in ("i1", "i2", "i4", "f8"):
    values = field(3, 4, 5, 6, dtype=kind)
    with new(f"{kind}.nc", "NETCDF3_CLASSIC") as file:
        file.set_auto_mask(False)
        add(file, values, kind=kind)
    expect(f"{kind}.nc", values, times=[0, 1, 2.5], **where)
for name, how in (("deflated", dict(zlib=True, shuffle=True)), ("chunked", dict(chunksizes=(1, 2, 3, 6))),
                  ("checked", dict(fletcher32=True, chunksizes=(1, 4, 5, 6))), ("big", dict(kind=">f4", endian="big"))):
    with new(f"{name}.nc") as file:
        add(file, moving, **how)
    expect(f"{name}.nc", moving, times=[0, 1, 2.5], **where)
with new("packed.nc") as file:
    packed = file.createVariable("rho", "i2", ("time", "z", "y", "x"))
    packed.scale_factor, packed.add_offset = 0.25, -3.0
    packed.set_auto_maskandscale(False)
    stored = field(3, 4, 5, 6, dtype="i2") // 2
    packed[:] = stored
expect("packed.nc", stored * 0.25 - 3.0, times=[0, 1, 2.5], **where)
with new("missing.nc") as file:
    holes = np.ma.masked_array(moving, mask=np.random.default_rng(1).random(moving.shape) < 0.2)
    add(file, holes, fill_value=np.float32(1e20))
with netCDF4.Dataset(path("missing.nc")) as file:
    expect("missing.nc", np.ma.filled(file["rho"][:].astype("f8"), np.nan), times=[0, 1, 2.5], **where)
with new("group.nc") as file:
    add(file.createGroup("run"), moving, "p")
    add(file, -moving, "rho")
expect("group.nc", moving, array="run/p", times=[0, 1, 2.5], **where)
expect("group.nc", -moving, array="rho", times=[0, 1, 2.5], **where)
# Files that count from other dates are in the first one's unit, as num2date and date2num have it.
for calendar in ("standard", "noleap", "360_day"):
    first, second = "days since 2000-02-27", "hours since 2000-03-01 06:00"
    for number, (units, times) in enumerate(((first, [0, 1]), (second, [3, 30]))):
        with new(f"{calendar}{number}.nc", times=times, units=units, calendar=calendar) as file:
            add(file, moving[:2] + number)
    dates = netCDF4.num2date([3, 30], second, calendar)
    times = [0, 1, *netCDF4.date2num(dates, first, calendar)]
    expect([f"{calendar}0.nc", f"{calendar}1.nc"], np.concatenate([moving[:2], moving[:2] + np.float32(1)]), times=times, **where)
done()
