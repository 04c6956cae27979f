// `isochron export`: surfaces as files for other programs.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/step_range.h"
#include "app/command_line/subcommands.h"
#include "app/indexing/open_index.h"
#include "app/output/guarded_outputs.h"
#include "app/text.h"
#include "app/version.h"
#include "index/error.h"
#include "index/export/surface_export.h"
#include "index/file/color_source.h"
#include "index/formats/length_units.h"
#include "index/system/new_file.h"
#include "render/gl/srgb.h"
#include "render/passes/color_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
    fs::path file;
    std::string out, format, steps, precision = "single", color_map = "viridis";
    std::vector<double> isovalues, range;
    std::optional<std::string> array, color_by, unit;
    double rate = 10;
    bool no_normals = false, force = false, json = false;
};

std::vector<std::string> format_names() {
    std::vector<std::string> names;
    for (const index::SurfaceFormat& format : index::surface_formats())
        names.emplace_back(format.name);
    return names;
}

/// The name that files are made of, and their format.
struct Target {
    const index::SurfaceFormat* format;
    fs::path name;
};

Target target_of(const ExportArguments& arguments) {
    const fs::path out(arguments.out);
    std::error_code ignored;
    const bool folder = !out.has_filename() || fs::is_directory(out, ignored);
    const index::SurfaceFormat* const by_name = index::surface_format(arguments.format);
    const index::SurfaceFormat* const by_extension =
        folder ? nullptr : index::surface_format_of(out);
    if (!by_name && !by_extension)
        throw UsageError(fmt::format(
            "--out: expected a name that ends in .ply, .stl, .obj, .vtp, .glb, .usda or .csv, or a "
            "folder and --format, got {}",
            arguments.out));
    const index::SurfaceFormat& format = by_name ? *by_name : *by_extension;
    if (folder)
        return {&format, out / (arguments.file.stem().string() + std::string(format.extension))};
    return {&format, out};
}

std::array<std::uint8_t, 3> bytes_of(const glm::vec3& srgb) {
    const glm::vec3 scaled = glm::round(glm::clamp(srgb, 0.0f, 1.0f) * 255.0f);
    return {static_cast<std::uint8_t>(scaled.x), static_cast<std::uint8_t>(scaled.y),
            static_cast<std::uint8_t>(scaled.z)};
}

/// What the values of an array are to look like.
index::ValuesWish values_of(const ExportArguments& arguments, const index::IndexFile& file) {
    const std::vector<std::string> names = index::color_source_names(file);
    const auto found = std::ranges::find(names, *arguments.color_by);
    if (found == names.end())
        throw index::Error(fmt::format(
            "{}: no array {} to color by, expected {}", file.name(), *arguments.color_by,
            names.empty() ? "an index with several arrays: isochron build --array A --array B ..."
                          : fmt::format("{}", fmt::join(names, ", "))));
    const auto number = static_cast<std::size_t>(found - names.begin());
    const index::ColorSource source(file, number);
    const auto map = render::color_map_from_name(arguments.color_map);
    if (!map)
        throw UsageError(fmt::format("--color-map: expected {}, got {}",
                                     fmt::join(render::kColorMapNames, ", "), arguments.color_map));
    std::array<double, 2> range{source.array().low, source.array().high};
    if (!arguments.range.empty())
        range = {arguments.range[0], arguments.range[1]};
    if (!(range[0] < range[1]) && !arguments.range.empty())
        throw UsageError(
            fmt::format("--range: expected LOW below HIGH, got {} {}", range[0], range[1]));
    return {.array = number, .color_of = [range, colors = render::color_map(*map)](float value) {
                const double share =
                    std::clamp((value - range[0]) / (range[1] - range[0]), 0.0, 1.0);
                const double place =
                    std::isnan(share) ? 0 : share * static_cast<double>(colors.size() - 1);
                const auto low = static_cast<std::size_t>(place);
                const glm::vec3 color =
                    glm::mix(colors[low], colors[std::min(low + 1, colors.size() - 1)],
                             static_cast<float>(place - static_cast<double>(low)));
                return bytes_of(render::srgb_from_linear(color));
            }};
}

/// The factor between two units of length. @throws UsageError: one is not known
double factor_between(const std::string& from, const std::string& to) {
    const auto source = index::meters_in(from), wanted = index::meters_in(to);
    if (!wanted)
        throw UsageError(
            fmt::format("--unit: expected m, km, cm, mm, um, nm, in or ft, got {}", to));
    if (!source)
        throw UsageError(fmt::format(
            "--unit {}: the data have {}; isochron build --length-unit says it", to,
            from.empty() ? "no unit of length" : "the unit " + from + ", which is not a length"));
    return *source / *wanted;
}

index::ExportRequest request_of(const ExportArguments& arguments, const index::IndexFile& file,
                                const index::SurfaceFormat& format) {
    const index::SeriesInfo& info = file.info();
    index::ExportRequest request;
    index::ExportPlan& plan = request.plan;
    plan.note = fmt::format("{}, {} of {}, content {:016x}", kProgram, one_line(info.array),
                            one_line(arguments.file.filename().string()), file.content_hash());
    plan.length_unit = one_line(info.length_unit);
    plan.time_unit = one_line(info.time_unit);
    if (arguments.unit) {
        plan.unit_factor = factor_between(info.length_unit, *arguments.unit);
        plan.length_unit = *arguments.unit;
    }
    plan.meters = index::meters_in(plan.length_unit).value_or(1);
    plan.double_precision = arguments.precision == "double";
    plan.normals = !arguments.no_normals;
    plan.rate = arguments.rate;
    plan.steps = arguments.steps.empty()
                     ? steps_of(fmt::format("0:{}", info.steps() - 1), "--steps", info.steps())
                     : steps_of(arguments.steps, "--steps", info.steps());
    for (const double isovalue : arguments.isovalues) {
        if (!std::isfinite(isovalue))
            throw UsageError(fmt::format("--isovalue: expected a number, got {}", isovalue));
        const std::size_t number = request.surfaces.size();
        request.surfaces.push_back({.isovalue = isovalue,
                                    .name = one_line(fmt::format("{} {}{}", info.array, isovalue,
                                                                 with_space(info.value_unit))),
                                    .color = bytes_of(render::surface_palette()[number])});
        warn_beyond(isovalue, file);
    }
    if (arguments.color_by) {
        request.values = values_of(arguments, file);
        if (format.with_values)
            plan.values_name = one_line(*arguments.color_by);
    }
    return request;
}

void print(const ExportArguments& arguments, const std::vector<fs::path>& files,
           const index::ExportRequest& request, const index::ExportCount& count) {
    if (arguments.json) {
        nlohmann::ordered_json names = nlohmann::ordered_json::array();
        for (const fs::path& file : files)
            names.push_back(file.string());
        const nlohmann::ordered_json j{{"files", names},
                                       {"steps", request.plan.steps},
                                       {"isovalues", arguments.isovalues},
                                       {"cells", count.cells},
                                       {"vertices", count.vertices},
                                       {"triangles", count.triangles},
                                       {"empty_steps", count.empty_steps}};
        fmt::print("{}\n", j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
        return;
    }
    fmt::print("wrote {}{}: {} step{}, {} cells, {} vertices, {} triangles\n",
               files.front().string(),
               files.size() == 1 ? "" : fmt::format(" and {} more", files.size() - 1),
               request.plan.steps.size(), request.plan.steps.size() == 1 ? "" : "s",
               grouped(count.cells), grouped(count.vertices), grouped(count.triangles));
    if (!count.empty_steps.empty())
        fmt::print(stderr,
                   "isochron: no cell has the isovalue in {} of {} steps, the first is {}\n",
                   count.empty_steps.size(), request.plan.steps.size(), count.empty_steps.front());
}

void run_export(const ExportArguments& arguments) {
    if (arguments.isovalues.size() > index::kMostSurfaces)
        throw UsageError(fmt::format("--isovalue: expected at most {} of them, got {}",
                                     index::kMostSurfaces, arguments.isovalues.size()));
    const Target target = target_of(arguments);
    if (arguments.precision == "double" && !target.format->with_doubles)
        throw UsageError(fmt::format("--precision double: {} has single precision alone; ply, obj, "
                                     "vtp and csv have both",
                                     target.format->name));
    const auto file = array_called(open_index(arguments.file), arguments.array);
    const index::ExportRequest request = request_of(arguments, *file, *target.format);
    const std::vector<fs::path> files =
        index::files_of_export(*target.format, target.name, request.plan, request.surfaces.size());
    std::vector<Output> outputs;
    outputs.reserve(files.size());
    for (const fs::path& each : files)
        outputs.push_back({each, OutputKind::surface});
    guard_outputs(outputs, {{arguments.file}, file.get()}, arguments.force);
    if (target.name.has_parent_path())
        index::make_folder(target.name.parent_path());
    index::ExportCount count;
    {
        const CancelOnSignal signals;
        ProgressBar bar;
        count = index::export_surfaces(file, *target.format, target.name, request,
                                       [&](std::string_view phase, double fraction) {
                                           signals.check();
                                           bar.show(phase, fraction);
                                       });
    }
    print(arguments, files, request, count);
}

} // namespace

void add_export(Command& program) {
    auto arguments = std::make_shared<ExportArguments>();
    Command command = program.subcommand(
        "export", "Write surfaces as files for other programs: meshes, or tables of cells.");
    command.examples({"isochron export run42.isochron --isovalue 100 --steps 0 -o surface.ply",
                      "isochron export run42.isochron --isovalue 100 -o surfaces/ --format vtp"});
    command.option("file", arguments->file, "Index").required().type_name("NAME.isochron");
    command.option("--array", arguments->array,
                   "Array to search, if the index has several (default: its first)");
    command
        .option("--isovalue", arguments->isovalues,
                "Isovalue, in the unit of the values (after scaling); again for another surface, 8 "
                "at most")
        .repeatable()
        .required();
    command
        .option("--steps", arguments->steps,
                "Steps, from 0: `7`, `0:63` with both ends, or `0:63:4` (default: all)")
        .type_name("FIRST:LAST[:STRIDE]");
    command
        .option("-o,--out", arguments->out,
                "Output: a file; with several steps each has its number: surface_0007.ply. Or a "
                "folder, which "
                "is made if it ends in a slash")
        .required()
        .type_name("NAME");
    command.option("--format", arguments->format, "Format (default: by the end of the name)")
        .one_of(format_names());
    command.option("--color-by", arguments->color_by,
                   "Array whose values color the vertices, and are written where the format has "
                   "values");
    command.option("--color-map", arguments->color_map, "Its color map").shows_default();
    command
        .option("--range", arguments->range,
                "Values at the ends of the color map (default: the range of the array)")
        .values(2)
        .type_name("LOW HIGH");
    command
        .option("--precision", arguments->precision,
                "Of coordinates. Where single precision is too coarse, an origin is subtracted, "
                "which the file names")
        .one_of({"single", "double"})
        .shows_default();
    command.option("--unit", arguments->unit,
                   "Unit of length of the coordinates: m, km, cm, mm, um, nm, in or ft (default: "
                   "the data's)");
    command.option("--rate", arguments->rate, "Steps a second in glb-animation and usda")
        .positive()
        .shows_default();
    command.flag("--no-normals", arguments->no_normals, "Write no normals");
    command.flag("--force", arguments->force, "Replace files that exist");
    command.flag("--json", arguments->json, "Print one JSON object");
    std::string formats = "Formats:\n";
    for (const index::SurfaceFormat& format : index::surface_formats())
        formats += fmt::format("  {:14} {}\n", format.name, format.words);
    command.footer(
        formats +
        "Each file appears whole or not at all. Triangles are counter-clockwise as seen "
        "from the side of\nlower values, to which normals point. JSON keys: files, steps, "
        "isovalues, cells, vertices,\ntriangles, empty_steps.");
    command.on_run([arguments] { run_export(*arguments); });
}

} // namespace isochron::app
