// Describes exports: what every export of an index says, and the export of what a session shows.
#pragma once

#include "app/frame/explorer_state.h"
#include "app/scene/color_scale.h"
#include "index/export/surface_export.h"
#include "index/file/index_file.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// What every export of an index says: its note and its units, without steps.
/// @param file the array of the surfaces @param data name of its file
index::ExportPlan plan_of(const index::IndexFile& file, const std::string& data);
/// `vorticity 9.5 1/s`, in one line.
std::string surface_name(const index::SeriesInfo& info, double isovalue);
/// @param srgb 0 to 1, clamped
std::array<std::uint8_t, 3> color_bytes(const glm::vec3& srgb);
/// The color at a place of a map, interpolated.
/// @param map linear colors @param share 0 to 1, clamped; NaN: 0
std::array<std::uint8_t, 3> color_at(const std::vector<glm::vec3>& map, double share);

/// Whether a clip plane leaves a vertex: triangles are cut away whole, those with a corner beyond it.
bool is_left(const index::MeshVertex& vertex, const index::Grid& grid,
             const interaction::ClipPlane& plane);

/// What the state shows: its surfaces of the picked one's array with their colors, at its moment or at
/// all steps of its range,
/// in its format and colors, cut by its clip plane. On a grid whose ids are wide, colors by time of
/// first crossing are those of the surfaces.
/// @param file all its arrays
/// @param scale of the colors as the picture has them; empty: as `color_scale` has them without
/// cells
index::ExportRequest shown_request(const ExplorerState& state,
                                   const std::shared_ptr<const index::IndexFile>& file,
                                   std::optional<ColorScale> scale = std::nullopt);

} // namespace isochron::app
