// `isochron export`: surfaces as files for other programs.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/step_range.h"
#include "app/command_line/subcommands.h"
#include "app/commands/mesh_cuts.h"
#include "app/commands/mesh_packing.h"
#include "app/indexing/open_index.h"
#include "app/output/export_request.h"
#include "app/output/guarded_outputs.h"
#include "app/telling.h"
#include "app/text.h"
#include "index/export/simplified_mesh.h"
#include "index/export/surface_export.h"
#include "index/file/color_source.h"
#include "index/measure/mesh_pieces.h"
#include "index/readers/formats/length_units.h"
#include "index/system/memory_limit.h"
#include "index/system/new_file.h"
#include "render/passes/color_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
    fs::path file;
    std::optional<std::string> steps;
    std::string out, format, precision = "single", color_map = "viridis";
    std::vector<double> isovalues, range;
    std::optional<std::string> array, color_by, unit;
    MeshCuts cuts;
    std::optional<double> rate;
    std::uint32_t fraction = 0;
    bool no_normals = false, quantize = false, compress = false, force = false;
};

/// @param has what the formats have; null: all formats
std::vector<std::string> format_names(bool index::SurfaceFormat::* has = nullptr) {
    std::vector<std::string> names;
    for (const index::SurfaceFormat& format : index::surface_formats())
        if (!has || format.*has)
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
        throw UsageError("--output: expected a name that ends in .ply, .stl, .obj, .vtp, .glb, "
                         ".usda or .csv, or a folder and --format, got {}",
                         arguments.out);
    const index::SurfaceFormat& format = by_name ? *by_name : *by_extension;
    if (folder)
        return {&format, out / (arguments.file.stem().string() + std::string(format.extension))};
    if (by_name && !out.has_extension()) // or no program could tell what the file is
        return {&format, out.string() + std::string(format.extension)};
    return {&format, out};
}

/// What the values of an array are to look like.
index::ValuesWish values_of(const ExportArguments& arguments, const index::IndexFile& file) {
    const std::size_t number = array_on_surface(file, *arguments.color_by, "to color by");
    const index::ColorSource source(file, number);
    const auto map = render::color_map_from_name(arguments.color_map);
    if (!map)
        throw UsageError("--color-map: expected {}, got {}",
                         fmt::join(render::kColorMapNames, ", "), arguments.color_map);
    std::array<double, 2> range{source.array().low, source.array().high};
    if (!arguments.range.empty())
        range = {arguments.range[0], arguments.range[1]};
    if (!(range[0] < range[1]) && !arguments.range.empty())
        throw UsageError("--color-range: expected LOW below HIGH, got {} {}", range[0], range[1]);
    return {.array = number, .color_of = [range, colors = render::color_map(*map)](float value) {
                return color_at(colors, (value - range[0]) / (range[1] - range[0]));
            }};
}

/// The factor between two units of length. @throws UsageError: one is not known
double factor_between(const std::string& from, const std::string& to) {
    const auto source = index::meters_in(from), wanted = index::meters_in(to);
    if (!wanted)
        throw UsageError("--length-unit: expected m, km, cm, mm, um, nm, in or ft, got {}", to);
    if (!source)
        throw UsageError(
            "--length-unit {}: the data have {}; build the index with --length-unit", to,
            from.empty() ? "no unit of length" : "the unit " + from + ", which is not a length");
    return *source / *wanted;
}

index::ExportRequest request_of(const ExportArguments& arguments, const index::IndexFile& file,
                                const index::SurfaceFormat& format) {
    const index::SeriesInfo& info = file.info();
    index::ExportRequest request;
    index::ExportPlan& plan = request.plan = plan_of(file, arguments.file.filename().string());
    if (arguments.unit) {
        plan.unit_factor = factor_between(info.length_unit, *arguments.unit);
        plan.length_unit = *arguments.unit;
        plan.meters = *index::meters_in(plan.length_unit);
    }
    plan.double_precision = arguments.precision == "double";
    plan.normals = !arguments.no_normals;
    plan.quantized = arguments.quantize;
    plan.packing = arguments.compress ? mesh_packing() : nullptr;
    plan.rate = arguments.rate.value_or(plan.rate);
    plan.steps = steps_or_all(arguments.steps, "--steps", info.steps());
    plan.fraction = arguments.fraction;
    if (plan.fraction > 0) // each step must have a next one
        index::instant_named(file, plan.steps.back(), plan.fraction);
    for (const double isovalue : arguments.isovalues) {
        const std::size_t number = request.surfaces.size();
        request.surfaces.push_back({.isovalue = isovalue,
                                    .name = surface_name(info, isovalue),
                                    .color = color_bytes(render::surface_palette()[number])});
        warn_beyond(isovalue, file);
    }
    if (arguments.color_by) {
        request.values = values_of(arguments, file);
        if (format.with_values)
            plan.values_name = one_line(*arguments.color_by);
    }
    return request;
}

void check(const ExportArguments& arguments, const index::SurfaceFormat& format) {
    struct Need {
        const char* option;
        bool given;
        bool index::SurfaceFormat::* held;
    };
    for (const Need& need :
         {Need{"--precision double", arguments.precision == "double",
               &index::SurfaceFormat::with_doubles},
          Need{"--color-by", arguments.color_by.has_value(), &index::SurfaceFormat::with_colors},
          Need{"--no-normals", arguments.no_normals, &index::SurfaceFormat::with_normals},
          Need{"--quantize", arguments.quantize, &index::SurfaceFormat::with_quantized},
          Need{"--compress", arguments.compress, &index::SurfaceFormat::with_quantized},
          Need{"--rate", arguments.rate.has_value(), &index::SurfaceFormat::all_in_one}})
        if (need.given && !(format.*need.held))
            throw UsageError("{}: is for {}, not {}", need.option,
                             fmt::join(format_names(need.held), ", "), format.name);
    for (const auto& [option, given] :
         {std::pair("--dust", arguments.cuts.dust > 0),
          std::pair("--crop", arguments.cuts.crop.has_value()),
          std::pair("--clip", !arguments.cuts.clip.empty()),
          std::pair("--simplify", arguments.cuts.simplify.has_value())})
        if (given && format.of_cells)
            throw UsageError("{}: is for triangles, and {} holds cells", option, format.name);
    if (arguments.compress && !mesh_packing())
        throw UsageError("--compress: this build is without meshoptimizer (libmeshoptimizer-dev)");
}

/// `12 cells`, and what their mesh has, if the format holds meshes.
std::string sizes_of(const index::ExportCount& count, const index::SurfaceFormat& format) {
    std::string sizes = fmt::format("{} cells", grouped(count.cells));
    if (!format.of_cells)
        sizes += fmt::format(", {} vertices, {} triangles", grouped(count.vertices),
                             grouped(count.triangles));
    return sizes;
}

void print(const ExportArguments& arguments, const index::SurfaceFormat& format,
           const std::vector<fs::path>& files, const index::ExportRequest& request,
           const index::ExportCount& count, const SimplifiedBy& moved) {
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const fs::path& file : files)
        names.push_back(file.string());
    tell_result({{"files", names},
                 {"steps", request.plan.steps},
                 {"fraction", request.plan.fraction},
                 {"isovalues", arguments.isovalues},
                 {"cells", count.cells},
                 {"vertices", count.vertices},
                 {"triangles", count.triangles},
                 {"empty_steps", count.empty_steps}});
    print_report("wrote {}{}: {} step{}, {}\n", files.front().string(),
                 files.size() == 1 ? "" : fmt::format(" and {} more", files.size() - 1),
                 request.plan.steps.size(), request.plan.steps.size() == 1 ? "" : "s",
                 sizes_of(count, format));
    if (arguments.cuts.simplify) {
        tell_result({{"error", moved.moved}, {"error_cells", moved.cells}});
        print_report("simplified: the surface has moved by at most {} ({})\n",
                     upper_text(moved.moved, request.plan.length_unit),
                     upper_text(moved.cells, "cells"));
    }
    if (!count.empty_steps.empty())
        print_note("note: {} of {} steps have no surface at this isovalue, the first is step {}",
                   count.empty_steps.size(), request.plan.steps.size(), count.empty_steps.front());
}

/// Says by how much single precision moves vertices, where that is much of a cell, as of thin layers.
void warn_of_rounding(const index::SurfaceFormat& format, const index::Grid& grid,
                      const index::ExportPlan& plan) {
    if (format.of_cells)
        return;
    const double moved = index::ExportedPlaces(grid, plan).rounding(0);
    const double share = moved / (plan.unit_factor * index::shortest_side(grid));
    if (share <= index::ExportedPlaces::kMostOfSide)
        return;
    print_note(
        "note: coordinates of single precision are off by up to {} ({} of a "
        "cell's shortest side){}",
        upper_text(moved, plan.length_unit), upper_text(share, ""),
        format.with_doubles
            ? "; --precision double keeps them"
            : fmt::format("; --precision double keeps them, in {}",
                          fmt::join(format_names(&index::SurfaceFormat::with_doubles), ", ")));
}

/// Steps are visited in turn, once. Of small ones, which are read as a whole, few are kept, so that a step
/// gets the memory of an earlier one: new memory is cleared first, which takes longer than decoding.
void keep_few_steps(const index::IndexFile& file) {
    constexpr std::uint64_t kFew = 8; // two steps of two arrays, each with the one before
    constexpr std::uint64_t kLeastKept = std::uint64_t{4} << 20; // [byte]
    std::uint64_t bytes = 0;
    for (std::size_t array = 0; array < file.arrays(); ++array)
        bytes = std::max<std::uint64_t>(bytes, file.array(array).info().step_bytes());
    file.kept().limit(std::min(file.cache().budget, std::max(kFew * bytes, kLeastKept)));
}

void run_export(const ExportArguments& arguments) {
    if (arguments.isovalues.size() > index::kMostSurfaces)
        throw UsageError("--isovalue: expected at most {} of them, got {}", index::kMostSurfaces,
                         arguments.isovalues.size());
    const Target target = target_of(arguments);
    check(arguments, *target.format);
    // Each value is looked at twice, soon after each other: to find cells and to place vertices.
    constexpr std::uint64_t kMostKept = std::uint64_t{128} << 20; // [byte]
    const std::uint64_t kept = std::min(kMostKept, index::memory_limit() / 4);
    const auto file = open_array(arguments.file, arguments.array, kept, arguments.color_by);
    keep_few_steps(*file);
    index::ExportRequest request = request_of(arguments, *file, *target.format);
    SimplifiedBy moved;
    request.reshape = reshaping(arguments.cuts, file->info().grid, index::is_complete(*file),
                                request.plan, moved);
    const std::vector<fs::path> files =
        index::files_of_export(*target.format, target.name, request.plan, request.surfaces.size());
    std::vector<Output> outputs;
    outputs.reserve(files.size());
    for (const fs::path& each : files)
        outputs.push_back({each, OutputKind::surface});
    guard_outputs(outputs, {{arguments.file}, file.get()}, arguments.force);
    if (target.name.has_parent_path())
        index::make_folder(target.name.parent_path());
    warn_of_rounding(*target.format, file->info().grid, request.plan);
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
    print(arguments, *target.format, files, request, count, moved);
}

} // namespace

void add_export(Command& program) {
    auto arguments = std::make_shared<ExportArguments>();
    Command command = program.subcommand(
        "export", "Write surfaces as files for other programs: meshes, or tables of cells.");
    command.examples({"isochron export run42.isochron --isovalue 100 --steps 0 -o surface.ply",
                      "isochron export run42.isochron --isovalue 100 -o surfaces/ --format vtp"});
    command.option("file INDEX", arguments->file, "Index to take surfaces of").required();
    command.option("--array NAME", arguments->array,
                   "Array of the surfaces, where the index has several (default: its first)");
    command
        .option(
            "--isovalue VALUE", arguments->isovalues,
            "Isovalue of the surface, in the unit of the values (after scaling). May be given up "
            "to 8 times, each time for another surface")
        .repeatable()
        .required();
    command.option(
        "--steps,--step FIRST:LAST[:STRIDE]", arguments->steps,
        "Steps to write, numbered from 0: `7`, `0:63` for 0 to 63, or `0:63:4` for every "
        "fourth of them (default: all)");
    command
        .option(
            "--fraction FRACTION", arguments->fraction,
            "Write the surface between each step and the next: 32768 is halfway, as for `query`")
        .between(0u, 65535u)
        .shows_default();
    command
        .option("-o,--output,--out FILE", arguments->out,
                "File to write; with several steps, the number of the step is added to its name, "
                "surface_0007.ply. Or a folder, which is made if its name ends in a slash")
        .required();
    command
        .option("--format FORMAT", arguments->format,
                "Format of the file (default: by its extension)")
        .one_of(format_names());
    const Option color_by = command.option(
        "--color-by,--color NAME", arguments->color_by,
        "Array whose values color the vertices. The values are written, too, where the "
        "format can hold them; stl and csv hold no colors");
    command.option("--color-map MAP", arguments->color_map, "Color map for these values")
        .needs(color_by)
        .shows_default();
    command
        .option("--color-range,--range LOW HIGH", arguments->range,
                "Values at both ends of the color map (default: the range of the array)")
        .needs(color_by);
    command
        .option(
            "--precision PRECISION", arguments->precision,
            "Precision of coordinates: single or double. Where single is too coarse, an origin is "
            "subtracted from them, and the file states this origin")
        .one_of({"single", "double"})
        .shows_default();
    command.option(
        "--length-unit,--unit UNIT", arguments->unit,
        "Unit of the coordinates: m, km, cm, mm, um, nm, in or ft (default: the unit of the "
        "data)");
    command
        .option("--rate RATE", arguments->rate,
                "Number of steps that glb-animation and usda play in a second (default: 10)")
        .positive();
    command.option(
        "--crop X0:X1,Y0:Y1,Z0:Z1", arguments->cuts.crop,
        "Write only triangles within a box, from one vertex of the grid to another; both "
        "belong to the box");
    command.option(
        "--clip X Y Z NX NY NZ", arguments->cuts.clip,
        "Write only triangles on one side of a plane, which is given by a point and a "
        "normal in the coordinates of the data. The normal points to the side that is cut "
        "away");
    command.option("--dust CELLS", arguments->cuts.dust,
                   "Leave out the connected pieces of the surface that have fewer active cells");
    command.option(
        "--simplify DISTANCE", arguments->cuts.simplify,
        "Write fewer triangles, so that the surface moves by at most this distance: a "
        "length in the unit of the file, or 0.5cells for half the shortest side of a cell. "
        "How far the surface has moved is measured and printed");
    command.flag(
        "--quantize", arguments->quantize,
        "In glTF, store coordinates in 16 bits and normals in 8 (KHR_mesh_quantization). A "
        "vertex moves by less than 1/75,000 of the surface's longest side");
    command.flag("--compress", arguments->compress,
                 "In glTF, pack vertices and triangles without loss (EXT_meshopt_compression). "
                 "Together with --quantize, files become smaller still");
    command.flag("--no-normals", arguments->no_normals, "Write no normals");
    command.flag("--force", arguments->force, "Replace files that exist");
    std::string formats = "Formats:\n";
    for (const index::SurfaceFormat& format : index::surface_formats())
        formats += fmt::format("  {:14} {}\n", format.name, format.words);
    command.footer(
        formats +
        "\nEach file appears once it is complete. Triangles are counter-clockwise as seen from the "
        "side of lower values, and normals point to this side.");
    command.on_run([arguments] { run_export(*arguments); });
}

} // namespace isochron::app
