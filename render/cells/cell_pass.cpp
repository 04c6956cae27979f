// The uniforms and GL state of a draw of cells.
#include "render/cells/cell_pass.h"

#include "render/cells/frame_block.h"
#include "render/cells/point_sprites.h"
#include "render/gl/driver.h"
#include "render/gl/driver_trials.h"
#include "render/gl/limits.h"
#include "render/gl/shader.h"
#include "render/gl/soft_edges.h"
#include "render/gl/viewport.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace isochron::render {

namespace {

constexpr GLuint kColorMapUnit = 7;     ///< of appearance.glsl
constexpr GLuint kSurroundingsUnit = 9; ///< of surroundings.glsl

/// Cells that are put in order in about the time in which one is drawn.
constexpr std::size_t kOrdered = 8;

std::size_t ordering_work(const CellBuffers& cells) {
    return (cells.size() + kOrdered - 1) / kOrdered;
}

/// Whether only as many cells are drawn at once as a window of corners holds.
bool comes_in_windows(Footprint footprint, bool blended) {
    return footprint == Footprint::surface && !blended;
}

/// Calls `f` for pieces of a part.
template <class F>
void for_each_piece(DrawPart part, std::size_t most, const F& f) {
    for (std::size_t count = 0; part.count > 0; part.first += count, part.count -= count) {
        count = std::min(part.count, most);
        f(DrawPart{part.first, count});
    }
}

} // namespace

CellPass::Programs CellPass::programs(std::string_view fragment_shader,
                                      const std::string& prelude) const {
    const std::vector sources{shader_file("cell.vert"), shader_file(fragment_shader)};
    const std::string all = grid_prelude_ + prelude;
    Programs programs{link_program(*gl_, sources, all), std::nullopt};
    if (two_views_at_once_)
        programs.two = link_program(*gl_, sources, std::string(kTwoEyes) + all);
    return programs;
}

CellPass::FootprintPrograms CellPass::footprint_programs(std::string_view fragment_shader,
                                                         Footprint footprint) const {
    const bool plane = shapes_.shape == CellShape::plane;
    const std::string prelude =
        footprint == Footprint::gaussian
            ? std::string("#define ROUND\n") + (plane ? "#define PLANE\n" : "")
            : std::string(plane ? "#define CUT\n" : "");
    return {programs(fragment_shader, prelude),
            programs(fragment_shader, prelude + "#define POINTS\n"), std::nullopt};
}

CellPass::CellPass(const Gl& gl, const FootprintShapes& shapes, const std::string& grid_prelude)
    : gl_(&gl), shapes_(shapes), grid_prelude_(grid_prelude),
      two_views_at_once_(draws_to_two_viewports(gl)), seen_only_(takes_processor_ways(gl)),
      largest_point_(Limits(gl).largest_point),
      quad_programs_(footprint_programs("cell_quad.frag", Footprint::quad)),
      gaussian_programs_(footprint_programs("cell_gaussian.frag", Footprint::gaussian)),
      mesh_(gl, grid_prelude), surface_(gl, two_views_at_once_, grid_prelude), corners_(gl),
      quads_(gl), sequences_(gl), frame_(gl) {
    if (shapes.shape == CellShape::voxel)
        quad_programs_.squares = programs("cell_quad.frag", "#define POINTS\n#define SQUARE\n");
    const float falloff = gaussian_falloff();
    for (const Programs* programs : {&gaussian_programs_.quads, &gaussian_programs_.points}) {
        gl.ProgramUniform1f(programs->one.name(), 0, falloff);
        if (programs->two)
            gl.ProgramUniform1f(programs->two->name(), 0, falloff);
    }
}

/// log2 of a splat's opacity on its outline, relative to its middle.
float CellPass::gaussian_falloff() const {
    const float sigmas = shapes_.radius_of(Footprint::gaussian) / shapes_.sigma();
    return -0.5f * sigmas * sigmas * std::numbers::log2e_v<float>;
}

void CellPass::draw(std::span<const View> views, const Placement& placement,
                    const CellBuffers& cells, Footprint footprint, const CellAppearance& appearance,
                    DrawPart part) {
    if (cells.size() == 0)
        return;
    assert(footprint != Footprint::mesh || cells.has_mesh());
    std::size_t before = 0;
    for (const Layer& layer : layers_of(cells, footprint, appearance)) {
        const std::size_t at_once = views_at_once(footprint);
        const std::size_t work = work_of(cells, footprint, layer);
        const std::size_t most =
            comes_in_windows(footprint, layer.blended) ? corners_.most() : work;
        for (std::size_t first = 0; first < views.size(); first += at_once, before += work)
            for_each_piece(part.among(before, work), most, [&](const DrawPart& piece) {
                draw_at_once(views.subspan(first, std::min(at_once, views.size() - first)),
                             placement, cells, footprint, layer, appearance, piece);
            });
    }
}

bool CellPass::needs_corners(const CellBuffers& cells, Footprint footprint,
                             const CellAppearance& appearance) {
    return footprint == Footprint::surface &&
           std::ranges::any_of(layers_of(cells, footprint, appearance), &Layer::blended);
}

std::size_t CellPass::work(std::size_t views, const CellBuffers& cells, Footprint footprint,
                           const CellAppearance& appearance) const {
    std::size_t work = 0;
    for (const Layer& layer : layers_of(cells, footprint, appearance)) {
        const std::size_t at_once = views_at_once(footprint);
        work += (views + at_once - 1) / at_once * work_of(cells, footprint, layer);
    }
    return cells.size() == 0 ? 0 : work;
}

std::size_t CellPass::views_at_once(Footprint footprint) const {
    const bool apart = !two_views_at_once_ || footprint == Footprint::mesh ||
                       (!has_layers(footprint) && seen_only_);
    return apart ? 1 : 2;
}

bool CellPass::is_ordered(Footprint footprint, bool blended) const {
    return blended || (seen_only_ && footprint == Footprint::quad);
}

std::size_t CellPass::work_of(const CellBuffers& cells, Footprint footprint,
                              const Layer& layer) const {
    if (is_ordered(footprint, layer.blended))
        return ordering_work(cells) + cells.size();
    if (!has_layers(footprint))
        return 1;
    return footprint == Footprint::mesh && !layer.blended
               ? MeshPass::triangles(cells, layer.surfaces)
               : cells.size();
}

DrawPart CellPass::put_in_order(std::span<const View> views, const Placement& placement,
                                const CellBuffers& cells, Footprint footprint, const Layer& layer,
                                const CellAppearance& appearance, DrawPart part) {
    if (!is_ordered(footprint, layer.blended))
        return part;
    const std::size_t all = ordering_work(cells);
    const DrawPart ordering = part.among(0, all), drawing = part.among(all, cells.size());
    const std::size_t done = (ordering.first + ordering.count) * views.size();
    for (std::size_t i = 0; drawing.count == 0 && i < views.size(); ++i) { // one after the other
        if (done <= i * all)
            break;
        const std::size_t to = std::min(done - i * all, all);
        if (footprint == Footprint::mesh) { // wants no texture with the order
            const TraversalKey key = key_of(views[i], placement);
            OrderCache& orders = sequences_.orders();
            orders.advance(cells, key, orders.work(cells, key) * to / all);
        } else {
            sequences_.find(
                sequence_wanted(views[i], placement, cells, footprint, layer.blended, appearance),
                to, all);
        }
    }
    return drawing;
}

std::vector<CellPass::Layer> CellPass::layers_of(const CellBuffers& cells, Footprint footprint,
                                                 const CellAppearance& appearance) {
    if (!has_layers(footprint))
        return {{.surfaces = ~0, .blended = footprint == Footprint::gaussian}};
    const std::size_t shown = cells.shown() ? cells.shown()->surfaces.size() : index::kMostSurfaces;
    Layer opaque, translucent{.blended = true};
    for (std::size_t i = 0; i < std::min(shown, index::kMostSurfaces); ++i)
        (is_translucent(appearance.surfaces[i]) ? translucent : opaque).surfaces |= 1 << i;
    std::vector<Layer> layers{opaque, translucent};
    std::erase_if(layers, [](const Layer& layer) { return layer.surfaces == 0; });
    return layers;
}

void CellPass::draw_at_once(std::span<const View> views, const Placement& placement,
                            const CellBuffers& cells, Footprint footprint, const Layer& layer,
                            const CellAppearance& appearance, DrawPart part) {
    part = put_in_order(views, placement, cells, footprint, layer, appearance, part);
    if (part.count == 0)
        return;
    const bool blended = layer.blended, in_windows = comes_in_windows(footprint, blended);
    if (in_windows)
        corners_.show(cells, part);
    FrameBlock frame = frame_of(appearance, shapes_, footprint, layer.surfaces, blended, placement,
                                cells.surroundings(), cells.slots().largest > 0);
    CellSequence sequence{.cells = cells.size()};
    for (std::size_t i = 0; i < views.size(); ++i) {
        frame.eyes[i] = eye_block(views[i], placement, appearance);
        set_viewport(*gl_, views[i], static_cast<GLuint>(i));
        if (is_ordered(footprint, blended) && footprint != Footprint::mesh) // which sorts triangles
            sequence = sequences_.find(
                sequence_wanted(views[i], placement, cells, footprint, blended, appearance));
        // The shader needs a texture of this type bound even if it reads no sequence.
        gl_->BindTextureUnit(static_cast<GLuint>(1 + i),
                             sequence.texture != 0 ? sequence.texture : cells.texture());
    }
    if (views.size() == 1)
        gl_->BindTextureUnit(2, cells.texture());
    if (is_ordered(footprint, blended) && !has_layers(footprint))
        sequence = sequence.part(part.first, part.first + part.count, cells.size());
    frame.order_begin = in_windows ? static_cast<std::int32_t>(part.first) : sequence.begin;
    frame.order_step = sequence.step;
    // Meshes have a color of their own in each pixel: the target converts these faster to display
    // values than the shader.
    if (footprint == Footprint::mesh && !blended)
        frame.linear_light = 1;
    gl_->NamedBufferData(frame_.name(), sizeof(frame), &frame, GL_STREAM_DRAW);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_.name());
    gl_->BindTextureUnit(0, cells.texture());
    gl_->BindTextureUnit(kSurroundingsUnit, cells.surroundings().texture());
    cells.axes().bind();
    if (appearance.values)
        gl_->BindTextureUnit(kColorMapUnit, appearance.values->map);
    // Without linear light the shader writes display values, which the target must not convert.
    if (!frame.linear_light)
        gl_->Disable(GL_FRAMEBUFFER_SRGB);

    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    gl_->DepthMask(blended ? GL_FALSE : GL_TRUE);
    gl_->Disable(GL_CULL_FACE); // a mirrored volume reverses the winding of every quad
    if (blended) {
        blend_over(*gl_);
    } else {
        gl_->Disable(GL_BLEND);
    }
    if (in_windows)
        surface_.draw(quads_, corners_.values_texture(), corners_.gradients_texture(), false,
                      views.size(), {0, part.count});
    else if (footprint == Footprint::surface)
        surface_.draw(quads_, cells.corner_values_texture(), cells.corner_gradients_texture(), true,
                      views.size(), part);
    else if (footprint == Footprint::mesh)
        draw_mesh(views.front(), placement, cells, layer, appearance, frame, part);
    else
        draw_footprints(sequence.cells, static_cast<int>(views.size()), footprint,
                        form_of(views, placement, footprint, cells));
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
    gl_->Disable(GL_BLEND);
    gl_->DepthMask(GL_TRUE);
    gl_->UseProgram(0);
}

CellPass::Form CellPass::form_of(std::span<const View> views, const Placement& placement,
                                 Footprint footprint, const CellBuffers& cells) const {
    const bool cut = footprint == Footprint::quad && shapes_.shape == CellShape::plane;
    const float size = static_cast<float>(std::max(cells.slots().largest, 1u));
    // Ellipsoids and parts of planes may be beside their cells' middles.
    const float radius = shapes_.radius_of(footprint) * size * (cut ? kMostOfCut : 1.0f);
    const float reach = cut                                 ? 1.0f / kMostOfCut
                        : shapes_.shape == CellShape::plane ? 1.0f + kFarthestPlane / radius
                        : footprint == Footprint::quad      ? kReachOfRectangle
                                                            : 1.0f;
    const bool square = footprint == Footprint::quad && !cut;
    Form form = square ? Form::squares : Form::points;
    for (const View& view : views) {
        if (!points_serve(view, placement, radius, reach, largest_point_))
            return Form::quads;
        if (square && !footprints_are_squares(view, placement, radius))
            form = Form::points;
    }
    return form;
}

SequenceWanted CellPass::sequence_wanted(const View& view, const Placement& placement,
                                         const CellBuffers& cells, Footprint footprint,
                                         bool blended, const CellAppearance& appearance) const {
    // Splats are not culled in linear light: there, even a contribution below a step of the
    // display's values shows in dark places.
    const bool leaves_out =
        seen_only_ && !all_cells_ && !has_layers(footprint) &&
        !(blended && appearance.linear_light) && hides_what_is_behind(appearance, placement) &&
        (shapes_.shape == CellShape::voxel || cells.slots().planes.size() == cells.size());
    const SplatShape shape{shapes_.shape, shapes_.radius_of(footprint),
                           footprint == Footprint::quad};
    return {view, placement, cells, shape, gaussian_falloff(), blended, leaves_out};
}

/// The largest voxel that can be in a view.
CellPass::VoxelInView CellPass::largest_voxel(const View& view, const Placement& placement,
                                              const CellBuffers& cells) {
    const glm::vec3 spacing = placement.spacing() * cells.axes().largest();
    const float voxel = std::max({spacing.x, spacing.y, spacing.z});
    const glm::vec2 scale = 0.5f * glm::vec2(view.size) *
                            glm::vec2(glm::length(glm::vec3(view.clip_from_eye[0])),
                                      glm::length(glm::vec3(view.clip_from_eye[1])));
    const float at_one_meter = voxel * std::max(scale.x, scale.y);
    if (view.is_parallel())
        return {at_one_meter, 0.0f};
    const glm::vec3 eye(glm::inverse(placement.room_from_index) *
                        glm::vec4(view.eye_in_room(), 1.0f));
    const glm::vec3 beside = eye - glm::clamp(eye, glm::vec3(0.0f), placement.extent);
    const float distance = glm::length(glm::mat3(placement.room_from_index) * beside);
    return {at_one_meter / distance, voxel / distance}; // infinite from within
}

void CellPass::draw_mesh(const View& view, const Placement& placement, const CellBuffers& cells,
                         const Layer& layer, const CellAppearance& appearance,
                         const FrameBlock& frame, DrawPart part) {
    CellAppearance opaque = appearance;
    for (SurfaceAppearance& surface : opaque.surfaces)
        surface.opacity = 1.0f;
    const VoxelInView largest = largest_voxel(view, placement, cells);
    constexpr float kFewPixels = 8.0f; // so that light within a triangle is seen to be straight
    // Highlights are off by at most 2 % if the ways from a triangle to the eye are those in between
    // the ways from its vertices.
    constexpr float kEven = 0.05f, kLeastShininess = 4.0f; // see mesh.frag
    const bool even = largest.angle * largest.angle * appearance.shininess <= kEven &&
                      appearance.shininess >= kLeastShininess;
    const bool small = largest.pixels <= kFewPixels;
    const MeshPass::Look look{.surfaces = layer.surfaces,
                              .colors = frame.surfaces,
                              .colored = appearance.values.has_value(),
                              .near = !hides_what_is_behind(opaque, placement) || (!small && !even),
                              .small = small};
    if (layer.blended)
        mesh_.draw_blended(cells, look,
                           sequences_.orders()
                               .order(cells, key_of(view, placement))
                               .subspan(part.first, part.count));
    else
        mesh_.draw(
            cells, look,
            near_planes_first(frame.eyes[0].eye_in_index, placement.extent, placement.spacing()),
            part);
}

void CellPass::draw_footprints(std::size_t cells, int views, Footprint footprint, Form form) {
    const FootprintPrograms& of_footprint =
        footprint == Footprint::gaussian ? gaussian_programs_ : quad_programs_;
    const Programs& programs = form == Form::squares  ? *of_footprint.squares
                               : form == Form::points ? of_footprint.points
                                                      : of_footprint.quads;
    gl_->UseProgram((views == 2 ? *programs.two : programs.one).name());
    if (form == Form::quads) {
        quads_.draw(cells, views);
        return;
    }
    gl_->Enable(GL_PROGRAM_POINT_SIZE);
    quads_.draw_points(cells, views);
}

} // namespace isochron::render
