// The uniforms and GL state of a draw of cells.
#include "render/drawing/cell_pass.h"

#include "render/cells/point_sprites.h"
#include "render/drawing/mesh_look.h"
#include "render/gl/driver.h"
#include "render/gl/driver_trials.h"
#include "render/gl/gl_memory.h"
#include "render/gl/limits.h"
#include "render/gl/soft_edges.h"
#include "render/gl/viewport.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace isochron::render {
namespace {

constexpr GLuint kColorMapUnit = 7;     ///< texture unit of appearance.glsl
constexpr GLuint kSurroundingsUnit = 9; ///< texture unit of surroundings.glsl

/// Whether only as many cells are drawn at once as a window of corners holds.
bool comes_in_windows(Footprint footprint, bool blended) {
    return footprint == Footprint::surface && !blended;
}

/// Cells that are put in order in about the time in which one is drawn.
std::size_t ordered_with_one(Footprint footprint, bool blended) {
    constexpr std::size_t kSorted = 128; // an opaque surface's are only sorted
    return comes_in_windows(footprint, blended) ? kSorted : 8;
}

std::size_t ordering_work(const CellBuffers& cells, Footprint footprint, bool blended) {
    const std::size_t together = ordered_with_one(footprint, blended);
    return (cells.size() + together - 1) / together;
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
    // Splats alone have a uniform that stays.
    const auto linked = [gl = gl_, falloff = gaussian_falloff(),
                         round = fragment_shader == "cell_gaussian.frag"](GLuint program) {
        if (round)
            gl->ProgramUniform1f(program, 0, falloff);
    };
    Programs programs{LazyProgram(*gl_, sources, all, linked), std::nullopt};
    if (two_views_at_once_)
        programs.two.emplace(*gl_, sources, std::string(kTwoEyes) + all, linked);
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
      two_views_at_once_(draws_to_two_viewports(gl)), seen_only_(is_drawn_for_processor(gl)),
      largest_point_(Limits(gl).largest_point),
      quad_programs_(footprint_programs("cell_quad.frag", Footprint::quad)),
      gaussian_programs_(footprint_programs("cell_gaussian.frag", Footprint::gaussian)),
      mesh_(gl, grid_prelude), surface_(gl, two_views_at_once_, grid_prelude), corners_(gl),
      in_sight_(gl), quads_(gl), sequences_(gl), frame_(gl), no_colors_(gl, GL_TEXTURE_1D) {
    gl.NamedBufferData(frame_.name(), sizeof(FrameBlock), nullptr, GL_STREAM_DRAW);
    expect_memory(gl, "constants of cells"); // drivers crash where a block has no memory
    gl.TextureStorage1D(no_colors_.name(), 1, GL_RGB16F, 1);
    gl.TextureParameteri(no_colors_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TextureParameteri(no_colors_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TextureParameteri(no_colors_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    if (shapes.shape == CellShape::voxel)
        quad_programs_.squares = programs("cell_quad.frag", "#define POINTS\n#define SQUARE\n");
}

/// log2 of a splat's opacity on its outline, relative to its middle.
float CellPass::gaussian_falloff() const {
    const float sigmas = shapes_.radius_of(Footprint::gaussian) / shapes_.sigma();
    return -0.5f * sigmas * sigmas * std::numbers::log2e_v<float>;
}

std::size_t CellPass::draw(std::span<const View> views, const Placement& placement,
                           const CellBuffers& cells, Footprint footprint,
                           const CellAppearance& appearance, DrawPart part) {
    if (cells.size() == 0)
        return 0;
    assert(footprint != Footprint::mesh || cells.has_mesh(appearance.mesh_level));
    std::size_t before = 0, end = part.first;
    for (const Layer& layer : layers_of(cells, footprint, appearance)) {
        const std::size_t at_once = views_at_once(footprint);
        const std::size_t work = work_of(cells, footprint, layer, appearance.mesh_level);
        const bool in_windows = comes_in_windows(footprint, layer.blended);
        for (std::size_t first = 0; first < views.size(); first += at_once, before += work) {
            const Drawing drawing{views.subspan(first, std::min(at_once, views.size() - first)),
                                  placement,
                                  cells,
                                  footprint,
                                  layer,
                                  appearance};
            const DrawPart mine = part.among(before, work);
            if (mine.count == 0)
                continue;
            end = before + mine.first + mine.count;
            if (in_windows && seen_only_)
                end = before + draw_in_sight(drawing, mine);
            else
                for_each_piece(mine, in_windows ? corners_.most() : work,
                               [&](const DrawPart& piece) { draw_at_once(drawing, piece); });
        }
    }
    return end - part.first;
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
        work += (views + at_once - 1) / at_once *
                work_of(cells, footprint, layer, appearance.mesh_level);
    }
    return cells.size() == 0 ? 0 : work;
}

std::size_t CellPass::views_at_once(Footprint footprint) const {
    const bool apart = !two_views_at_once_ || footprint == Footprint::mesh ||
                       (!has_layers(footprint) && seen_only_);
    return apart ? 1 : 2;
}

/// Whether the order of cells needs no texture: cells in sight are ordered window by window, and
/// meshes by their triangles.
bool CellPass::wants_order_only(Footprint footprint, bool blended) {
    return footprint == Footprint::mesh || comes_in_windows(footprint, blended);
}

bool CellPass::is_ordered(Footprint footprint, bool blended, std::size_t mesh_level) const {
    if (footprint == Footprint::mesh)
        return blended && mesh_level == 0;
    return blended ||
           (seen_only_ && (footprint == Footprint::quad || footprint == Footprint::surface));
}

std::size_t CellPass::work_of(const CellBuffers& cells, Footprint footprint, const Layer& layer,
                              std::size_t mesh_level) const {
    if (is_ordered(footprint, layer.blended, mesh_level))
        return ordering_work(cells, footprint, layer.blended) + cells.size();
    if (!has_layers(footprint))
        return 1;
    return footprint == Footprint::mesh ? MeshPass::triangles(cells, mesh_level, layer.surfaces)
                                        : cells.size();
}

DrawPart CellPass::put_in_order(const Drawing& drawing, DrawPart part) {
    const auto& [views, placement, cells, footprint, layer, appearance] = drawing;
    if (!is_ordered(footprint, layer.blended, appearance.mesh_level))
        return part;
    const std::size_t all = ordering_work(cells, footprint, layer.blended);
    const DrawPart ordering = part.among(0, all), left = part.among(all, cells.size());
    const std::size_t done = (ordering.first + ordering.count) * views.size();
    for (std::size_t i = 0; left.count == 0 && i < views.size(); ++i) { // one after the other
        if (done <= i * all)
            break;
        const std::size_t to = std::min(done - i * all, all);
        if (wants_order_only(footprint, layer.blended)) {
            const TraversalKey key = key_of(views[i], placement);
            OrderCache& orders = sequences_.orders();
            orders.advance(cells, key, orders.work(cells, key) * to / all);
        } else {
            sequences_.find(sequence_wanted(drawing, i), to, all);
        }
    }
    return left;
}

std::vector<CellPass::Layer> CellPass::layers_of(const CellBuffers& cells, Footprint footprint,
                                                 const CellAppearance& appearance) {
    if (!has_layers(footprint))
        return {{.surfaces = ~0, .blended = footprint == Footprint::gaussian}};
    const std::size_t shown = cells.shown() ? cells.shown()->surfaces.size() : index::kMostSurfaces;
    Layer opaque, translucent{.blended = true};
    for (std::size_t i = 0; i < std::min(shown, index::kMostSurfaces); ++i)
        if ((appearance.drawn >> i & 1) != 0)
            (is_translucent(appearance.surfaces[i]) ? translucent : opaque).surfaces |= 1 << i;
    std::vector<Layer> layers{opaque, translucent};
    std::erase_if(layers, [](const Layer& layer) { return layer.surfaces == 0; });
    return layers;
}

void CellPass::draw_at_once(const Drawing& drawing, DrawPart part) {
    const auto& [views, placement, cells, footprint, layer, appearance] = drawing;
    part = put_in_order(drawing, part);
    if (part.count == 0)
        return;
    if (comes_in_windows(footprint, layer.blended)) {
        corners_.show(cells, part);
        const CellSequence window{part.count, 0, static_cast<int>(part.first), 0};
        return draw_cells(drawing, {window, window}, {0, part.count}, false);
    }
    std::array<CellSequence, 2> sequences;
    sequences.fill({.cells = cells.size()});
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (!is_ordered(footprint, layer.blended, appearance.mesh_level) ||
            wants_order_only(footprint, layer.blended))
            break;
        sequences[i] = sequences_.find(sequence_wanted(drawing, i));
        if (!has_layers(footprint))
            sequences[i] = sequences[i].part(part.first, part.first + part.count, cells.size());
    }
    draw_cells(drawing, sequences, part, true);
}

/// Draws an opaque surface, nearest cells first, without those that nearer ones hide.
/// @return the work that is done then
std::size_t CellPass::draw_in_sight(const Drawing& drawing, DrawPart part) {
    const CellBuffers& cells = drawing.cells;
    Drawing first = drawing; // whose order serves for both
    first.views = drawing.views.first(1);
    const std::size_t end = part.first + part.count;
    part = put_in_order(first, part);
    if (part.count == 0)
        return end;
    const std::span<const std::uint32_t> order =
        sequences_.orders().order(cells, key_of(first.views[0], drawing.placement));
    in_sight_.begin({drawing.views, drawing.placement, cells, drawing.layer.surfaces, all_cells_},
                    part.first);
    const bool few = cells.size() <= corners_.most();
    auto effort = static_cast<double>(part.count);
    while (effort > 0 && in_sight_.passed() < order.size()) {
        const std::size_t found = in_sight_.next(order, corners_.most(), effort).size();
        if (found == 0)
            continue;
        if (few)
            corners_.show(cells, {0, cells.size()}); // computed once for the set
        else
            corners_.show(cells, in_sight_.buffer(), found);
        const CellSequence sequence{found, in_sight_.texture(), 0, 1};
        draw_cells(drawing, {sequence, sequence}, {0, found}, few);
    }
    return ordering_work(cells, drawing.footprint, false) + in_sight_.passed();
}

void CellPass::draw_cells(const Drawing& drawing, const std::array<CellSequence, 2>& sequences,
                          DrawPart part, bool corners_by_slot) {
    const auto& [views, placement, cells, footprint, layer, appearance] = drawing;
    const bool blended = layer.blended;
    FrameBlock frame = frame_of(appearance, shapes_, footprint, layer.surfaces, blended, placement,
                                cells.surroundings(), cells.slots().largest > 0);
    for (std::size_t i = 0; i < views.size(); ++i) {
        frame.eyes[i] = eye_block(views[i], placement, appearance);
        set_viewport(*gl_, views[i], static_cast<GLuint>(i));
    }
    // The shader needs a texture of this type bound even if it reads no sequence.
    for (std::size_t i = 0; i < sequences.size(); ++i)
        gl_->BindTextureUnit(static_cast<GLuint>(1 + i),
                             sequences[i].texture != 0 ? sequences[i].texture : cells.texture());
    frame.order_begin = sequences[0].begin;
    frame.order_step = sequences[0].step;
    frame.corners_by_slot = corners_by_slot;
    // A mesh has another color in each pixel, which the target converts faster than the shader.
    if (footprint == Footprint::mesh && !blended)
        frame.linear_light = 1;
    gl_->NamedBufferData(frame_.name(), sizeof(frame), &frame, GL_STREAM_DRAW);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_.name());
    gl_->BindTextureUnit(0, cells.texture());
    gl_->BindTextureUnit(kSurroundingsUnit, cells.surroundings().texture());
    cells.axes().bind();
    // For no map there is a texture of the same kind: llvmpipe would compile for another kind.
    gl_->BindTextureUnit(kColorMapUnit,
                         appearance.values ? appearance.values->map : no_colors_.name());
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
    if (footprint == Footprint::surface)
        surface_.draw(quads_, corners_of(drawing), blended, views.size(), part);
    else if (footprint == Footprint::mesh)
        draw_mesh(drawing, frame, part);
    else
        draw_footprints(sequences[0].cells, static_cast<int>(views.size()), footprint,
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
        if (!points_ || !points_serve(view, placement, radius, reach, largest_point_))
            return Form::quads;
        if (square && !footprints_are_squares(view, placement, radius))
            form = Form::points;
    }
    return form;
}

SequenceWanted CellPass::sequence_wanted(const Drawing& drawing, std::size_t eye) const {
    const auto& [views, placement, cells, footprint, layer, appearance] = drawing;
    // Splats are not culled in linear light: there, even a contribution below a step of the
    // display's values shows in dark places.
    const bool leaves_out =
        seen_only_ && !all_cells_ && !has_layers(footprint) &&
        !(layer.blended && appearance.linear_light) &&
        hides_what_is_behind(appearance, placement) &&
        (shapes_.shape == CellShape::voxel || cells.slots().planes.size() == cells.size());
    const SplatShape shape{shapes_.shape, shapes_.radius_of(footprint),
                           footprint == Footprint::quad};
    return {views[eye], placement, cells, shape, gaussian_falloff(), layer.blended, leaves_out};
}

void CellPass::draw_mesh(const Drawing& drawing, const FrameBlock& frame, DrawPart part) {
    const auto& [views, placement, cells, footprint, layer, appearance] = drawing;
    const View& view = views.front();
    MeshLook look = mesh_look(view, placement, cells.axes(), appearance);
    look.surfaces = layer.surfaces;
    look.colors = frame.surfaces;
    const glm::mat4& eye = frame.eyes[0].eye_from_index;
    if (layer.blended && look.level > 0)
        mesh_.draw_blended(cells, look, -glm::vec4(eye[0].z, eye[1].z, eye[2].z, eye[3].z), part);
    else if (layer.blended)
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
