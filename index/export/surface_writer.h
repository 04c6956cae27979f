// Files of surfaces for other programs: the formats, and who writes them.
//
//     const auto format = index::surface_format("ply");
//     const auto writer = format->make(plan, "surfaces/run42.ply");
//     for (const std::uint32_t step : plan.steps)
//         writer->add(exported(step));
//     writer->finish();
#pragma once

#include "index/export/exported_step.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace isochron::index {

/// Writes the steps of a plan. Each file appears whole under its name, or not at all. Functions
/// throw Error as NewFile's do.
class SurfaceWriter {
  public:
    virtual ~SurfaceWriter() = default;
    /// In the order of the plan, all with the same number of surfaces.
    virtual void add(const ExportedStep& step) = 0;
    /// Completes what is written once for all steps.
    virtual void finish() {}
};

struct SurfaceFormat {
    std::string_view name;       ///< as on a command line
    std::string_view extension;  ///< with its dot
    std::string_view words;      ///< what it is for
    bool all_in_one = false;     ///< one file holds all steps
    bool by_surface = false;     ///< each surface has files of its own, where there are several
    bool with_normals = true;    ///< has normals, or none where they are not wanted
    bool with_colors = true;     ///< has colors
    bool with_values = false;    ///< can hold values at the vertices
    bool with_doubles = false;   ///< can hold coordinates in double precision
    bool of_cells = false;       ///< holds cells, not triangles
    bool with_quantized = false; ///< can hold coordinates in fewer bits
    std::unique_ptr<SurfaceWriter> (*make)(const ExportPlan& plan,
                                           const std::filesystem::path& name);
};

std::span<const SurfaceFormat> surface_formats();
/// @return null if there is no such format
const SurfaceFormat* surface_format(std::string_view name);
/// The format of files with this extension, in any case; null if there is none.
const SurfaceFormat* surface_format_of(const std::filesystem::path& file);

/// The file of a step: `name` itself if the export has one step or the format holds all, else with
/// the step's number, of as many digits as the last one has and at least four: `run42_0007.ply`.
/// @param surface its number, where each has a file of its own
std::filesystem::path file_of_step(const std::filesystem::path& name, const ExportPlan& plan,
                                   std::uint32_t step,
                                   std::optional<std::size_t> surface = std::nullopt);
/// All files that an export makes.
std::vector<std::filesystem::path> files_of_export(const SurfaceFormat& format,
                                                   const std::filesystem::path& name,
                                                   const ExportPlan& plan, std::size_t surfaces);

// The writers of the formats: each in the source of its name.
std::unique_ptr<SurfaceWriter> csv_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name);
std::unique_ptr<SurfaceWriter> ply_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name);
std::unique_ptr<SurfaceWriter> stl_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name);
std::unique_ptr<SurfaceWriter> obj_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name);
std::unique_ptr<SurfaceWriter> vtp_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name);
std::unique_ptr<SurfaceWriter> glb_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name);
std::unique_ptr<SurfaceWriter> glb_animation_writer(const ExportPlan& plan,
                                                    const std::filesystem::path& name);
std::unique_ptr<SurfaceWriter> usda_writer(const ExportPlan& plan,
                                           const std::filesystem::path& name);

} // namespace isochron::index
