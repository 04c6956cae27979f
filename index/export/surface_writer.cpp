// The formats of surfaces, and the names of their files.
#include "index/export/surface_writer.h"

#include "index/lower_case.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::index {
namespace {

constexpr std::array<SurfaceFormat, 8> kFormats{{
    {.name = "ply",
     .extension = ".ply",
     .words = "Blender, MeshLab: binary, with normals, colors and values",
     .with_values = true,
     .with_doubles = true,
     .make = ply_writer},
    {.name = "stl",
     .extension = ".stl",
     .words = "printing, CAD: binary, triangles alone",
     .by_surface = true,
     .with_normals = false,
     .with_colors = false,
     .make = stl_writer},
    {.name = "obj",
     .extension = ".obj",
     .words = "nearly everything: text",
     .with_doubles = true,
     .make = obj_writer},
    {.name = "vtp",
     .extension = ".vtp",
     .words = "ParaView, PyVista: with normals, colors, values, and a .pvd of the times",
     .with_values = true,
     .with_doubles = true,
     .make = vtp_writer},
    {.name = "glb",
     .extension = ".glb",
     .words = "headsets, slides, the web: glTF",
     .with_quantized = true,
     .make = glb_writer},
    {.name = "glb-animation",
     .extension = ".glb",
     .words = "glTF with all steps in one file, which viewers play",
     .all_in_one = true,
     .with_quantized = true,
     .make = glb_animation_writer},
    {.name = "usda",
     .extension = ".usda",
     .words = "Blender, Omniverse: USD as text, all steps in one file",
     .all_in_one = true,
     .with_values = true,
     .make = usda_writer},
    {.name = "csv",
     .extension = ".csv",
     .words = "spreadsheets, pandas: the active cells, with their places and normals",
     .with_normals = false,
     .with_colors = false,
     .with_doubles = true,
     .of_cells = true,
     .make = csv_writer},
}};

} // namespace

std::span<const SurfaceFormat> surface_formats() {
    return kFormats;
}

const SurfaceFormat* surface_format(std::string_view name) {
    const auto found = std::ranges::find(kFormats, name, &SurfaceFormat::name);
    return found == kFormats.end() ? nullptr : &*found;
}

const SurfaceFormat* surface_format_of(const std::filesystem::path& file) {
    const std::string extension = lower_case(file.extension().string());
    const auto found = std::ranges::find(kFormats, extension, &SurfaceFormat::extension);
    return found == kFormats.end() ? nullptr : &*found;
}

std::filesystem::path file_of_step(const std::filesystem::path& name, const ExportPlan& plan,
                                   std::uint32_t step, std::optional<std::size_t> surface) {
    std::string stem = name.stem().string();
    if (surface)
        stem += fmt::format("_surface{}", *surface + 1);
    if (plan.steps.size() > 1) {
        const std::size_t digits =
            std::max<std::size_t>(4, fmt::formatted_size("{}", plan.steps.back()));
        stem += fmt::format("_{:0{}}", step, digits);
    }
    return name.parent_path() / (stem + name.extension().string());
}

std::vector<std::filesystem::path> files_of_export(const SurfaceFormat& format,
                                                   const std::filesystem::path& name,
                                                   const ExportPlan& plan, std::size_t surfaces) {
    if (format.all_in_one)
        return {name};
    std::vector<std::filesystem::path> files;
    for (const std::uint32_t step : plan.steps) {
        if (!format.by_surface || surfaces == 1) {
            files.push_back(file_of_step(name, plan, step));
            continue;
        }
        for (std::size_t i = 0; i < surfaces; ++i)
            files.push_back(file_of_step(name, plan, step, i));
    }
    if (format.name == "vtp" && plan.steps.size() > 1)
        files.push_back(std::filesystem::path(name).replace_extension(".pvd"));
    return files;
}

} // namespace isochron::index
