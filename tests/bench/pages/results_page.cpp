// The page of results.
#include "tests/bench/pages/results_page.h"

#include "app/text.h"
#include "tests/bench/measures/timing.h"
#include "tests/bench/pages/agreement_rows.h"
#include "tests/bench/pages/artifact_page.h"
#include "tests/bench/pages/change_page.h"
#include "tests/bench/pages/first_page.h"
#include "tests/bench/pages/goals.h"
#include "tests/bench/pages/motion_page.h"
#include "tests/bench/pages/paper_tables.h"
#include "tests/bench/pages/render_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace isochron::bench {

namespace {

std::string page_number(double value) {
    return value >= 100 ? app::grouped(static_cast<std::uint64_t>(std::llround(value)))
                        : fmt::format("{:.3g}", value);
}

std::string page_number(const std::optional<double>& value) {
    return value ? page_number(*value) : "-";
}

constexpr std::string_view kHowToRead =
    "## How to read it\n\n"
    "- *raw* is steps x cells x 24 bytes, as in the paper. `% of raw` counts everything that the "
    "structure stores and not the volume; `% with volume` adds it, since the paper's 24 bytes "
    "include a gradient and ours are computed from the volume, at that very step.\n"
    "- Every time is processor time of one thread, with everything in memory: the median over all "
    "steps of medians over several rounds. All structures, the scan, the T-BON, flying edges and "
    "memcpy take turns in one process, on the same field, step and isovalue; each runs once "
    "before it is timed. Build rates are per second of processor time over all threads; "
    "the entries that the THI tree and its variants have in common are found once, and count for "
    "each.\n"
    "- *runs*: a search that leaves the ids where they lie. *ids*: cell ids as 32-bit numbers, in "
    "memory that is kept from search to search, as that of memcpy; for the THI tree and its "
    "variants candidates with their false positives. *full*: ids in order, "
    "without false positives, with positions and normals. *incremental*: added and removed ids to "
    "the neighboring step. *whole*: the complete set of the neighboring step from that of this "
    "one. *sweep*: all steps once, forwards or backwards.\n"
    "- FP: false positives in percent of the active cells at the isovalue of the times; those over "
    "all queries are in the rows. FN: false negatives over all queries. A query is a step and one "
    "of 64 isovalues, the quantiles of the values.\n"
    "- *bricks* also find the ids while an isovalue of wide values is dragged. Copies of the "
    "bricks "
    "with the vertices of each side by side in memory, which earlier versions made of a step at "
    "its "
    "17th search in a row, took at most half a millisecond less for that search of 256^3; it runs "
    "in the background, so a drag loses nothing of a frame.\n"
    "- *T-BON*: branch-on-need octree per step over one topology, exact, with the volume at hand "
    "(Sutton and Hansen 1999). *Flying edges*: `vtkFlyingEdges3D`, sequential. It makes triangles "
    "where the others find cells: the fair partner of *full* is flying edges with normals.\n\n";

constexpr std::string_view kComparable =
    "## Next to the paper\n\n"
    "Vrolijk, Botha and Post (SCCG 2004) measured a moving sphere of 61 x 50 x 60 vertices on a "
    "dual AMD Athlon MP of 1.2 GHz. Comparable are the sizes in percent of raw, and how sizes, "
    "false positives and the gain of the incremental search change with L, MaxVariation and the "
    "number of steps. Not comparable are the times themselves (another machine, and 24 bytes "
    "copied for each cell instead of 4) and the percentages of false positives: their field, "
    "isovalue and motion are not published. The sphere here was chosen to have as many active "
    "cells and, in the paper's layout of 48 bytes per entry, trees of about the same size; ours "
    "take 16 bytes per entry.\n\n";

/// The row with this setting of the published structure; null if it was not measured.
const Row* find(const Results& results, const PublishedThi& published, std::string_view type) {
    const auto found = std::find_if(results.rows.begin(), results.rows.end(), [&](const Row& row) {
        return row.data == "sphere" && row.structure == "thi" && row.type == type &&
               row.steps == published.steps && row.l == published.l &&
               row.max_variation == published.max_variation;
    });
    return found == results.rows.end() ? nullptr : &*found;
}

/// A table of the paper: the published figures and ours for each setting and number of steps.
std::string published_table(const Results& results, std::span<const PublishedThi> table) {
    std::string text =
        "| L | MaxVariation | steps | | % of raw | FP % | search us | incremental us "
        "| speed-up |\n|---|---|---|---|---|---|---|---|---|\n";
    for (const PublishedThi& published : table) {
        text += fmt::format("| {} | {} | {} | paper | {} | {} | {:.0f} | {:.0f} | {:.2f} |\n",
                            published.l, published.max_variation, published.steps,
                            published.percent_of_raw, published.percent_false_positives,
                            1000 * published.search_ms, 1000 * published.incremental_ms,
                            published.speed_up);
        for (const char* type : {"u8", "f32"}) {
            const Row* row = find(results, published, type);
            if (!row) {
                text += fmt::format("| | | | {} here | - | - | - | - | - |\n", type);
                continue;
            }
            // The published times are means, and so is a sweep. The median over the steps would
            // hide steps at which half of the tree is searched again.
            const double incremental = 1e3 * row->sweep_ms / static_cast<double>(row->steps);
            const auto& detail =
                results.details[static_cast<std::size_t>(row - results.rows.data())];
            text += fmt::format("| | | | {} here | {:.1f} | {:.2g} | {} | {} | {:.2f} |\n", type,
                                row->percent_of_raw, detail.percent_at_isovalue,
                                page_number(row->search_ids_us), page_number(incremental),
                                row->search_ids_us / incremental);
        }
    }
    return text + "\n";
}

/// The errors of one normal per time span, for every setting of the published structure.
std::string normals_table(const Results& results) {
    std::string text = "| series | type | steps | L | MaxVariation | mean | 99 % are below |\n"
                       "|---|---|---|---|---|---|---|\n";
    for (std::size_t i = 0; i < results.rows.size(); ++i) {
        const Row& row = results.rows[i];
        if (const ErrorDetail& detail = results.details[i]; detail.normal_error_mean)
            text +=
                fmt::format("| {} | {} | {} | {} | {} | {:.3g} deg | {:.3g} deg |\n", row.data,
                            row.type, row.steps, row.l.value_or(0), row.max_variation.value_or(0),
                            *detail.normal_error_mean, detail.normal_error_p99.value_or(0));
    }
    return text + "\n";
}

std::string structure_line(const Row& row, const ErrorDetail& detail) {
    const std::string setting =
        row.l ? fmt::format(", L {}, MaxVariation {}", *row.l, *row.max_variation) : "";
    return fmt::format(
        "| {}{} | {} | {:.3g} | {:.3g} | {:.2g} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
        row.structure, setting, app::grouped(row.bytes), row.percent_of_raw,
        row.percent_with_volume, detail.percent_at_isovalue, row.false_negatives,
        page_number(row.search_runs_us), page_number(row.search_ids_us),
        page_number(row.search_full_us), page_number(row.incremental_us),
        page_number(row.incremental_full_us), page_number(row.sweep_ms),
        page_number(row.build_mcs_per_s));
}

/// The median over the rows of a series, each of which has its own measurement of the comparison.
std::string compared(std::span<const Row> rows, double Row::* figure) {
    std::vector<double> all;
    for (const Row& row : rows)
        all.push_back(row.*figure);
    return page_number(median(std::move(all)));
}

std::string series_table(std::span<const Row> rows, std::span<const ErrorDetail> details) {
    const Row& first = rows.front();
    std::string text = fmt::format(
        "### {}, {}, {} steps\n\nIsovalue {:.5g}: {} active cells on average, {} added or removed "
        "from step to step; errors over {} queries with {} active cells.\n\nscan {} us, T-BON {} "
        "us, flying edges {} us, with normals {} us, memcpy of the ids {} us.\n\n",
        first.data, first.type, first.steps, first.isovalue, page_number(first.active),
        page_number(first.delta_ids), app::grouped(details.front().queries),
        app::grouped(details.front().active), compared(rows, &Row::scan_us),
        compared(rows, &Row::tbon_us), compared(rows, &Row::flying_edges_us),
        compared(rows, &Row::flying_edges_normals_us), compared(rows, &Row::memcpy_us));
    text +=
        "| structure | bytes | % of raw | % with volume | FP % | FN | runs us | ids us | full us "
        "| incremental us | whole us | sweep ms | build Mcs/s per core |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (std::size_t i = 0; i < rows.size(); ++i)
        text += structure_line(rows[i], details[i]);
    return text + "\n";
}

} // namespace

std::string results_page(const Results& results, const ResultPaths& paths) {
    const Header& header = results.header;
    std::string command = paths.index;
    const std::initializer_list<std::pair<const char*, const std::string&>> options{
        {" --render ", paths.render},       {" --artifacts ", paths.artifacts},
        {" --scale ", paths.scale},         {" --gpu ", paths.gpu},
        {" --agreement ", paths.agreement}, {" --motion ", paths.motion},
        {" --building ", paths.building},   {" --change ", paths.change},
        {" --between ", paths.between},     {" --public ", paths.public_files}};
    for (const auto& [option, path] : options)
        if (!path.empty())
            command += option + path;
    std::string text = fmt::format("# The index, measured\n\nMade from `{}` by `./run bench "
                                   "results {}`; not to be edited. "
                                   "Measured on {} with commit {}, {}, on {}, {} threads.\n\n",
                                   paths.index, command, header.date, header.commit,
                                   header.compiler, header.processor, header.threads);
    text += kHowToRead;
    text += "## Goals\n\nThe worst figure of all rows that a goal speaks of decides.\n\n" +
            goals_table(results) + "\n";
    text += kComparable;
    text += "### Table 1: SpanSpaceSize L\n\n" + published_table(results, kTable1);
    text += "### Table 2: MaxVariation\n\n" + published_table(results, kTable2);
    text += "## Normals kept over a time span\n\n"
            "The published structure stores a cell once for a time span, with one gradient. The "
            "angle between a cell's normal in the middle of its span and that at the step on "
            "screen, over all active cells and steps at the isovalue of the times. The tiers "
            "compute normals from the volume at that very step: no error.\n\n" +
            normals_table(results);
    text += "## Every series\n\n"
            "`thi` is the published structure; `thi-node-lattices`, `thi-interval-trees` and "
            "`thi-compact-lists` are the improvements that its section 7 proposes: a lattice for "
            "each time node, one interval tree for each and no lattice, and AL and DR without "
            "storing ids and keys twice. They merge cells over time as the published structure "
            "does, hence have its false positives.\n\n";
    for (std::size_t begin = 0, end; begin < results.rows.size(); begin = end) {
        const Row& first = results.rows[begin];
        for (end = begin; end < results.rows.size() && results.rows[end].data == first.data &&
                          results.rows[end].type == first.type &&
                          results.rows[end].steps == first.steps;)
            ++end;
        text += series_table(std::span(results.rows).subspan(begin, end - begin),
                             std::span(results.details).subspan(begin, end - begin));
    }
    text.pop_back(); // one line end is enough
    return text;
}

namespace {

/// The section with the output of `isochron-bench scale`, unchanged.
std::string scale_section(const std::string& lines, const std::string& path) {
    return fmt::format(
        "\n# Large grids, measured\n\n"
        "What `./run bench scale` printed, kept in `{}`: one step of turbulence of 64 Fourier "
        "modes, "
        "*smooth* with wave numbers to 10, *rough* to a quarter of the grid. Index / data: the "
        "default index, with all levels of detail. Cold: nothing of the file is in memory; bytes "
        "are what the disk gave from opening on, to cells with positions and normals. *In blocks*: "
        "how many blocks of so many cells hold an active one, and the bytes of their values. No "
        "search reads less where values lie in such blocks: those around them come on top, for "
        "cells and normals at their sides, and a disk gives no less than 4 KiB at a time, which is "
        "a block of 16^3 values of a byte, or eight of 8^3. Where that is most of a step, as in "
        "the "
        "rough field, no order of the values makes the first look many times as fast as reading "
        "it.\n\n"
        "```\n{}```\n",
        path, lines);
}

/// The section with what programs printed where a GPU drew, unchanged.
std::string gpu_section(const std::string& lines, const std::string& path) {
    return fmt::format(
        "\n# On a GPU, measured\n\n"
        "What programs printed, kept in `{}`, where an NVIDIA H100 drew (driver 580.159, through "
        "EGL without a window, 16 processors). It is made for computing: only a few of its "
        "multiprocessors can draw. A recording is played live at the pace of a display of 90 Hz: "
        "a head that rests, stands and sways, walks into the volume, drags the isovalue and jumps "
        "in time, six seconds each. `vtk`: the same GPU draws for VTK. The last table comes from a "
        "working tree that was committed later, under another name.\n\n"
        "```\n{}```\n",
        path, lines);
}

/// The section with what the comparison of public files printed, unchanged.
std::string public_section(const std::string& lines, const std::string& path) {
    return fmt::format(
        "\n# Public files, read\n\n"
        "What `tests/index/conformance/public.py check` printed, kept in `{}`: the files that "
        "`tests/index/conformance/PUBLIC.tsv` names, at its commits. *Read right*: vertices, "
        "spacing, times and the numbers of active cells of three isovalues are those of an "
        "independent decode (nibabel, pydicom, netCDF4, tifffile, h5py, VTK, numpy), *refused*: "
        "the "
        "file is no volume, and the one line that says so names the cause that is written down. "
        "The words of refusals were taken from the program; files of VTK are decoded by VTK; no "
        "Zarr, XDMF, BOV, CGNS, OpenFOAM or OME-TIFF is among them.\n\n"
        "```\n{}```\n",
        path, lines);
}

} // namespace

ResultsPage whole_page(const ResultPaths& paths,
                       const std::function<std::string(const std::string&)>& read) {
    constexpr const char* kCharts = "pictures/charts";
    FirstPageInput input{
        .names = {paths.index, paths.render, paths.agreement, paths.scale, paths.gpu}};
    input.index = results_from_json(read(paths.index), paths.index);
    std::string tables = results_page(*input.index, paths);
    if (!paths.render.empty()) {
        input.render = render_results_from_json(read(paths.render), paths.render);
        tables += render_section(*input.render, paths.render);
    }
    if (!paths.artifacts.empty())
        tables += artifact_section(artifacts_from_json(read(paths.artifacts), paths.artifacts),
                                   paths.artifacts);
    if (!paths.scale.empty()) {
        input.scale = read(paths.scale);
        tables += scale_section(input.scale, paths.scale);
    }
    if (!paths.gpu.empty()) {
        input.gpu = read(paths.gpu);
        tables += gpu_section(input.gpu, paths.gpu);
    }
    if (!paths.agreement.empty()) {
        input.agreement = agreement_results_from_json(read(paths.agreement), paths.agreement);
        tables += agreement_section(*input.agreement, paths.agreement);
    }
    if (!paths.motion.empty())
        tables += motion_section(motion_from_json(read(paths.motion), paths.motion), paths.motion,
                                 "pictures/motion.jpg");
    if (!paths.building.empty())
        tables += building_section(read(paths.building), paths.building);
    if (!paths.change.empty())
        tables += change_section(read(paths.change), paths.change);
    if (!paths.between.empty())
        tables += between_section(read(paths.between), paths.between);
    if (!paths.public_files.empty())
        tables += public_section(read(paths.public_files), paths.public_files);
    const std::vector<PageFigure> figures = figures_of(input);
    ResultsPage page{first_page(figures, kCharts) + tables, {}};
    for (const PageFigure& figure : figures)
        page.charts[fmt::format("{}/{}.svg", kCharts, figure.name)] = svg_of(figure.chart);
    return page;
}

} // namespace isochron::bench
