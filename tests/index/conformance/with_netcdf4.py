"""NetCDF in its four formats by netCDF4: types, packed and missing values, groups, filters, times of several calendars."""
import netCDF4
import numpy as np

from manifest import done, expect, field, path, refuse

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
with new("group.nc") as file:
    add(file.createGroup("run"), moving, "p")
    add(file, -moving, "rho")
expect("group.nc", moving, array="run/p", times=[0, 1, 2.5], **where)
expect("group.nc", -moving, array="rho", times=[0, 1, 2.5], **where)
with new("units.nc") as file:  # each step is a group, whose time has a unit of its own
    for number, (at, unit) in enumerate(((0, "hours since 2000-02-27"), (6, "hours since 2000-02-27"),
                                         (180, "minutes since 2000-02-28"))):
        group = file.createGroup(f"step{number}")
        group.createVariable("rho", "f4", ("z", "y", "x"))[:] = moving[number]
        time = group.createVariable("time", "f8", ())
        time.units = unit
        time[...] = at
expect("units.nc", moving, times=[0, 6, 27], **where)
# Files that count from other dates are in the first one's unit, as num2date and date2num have it.
for calendar in ("standard", "noleap", "360_day"):
    first, second = "days since 2000-02-27", "hours since 2000-03-01 06:00"
    for number, (units, times) in enumerate(((first, [0, 1]), (second, [3, 30]))):
        with new(f"{calendar}{number}.nc", times=times, units=units, calendar=calendar) as file:
            add(file, moving[:2] + number)
    dates = netCDF4.num2date([3, 30], second, calendar)
    times = [0, 1, *netCDF4.date2num(dates, first, calendar)]
    expect([f"{calendar}0.nc", f"{calendar}1.nc"], np.concatenate([moving[:2], moving[:2] + np.float32(1)]), times=times, **where)


# Vectors whose components are arrays of their own.
def derived(u, v, w, dz, dy, dx):
    """Length, length of the curl and Q of one step."""
    slopes = np.array([[np.gradient(part.astype("f8"), *(dz, dy, dx))[axis] for axis in (2, 1, 0)] for part in (u, v, w)])
    (_, uy, uz), (vx, _, vz), (wx, wy, _) = slopes
    rotation, strain = (slopes - slopes.swapaxes(0, 1)) / 2, (slopes + slopes.swapaxes(0, 1)) / 2
    return (np.sqrt(u.astype("f8") ** 2 + v.astype("f8") ** 2 + w.astype("f8") ** 2),
            np.sqrt((wy - vz) ** 2 + (uz - wx) ** 2 + (vx - uy) ** 2),
            ((rotation ** 2).sum((0, 1)) - (strain ** 2).sum((0, 1))) / 2)


def expect_derived(name, names, parts, **more):
    steps = [derived(*step, *more.get("spacing", (1, 1, 1))[::-1]) for step in zip(*parts)]
    for number, component in enumerate(("magnitude", "vorticity", "q-criterion")):
        expect(name, np.array([step[number] for step in steps]), array=names, component=component, kind="rounded", **more)


parts = [field(3, 4, 5, 6) for _ in range(3)]
with new("vector.nc") as file:
    for name, values in zip("uvw", parts):
        add(file, values, name)
    add(file, moving, "one,two")
expect_derived("vector.nc", "u,v,w", parts, times=[0, 1, 2.5], **where)
expect("vector.nc", np.hypot(parts[0].astype("f8"), parts[2].astype("f8")), array="u,w", kind="rounded", times=[0, 1, 2.5],
       **where)
expect("vector.nc", moving, array="one,two", times=[0, 1, 2.5], **where)
refuse("vector.nc", "--component vorticity of u,w, expected magnitude", array="u,w", component="vorticity")
refuse("vector.nc", "none", array="u,v,none")


# As WRF has it: staggered winds, and dates as text.
def wrf(name, first_hour, winds, dates=None):
    with netCDF4.Dataset(path(name), "w", format="NETCDF3_64BIT_OFFSET") as file:
        for dimension, length in (("Time", None), ("DateStrLen", 19), ("bottom_top", 4), ("south_north", 5), ("west_east", 6),
                                  ("bottom_top_stag", 5), ("south_north_stag", 6), ("west_east_stag", 7)):
            file.createDimension(dimension, length)
        text = file.createVariable("Times", "S1", ("Time", "DateStrLen"))
        dates = dates or [f"2005-08-28_{first_hour + i:02d}:30:00" for i in range(len(winds[0]))]
        text[:] = np.array([list(date) for date in dates], "S1")
        for i, (variable, values) in enumerate(zip("UVW", winds)):
            space = ["bottom_top", "south_north", "west_east"]
            space[2 - i] += "_stag"
            file.createVariable(variable, "f4", ("Time", *space))[:] = values


def centered(winds):
    return [np.float32((w.astype("f8").take(range(1, w.shape[a]), a) + w.astype("f8").take(range(w.shape[a] - 1), a)) / 2)
            for w, a in zip(winds, (3, 2, 1))]


winds = [field(2, 4, 5, 7), field(2, 4, 6, 6), field(2, 5, 5, 6)]
later = [-wind for wind in winds]
wrf("wrfout_1", 12, winds)
wrf("wrfout_2", 14, later)
files = ["wrfout_1", "wrfout_2"]
expect(files, np.concatenate([winds[0], later[0]]), array="U", times=[0, 3600, 7200, 10800])
both = [np.concatenate(pair) for pair in zip(centered(winds), centered(later))]
expect_derived(files, "U,V,W", both, times=[0, 3600, 7200, 10800], origin=(0.5, 0, 0))
wrf("odd", 0, [wind[:1] for wind in winds], dates=["2005-13-28_12:30:00"])
expect("odd", winds[0][:1], array="U")
done()
