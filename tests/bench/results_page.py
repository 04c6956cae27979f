#!/usr/bin/env python3
"""Writes the page of results, docs/RESULTS.md, and its charts from what the benchmarks wrote.

The words of the page and its tables stand in results_page.md, a template: `{scale.path}` is a figure, `{each LIST}` in
front of a line repeats the line for each element of a list, and alone on a line all that follows until `{end}`. Here
stand the goals, the figures of the charts, and what has to be computed of the results.
"""

import argparse
import html
import itertools
import json
import math
import re
import statistics
import string
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# The files of results by the options that name others, and what wrote each.
RESULTS = {
    "index": ("docs/results/index.json", "`isochron-bench index --json`"),
    "render": ("docs/results/render.json", "`isochron-bench render --json`"),
    "artifacts": ("docs/results/artifacts.json", "`isochron-bench artifacts --json`"),
    "scale": ("docs/results/scale.txt", "what `isochron-bench scale` printed"),
    "gpu": ("docs/results/gpu.txt", "what programs printed where a GPU drew"),
    "agreement": ("docs/results/agreement.json", "`isochron-bench render --data vorticity --agreement-only --json`"),
    "motion": ("docs/results/motion.json", "`isochron-bench motion --json`"),
    "building": ("docs/results/building.json", "`isochron-bench building --json`"),
    "change": ("docs/results/change.json", "`isochron-bench change --json`"),
    "between": ("docs/results/between.json", "`isochron-bench between --json`"),
    "public": ("docs/results/public.txt", "what tests/index/conformance/public.py printed of public files"),
}


class Row(dict):
    """An object of JSON; a member of it is also an attribute."""

    def __getattr__(self, name):
        return self[name]


# ---- Numbers and templates


def short(value):
    """Three digits, or all before the point: `0.0123`, `126`, `1034`."""
    return format(value, ".3g" if abs(value) < 999.5 else ".0f")


def whole(value):
    """The nearest whole number, in groups of three digits: `17,747`."""
    return format(math.floor(value + 0.5), ",")


def figure(value):
    """Three digits, or the nearest whole number from 100 on: `0.0988`, `1,190`."""
    return whole(value) if value >= 100 else format(value, ".3g")


class Figures(string.Formatter):
    """Format strings whose numbers may also be `:n` (`short`), `:p` (`figure`) and `:%.1f` (in percent). A
    figure that a row does not have is a dash."""

    def format_field(self, value, spec):
        if value is None:
            return "-"
        if spec == "n":
            return short(value)
        if spec == "p":
            return figure(value)
        if spec.startswith("%"):
            return format(100 * value, spec[1:])
        return super().format_field(value, spec)


def expand(template, values):
    """Fills a template with the members of `values`."""
    figures, text, end = Figures(), "", 0
    for each in re.finditer(r"^\{each (\S+)\}(?:\n(.*?)\{end\}\n|([^\n]*\n))", template, re.M | re.S):
        text += figures.vformat(template[end:each.start()], (), values)
        elements, _ = figures.get_field(each[1], (), values)
        text += ("\n" if each[2] else "").join(expand(each[2] or each[3], element) for element in elements)
        end = each.end()
    return text + figures.vformat(template[end:], (), values)


# ---- Goals: what is to be reached, and the least that is accepted


def goals_of(rows, key, goals):
    """The range of the figures of each goal, and the verdict on the worst of them.

    A goal is what it speaks of, a unit, the goal and the floor, a pattern and a figure: it concerns the rows whose key
    matches the pattern, and which have the figure. Where the goal is above the floor, larger figures are better.
    """
    for what, unit, goal, floor, pattern, measure in goals:
        figures = []
        for row in rows:
            if re.fullmatch(pattern, key(row)):
                try:
                    figures.append(measure(row))
                except TypeError:  # the row lacks a member that the figure is computed of
                    pass
        found, verdict = "-", "not measured"
        if figures:
            low, high = min(figures), max(figures)
            found = (short(low) if low == high else f"{short(low)} to {short(high)}") + unit
            worst, sign = (low, 1) if goal > floor else (high, -1)
            verdict = ("goal reached" if sign * worst >= sign * goal else
                       "above the floor" if sign * worst >= sign * floor else "**below the floor**")
        yield Row(what=what, goal=f"{goal:g}{unit}", floor=f"{floor:g}{unit}", found=found, verdict=verdict)


def index_key(row):
    large = "large" if row.active >= 90_000 else "small"
    return f"{row.structure} {row.data} {row.type} {large}"


def size(row):
    return row.percent_of_raw


def over_scan(row):
    return row.scan_us / row.search_ids_us


def build_rate(row):
    return row.build_mcs_per_s


INDEX_GOALS = [
    # The false positives of the published structure are those of its method.
    ("false positives and negatives, all types, steps and isovalues", "", 0, 0, "(?!thi).*",
     lambda row: row.false_positives + row.false_negatives),
    ("bricks (u8), of raw", " %", 0.07, 0.1, "bricks .* u8 .*", size),
    ("bricks (f32), of raw, above the plain volume", " %", 0.08, 0.1, "bricks .* f32 .*", size),
    ("ids from bricks (f32) against the scan, sphere", "x", 6, 2, "bricks sphere f32 .*", over_scan),
    ("ids from bricks (f32) against the scan, vorticity 64^3", "x", 3, 1.5, "bricks vorticity64 f32 .*", over_scan),
    ("ids from bricks (f32) against the scan, 256^3", "x", 40, 12, "bricks fourier256 f32 .*", over_scan),
    ("building of bricks, per core", " Mcs/s", 1500, 500, "bricks .*", build_rate),
]


def render_key(row):
    return f"{row.footprint} {row.data} {row.picture} {row.threads}"


def rate(row):
    return row.fps


def over_vtk(row):
    return row.fps / row.vtk_fps


RENDER_GOALS = [
    ("fast quads, sphere, 512^2", " fps", 600, 250, r"quad sphere 512\^2 2", rate),
    ("ShellSplatting, sphere, 512^2", " fps", 150, 50, r"gaussian sphere 512\^2 2", rate),
    ("fast quads, vorticity 64^3, 512^2", " fps", 600, 284, r"quad vorticity64 512\^2 2", rate),
    ("ShellSplatting, vorticity 64^3, 512^2", " fps", 150, 46, r"gaussian vorticity64 512\^2 2", rate),
    ("whole time-scrub frame of fast quads against VTK, 1024^2", "x", 4, 2, r"quad \S+ 1024\^2 2", over_vtk),
    ("the same of meshes", "x", 2, 1.4, r"mesh \S+ 1024\^2 2", over_vtk),
    ("the same of meshes, both eyes", "x", 2, 1.3, r"mesh \S+ 2 x 1024\^2 2", over_vtk),
    ("fast quads, those that are seen, against all bare quads, 512^2", "x", 1.1, 1.3, r"quad \S+ 512\^2 2",
     lambda row: 1e-3 * row.draw_ms * row.bare_fps),
    ("fast quads, all of them, against bare quads, 512^2", "x", 1.1, 1.3, r"quad \S+ 512\^2 2",
     lambda row: 1e-3 * row.quads_ms * row.bare_fps),
    ("99th percentile of frame over static draw", "x", 1.3, 2, ".* 2", lambda row: row.p99_over_static),
    ("ids that a GPU is sent from step to step, of all, sphere", " %", 20, 40, r"\S+ sphere 512\^2 2",
     lambda row: 1.0 * row.sent_ids_percent),
    ("surface against ShellSplatting, 1024^2", "x", 0.7, 1.3, r"surface \S+ 1024\^2 2",
     lambda row: row.draw_ms / row.splats_ms),
]


def motion_key(row):
    return f"{row.data} {row.picture} {row.budget_ms:g} {row.motion}"


def overlap(row):
    return row.overlap


def shown(row):
    return 1.0 * row.shown_ms  # a TypeError where nothing was asked for


def shown_late(row):
    return 1.0 * row.shown_late_ms


def exact_seconds(row):
    return 1e-3 * (1e6 if row.exact_ms is None else row.exact_ms)  # never: longer than any goal


MOTION_GOALS = [
    ("1024^2, 33 ms, 64^3 to 256^3: lit area off", " %", 6, 10, r"(demo|192|256) 1024x1024.* 33 .*",
     lambda row: 100 * abs(row.lit - 1)),
    ("the same: IoU", "", 0.94, 0.90, r"(demo|192|256) 1024x1024.* 33 .*", overlap),
    ("the same: luminance off", " %", 8, 15, r"(demo|192|256) 1024x1024.* 33 .*", lambda row: 100 * row.luminance_off),
    ("1024^2, 33 ms, 512^3: IoU", "", 0.90, 0.85, r"512 1024x1024.* 33 .*", overlap),
    ("1024^2, 16.7 ms, 64^3: IoU", "", 0.98, 0.96, r"demo 1024x1024.* 16\.7 .*", overlap),
    ("the same, 256^3", "", 0.94, 0.90, r"256 1024x1024.* 16\.7 .*", overlap),
    ("the same, 192^3", "", 0.88, 0.78, r"192 1024x1024.* 16\.7 .*", overlap),
    ("1024^2, 8.3 ms, 64^3: IoU", "", 0.97, 0.95, r"demo 1024x1024.* 8\.3 .*", overlap),
    ("the same, 256^3", "", 0.90, 0.85, r"256 1024x1024.* 8\.3 .*", overlap),
    ("1024^2, 100 ms, 64^3 to 256^3: IoU", "", 0.99, 0.97, r"(demo|192|256) 1024x1024.* 100 .*", overlap),
    ("the same, 512^3", "", 0.95, 0.92, r"512 1024x1024.* 100 .*", overlap),
    ("orbit of 192^3, default window: recognizable pictures", "/s", 30, 20, r"192 \S+ window .* orbit",
     lambda row: row.recognizable * row.per_second),
    ("frames over two promised times, beyond the control", " %", 1, 2, ".*",
     lambda row: 100 * max(0, row.over_two - row.control_two)),
    ("frames over three promised times, beyond the control", " %", 0.1, 0.5, ".*",
     lambda row: 100 * max(0, row.over_three - row.control_three)),
    ("asked to shown, 64^3, median", " ms", 20, 40, r"demo \S+ \S+ (scrub|jump-on)", shown),
    ("the same, 95 %", " ms", 40, 80, r"demo \S+ \S+ (scrub|jump-on)", shown_late),
    ("asked to shown, 256^3, median", " ms", 50, 80, r"256 \S+ \S+ (scrub|jump-on)", shown),
    ("the same, 95 %", " ms", 120, 200, r"256 \S+ \S+ (scrub|jump-on)", shown_late),
    ("asked to shown, 512^3, median", " ms", 100, 200, r"512 \S+ \S+ (scrub|jump-on)", shown),
    ("the same, 95 %", " ms", 250, 500, r"512 \S+ \S+ (scrub|jump-on)", shown_late),
    ("exact after stopping, 64^3", " s", 0.1, 0.3, r"demo \S+ \S+ \S+", exact_seconds),
    ("exact after stopping, 192^3 and 256^3", " s", 0.6, 1.2, r"(192|256) \S+ \S+ \S+", exact_seconds),
    ("exact after stopping, 512^3 with 2.4 M cells", " s", 2, 4, r"512-dense \S+ \S+ \S+", exact_seconds),
    ("exact after stopping, 1024^3 with 3 M cells", " s", 4, 6, r"1024 \S+ \S+ \S+", exact_seconds),
    ("processors busy while drawing, of two", "", 1.9, 1.7, ".*", lambda row: row.busy),
]


# ---- Charts of a few horizontal bars, as SVG


def bar(label, value, ours, text):
    """A bar in the color of this program, or gray, for comparison; the text is its value as people read it."""
    return Row(label=label, value=float(value), ours=ours, text=text)


def bar_of(unit):
    return lambda label, value, ours: bar(label, value, ours, short(float(value)) + unit)


ms, fps, percent = bar_of(" ms"), bar_of(" fps"), bar_of(" %")


def us(label, value, ours):
    return bar(label, value, ours, whole(value) + " us")


def range_of(bars):
    low, high = (choose(bars, key=lambda one: one.value).text for choose in (min, max))
    return low if low == high else f"{low} to {high}"


def svg_of(title, bars, logarithmic=False, mark=None, mark_text="", **_):
    """The chart on a background of its own, so that dark pages show it, too.

    A logarithmic scale begins a little below the smallest value, so that every bar is seen. A mark is a value with a
    line and a name of its own.
    """
    width, labels, values, row, top, bottom, ink, red = 720, 290, 100, 26, 48, 16, "#22282d", "#b0452b"
    most = max([mark or 0] + [one.value for one in bars])
    least = min([one.value for one in bars if one.value > 0], default=2) / 2

    def length(value):
        if value <= 0:
            return 0
        part = math.log(value / least) / math.log(most / least) if logarithmic else value / most
        return (width - labels - values) * part

    def text(x, y, words, more):
        return f'<text x="{x}" y="{y}" {more}>{html.escape(words, quote=False)}</text>\n'

    height = top + row * len(bars) + bottom
    svg = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
           f'height="{height}" role="img" font-family="sans-serif" font-size="13">\n'
           f"<title>{html.escape(title, quote=False)}</title>\n"
           f'<rect width="{width}" height="{height}" rx="6" fill="#ffffff"/>\n')
    svg += text(16, 26, title, f'font-size="15" font-weight="bold" fill="{ink}"')
    if mark is not None:
        x = labels + length(mark)
        svg += (f'<line x1="{x:.1f}" y1="{top - 8}" x2="{x:.1f}" y2="{height - bottom}" stroke="{red}" '
                'stroke-dasharray="4 3"/>\n')
        svg += text(f"{x - 5:.1f}", top - 5, mark_text, f'text-anchor="end" font-size="12" fill="{red}"')
    for i, one in enumerate(bars):
        y, end = top + row * i, length(one.value)
        svg += text(labels - 10, y + 16, one.label, f'text-anchor="end" fill="{ink}"')
        svg += (f'<rect x="{labels}" y="{y + 3}" width="{end:.1f}" height="{row - 8}" '
                f'fill="{"#1f6f8b" if one.ours else "#a3adb5"}"/>\n')
        svg += text(f"{labels + end + 8:.1f}", y + 16, one.text,
                    f'fill="{ink}" stroke="#ffffff" stroke-width="4" paint-order="stroke"')
    return svg + "</svg>\n"


# ---- The figures of the first page


def first_look(scale):
    """The first look at a file of which nothing is in memory: the larger surface of the largest grid."""
    lines = re.findall(r"^(\w+) \d+\^3 u8, (\d+) cells .*cold: ([\d.]+) of 1024 MiB read, (\d+) ms; "
                       r"read and scan (\d+) ms.*VTK (\d+) ms", scale.text, re.M)
    bars, read = [], []
    for kind in ("smooth", "rough"):
        _, cells, mib, *times = max((line for line in lines if line[0] == kind), key=lambda line: int(line[1]))
        bars += map(ms, [f"{kind}: Isochron", "read all and scan", "VTK, flying edges"], times, [True, False, False])
        read.append(f"{short(float(mib))} of 1,024 MiB of the {kind} step ({int(cells):,} active cells)")
    return Row(bars=bars, read=" and ".join(read))


def median_of(rows, key):
    """The median over the rows of a series: each has its own measurement of what all are compared with."""
    return statistics.median(row[key] for row in rows)


def search_time(index):
    """Searches of one step in memory: the largest series of bytes."""
    rows = [row for row in index.rows if (row.data, row.type) == ("fourier256", "u8")]
    bricks = next(row for row in rows if row.structure == "bricks")
    # The paper's series, small enough for its tree: the fastest tree of any setting.
    paper = [row for row in index.rows if (row.data, row.type, row.steps) == ("sphere", "u8", 25)]
    tree = min((row for row in paper if row.structure == "thi" and row.max_variation == 2),
               key=lambda row: row.search_ids_us)
    return Row(active=int(bricks.active), logarithmic=True, tree=tree,
               paper=next(row for row in paper if row.structure == "bricks"), bars=[
        us("ids: bricks", bricks.search_ids_us, True), us("ids: plain scan", median_of(rows, "scan_us"), False),
        us("with normals: bricks", bricks.search_full_us, True),
        us("VTK: triangles with normals", median_of(rows, "flying_edges_normals_us"), False)])


def mesh_time(scale):
    """Triangles with normals from cells that are known, and by VTK."""
    bars, gains = [], []
    lines = re.findall(r"^(\w+) 256\^3 f32, \d+ cells .*warm:|"
                       r"mesh of (\d+) triangles with normals .*: ([\d.]+) ms, VTK ([\d.]+) ms, ([\d.]+)x",
                       scale.text, re.M)
    kind = None
    for warm, triangles, ours, vtk, gain in lines:
        kind = warm or kind
        if kind and triangles:
            bars += [ms(f"{kind}, {int(triangles):,} triangles: Isochron", ours, True),
                     ms("VTK, flying edges", vtk, False)]
            gains.append(float(gain))
    return Row(bars=bars, gains=f"{short(min(gains))} to {short(max(gains))}")


def size_and_time(scale):
    """The size of the default index and the time to build it, of every grid."""
    sizes, times = [], []
    for kind, edge, part, seconds in re.findall(
            r"^(\w+) (\d+)\^3 u8, codec fitting: index / data ([\d.]+), build ([\d.]+) s", scale.text, re.M):
        per_gib = float(seconds) / (int(edge) ** 3 / 2**30)
        sizes.append(bar(f"{kind} {edge}^3", part, True, part))
        times.append(bar(f"{kind} {edge}^3", per_gib, True, f"{per_gib:.1f} s"))
    return Row(bars=sizes, range=range_of(sizes)), Row(bars=times, range=range_of(times))


FOOTPRINTS = {"quad": "quads", "gaussian": "splats", "mesh": "triangles", "surface": "exact surface"}


def frames(rates):
    """Whole frames while time plays, of a footprint, its rate and VTK's each."""
    bars = [fps(FOOTPRINTS[footprint], rate, True) for footprint, rate, _ in rates]
    return Row(bars=[*bars, fps("VTK, flying edges", max(float(vtk or 0) for _, _, vtk in rates), False)])


def frames_gpu(gpu):
    """The last table of the file, which names VTK's pace, too."""
    found = frames(re.findall(r"^vorticity64\s+(\w+)\s+1024\^2\s+1 egl\s+\d+\s+(\d+)\s+(\d+)\s", gpu.text, re.M))
    machine = re.findall("^commit .*", gpu.text, re.M)[-1]
    return Row(found, source=f"`{gpu.path}`, {machine}")


def live_frames(gpu):
    """Frames of a live session on a GPU, of which a display wants one every 11.1 ms."""
    bars, missed, exact, shape, count = [], [], [], None, None
    for line in gpu.text.splitlines():
        if match := re.search(r"\b(\d+\^3) u8, [\d,]+ cells at", line):
            shape = match[1]
        elif match := re.search(r"^(\d+) frames\s+median", line):
            count = match[1]
        elif shape and (match := re.search(r"^\s+total\s+([\d.]+)\s+([\d.]+)\s+([\d.]+)", line)):
            bars += map(ms, [f"{shape}: half of the frames", "99 of 100", "the longest"], match.groups(), [True] * 3)
        elif shape and (match := re.search(r"^\s+missed\s+(\d+) refreshes", line)):
            missed.append(f"{match[1]} of {count} refreshes with {shape}")
        elif shape and (match := re.search(r"^\s+at rest\s+(\d+) times, (\d+) of them exact", line)):
            exact.append(f"{match[2]} of {match[1]} with {shape}")
            shape = None
    machine = re.findall("^EGL, OpenGL.*", gpu.text, re.M)[-1]
    return Row(bars=bars, missed=", and ".join(missed), exact=", ".join(exact), mark=1000 / 90, mark_text="a frame of 90 Hz",
               source=f"`{gpu.path}`, {machine}")


def outlines(agreement):
    """How far outlines are from the outline of the exact surface: the middle one of the surfaces."""
    pixels = 4
    rows = sorted((row for row in agreement.rows if row.pixels_per_voxel == pixels), key=lambda row: row.cells)
    bars = [bar(f'{FOOTPRINTS[row.footprint]}, {"on the surface" if row.shape == "plane" else "as in the paper"}',
                row.offset, row.shape == "plane", f"{row.offset:.2f}")
            for row in rows if row.cells == rows[len(rows) // 2].cells]
    return Row(bars=bars, range=range_of([one for one in bars if one.ours]), pixels=pixels)


def wrong_cells(index):
    """What the published structure finds too much; bricks find nothing too much."""
    ours = [row for row in index.rows if row.structure == "bricks"]
    active = sum(row.detail.active for row in ours)
    wrong = sum(row.false_positives + row.false_negatives for row in ours)
    bars = [percent("bricks: all series", 100 * wrong / active, True)]
    bars += [percent(f"published: {row.data}, {row.type}, {row.steps} steps", row.detail.percent_at_isovalue, False)
             for row in index.rows if (row.structure, row.l, row.max_variation) == ("thi", 64, 2)]
    return Row(bars=bars, active=active, queries=sum(row.detail.queries for row in ours),
               wrong=f"{wrong:,}" if wrong else "no")


# ---- What the tables need that the results do not hold


# Tables 1 and 2 of the paper, the moving sphere: L, MaxVariation, steps, % of raw, false positives in % of the
# isovalue's cells, search and incremental search in ms, speed-up.
PUBLISHED = [(32, 2, 25, 25.0, 5.3, 2.12, 0.46, 4.64), (32, 2, 55, 21.4, 2.1, 2.45, 0.65, 3.75),
             (64, 1, 25, 116.2, 0.09, 2.07, 0.93, 2.23), (64, 1, 55, 107.6, 0.08, 2.32, 0.83, 2.79),
             (64, 2, 25, 37.2, 1.3, 2.14, 0.74, 2.90), (64, 2, 55, 33.0, 0.5, 2.86, 0.88, 3.26),
             (64, 3, 25, 26.3, 3.9, 2.36, 0.59, 4.00), (64, 3, 55, 22.8, 1.4, 2.93, 0.88, 3.34),
             (128, 2, 25, 57.0, 0.3, 1.97, 0.89, 2.21), (128, 2, 55, 48.9, 0.1, 2.50, 1.00, 2.50)]


def published_table(rows, published):
    """The published figures and ours for each setting and number of steps."""
    names = "setting", "source", "size", "false", "search", "incremental", "speed_up"
    for l, variation, steps, of_raw, false, search_ms, incremental_ms, speed_up in published:
        yield Row(zip(names, (f"{l} | {variation} | {steps}", "paper", f"{of_raw:g}", f"{false:g}",
                              f"{1000 * search_ms:.0f}", f"{1000 * incremental_ms:.0f}", f"{speed_up:.2f}")))
        for kind in ("u8", "f32"):
            ours = Row(zip(names, ("| |", f"{kind} here", *"-----")))
            wanted = ("sphere", "thi", kind, steps, l, variation)
            for row in rows:
                if wanted == (row.data, row.structure, row.type, row.steps, row.l, row.max_variation):
                    # The published times are means, and so is a sweep. The median over the steps would hide steps at
                    # which half of the tree is searched again.
                    step_us = 1e3 * row.sweep_ms / row.steps
                    ours.update(size=f"{row.percent_of_raw:.1f}", false=f"{row.detail.percent_at_isovalue:.2g}",
                                search=figure(row.search_ids_us), incremental=figure(step_us),
                                speed_up=f"{row.search_ids_us / step_us:.2f}")
            yield ours


def series_of(rows):
    """The rows of each series, with what all of its structures are compared with."""
    for _, group in itertools.groupby(rows, lambda row: (row.data, row.type, row.steps)):
        group = list(group)
        for row in group:
            row["name"] = row.structure + (f", L {row.l}, MaxVariation {row.max_variation}" if row.l else "")
        compared = {key: median_of(group, key) for key in (
            "scan_us", "tbon_us", "flying_edges_us", "flying_edges_normals_us", "memcpy_us")}
        yield Row(group[0] | compared, rows=group)


def table3(rows):
    """Table 3 of the paper, frames per second of extraction and rendering together, and the same here."""
    for mode, footprint, sphere, vorticity in [("high quality", "gaussian", 50.30, 46.29),
                                               ("fast", "quad", 250.85, 284.42)]:
        yield Row(mode=f"{mode} |", source="paper, GeForce 4", sphere=f"{sphere:g}", vorticity=f"{vorticity:g}")
        for threads, cores in ((1, "1 core"), (2, "2 cores")):
            found = {row.data: f"{row.fps:.0f}" for row in rows
                     if (row.footprint, row.threads, row.picture) == (footprint, threads, "512^2")}
            yield Row(mode="|", source=f"here, software GL, {cores}", sphere=found.get("sphere", "-"),
                      vorticity=found.get("vorticity64", "-"))


def read(path):
    """Results with what is said of each: where they stand, the machine, and the page's source of figures."""
    try:
        text = (ROOT / path).read_text(encoding="utf-8")  # of another folder where the path is absolute
    except OSError as error:
        sys.exit(f"{path}: {error.strerror}")
    if not path.endswith(".json"):
        machine = re.search("^commit .*", text, re.M)
        return Row(text=text, path=path, source=f"`{path}`, {machine[0]}" if machine else f"`{path}`")
    results = Row(json.loads(text, object_hook=Row), path=path)
    if "header" in results:
        header = results.header
        results["measured"] = expand("Measured on {date} with commit {commit}, {compiler}, on {processor}", header)
        results["source"] = f"`{path}`, " + expand("commit {commit}, {processor}, {threads} threads, {date}", header)
    return results


def values_of(paths):
    """All that the template needs."""
    page = Row({name: read(path) for name, path in paths.items()})
    index, render, artifacts, motion = page.index, page.render, page.artifacts, page.motion
    for row, detail in zip(index.rows, index.details, strict=True):
        row["detail"] = detail
    index["goals"] = goals_of(index.rows, index_key, INDEX_GOALS)
    page["table1"] = published_table(index.rows, [line for line in PUBLISHED if line[1] == 2])
    page["table2"] = published_table(index.rows, [line for line in PUBLISHED if line[0] == 64])
    page["normals"] = [row for row in index.rows if row.detail.normal_error_mean is not None]
    page["series"] = series_of(index.rows)

    def picture(row):
        return row.data, row.size, row.eyes, row.threads, row.context

    splats = {picture(row): row.draw_ms for row in render.rows if row.footprint == "gaussian"}
    for row in render.rows:
        row["picture"] = f'{"2 x " if row.eyes == 2 else ""}{row.size}^2'
        row["splats_ms"] = splats.get(picture(row))
    render["goals"] = goals_of(render.rows, render_key, RENDER_GOALS)
    page["table3"] = table3(render.rows)

    artifacts["most"] = []
    for variation in (1, 2, 3):
        rows = [row for row in artifacts.rows if row.max_variation == variation]
        artifacts.most.append(Row(max_variation=variation, normals=max(row.normals_changed_percent for row in rows),
                                  false=max(row.false_changed_percent for row in rows)))
    artifacts["shown"] = [Row(data="sphere"), Row(data="vorticity64")]

    for row in motion.rows:
        eyes, window = "2x" if row.eyes == 2 else "", " window" if row.place == "window" else ""
        row["picture"] = f"{eyes}{row.width}x{row.height}{window}"
    loads = [row.load for row in motion.rows]
    on_sheet = [row for row in motion.rows if row.picture == "1280x720"]
    motion.update(loads=f"{min(loads):.1f} to {max(loads):.1f}", seconds=motion.rows[0].seconds,
                  shown_motions=", ".join(dict.fromkeys(row.motion for row in on_sheet)),
                  shown_data=", ".join(dict.fromkeys(row.data for row in on_sheet)),
                  goals=goals_of(motion.rows, motion_key, MOTION_GOALS))

    for row in page.building.rows:
        row.update(build_ms=1e3 * row.build_seconds, zstd_ms=1e3 * row.zstd_seconds)
    for row in page.change.rows:
        row["look"] = "again" if row.again else "first"
    for row in page.between.rows:
        row.update({bound: f"{row[bound]:g}" if row[bound] else "" for bound in ("goal", "floor")})

    index_size, build_time = size_and_time(page.scale)
    played = [(row.footprint, row.fps, row.vtk_fps) for row in render.rows
              if (row.data, row.picture, row.threads) == ("vorticity64", "1024^2", 2)]
    return page | {
        "first_look": first_look(page.scale), "search_time": search_time(index), "mesh_time": mesh_time(page.scale),
        "index_size": index_size, "build_time": build_time, "frames_processor": frames(played),
        "frames_gpu": frames_gpu(page.gpu), "live_frames": live_frames(page.gpu),
        "outlines": outlines(page.agreement), "wrong_cells": wrong_cells(index),
        "command": " ".join(path if name == "index" else f"--{name} {path}" for name, path in paths.items())}


# Commits of measurements that the history does not have, and that could not be made again: of a GPU that is no longer
# at hand, and of times that need a machine to themselves.
GONE = ("69ae3ff3c705", "498f46717f94")


def files_of(paths):
    """The page in Markdown and the charts that it shows, by their paths from its folder."""
    values = values_of(paths)
    page = expand(Path(__file__).with_suffix(".md").read_text(encoding="utf-8"), values)
    for commit in GONE:  # but where a program's own words are quoted
        page = re.sub(f"(?<!\n)commit {commit}", f"commit {commit}, which is no longer in the history", page)
    charts = re.findall(r"!\[(.*)\]\((pictures/charts/(\w+)\.svg)\)", page)
    return {"RESULTS.md": page} | {path: svg_of(title, **values[name]) for title, path, name in charts}


def main():
    parser = argparse.ArgumentParser(prog="./run bench results", description=__doc__.splitlines()[0])
    for name, (path, what) in RESULTS.items():
        option = {"default": path, "metavar": "FILE", "help": f"{what} (default: {path})"}
        if name == "index":
            parser.add_argument(name, nargs="?", **option)
        else:
            parser.add_argument(f"--{name}", **option)
    parser.add_argument("-o", "--out", default=ROOT / "docs/RESULTS.md", type=Path, metavar="FILE.md",
                        help="the page; its charts lie in pictures/charts beside it (default: docs/RESULTS.md)")
    parser.add_argument("--check", action="store_true", help="write nothing; fail where a file would be another")
    arguments = parser.parse_args()
    try:
        files = files_of({name: getattr(arguments, name) for name in RESULTS})
    except (KeyError, ValueError) as error:
        sys.exit(f"the results lack what the page shows: {error!r}")
    others = []
    for name, text in files.items():
        path = arguments.out if name == "RESULTS.md" else arguments.out.parent / name
        if arguments.check:
            others += [str(path)] if path.read_text(encoding="utf-8") != text else []
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
    if others:
        sys.exit(f"{', '.join(others)}: not as the results say; write the page again: ./run bench results")


if __name__ == "__main__":
    main()
