// What one eye sees: the cells, the volume's box, the wand and what lies on the floor.
#include "app/scene.h"

#include <array>

namespace isochron::app {
namespace {

constexpr float kWandLength = 1.2f; // metres
constexpr glm::vec4 kBoxColour(0.45f, 0.50f, 0.56f, 0.55f);
constexpr glm::vec4 kWandColour(1.0f, 0.77f, 0.36f, 0.9f);

} // namespace

Scene::Scene(const render::Gl& gl, const index::SeriesInfo& info, const Config& config)
    : grid_(info.grid), bounding_box_(config.bounding_box),
      upload_bytes_(std::size_t{1024} * config.upload_kilobytes_per_frame), cells_(gl, info.grid),
      cell_pass_(gl), line_pass_(gl) {
    appearance_.color = config.surface_colour;
}

void Scene::upload(const index::ExtractionPtr& newest) {
    cells_.upload(newest, upload_bytes_);
}

render::Footprint Scene::best_footprint() const {
    return cells_.size() <= cells_.corner_limit() ? render::kBestFootprint
                                                  : render::Footprint::gaussian;
}

void Scene::draw(const render::View& view, const interaction::Similarity& room_from_physical,
                 render::Footprint footprint, const std::optional<interaction::Pose>& wand) {
    const auto placement = render::Placement::of(grid_, matrix(room_from_physical));
    if (bounding_box_) {
        const auto box = render::box_lines(placement.extent, kBoxColour);
        line_pass_.draw(view, placement.room_from_index, box);
    }
    if (!guides_.empty())
        line_pass_.draw(view, glm::mat4(1.0f), guides_);
    if (wand) {
        const std::array ray{render::Line{{0, 0, 0}, {0, 0, -kWandLength}, kWandColour}};
        line_pass_.draw(view, room_from(*wand), ray);
    }
    if (footprint == render::Footprint::surface)
        cells_.compute_corners();
    cell_pass_.draw(view, placement, cells_, footprint, appearance_);
}

} // namespace isochron::app
