// Exports surfaces of an index, step by step.
#pragma once

#include "index/export/surface_writer.h"
#include "index/file/index_file.h"
#include "index/progress.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace isochron::index {

/// A surface to be exported.
struct SurfaceWish {
    double isovalue = 0;
    std::string name;
    std::array<std::uint8_t, 3> color{}; ///< sRGB
    float opacity = 1;
};

/// Values at the vertices, and what color they have.
struct ValuesWish {
    /// To color by (ColorSource); none: the time at which the surface first passed through a cell,
    /// which its vertices get, and NaN where that is not known.
    std::optional<std::size_t> array;
    /// Without an array: first crossings are those of blends between steps, as pictures show them
    /// where steps are blended; else those of steps alone.
    bool blended = false;
    /// sRGB of a value; empty: vertices have the color of their surface.
    std::function<std::array<std::uint8_t, 3>(float value)> color_of;
};

struct ExportRequest {
    ExportPlan plan;
    std::vector<SurfaceWish> surfaces;
    std::optional<ValuesWish> values; ///< needs `ExportPlan::values_name`
    /// Changes each mesh before it is colored and written; may be null. Called on one thread. It gets
    /// the whole mesh, which is in memory then, what it is the surface of, and what to call now and then
    /// where it takes long (it throws where the export is canceled).
    std::function<void(CellMesh& mesh, const Query& query, const std::function<void()>& look)>
        reshape;
    std::stop_token stop = {}; ///< ends the export: it throws Error then
};

/// What was written.
struct ExportCount {
    std::uint64_t cells = 0;
    std::uint64_t vertices = 0, triangles = 0; ///< 0 in formats of cells, for which no mesh is made
    std::vector<std::uint32_t> empty_steps;    ///< steps in which no surface has a cell
};

/// Meshes are made and written in pieces, by layers of chunks: memory holds some megabytes of a mesh,
/// and the disk of the files the rest until it is written. Steps are written while the next ones are
/// made.
/// @param name of the file, or of the files of steps: see `file_of_step`
/// @throws Error: a step that is not there, damage, a disk that is full; what `progress` throws.
///         Files that are written by then are whole and stay.
ExportCount export_surfaces(const std::shared_ptr<const IndexFile>& file,
                            const SurfaceFormat& format, const std::filesystem::path& name,
                            const ExportRequest& request, const Progress& progress = {});

} // namespace isochron::index
