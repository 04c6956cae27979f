// `isochron measure`: area, volume, pieces and other numbers of surfaces, at steps of an index.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/step_range.h"
#include "app/command_line/subcommands.h"
#include "app/commands/csv_rows.h"
#include "app/commands/mesh_cuts.h"
#include "app/indexing/open_index.h"
#include "app/output/guarded_outputs.h"
#include "app/telling.h"
#include "app/text.h"
#include "index/measure/measures.h"
#include "index/system/new_file.h"
#include "index/volume/instant_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

using Json = nlohmann::ordered_json;

struct MeasureArguments {
    std::filesystem::path file, out;
    std::vector<double> isovalues;
    std::optional<std::string> steps;
    std::uint32_t fraction = 0, dust = 0;
    std::vector<std::string> measures;
    std::optional<std::string> array, on_surface, crop;
    std::vector<double> clip, from;
    bool pieces = false, csv = false, force = false;
};

/// The measures that are asked for, by their numbers; those of the other array, or from a place, only
/// with one.
std::vector<std::size_t> chosen(const MeasureArguments& arguments) {
    std::vector<std::size_t> numbers;
    const std::span<const index::Measure> all = index::measures();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool named =
            std::ranges::find(arguments.measures, all[i].name) != arguments.measures.end();
        const bool there =
            index::is_measured(all[i], arguments.on_surface.has_value(), !arguments.from.empty());
        if (named && !there)
            throw UsageError("--measure {}: needs {}", all[i].name,
                             all[i].unit == index::MeasureUnit::value ? "--on-surface ARRAY"
                                                                      : "--from X Y Z");
        if (named || (arguments.measures.empty() && there))
            numbers.push_back(i);
    }
    return numbers;
}

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

/// What is measured, a row for each surface or for each of its pieces.
struct Rows {
    std::vector<std::string> columns, units; ///< a unit for each column
    Json rows = Json::array();
};

void add_pieces(const index::MeasuredSurface& found, const Json& of_surface, Json& rows) {
    for (std::size_t i = 0; i < found.pieces.size(); ++i) {
        const index::MeasuredPiece& piece = found.pieces[i];
        Json row = of_surface;
        row["piece"] = i;
        row["area"] = number(piece.area);
        row["volume"] = number(piece.volume);
        row["closed"] = piece.closed ? 1 : 0;
        row["cells"] = piece.cells;
        row["euler"] = piece.euler;
        row["triangles"] = piece.triangles;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const char name = "xyz"[axis];
            row[fmt::format("{}", name)] = number(piece.centroid[axis]);
            row[fmt::format("{}-least", name)] = number(piece.low[axis]);
            row[fmt::format("{}-greatest", name)] = number(piece.high[axis]);
        }
        rows.push_back(std::move(row));
    }
}

Rows measured(const MeasureArguments& arguments,
              const std::shared_ptr<const index::IndexFile>& file,
              const std::vector<std::size_t>& numbers) {
    const index::SeriesInfo& info = file->info();
    index::MeasureWishes wishes{.pieces = arguments.pieces, .only = numbers};
    wishes.kept.dust = arguments.dust;
    if (arguments.on_surface)
        wishes.array = array_on_surface(*file, *arguments.on_surface, "to measure on the surface");
    if (arguments.crop)
        wishes.box = box_of(*arguments.crop, info.grid);
    if (const auto plane = plane_of(arguments.clip))
        wishes.clip = index::CutPlane{plane->point, plane->normal};
    if (!arguments.from.empty())
        wishes.from = glm::dvec3(arguments.from[0], arguments.from[1], arguments.from[2]);
    const std::string other =
        wishes.array ? index::ColorSource(*file, *wishes.array).array().value_unit : "";
    Rows made{.columns = {"step", "fraction", "time", "isovalue"},
              .units = {"", "", info.time_unit, info.value_unit}};
    if (arguments.pieces) {
        const std::string length = info.length_unit;
        const auto power = [&](int n) {
            return length.empty() ? "" : fmt::format("{}^{}", length, n);
        };
        made.columns.insert(made.columns.end(),
                            {"piece", "area", "volume", "closed", "cells", "euler", "triangles",
                             "x", "x-least", "x-greatest", "y", "y-least", "y-greatest", "z",
                             "z-least", "z-greatest"});
        made.units.insert(made.units.end(), {"", power(2), power(3), "", "", "", ""});
        made.units.resize(made.columns.size(), length);
    } else {
        for (const std::size_t i : numbers) {
            made.columns.emplace_back(index::measures()[i].name);
            made.units.push_back(index::unit_of(index::measures()[i], info, other));
        }
    }
    const std::vector<std::uint32_t> steps = steps_or_all(arguments.steps, "--steps", info.steps());
    const CancelOnSignal signals;
    ProgressBar bar;
    index::SurfaceMeasures measuring(file);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        signals.check();
        if (steps.size() > 1)
            bar.show("measuring", static_cast<double>(i) / static_cast<double>(steps.size()));
        const index::Instant at = index::instant_named(*file, steps[i], arguments.fraction);
        for (const double isovalue : arguments.isovalues) {
            const auto found = measuring.measure({at, isovalue}, wishes);
            Json row{{"step", at.step},
                     {"fraction", at.fraction},
                     {"time", index::time_at(info.times, at)},
                     {"isovalue", isovalue}};
            if (arguments.pieces) {
                add_pieces(*found, row, made.rows);
                continue;
            }
            for (const std::size_t k : numbers)
                row[std::string(index::measures()[k].name)] = number(found->values[k]);
            made.rows.push_back(std::move(row));
        }
    }
    if (steps.size() > 1)
        bar.show("measuring", 1);
    return made;
}

Json as_json(const MeasureArguments& arguments, const index::IndexFile& file, const Rows& made) {
    Json units = Json::object();
    for (std::size_t i = 0; i < made.columns.size(); ++i)
        if (!made.units[i].empty())
            units[made.columns[i]] = made.units[i];
    return Json{{"file", arguments.file.string()},
                {"array", file.info().array},
                {"units", std::move(units)},
                {"rows", made.rows}};
}

/// Columns with their units, right-aligned.
SafeText as_table(const Rows& made) {
    std::vector<std::vector<std::string>> lines(made.rows.size() + 1);
    for (std::size_t i = 0; i < made.columns.size(); ++i)
        lines[0].push_back(made.units[i].empty()
                               ? made.columns[i]
                               : fmt::format("{} [{}]", made.columns[i], made.units[i]));
    for (std::size_t k = 0; k < made.rows.size(); ++k)
        for (const std::string& column : made.columns) {
            const Json& value = made.rows[k][column];
            lines[k + 1].push_back(value.is_null() ? "-"
                                   : value.is_number_float()
                                       ? fmt::format("{:.7g}", value.get<double>())
                                       : value.dump());
        }
    std::vector<std::size_t> widths(made.columns.size());
    for (const auto& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i)
            widths[i] = std::max(widths[i], line[i].size());
    SafeText text;
    for (const auto& line : lines) {
        std::string words;
        for (std::size_t i = 0; i < line.size(); ++i)
            words += fmt::format("{}{:>{}}", i == 0 ? "" : "  ", line[i], widths[i]);
        text += SafeText("{}\n", words);
    }
    return text;
}

void run_measure(const MeasureArguments& arguments) {
    const std::vector<std::size_t> numbers = chosen(arguments);
    const auto file = open_array(arguments.file, arguments.array, 0, arguments.on_surface);
    for (const double isovalue : arguments.isovalues)
        warn_beyond(isovalue, *file);
    if (!arguments.out.empty())
        guard_outputs({{arguments.out, OutputKind::surface}}, {{arguments.file}, file.get()},
                      arguments.force);
    const Rows made = measured(arguments, file, numbers);
    if (arguments.out.empty()) {
        if (tells_json())
            return tell_result(as_json(arguments, *file, made));
        return print_answer(arguments.csv ? SafeText::lines(csv_of(made.rows, made.columns))
                                          : as_table(made));
    }
    const std::string text = csv_of(made.rows, made.columns);
    index::write_file(arguments.out, text);
    tell_result({{"file", arguments.out.string()}, {"rows", made.rows.size()}});
    print_report("wrote {}: {} rows\n", arguments.out.string(), made.rows.size());
}

} // namespace

void add_measure(Command& program) {
    auto arguments = std::make_shared<MeasureArguments>();
    Command command = program.subcommand(
        "measure", "Measure surfaces: their area, the volume that they enclose, their connected "
                   "pieces and more.");
    command.examples({"isochron measure run42.isochron --isovalue 100",
                      "isochron measure run42.isochron --isovalue 100 --steps 2 --pieces"});
    command.option("file INDEX", arguments->file, "Index whose surfaces are measured").required();
    command.option("--array NAME", arguments->array,
                   "Array of the surfaces, where the index has several (default: its first)");
    command
        .option("--isovalue VALUE", arguments->isovalues,
                "Isovalue, in the unit of the values (after scaling); again for another surface")
        .repeatable()
        .required();
    command.option(
        "--steps,--step STEPS", arguments->steps,
        "Steps to measure, counted from 0: one step, or FIRST:LAST[:STRIDE] (default: all)");
    command
        .option("--fraction FRACTION", arguments->fraction,
                "Measure between each step and the next: 0 is the step, 32768 is halfway, 65536 "
                "would be the next step")
        .between(0u, 65535u)
        .shows_default();
    std::vector<std::string> names;
    std::string definitions;
    for (const index::Measure& measure : index::measures()) {
        names.emplace_back(measure.name);
        definitions += fmt::format("{}: {}. ", measure.name, measure.definition);
    }
    command
        .option("--measure MEASURE", arguments->measures,
                "What to measure; again for another one (default: all)")
        .repeatable()
        .one_of(names);
    command.option("--on-surface NAME", arguments->on_surface,
                   "Another array of the index, whose values on the surface are measured");
    command.option(
        "--crop X0:X1,Y0:Y1,Z0:Z1", arguments->crop,
        "Measure only the cells within a box, from one vertex of the grid to another; the "
        "surface ends at its faces");
    command.option(
        "--clip X Y Z NX NY NZ", arguments->clip,
        "Measure only what lies on one side of a plane, which is given by a point and a "
        "normal in the coordinates of the data. The normal points to the side that is cut "
        "away. The surface is cut without a cap; volumes are those of that side, exactly");
    command.option("--from X Y Z", arguments->from,
                   "Measure the distance from this place, in the coordinates of the data, to the "
                   "nearest point of the surface");
    command.option(
        "--dust CELLS", arguments->dust,
        "Measure without the connected pieces that have fewer active cells. What these enclose "
        "is taken from the volume");
    command.flag(
        "--pieces", arguments->pieces,
        "Print a row for each connected piece of a surface, the largest area first, with its "
        "area, the volume that it encloses (negative around lower values), its Euler number, "
        "its centroid and its extent");
    command.flag("--csv", arguments->csv, "Print the table as CSV");
    command.option("-o,--output,--out FILE", arguments->out,
                   "CSV file to write (default: print a table)");
    command.flag("--force", arguments->force, "Replace a file that exists");
    command.footer(
        "The measures. " + definitions +
        "Areas and volumes are in powers of the data's unit of length. docs/FORMATS.md has "
        "the definitions in full.");
    command.on_run([arguments] { run_measure(*arguments); });
}

} // namespace isochron::app
