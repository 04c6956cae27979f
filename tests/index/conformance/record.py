"""A plain record of what a container can state of an array, and what follows from it by arithmetic alone."""
import copy
import dataclasses
from dataclasses import dataclass, field

import numpy as np

METERS = {"m": 1, "km": 1e3, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "angstrom": 1e-10, "micrometers": 1e-6}
SECONDS = {"s": 1, "ms": 1e-3, "h": 3600, "hours": 3600, "second": 1, "sec": 1, "millisecond": 1e-3, "msec": 1e-3}


@dataclass
class Axis:
    """A dimension. `at`: the coordinate of each of its vertices, or its times."""

    role: str  # x, y, z, t, c: components, or m: runs of an ensemble
    name: str
    at: np.ndarray
    unit: str = ""
    attributes: dict = field(default_factory=dict)  # of the coordinates, in words of CF
    variable: str = ""  # what the coordinates are called
    texts: np.ndarray = None  # or dates, as texts or datetime64, in place of numbers

    def __post_init__(self):
        self.variable = self.variable or self.name

    def rename(self, name):
        self.name = self.variable = name

    def step(self):
        return (self.at[-1] - self.at[0]) / max(len(self.at) - 1, 1)

    def in_unit(self, unit):
        table = METERS if unit in METERS else SECONDS
        return np.asarray(self.at) * (table[self.unit] / table[unit] if self.unit else 1)


@dataclass
class Record:
    axes: list  # as stored, slowest first
    values: np.ndarray
    name: str = "v"
    unit: str = ""  # of the values
    slope: float = 1
    offset: float = 0
    fill: dict = field(default_factory=dict)  # attribute: the value that stands for none
    valid: tuple = ()  # least and greatest value that stands for itself
    attributes: dict = field(default_factory=dict)  # of the array
    others: dict = field(default_factory=dict)  # further arrays of the same shape
    curved: dict = field(default_factory=dict)  # coordinates along two axes, [y][x]
    component: int = 0
    member: int = 0
    turn: np.ndarray = field(default_factory=lambda: np.eye(3))  # of coordinates into space
    frame: str = ""  # of coordinates: ras, lps
    notes: list = field(default_factory=list)  # patterns, one for each note that there must be
    may: list = field(default_factory=list)  # patterns of notes that there may be
    upright: bool = False  # whether one axis is said to be vertical
    dates: list = None
    times: np.ndarray = None  # what the stated times come to, if not the numbers themselves

    def axis(self, role):
        return next((axis for axis in self.axes if axis.role == role), None)

    def ordered(self, roles):
        """Stored with these axes, slowest first."""
        place = [next(i for i, axis in enumerate(self.axes) if axis.role == role) for role in roles]
        self.axes = [self.axes[i] for i in place]
        self.values = np.ascontiguousarray(self.values.transpose(place))
        self.others = {name: np.ascontiguousarray(values.transpose(place)) for name, values in self.others.items()}
        return self

    def without_unnamed(self):
        """Without time, where nothing tells it."""
        told = [axis for axis in self.axes if axis.name]
        shape = [len(axis.at) for axis in told]
        return dataclasses.replace(self, axes=told, values=self.values.reshape(shape), others={
            name: values.reshape(shape) for name, values in self.others.items()})

    def flip(self, role):
        """Stored the other way round: the same values at the same places."""
        place = next(i for i, axis in enumerate(self.axes) if axis.role == role)
        self.axes[place].at = self.axes[place].at[::-1]
        self.values = np.ascontiguousarray(np.flip(self.values, place))

    def space(self):
        """The axes of space, as stored, fastest first."""
        return [axis for axis in reversed(self.axes) if axis.role in "xyz"]

    def steps(self, frame="", unit=""):
        """The vector along each of them, and the first vertex. frame: ras or lps, into which a stated frame is brought."""
        signs = [-1, -1, 1] if frame and self.frame not in ("", frame) else [1, 1, 1]
        bring = np.diag(signs) @ self.turn
        ratio = METERS[self.axis("x").unit] / METERS[unit] if unit and self.axis("x").unit else 1
        first = bring @ [self.axis(role).at[0] for role in "xyz"]
        return [bring[:, "xyz".index(axis.role)] * axis.step() * ratio for axis in self.space()], first * ratio

    def volumes(self):
        """[time] of arrays as stored."""
        place = [axis.role for axis in self.axes].index("t")
        return np.moveaxis(self.values, place, 0)


def plain(sizes):
    """x, y, z and time, all different in every respect; the value follows from the place."""
    t, z, y, x = (np.arange(float(size)) for size in sizes)
    axes = [Axis("t", "time", 2 * t, "s"), Axis("z", "z", 5 + 3 * z, "mm"), Axis("y", "y", 20 + 2 * y, "mm"),
            Axis("x", "x", 10 + 0.5 * x, "mm")]
    t, z, y, x = np.ogrid[tuple(map(slice, sizes))]
    return Record(axes, (3 * t + 4 * z + 2 * y + x).astype("f4"))


@dataclass
class Meaning:
    """What a record says, in the terms of the program."""

    places: list  # coordinates along x, y and z as drawn
    values: np.ndarray  # [time][z][y][x], NaN where there is none
    length_unit: str
    times: np.ndarray
    time_unit: str


def drawn(record):
    """Coordinates along x, y and z in one unit: that of x. Where there is no proportion between units, those of an axis are
    scaled by the power of ten that brings its spacing next to that of x (guide: Formats). What counts downwards is drawn with
    its sign reversed."""
    axes, places = [copy.copy(record.axis(role)) for role in "xyz"], []
    if axes[0].unit == "degrees":
        axes[0].at = np.unwrap(axes[0].at, period=360)
    convertible = all(axis.unit in METERS for axis in axes)
    for axis in axes:
        factor = 1
        if convertible:
            factor = METERS[axis.unit] / METERS[axes[0].unit]
        elif axis.unit != axes[0].unit:
            factor = 10.0 ** round(np.log10(abs(axes[0].step() / axis.step())))
        downwards = axis.attributes.get("positive", "down" if axis.unit == "hPa" else "up") == "down"
        places.append(axis.at * factor * (-1 if downwards else 1))
    same = convertible or len({axis.unit for axis in axes}) == 1
    return places, axes[0].unit if same else ""


def meaning(record):
    roles = [axis.role for axis in record.axes]
    values = record.values
    if "m" in roles:
        values = values.take(record.member, roles.index("m"))
        roles.remove("m")
    values = np.moveaxis(values, [roles.index(role) for role in "tzyx"], range(4))
    if "c" in roles:
        values = values[..., record.component]
    values = values.reshape(values.shape[:4])
    stored = values.astype("f8")
    gaps = np.isin(stored, [float(np.array(each, record.values.dtype)) for each in record.fill.values()])
    if record.valid:
        gaps |= (stored < record.valid[0]) | (stored > record.valid[1])
    places, unit = drawn(record)
    time = record.axis("t")
    return Meaning(places, np.where(gaps, np.nan, stored * record.slope + record.offset), unit,
                   np.asarray(time.at if record.times is None else record.times), time.unit)


def crossings(meant, record, step, isovalue):
    """Where the surface crosses the edges of the grid: interpolated between their ends, [n][xyz]. An edge counts if some cell
    at it has all of its eight values."""
    values = meant.values[step]
    whole = np.isfinite(values)
    for axis in range(3):
        whole = np.delete(whole, -1, axis) & np.delete(whole, 0, axis)
    points = []
    for axis in range(3):
        low, high = np.delete(values, -1, axis), np.delete(values, 0, axis)
        cells = np.pad(whole, [(0, 0) if a == axis else (1, 1) for a in range(3)])
        for other in {0, 1, 2} - {axis}:
            cells = np.delete(cells, -1, other) | np.delete(cells, 0, other)
        with np.errstate(invalid="ignore"):
            at = np.argwhere(((low < isovalue) != (high < isovalue)) & cells)
        for k, j, i in at:
            share = (isovalue - low[k, j, i]) / (high[k, j, i] - low[k, j, i])
            point = [meant.places[0][i], meant.places[1][j], meant.places[2][k]]
            along = meant.places[2 - axis]
            number = (k, j, i)[axis]
            point[2 - axis] = along[number] + share * (along[number + 1] - along[number])
            points.append(record.turn @ point)
    return np.array(points)
