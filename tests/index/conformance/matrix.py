"""The same statement in every container that can make it gives the same surface, times, units and notes.

    matrix.py PROGRAM [--only CONTAINER,...] [--rows STATEMENT,...] [--keep FOLDER]

prints the table, statements by containers: `=` the same, `-` the container has no way to say it (LACKS in containers.py has the
place in its specification), `X` anything else, which fails. A new row is a function here that changes the plain record of
record.py; a new column is a function in containers.py that writes a record. What is expected follows from the record by numpy.
"""
import argparse
import copy
import glob
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from containers import CONTAINERS, LACKS
from record import METERS, SECONDS, Axis, crossings, meaning, plain

ISOVALUE = 14.25  # the values of each step are 3 more than those of the step before
STATEMENTS = {}


def statement(name, *needs, sizes=(5, 6, 7, 8)):
    """needs: what a container must be able to say for it. sizes: along t, z, y and x."""

    def add(change):
        STATEMENTS[name] = (change, needs, sizes)
        return change

    return add


# ---- Places
@statement("order zyx")
def order_zyx(record):
    pass


@statement("order xyz", "order")
def order_xyz(record):
    record.ordered("txyz")


@statement("order yxz", "order")
def order_yxz(record):
    record.ordered("tyxz")


@statement("few steps", "time told", sizes=(3, 4, 5, 6))
def few_steps(record):
    """As few as a vector has components."""


@statement("no time", sizes=(1, 6, 7, 8))
def no_time(record):
    record.axis("t").name = ""


@statement("an axis of one", "extra axis")
def an_axis_of_one(record):
    record.axes.insert(1, Axis("s", "band", np.zeros(1)))
    record.values = record.values[:, None]


@statement("member", "member", "extra axis", "names")
def member(record):
    """Runs of an ensemble, of which one is read."""
    record.axes.insert(0, Axis("m", "member", np.arange(3.0)))
    record.values, record.member = np.stack([record.values + 40, record.values, record.values - 40]), 1


@statement("origin", "spacing", "origin")
def origin(record):
    for axis, more in zip(record.axes[1:], (-40, 7, 0.25)):
        axis.at = axis.at + more


@statement("unit of length", "spacing", "unit")
def unit_of_length(record):
    for axis in record.axes[1:]:
        axis.unit = "um"


@statement("units in words", "unit words", "time unit")
def units_in_words(record):
    for axis in record.axes:
        axis.unit = "hours" if axis.role == "t" else "micrometers"


@statement("units by axis", "spacing", "unit", "unit by axis")
def units_by_axis(record):
    for role, unit in zip("xyz", ("mm", "um", "m")):
        axis = record.axis(role)
        axis.at, axis.unit = axis.at * METERS["mm"] / METERS[unit], unit
    record.may = ["all are given in"]


@statement("units without proportion", "spacing", "unit", "unit by axis", "unit any")
def units_without_proportion(record):
    axis = record.axis("z")
    axis.at, axis.unit = axis.at * 100, "V"
    record.notes = ["units differ"]


@statement("uneven", "spacing", "uneven all")
def uneven(record):
    for role, first in (("x", 10), ("y", 20), ("z", 5)):
        number = np.arange(len(record.axis(role).at))
        record.axis(role).at = first + number * (number + 1) / 2
    record.notes = [rf"\b{role}\b.* is not uniform" for role in "xyz"]


@statement("uneven slices", "spacing", "uneven slices")
def uneven_slices(record):
    record.axis("z").at = np.array([5, 6, 8.5, 12, 13, 15.5])
    record.notes = ["is not uniform|are .* apart"]


@statement("descending", "spacing", "origin", "descending")
def descending(record):
    for role in "xyz":
        record.flip(role)


@statement("descending uneven", "spacing", "uneven all", "descending")
def descending_uneven(record):
    uneven(record)
    descending(record)


@statement("turned by 37 degrees", "spacing", "origin", "direction")
def turned(record):
    record.turn = np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]])


@statement("frame RAS", "spacing", "origin", "frame ras")
def frame_ras(record):
    record.frame = "ras"


@statement("frame LPS", "spacing", "origin", "frame lps")
def frame_lps(record):
    record.frame = "lps"


# ---- Names
def renamed(record, names):
    for role, name in names.items():
        record.axis(role).rename(name)
    return record.ordered("txyz")


@statement("roles by axis", "order", "names by attributes")
def roles_by_axis(record):
    renamed(record, dict(x="i", y="j", z="k"))
    for role in "xyz":
        record.axis(role).attributes["axis"] = role.upper()


@statement("roles by standard_name", "order", "names by attributes")
def roles_by_standard_name(record):
    renamed(record, dict(x="i", y="j", z="k"))
    for role, name in dict(x="projection_x_coordinate", y="projection_y_coordinate", z="height").items():
        record.axis(role).attributes["standard_name"] = name
    record.upright = True


@statement("coordinates of other names", "order", "names of variables")
def coordinates_of_other_names(record):
    renamed(record, dict(x="i", y="j", z="k"))
    for role in "xyz":
        record.axis(role).variable = role + "c"
        record.axis(role).attributes["axis"] = role.upper()


@statement("packed coordinates", "names by attributes")
def packed_coordinates(record):
    for axis in record.axes[1:]:
        axis.attributes.update(scale_factor=0.25, add_offset=5.0)


@statement("longer names", "names")
def longer_names(record):
    renamed(record, dict(x="west_east", y="south_north", z="bottom_top"))


# ---- Units that are no lengths
@statement("degrees and meters", "spacing", "unit other degrees")
def degrees_and_meters(record):
    for role, name, unit, standard in (("x", "lon", "degrees_east", "longitude"), ("y", "lat", "degrees_north", "latitude")):
        record.axis(role).rename(name)
        record.axis(role).unit = "degrees"
        record.axis(role).attributes.update(units=unit, standard_name=standard)
    record.axis("z").unit, record.axis("z").attributes = "m", dict(standard_name="height", positive="up")
    record.axis("z").at = record.axis("z").at * 100
    record.notes, record.upright = ["units differ"], True


@statement("roles by units", "order", "unit other degrees", "names by attributes")
def roles_by_units(record):
    degrees_and_meters(record)
    renamed(record, dict(x="i", y="j", z="k"))
    for role in "xyz":
        record.axis(role).attributes.pop("standard_name")


@statement("across Greenwich", "unit other degrees")
def across_greenwich(record):
    degrees_and_meters(record)
    record.axis("x").at = (356 + np.arange(8.0)) % 360


@statement("pressure levels", "spacing", "uneven all", "unit other pressure")
def pressure_levels(record):
    degrees_and_meters(record)
    z = record.axis("z")
    z.rename("plev")
    z.at, z.unit, z.attributes = np.array([1000.0, 850, 700, 500, 300, 200]), "hPa", dict(standard_name="air_pressure")
    record.notes += ["plev.* is not uniform", "plev.* counts downwards"]


@statement("depth positive down", "spacing", "origin", "names by attributes")
def depth(record):
    record.axis("z").rename("depth")
    record.axis("z").attributes = dict(positive="down", standard_name="depth")
    record.notes, record.upright = ["depth.* counts downwards"], True


# ---- Times
@statement("times", "first time")
def times(record):
    record.axis("t").at = 3 + 0.5 * np.arange(5)


@statement("uneven times", "first time", "times uneven")
def uneven_times(record):
    record.axis("t").at = np.array([1.0, 2, 6, 6.5, 9])


@statement("unit of time", "interval", "time unit")
def unit_of_time(record):
    record.axis("t").unit = "ms"


@statement("time in the middle", "time axis middle")
def time_in_the_middle(record):
    record.ordered("ztyx")


@statement("time last", "time axis last")
def time_last(record):
    record.ordered("zyxt")


@statement("time of another name", "first time", "names by attributes")
def time_of_another_name(record):
    record.axis("t").rename("tau")
    record.axis("t").attributes = dict(axis="T", standard_name="time")
    record.ordered("ztyx")


def dated(name, calendar, dates):
    @statement(name, "first time", "time dates")
    def change(record):
        time = record.axis("t")
        time.at, time.unit, record.dates = 58.5 + np.arange(5), "days since 2000-01-01", dates
        if calendar:
            time.attributes["calendar"] = calendar


def noons(*days, of=""):
    return [f"2000-{day} 12:00{of}" for day in days]


dated("dates", "", noons("02-28", "02-29", "03-01", "03-02", "03-03"))
dated("dates THIRTY_DAY_MONTHS", "THIRTY_DAY_MONTHS", noons("02-29", "02-30", "03-01", "03-02", "03-03", of=" (360_day)"))
dated("dates noleap", "noleap", noons("02-28", "03-01", "03-02", "03-03", "03-04", of=" (noleap)"))
dated("dates 360_day", "360_day", noons("02-29", "02-30", "03-01", "03-02", "03-03", of=" (360_day)"))


def texts(name, need, dates, form):
    @statement(name, need)
    def change(record):
        record.axis("t").texts = np.array([form(date) for date in dates])
        record.axis("t").unit, record.times, record.dates = "", 43200 * np.arange(5.0), dates


HALF_DAYS = ["2000-02-28 12:00", "2000-02-29", "2000-02-29 12:00", "2000-03-01", "2000-03-01 12:00"]
texts("dates as texts", "time dates texts", HALF_DAYS, lambda date: f"{np.datetime64(date, 'm')}:00")
texts("dates as texts in a zone", "time dates texts", HALF_DAYS,
      lambda date: f"{np.datetime64(date, 'm') + np.timedelta64(90, 'm')}:00+01:30")
texts("dates of NumPy", "time dates datetime64", HALF_DAYS, lambda date: np.datetime64(date, "ns"))


@statement("months since", "time dates")
def months_since(record):
    time = record.axis("t")
    time.at, time.unit, time.attributes = np.arange(5.0), "months since 2000-01-01", dict(calendar="standard")
    record.dates = [f"2000-0{month}-01" for month in range(1, 6)]
    record.may = ["are counted in months of the calendar"]


@statement("dates as numbers", "time dates")
def dates_as_numbers(record):
    time = record.axis("t")
    time.at, time.unit = 20000228.5 + np.array([0, 1, 73, 74, 75]), "day as %Y%m%d.%f"
    record.times, record.dates = 0.5 + np.arange(5), noons("02-28", "02-29", "03-01", "03-02", "03-03")


# ---- Values
@statement("unit of values", "values unit")
def unit_of_values(record):
    record.unit = "K"


def packed(record):
    record.values = (2 * record.values).astype("i2")
    record.slope = 0.5


@statement("scale_factor", "values scale factor")
def scale_factor(record):
    packed(record)


@statement("scale_factor and add_offset", "values scale factor", "values scale offset")
def scale_and_offset(record):
    packed(record)
    record.values, record.offset = record.values + np.int16(20), -10


@statement("fill value", "values gaps fill")
def fill_value(record):
    gap(record, "_FillValue", -999)


@statement("missing_value", "values gaps missing")
def missing_value(record):
    gap(record, "missing_value", 1e20)


def gap(record, name, value):
    record.values[0, 0, 0, :2] = value
    record.may = ["missing ones to NaN"]
    record.fill[name] = record.values.dtype.type(value)


@statement("fill value of packed", "values scale factor", "values gaps fill")
def fill_packed(record):
    packed(record)
    gap(record, "_FillValue", -999)


@statement("valid_range", "values gaps valid")
def valid_range(record):
    record.valid = (2, 40)


@statement("one of two arrays", "arrays")
def one_of_two_arrays(record):
    record.name, record.others = "b", {"a": record.values[:, ::-1] * 2 + 1}


def vector(record, roles):
    values = np.stack([record.values + 40, record.values, record.values - 40], -1)
    record.axes = record.axes + [Axis("c", "c", np.arange(3.0))]
    record.values, record.component = values, 1
    record.ordered(roles)


@statement("components last", "components last")
def components_last(record):
    vector(record, "tzyxc")


@statement("components first", "components first")
def components_first(record):
    vector(record, "tczyx")


# ---- What nothing uses
@statement("remark", "remark")
def remark(record):
    record.attributes = dict(cell_methods="time: mean", ancillary_variables="q")
    record.notes = ["stated and not used(?=.*cell_methods)(?=.*ancillary_variables)"]


@statement("curved coordinates", "names of variables")
def curved_coordinates(record):
    record.curved = {name: 20 + np.arange(7.0)[:, None] + step * np.arange(8.0) for name, step in (("lat", 0.5), ("lon", 2))}
    record.notes = ["stated and not used.*lat.*lon"]


# ---- What the program says
class Wrong(Exception):
    pass


def run(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, errors="replace", timeout=60,
                          check=False)
    if done.returncode:
        raise Wrong(" ".join((done.stderr or done.stdout).split())[-300:])
    return done.stdout


def vertices_in(ply):
    """[n][x, y, z]"""
    with open(ply, "rb") as file:
        head, _, body = file.read().partition(b"end_header\n")
    text = head.decode(errors="replace")
    kind = np.dtype([(name, {"double": "<f8", "float": "<f4", "uchar": "u1"}[of]) for of, name in
                     re.findall(r"property (double|float|uchar) (\w+)\n", text)])
    points = np.frombuffer(body, kind, int(re.search(r"element vertex (\d+)", text)[1]))
    less = [float(word) for word in re.search(r"less origin (.*)", text)[1].split()]
    return np.stack([points[name] for name in "xyz"], 1) + less


def of(numbers):
    return " ".join(f"{number:.5g}" for number in np.ravel(numbers))


def in_unit(numbers, unit, wanted, table, kind, wrong):
    """In the unit that is expected: numbers of one kind may be given in another unit of that kind."""
    if unit == wanted:
        return numbers
    if unit in table and wanted in table:
        return numbers * (table[unit] / table[wanted])
    wrong.append(f"{kind} unit {unit!r}, expected {wanted!r}")
    return numbers


def same_places(got, expected, size):
    if len(got) != len(expected) or not len(got):
        return len(got) == len(expected)
    distances = np.linalg.norm(got[:, None] - expected[None], axis=-1)
    return max(distances.min(0).max(), distances.min(1).max()) < 1e-5 * size


def extent(points):
    return f"{len(points)} vertices from {of(points.min(0))} to {of(points.max(0))}" if len(points) else "no vertices"


def compare_surfaces(record, meant, said, surfaces, wrong):
    if len(surfaces) != len(meant.times):
        wrong.append(f"{len(surfaces)} steps, expected {len(meant.times)}")
    turned = record.frame and said["anatomy"] not in ("none", record.frame)
    turn = np.diag([-1, -1, 1]) if turned else np.eye(3)
    size = max(float(np.ptp(place)) for place in meant.places)
    ratio = in_unit(1, said["length_unit"], meant.length_unit, METERS, "length", wrong)
    for step, points in enumerate(surfaces[:len(meant.times)]):
        got, expected = points @ turn * ratio, crossings(meant, record, step, ISOVALUE)
        if not same_places(got, expected, size):
            wrong.append(f"step {step}: {extent(got)}, expected {extent(expected)}")
            break


def compare_times(record, meant, said, wrong):
    if len(meant.times) == 1:
        return
    got = np.array(said["times"])
    if record.dates:
        dates = [date.replace(" 00:00", "") for date in said["dates"] or []]
        if dates != record.dates:
            wrong.append(f"dates {', '.join(dates) or 'none'}, expected {', '.join(record.dates)}")
    else:
        got = in_unit(got, said["time_unit"], meant.time_unit, SECONDS, "time", wrong)
    if len(got) != len(meant.times) or not np.allclose(got, meant.times, rtol=1e-6, atol=1e-9):
        wrong.append(f"times {of(got)}, expected {of(meant.times)}")


def compare_notes(record, said, wrong):
    left = list(said["notes"])
    for pattern in record.notes:
        found = next((note for note in left if re.search(pattern, note)), None)
        if found is None:
            wrong.append(f"no note {pattern!r}")
        else:
            left.remove(found)
    wrong += [f"note {note!r}" for note in left if not any(re.search(pattern, note) for pattern in record.may)]


def compare(record, said, surfaces):
    """@return what is wrong, in words."""
    meant, wrong = meaning(record), []
    compare_surfaces(record, meant, said, surfaces, wrong)
    compare_times(record, meant, said, wrong)
    gaps, ends = np.isnan(meant.values).sum(), [np.nanmin(meant.values), np.nanmax(meant.values)]
    if said["value_unit"] != record.unit:
        wrong.append(f"unit {said['value_unit']!r}, expected {record.unit!r}")
    if said["nan_values"] != gaps:
        wrong.append(f"{said['nan_values']} missing values, expected {gaps}")
    if not np.allclose([said["low"], said["high"]], ends, atol=1e-6 * (ends[1] - ends[0])):
        wrong.append(f"values from {of([said['low'], said['high']])}, expected {of(ends)}")
    if record.upright and said["anatomy"] != "enu":
        wrong.append("nothing says which way is up")
    if record.frame and said["anatomy"] == "none":
        wrong.append(f"no anatomy, expected {record.frame}")
    compare_notes(record, said, wrong)
    return wrong


def lacking(lacks, need):
    """A container that lacks `unit` lacks `unit by axis`, too."""
    return next((why for lack, why in lacks.items() if (need + " ").startswith(lack + " ")), None)


def stated(name, container):
    """The record of a statement, less what the container cannot say of any record; None: it cannot say the statement."""
    change, needs, sizes = STATEMENTS[name]
    lacks = CONTAINERS[container].lacks
    if any(lacking(lacks, need) for need in needs):
        return None
    record = plain(sizes)
    for axis in record.axes:
        time = axis.role == "t"
        if lacking(lacks, "interval" if time else "spacing"):
            axis.at = np.arange(float(len(axis.at)))
        if lacking(lacks, "first time" if time else "origin"):
            axis.at = axis.at - axis.at[0]
        if lacking(lacks, "time unit" if time else "unit"):
            axis.unit = ""
    change(record)
    record.may = [*record.may, *CONTAINERS[container].may]
    return record


def check(program, name, container, folder):
    """@return what is wrong with a cell; none: it is the same; None: the container cannot say it."""
    record = stated(name, container)
    if record is None:
        return None
    where = os.path.join(folder, re.sub(r"\W+", "_", f"{container} {name}"))
    os.makedirs(where)
    index, out = os.path.join(where, "out.isochron"), os.path.join(where, "out")
    try:
        run(program, "build", *CONTAINERS[container].write(copy.deepcopy(record), where), "--quiet", "-o", index)
        said = json.loads(run(program, "info", index, "--json"))
        run(program, "export", index, "--isovalue", ISOVALUE, "--format", "ply", "--precision", "double", "-o", out + "/")
    except Wrong as error:
        return [f"refused: {error}"]
    return compare(record, said, [vertices_in(ply) for ply in sorted(glob.glob(out + "/*.ply"))])


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("program")
    arguments.add_argument("--only", default=",".join(CONTAINERS))
    arguments.add_argument("--rows", default=",".join(STATEMENTS))
    arguments.add_argument("--keep")
    given = arguments.parse_args()
    rows = given.rows.split(",")
    columns, wrong = given.only.split(","), []
    print(" " * 28 + " ".join(f"{number:2d}" for number in range(len(columns))))
    with tempfile.TemporaryDirectory() as scratch:
        for row in rows:
            cells = []
            for column in columns:
                found = check(given.program, row, column, given.keep or scratch)
                cells.append(" -" if found is None else " X" if found else " =")
                wrong += [(row, column, found)] if found else []
            print(f"{row:28s}" + " ".join(cells), flush=True)
    print("\n".join(f"{number:2d} {column}" for number, column in enumerate(columns)))
    for row, column, found in wrong:
        print(f"{row} | {column}: {'; '.join(found)}")
    print(f"{len(wrong)} cells fail")
    return bool(wrong)


class Matrix(unittest.TestCase):
    """A test for each container."""

    def test_what_a_container_lacks_some_statement_needs(self):
        named = {name for row in LACKS.strip().splitlines() for name in row.split(" | ")[0].split(", ")}
        self.assertLessEqual(named, set(CONTAINERS))
        needs = [need for _, needs, _ in STATEMENTS.values() for need in needs] + ["spacing", "interval", "unit"]
        for name, container in CONTAINERS.items():
            for lack in container.lacks:
                self.assertTrue(any(lacking({lack: "-"}, need) for need in needs), f"{name}: {lack}")


def test_of(name):
    def test(self):
        with tempfile.TemporaryDirectory() as folder:
            for each in STATEMENTS:
                with self.subTest(statement=each):
                    self.assertFalse(check(os.environ["ISOCHRON_PROGRAM"], each, name, folder))

    return test


for column in CONTAINERS:
    setattr(Matrix, "test_" + re.sub(r"\W+", "_", column), test_of(column))

if __name__ == "__main__":
    sys.exit(main())
