// The ways in which cells that move are drawn.
#include "app/scene/moving_cells.h"

#include "app/frame/cell_resolutions.h"
#include "render/gl/render_target.h"
#include "render/gl/viewport.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace isochron::app {
namespace {

/// A box that holds all cells, which may reach a little out of the volume.
glm::mat4 around_cells(const render::Placement& placement) {
    constexpr float kBeyond = 0.03f; // share of the volume
    const glm::mat4 larger = glm::translate(glm::mat4(1.0f), -kBeyond * placement.extent);
    return placement.room_from_index *
           glm::scale(larger, (1.0f + 2.0f * kBeyond) * placement.extent);
}

/// Meshes leave out surfaces by number, quads those of no opacity.
void leave_out(render::CellAppearance& appearance, std::size_t surface) {
    appearance.drawn &= ~(1u << surface);
    appearance.surfaces[surface].opacity = 0.0f;
}

/// Whether what stands beside the cells has written depths.
bool depths_beside(const Picture& picture) {
    return !picture.slices.empty() || !picture.beside.empty() || !picture.further.empty();
}

bool has_several_samples(const render::Gl& gl) {
    GLint samples = 0;
    gl.GetIntegerv(GL_SAMPLES, &samples);
    return samples > 1;
}

} // namespace

bool moves_in_layers(const Picture& picture, render::Footprint footprint) {
    const bool moves = footprint == render::Footprint::mesh ? picture.mesh_level > 0
                                                            : footprint == render::Footprint::quad;
    return moves && interaction::any_is(picture.isosurfaces, true);
}

render::Placement MovingCells::placement_of(const Picture& picture) const {
    return render::Placement::of(grid_, matrix(picture.room_from_physical));
}

glm::mat4 MovingCells::box_of(const Picture& picture) const {
    return around_cells(placement_of(picture));
}

bool MovingCells::draw_moved(const CellsPicture& kept, const Picture& picture,
                             std::span<const render::View> views) {
    const Picture* then = kept.movable(1);
    std::vector<render::PictureWithDepth> pictures =
        then ? kept.for_screens_of(views) : std::vector<render::PictureWithDepth>();
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        pictures[i].room_from_box = box_of(*then);
        reproject_.draw(views[i], pictures[i], box_of(picture));
    }
    for (std::size_t i = 0; i < views.size(); ++i)
        render::set_viewport(gl_, views[i], static_cast<GLuint>(i));
    return !pictures.empty();
}

void MovingCells::draw_in_few_pixels(const Cells& cells, const Picture& picture,
                                     std::span<const render::View> views) {
    const bool layers = moves_in_layers(picture, render::Footprint::quad);
    if (layers && depths_beside(picture)) // which layers need
        return draw_in_layers(cells, picture, render::Footprint::quad, views);
    enlarge_.begin(views, kCellResolutions[picture.resolution], cells.appearance.linear_light);
    if (layers)
        draw_in_layers(cells, picture, render::Footprint::quad, enlarge_.few());
    else
        cells.pass.draw(enlarge_.few(), placement_of(picture), cells.buffers,
                        render::Footprint::quad, cells.appearance);
    enlarge_.end(views, box_of(picture), layers);
}

bool MovingCells::draws_layers(const Picture& picture, render::Footprint footprint) const {
    return moves_in_layers(picture, footprint) &&
           (footprint == render::Footprint::mesh || picture.resolution > 0 ||
            !has_several_samples(gl_));
}

void MovingCells::draw_in_layers(const Cells& cells, const Picture& picture,
                                 render::Footprint footprint, std::span<const render::View> views) {
    const render::Placement placement = placement_of(picture);
    const auto draw = [&](const render::CellAppearance& appearance) {
        cells.pass.draw(views, placement, cells.buffers, footprint, appearance);
    };
    const std::size_t count = picture.isosurfaces.size();
    render::CellAppearance opaque = cells.appearance;
    std::vector<std::size_t> surfaces; // that let light through
    std::vector<float> opacities;
    for (std::size_t i = 0; i < count; ++i)
        if (render::is_translucent(opaque.surfaces[i])) {
            if (opaque.surfaces[i].opacity > 0) {
                surfaces.push_back(i);
                opacities.push_back(opaque.surfaces[i].opacity);
            }
            leave_out(opaque, i);
        }
    const bool some_opaque = interaction::any_is(picture.isosurfaces, false);
    if (has_several_samples(gl_)) // all layers, sorted, or a share of the quads
        return draw(cells.appearance);
    if (some_opaque)
        draw(opaque);
    if (surfaces.empty())
        return;
    layers_.draw(
        views, opacities,
        [&](std::size_t layer) {
            render::CellAppearance one = cells.appearance;
            for (std::size_t i = 0; i < count; ++i)
                leave_out(one, i);
            one.drawn |= 1u << surfaces[layer];
            one.surfaces[surfaces[layer]].opacity = 1.0f;
            draw(one);
        },
        some_opaque || depths_beside(picture), cells.appearance.linear_light, box_of(picture));
}

void MovingCells::warm_up(const Picture& picture, std::span<const render::View> views,
                          bool linear_light) {
    const glm::mat4 box = box_of(picture);
    enlarge_.begin(views, kCellResolutions.back(), linear_light);
    enlarge_.end(views, box, false);
    layers_.link();
    const std::array opacities{0.5f, 0.5f};
    layers_.draw(views, opacities, [](std::size_t) {}, false, linear_light, box);
    layers_.draw(
        views, std::span(opacities).first(1), [](std::size_t) {}, false, linear_light, box);
    render::RenderTarget small(gl_, {1, 1});
    small.clear(glm::vec4(0));
    const render::View pixel{.size = glm::ivec2(1)};
    for (const render::View& view : views)
        reproject_.draw(view, {small.color_texture(), small.depth_texture(), pixel}, box);
}

} // namespace isochron::app
