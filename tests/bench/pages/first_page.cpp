// The first page of the results: takes its figures from the rows and lines of the measurements.
#include "tests/bench/pages/first_page.h"

#include "app/text.h"
#include "tests/bench/measures/timing.h"
#include "tests/bench/pages/figure_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <string_view>
#include <utility>

namespace isochron::bench {
namespace {

/// The size of the default index and the time to build it, of every grid.
void add_index_figures(const FirstPageInput& input, std::vector<PageFigure>& figures) {
    const std::vector<std::string> lines = lines_of(input.scale);
    BarChart size{.title = "Size of the index, as a part of the data", .bars = {}};
    BarChart build{.title = "Processor time to index a GiB of values, in seconds", .bars = {}};
    for (const std::smatch& line : lines_like(
             lines,
             R"(^(\w+) (\d+)\^3 u8, codec fitting: index / data ([\d.]+), build ([\d.]+) s)")) {
        const std::string label = fmt::format("{} {}^3", line[1].str(), line[2].str());
        const double edge = number(line, 2), gibibytes = edge * edge * edge / (1 << 30);
        const double seconds = number(line, 4) / gibibytes;
        size.bars.push_back({label, number(line, 3), line[3].str(), true});
        build.bars.push_back({label, seconds, fmt::format("{:.1f} s", seconds), true});
    }
    if (size.bars.empty())
        return;
    const std::string source = source_of(input.names.scale, lines);
    const std::string kinds =
        "*smooth* is a field whose surfaces are large and simple, *rough* one "
        "whose surface is nearly everywhere";
    figures.push_back(
        {"index_size", "How large is an index?",
         fmt::format("{} of the data: it holds the packed values, levels of detail and search "
                     "structures of one step of 8-bit values. {}.",
                     range_of(size.bars), kinds),
         source, size});
    figures.push_back({"build_time", "How long does it take to make one?",
                       fmt::format("{} of processor time for a GiB of 8-bit values that are in "
                                   "memory, over all threads.",
                                   range_of(build.bars)),
                       source, build});
}

/// The first look at a file of which nothing is in memory: the larger surface of the largest grid.
void add_first_look(const FirstPageInput& input, std::vector<PageFigure>& figures) {
    const std::vector<std::string> lines = lines_of(input.scale);
    BarChart chart{.title = "First look at a step of 1 GiB, from the disk, in ms", .bars = {}};
    std::string read;
    const std::vector<std::smatch> all = lines_like(
        lines, R"(^(\w+) (\d+)\^3 u8, (\d+) cells .*cold: ([\d.]+) of 1024 MiB read, (\d+) ms; )"
               R"(read and scan (\d+) ms.*VTK (\d+) ms)");
    for (const char* kind : {"smooth", "rough"}) {
        const std::smatch* most = nullptr;
        for (const std::smatch& line : all)
            if (line[1] == kind && (!most || number(line, 3) > number(*most, 3)))
                most = &line;
        if (!most)
            return;
        chart.bars.push_back(
            milliseconds(fmt::format("{}: Isochron", kind), number(*most, 5), true));
        chart.bars.push_back(milliseconds("read all and scan", number(*most, 6), false));
        chart.bars.push_back(milliseconds("VTK, flying edges", number(*most, 7), false));
        read += fmt::format("{}{} of 1,024 MiB of the {} step ({} active cells)",
                            read.empty() ? "" : " and ", short_number(number(*most, 4)), kind,
                            app::grouped(std::stoull((*most)[3].str())));
    }
    figures.push_back(
        {"first_look", "How soon is the first surface of a large file there?",
         fmt::format("The disk gave {}. Where a surface is nearly everywhere, an index gains "
                     "nothing at the first look. Times go on to cells with positions and normals.",
                     read),
         source_of(input.names.scale, lines), chart});
}

/// Triangles with normals from cells that are known, and by VTK.
void add_mesh(const FirstPageInput& input, std::vector<PageFigure>& figures) {
    const std::vector<std::string> lines = lines_of(input.scale);
    BarChart chart{.title = "A mesh of a 256^3 step, one thread, in ms", .bars = {}};
    std::string kind;
    double least_gain = 0, most_gain = 0;
    for (const std::string& line : lines) {
        static const std::regex kWarm(R"(^(\w+) 256\^3 f32, (\d+) cells .*warm:)");
        static const std::regex kMesh(
            R"(mesh of (\d+) triangles with normals .*: ([\d.]+) ms, VTK ([\d.]+) ms, ([\d.]+)x)");
        std::smatch match;
        if (std::regex_search(line, match, kWarm)) {
            kind = match[1].str();
        } else if (!kind.empty() && std::regex_search(line, match, kMesh)) {
            const std::string triangles = app::grouped(std::stoull(match[1].str()));
            chart.bars.push_back(
                milliseconds(fmt::format("{}, {} triangles: Isochron", kind, triangles),
                             number(match, 2), true));
            chart.bars.push_back(milliseconds("VTK, flying edges", number(match, 3), false));
            const double gain = number(match, 4);
            least_gain = least_gain == 0 ? gain : std::min(least_gain, gain);
            most_gain = std::max(most_gain, gain);
        }
    }
    if (!chart.bars.empty())
        figures.push_back({"mesh_time", "How fast is a surface made into triangles?",
                           fmt::format("{} to {} times as fast as VTK's flying edges, both with "
                                       "normals. Isochron begins with the active cells, which the "
                                       "index has found.",
                                       short_number(least_gain), short_number(most_gain)),
                           source_of(input.names.scale, lines), chart});
}

/// Searches of one step in memory: the largest series of bytes.
void add_search(const FirstPageInput& input, std::vector<PageFigure>& figures) {
    if (!input.index)
        return;
    const auto row_of = [&](std::string_view structure) {
        return std::ranges::find_if(input.index->rows, [&](const Row& row) {
            return row.data == "fourier256" && row.type == "u8" && row.structure == structure;
        });
    };
    const auto cells = row_of("cells"), bricks = row_of("bricks"), none = input.index->rows.end();
    if (cells == none || bricks == none)
        return;
    // As in the tables: the median over the rows, each of which has its own measurement.
    const auto compared = [&](double Row::* figure) {
        std::vector<double> all;
        for (const Row& row : input.index->rows)
            if (row.data == cells->data && row.type == cells->type)
                all.push_back(row.*figure);
        return median(std::move(all));
    };
    const auto bar = [](std::string label, double value, bool ours) {
        const auto whole = static_cast<std::uint64_t>(std::llround(value));
        return Bar{std::move(label), value, app::grouped(whole) + " us", ours};
    };
    const BarChart chart{.title =
                             "Search of a 256^3 step in memory, one thread, in us (logarithmic)",
                         .bars = {bar("ids: cells", cells->search_ids_us, true),
                                  bar("ids: bricks", bricks->search_ids_us, true),
                                  bar("ids: plain scan", compared(&Row::scan_us), false),
                                  bar("with normals: cells", cells->search_full_us, true),
                                  bar("with normals: bricks", bricks->search_full_us, true),
                                  bar("VTK: triangles with normals",
                                      compared(&Row::flying_edges_normals_us), false)},
                         .logarithmic = true};
    figures.push_back(
        {"search_time", "How fast is a search?",
         fmt::format("The ids of {} active cells come from the tier *cells* in {}, and with "
                     "positions and normals in {}. VTK's flying edges make triangles in {}.",
                     app::grouped(static_cast<std::uint64_t>(cells->active)), chart.bars[0].text,
                     chart.bars[3].text, chart.bars[5].text),
         source_of(input.names.index, input.index->header), chart});
}

/// What the published structure finds too much; the tiers find nothing too much.
void add_errors(const FirstPageInput& input, std::vector<PageFigure>& figures) {
    if (!input.index)
        return;
    BarChart chart{.title = "Cells that a search returns and that are not active, in %",
                   .bars = {{}}};
    std::uint64_t wrong = 0, active = 0, queries = 0;
    const Results& results = *input.index;
    for (std::size_t i = 0; i < results.rows.size(); ++i) {
        const Row& row = results.rows[i];
        const ErrorDetail& detail = results.details[i];
        if (row.structure == "bricks" || row.structure.starts_with("cells")) {
            wrong += row.false_positives + row.false_negatives;
            active += detail.active;
            queries += detail.queries;
        }
        if (row.structure == "thi" && row.l == 64u && row.max_variation == 2u)
            chart.bars.push_back(
                {fmt::format("published: {}, {}, {} steps", row.data, row.type, row.steps),
                 detail.percent_at_isovalue, short_number(detail.percent_at_isovalue) + " %",
                 false});
    }
    if (active == 0)
        return;
    const double percent = 100.0 * static_cast<double>(wrong) / static_cast<double>(active);
    chart.bars.front() = {"bricks, cells, deltas: all series", percent,
                          short_number(percent) + " %", true};
    figures.push_back(
        {"wrong_cells", "Are the cells the right ones?",
         fmt::format(
             "In {} queries the search structures returned {} active cells, and {} wrong or "
             "missing ones. The published structure, here with L 64 and MaxVariation 2, "
             "also returns cells that are not active: these have to be tested.",
             app::grouped(queries), app::grouped(active), wrong == 0 ? "no" : app::grouped(wrong)),
         source_of(input.names.index, results.header), chart});
}

} // namespace

std::vector<PageFigure> figures_of(const FirstPageInput& input) {
    std::vector<PageFigure> figures;
    add_first_look(input, figures);
    add_search(input, figures);
    add_mesh(input, figures);
    add_index_figures(input, figures);
    add_frame_figures(input, figures);
    add_errors(input, figures);
    return figures;
}

std::string first_page(const std::vector<PageFigure>& figures, const std::string& charts) {
    if (figures.empty())
        return {};
    std::string text = fmt::format(
        "# What to expect: {} figures\n\n"
        "Colored bars are Isochron, gray ones are what it is compared with. Below each chart "
        "stands "
        "the file that holds the measurement, and the machine. All tables follow after these "
        "figures.\n\n"
        "**The machines.** An AMD EPYC server, of which two cores were used, without a GPU: Mesa "
        "draws on the processor. And an NVIDIA H100 with 16 cores of an Intel Xeon; it is made for "
        "computing, only a few of its multiprocessors can draw.\n\n"
        "**Not measured.** Nobody has worn a headset, and no wall, tracker or shutter glasses were "
        "connected: recordings were played, and no person judged pictures or felt delays. A GPU "
        "has "
        "not drawn into a window. No GPU for desktops, no network file system, no cluster of "
        "several computers, no steps of more than 2048^3 vertices. Other programs than VTK were "
        "not "
        "timed.\n\n",
        figures.size());
    for (const PageFigure& figure : figures)
        text += fmt::format("## {}\n\n{}\n\n![{}]({}/{}.svg)\n\n*From {}.*\n\n", figure.heading,
                            figure.text, figure.chart.title, charts, figure.name, figure.source);
    return text;
}

} // namespace isochron::bench
