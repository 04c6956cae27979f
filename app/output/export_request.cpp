// What an export is asked for.
#include "app/output/export_request.h"

#include "app/config/first_placement.h"
#include "app/safe_text.h"
#include "app/text.h"
#include "app/version.h"
#include "index/file/color_source.h"
#include "index/measure/kept_pieces.h"
#include "index/readers/formats/length_units.h"
#include "index/surface/mesh_crop.h"
#include "interaction/step_track.h"
#include "interaction/tools/clip_box.h"
#include "render/gl/srgb.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace isochron::app {
index::ExportPlan plan_of(const index::IndexFile& file, const std::string& data) {
    const index::SeriesInfo& info = file.info();
    index::ExportPlan plan;
    plan.note = fmt::format("{}, {} of {}, content {:016x}", kProgram, one_line(info.array),
                            one_line(data), file.content_hash());
    plan.length_unit = one_line(info.length_unit);
    plan.time_unit = one_line(info.time_unit);
    plan.meters = index::meters_in(plan.length_unit).value_or(1);
    return plan;
}

std::string surface_name(const index::SeriesInfo& info, double isovalue) {
    return one_line(fmt::format("{} {}{}", info.array, isovalue, with_space(info.value_unit)));
}

std::array<std::uint8_t, 3> color_bytes(const glm::vec3& srgb) {
    const glm::vec3 scaled = glm::round(glm::clamp(srgb, 0.0f, 1.0f) * 255.0f);
    return {static_cast<std::uint8_t>(scaled.x), static_cast<std::uint8_t>(scaled.y),
            static_cast<std::uint8_t>(scaled.z)};
}

std::array<std::uint8_t, 3> color_at(const std::vector<glm::vec3>& map, double share) {
    const double place =
        std::isnan(share) ? 0 : std::clamp(share, 0.0, 1.0) * static_cast<double>(map.size() - 1);
    const auto low = static_cast<std::size_t>(place);
    return color_bytes(
        render::srgb_from_linear(glm::mix(map[low], map[std::min(low + 1, map.size() - 1)],
                                          static_cast<float>(place - static_cast<double>(low)))));
}

bool is_left(const index::MeshVertex& vertex, const index::Grid& grid,
             const interaction::ClipPlane& plane) {
    return glm::dot(grid.physical(position_of(vertex)) - plane.point, plane.normal) <= 0;
}

index::ExportRequest shown_request(const ExplorerState& state,
                                   const std::shared_ptr<const index::IndexFile>& file,
                                   std::optional<ColorScale> scale) {
    const std::size_t number_of_array = array_of_surface(state, state.picked, *file);
    const index::IndexFile& array = file->array(number_of_array);
    const index::SeriesInfo& info = array.info();
    const index::SurfaceFormat& format = *index::surface_format(state.pictures.surfaces.format);
    index::ExportRequest request;
    request.plan = plan_of(array, std::filesystem::path(file->name()).filename().string());
    const auto steps = static_cast<std::uint32_t>(state.known_steps(info.steps()));
    if (state.pictures.surfaces.steps == interaction::ExportedSteps::range) {
        const auto range = state.play_range;
        for (std::uint32_t step = first_of(range, steps); step <= last_of(range, steps); ++step)
            request.plan.steps.push_back(step);
    } else {
        const index::Instant now = state.shown_instant();
        request.plan.steps = {now.step};
        request.plan.fraction = now.fraction;
    }
    std::vector<std::size_t> numbers; // in the state
    for (std::size_t i = 0; i < state.isosurfaces.size(); ++i) {
        const interaction::Isosurface& surface = state.isosurfaces[i];
        if (array_of_surface(state, i, *file) != number_of_array)
            continue;
        numbers.push_back(i);
        request.surfaces.push_back({.isovalue = surface.isovalue,
                                    .name = surface_name(info, surface.isovalue),
                                    .color = color_bytes(surface.color),
                                    .opacity = surface.opacity});
    }
    PercentileRange none;
    const bool by_crossing = state.coloring.by == interaction::ColorBy::first_crossing;
    if (!scale)
        scale = color_scale(state, *file, {}, none);
    if (scale && !(by_crossing && index::has_wide_ids(info.grid))) {
        std::optional<std::size_t> number;
        if (!by_crossing)
            number = color_array(state, *file);
        if (format.with_values)
            request.plan.values_name =
                number ? one_line(index::ColorSource(array, *number).array().array)
                       : "first crossing";
        request.values = {.array = number,
                          .blended = state.blends(),
                          .color_of = [scale = *scale, colors = colors_of(*scale)](float value) {
                              return color_at(colors, share_on(scale, static_cast<double>(value)));
                          }};
    }
    auto cuts = interaction::cutting_planes(state, data_frame(info));
    if (!state.pictures.surfaces.clipped)
        cuts.clear();
    if ((!cuts.empty() || !state.pieces.all()) && !format.of_cells)
        request.reshape = [cuts, grid = info.grid, surfaces = state.isosurfaces, numbers,
                           pieces = filter_of(state.pieces), complete = index::is_complete(array)](
                              index::CellMesh& mesh, const index::Query& query, const auto&) {
            const auto surface =
                std::ranges::find(numbers, query.isovalue,
                                  [&](std::size_t number) { return surfaces[number].isovalue; });
            index::keep(mesh, index::kept_pieces(mesh, grid, complete, pieces, *surface));
            if (!cuts.empty())
                index::keep_triangles(mesh, [&](const index::MeshVertex& vertex) {
                    return std::ranges::all_of(
                        cuts, [&](const auto& plane) { return is_left(vertex, grid, plane); });
                });
        };
    return request;
}

} // namespace isochron::app
