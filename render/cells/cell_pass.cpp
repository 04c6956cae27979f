// The uniforms and GL state of a draw of cells.
#include "render/cells/cell_pass.h"

#include "render/cells/point_sprites.h"
#include "render/gl/driver.h"
#include "render/gl/driver_trials.h"
#include "render/gl/limits.h"
#include "render/gl/shader.h"
#include "render/gl/soft_edges.h"
#include "render/gl/srgb.h"
#include "render/gl/viewport.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace isochron::render {

namespace {

/// The uniform block of frame.glsl, in std140 layout.
struct EyeBlock {
    glm::mat4 rows;
    glm::vec4 ray_right, ray_up, ray_ahead;
    glm::mat4 eye_from_index;
    glm::mat4 eye_from_physical;
    glm::vec4 eye_in_index;
    glm::vec4 clip_per_pixel;
    glm::vec4 viewport;
    glm::vec4 depth_cue;
    glm::vec4 key_light;
    glm::vec4 up;
    glm::vec4 between_eyes;
    glm::vec4 cut;
};
struct Frame {
    std::array<EyeBlock, 2> eyes;
    std::array<glm::vec4, index::kMostSurfaces> surfaces;
    glm::vec4 no_value;
    glm::vec4 light;
    glm::vec4 material;
    glm::vec4 near_fade;
    glm::vec2 color_range;
    std::int32_t colored;
    std::int32_t linear_light;
    float radius;
    std::int32_t order_begin;
    std::int32_t order_step;
    std::int32_t blended;
    std::int32_t drawn_surfaces;
    std::int32_t soft_near_eye;
    glm::vec2 padding{0.0f};
    std::array<glm::vec4, 3> index_from_normal; ///< rows
};
static_assert(sizeof(Frame) == 2 * (3 * 64 + 11 * 16) + (index::kMostSurfaces + 10) * 16);
static_assert(sizeof(Frame) <= kUniformBlockBytes);
constexpr GLuint kColorMapUnit = 7; ///< of appearance.glsl

/// The depth cue runs from the near to the far end of the volume's bounding sphere.
glm::vec4 depth_cue(const glm::mat4& eye_from_index, const glm::vec3& extent, float strength) {
    const glm::vec3 center(eye_from_index * glm::vec4(0.5f * extent, 1.0f));
    float radius = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 unit(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::vec3 at(eye_from_index * glm::vec4(extent * unit, 1.0f));
        radius = std::max(radius, glm::length(at - center));
    }
    const float near = std::max(glm::length(center) - radius, 0.0f);
    const float far = glm::length(center) + radius;
    return {near, 1.0f / std::max(far - near, 1e-6f), strength, 0.0f};
}

/// w = 0 where the view is parallel: the direction towards the eye.
glm::vec4 eye_in_index(const View& view, const Placement& placement) {
    return glm::inverse(view.eye_from_room * placement.room_from_index) *
           (view.is_parallel() ? glm::vec4(0, 0, 1, 0) : glm::vec4(0, 0, 0, 1));
}

EyeBlock eye_block(const View& view, const Placement& placement, const CellAppearance& appearance) {
    const glm::mat3 eye_from_room(view.eye_from_room);
    const glm::mat4 eye_from_index = view.eye_from_room * placement.room_from_index;
    const bool parallel = view.is_parallel();
    const glm::vec2 half_size = 0.5f * glm::vec2(view.size);
    glm::mat4 pixel_from_clip(1.0f);
    pixel_from_clip[0][0] = half_size.x;
    pixel_from_clip[1][1] = half_size.y;
    const glm::mat4 pixel_from_index = pixel_from_clip * view.clip_from_eye * eye_from_index;
    const glm::dmat4 index_from_pixel = glm::inverse(glm::dmat4(pixel_from_index));
    // A pixel's ray is the points (x w, y w, z, w), z being linear in w.
    const glm::dmat4 clip(view.clip_from_eye);
    const double ahead_z = parallel ? 1.0 : clip[2][2] / clip[2][3];
    const glm::dvec4 ahead = index_from_pixel * glm::dvec4(0, 0, ahead_z, parallel ? 0.0 : 1.0);
    return {
        .rows = glm::transpose(pixel_from_index),
        .ray_right = glm::vec4(index_from_pixel[0]),
        .ray_up = glm::vec4(index_from_pixel[1]),
        .ray_ahead = glm::vec4(glm::dvec4(glm::dvec3(ahead), ahead_z)),
        .eye_from_index = eye_from_index,
        .eye_from_physical =
            glm::mat4(glm::mat3(view.eye_from_room) * placement.room_from_physical),
        .eye_in_index = eye_in_index(view, placement),
        .clip_per_pixel = glm::vec4(1.0f / half_size, 0.0f, 0.0f),
        .viewport = glm::vec4(view.corner, view.size),
        .depth_cue = depth_cue(eye_from_index, placement.extent, appearance.depth_cue),
        .key_light = glm::vec4(glm::normalize(eye_from_room * appearance.key_direction), 0.0f),
        .up = glm::vec4(eye_from_room * glm::vec3(0, 1, 0), 0.0f),
        .between_eyes =
            appearance.near_fade
                ? view.eye_from_room * glm::vec4(appearance.near_fade->between_eyes, 1.0f)
                : glm::vec4(0.0f),
        .cut = appearance.cut ? *appearance.cut * glm::inverse(view.eye_from_room)
                              : glm::vec4(0.0f, 0.0f, 0.0f, -1.0f),
    };
}

/// @param spacing of the voxels in the room [m]
glm::vec4 near_fade_of(const NearFade& fade, const glm::vec3& spacing) {
    constexpr float kGrain = 0.0012f; // [m]: from 0.2 m a third of a degree
    const float voxel = std::cbrt(spacing.x * spacing.y * spacing.z);
    return {fade.gone, 1.0f / std::max(fade.whole - fade.gone, 1e-4f),
            std::clamp(voxel / kGrain, 1.0f, 1024.0f), 0.0f};
}

bool is_translucent(const SurfaceAppearance& surface) {
    return surface.opacity < 1.0f;
}

/// Whether all quads are drawn whole: none is left out, which others would be seen through.
bool hides_what_is_behind(const CellAppearance& look, const Placement& placement) {
    if (look.cut || std::ranges::any_of(look.surfaces, is_translucent))
        return false;
    if (!look.near_fade)
        return true;
    const glm::vec3 eyes(glm::inverse(placement.room_from_index) *
                         glm::vec4(look.near_fade->between_eyes, 1.0f));
    const glm::vec3 beside = eyes - glm::clamp(eyes, glm::vec3(0.0f), placement.extent);
    return glm::length(glm::mat3(placement.room_from_index) * beside) > look.near_fade->whole;
}

/// The part of the block that is the same for every eye.
Frame frame_of(const CellAppearance& look, const FootprintShapes& shapes, Footprint footprint,
               std::int32_t surfaces, bool blended, const Placement& placement) {
    const bool gaussian = footprint == Footprint::gaussian;
    Frame frame{
        .eyes = {},
        .surfaces = {},
        .no_value = {},
        .light = {look.ambient, look.head_light, look.key_light, 0.0f},
        .material = {look.reflectance, look.shininess, look.ground, look.outline},
        .near_fade = {-1.0f, 1.0f, 0.0f, 0.0f}, // all is whole at any distance
        .color_range = {},
        .colored = look.values.has_value(),
        .linear_light = blended && look.linear_light,
        .radius = shapes.radius_of(footprint),
        .order_begin = 0,
        .order_step = 0,
        .blended = blended,
        .drawn_surfaces = surfaces,
        .soft_near_eye = gaussian,
        .index_from_normal = {},
    };
    const glm::mat3 rows = glm::transpose(placement.index_from_normal());
    for (int i = 0; i < 3; ++i)
        frame.index_from_normal[static_cast<std::size_t>(i)] = glm::vec4(rows[i], 0.0f);
    for (std::size_t i = 0; i < index::kMostSurfaces; ++i) {
        const auto& [color, opacity] = look.surfaces[i];
        frame.surfaces[i] = glm::vec4(linear_from_srgb(color),
                                      gaussian ? splat_opacity(opacity, shapes.sigma()) : opacity);
    }
    if (look.values) {
        const float width = std::max(look.values->high - look.values->low, 1e-6f);
        frame.no_value = glm::vec4(linear_from_srgb(look.values->no_value), 1.0f);
        frame.color_range = {1.0f / width, -look.values->low / width};
    }
    return frame;
}

} // namespace

const char* name_of(CellShape shape) {
    return shape == CellShape::plane ? "plane" : "voxel";
}

float FootprintShapes::radius_of(Footprint footprint) const {
    const bool gaussian = footprint == Footprint::gaussian;
    if (shape == CellShape::plane)
        return gaussian ? plane_gaussian_radius : plane_radius;
    return 0.5f * (gaussian ? gaussian_diameter : quad_diameter);
}

const char* name_of(Footprint footprint) {
    switch (footprint) {
    case Footprint::quad: return "quad";
    case Footprint::gaussian: return "gaussian";
    case Footprint::surface: break;
    }
    return "surface";
}

CellPass::Programs CellPass::programs(std::string_view fragment_shader,
                                      const std::string& prelude) const {
    const std::vector sources{shader_file("cell.vert"), shader_file(fragment_shader)};
    Programs programs{link_program(*gl_, sources, prelude), std::nullopt};
    if (two_views_at_once_)
        programs.two = link_program(*gl_, sources, std::string(kTwoEyes) + prelude);
    return programs;
}

CellPass::FootprintPrograms CellPass::footprint_programs(std::string_view fragment_shader,
                                                         bool round) const {
    const std::string prelude =
        std::string(shapes_.shape == CellShape::plane ? "#define PLANE\n" : "") +
        (round ? "#define ROUND\n" : "");
    return {programs(fragment_shader, prelude),
            programs(fragment_shader, prelude + "#define POINTS\n"), std::nullopt};
}

CellPass::CellPass(const Gl& gl, const FootprintShapes& shapes)
    : gl_(&gl), shapes_(shapes), two_views_at_once_(draws_to_two_viewports(gl)),
      seen_only_(takes_processor_ways(gl)), largest_point_(Limits(gl).largest_point),
      quad_programs_(footprint_programs("cell_quad.frag", is_round(Footprint::quad))),
      gaussian_programs_(footprint_programs("cell_gaussian.frag", is_round(Footprint::gaussian))),
      surface_(gl, two_views_at_once_), quads_(gl), orders_(gl), seen_slots_(gl),
      seen_texture_(gl, GL_TEXTURE_BUFFER), frame_(gl) {
    if (shapes.shape == CellShape::voxel)
        quad_programs_.squares = programs("cell_quad.frag", "#define POINTS\n#define SQUARE\n");
    const float falloff = gaussian_falloff();
    for (const Programs* programs : {&gaussian_programs_.quads, &gaussian_programs_.points}) {
        gl.ProgramUniform1f(programs->one.name(), 0, falloff);
        if (programs->two)
            gl.ProgramUniform1f(programs->two->name(), 0, falloff);
    }
}

bool CellPass::is_round(Footprint footprint) const {
    return footprint == Footprint::gaussian || shapes_.shape == CellShape::plane;
}

/// log2 of a splat's opacity on its outline, where it is 1 in the middle.
float CellPass::gaussian_falloff() const {
    const float sigmas = shapes_.radius_of(Footprint::gaussian) / shapes_.sigma();
    return -0.5f * sigmas * sigmas * std::numbers::log2e_v<float>;
}

void CellPass::draw(std::span<const View> views, const Placement& placement,
                    const CellBuffers& cells, Footprint footprint,
                    const CellAppearance& appearance) {
    if (cells.size() == 0)
        return;
    const bool apart = !two_views_at_once_ || (footprint != Footprint::surface && seen_only_);
    const std::size_t at_once = apart ? 1 : 2;
    for (const Layer& layer : layers_of(cells, footprint, appearance))
        for (std::size_t first = 0; first < views.size(); first += at_once)
            draw_at_once(views.subspan(first, std::min(at_once, views.size() - first)), placement,
                         cells, footprint, layer, appearance);
}

std::vector<CellPass::Layer> CellPass::layers_of(const CellBuffers& cells, Footprint footprint,
                                                 const CellAppearance& appearance) {
    if (footprint != Footprint::surface)
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
                            const CellAppearance& appearance) {
    const bool blended = layer.blended;
    Frame frame = frame_of(appearance, shapes_, footprint, layer.surfaces, blended, placement);
    if (appearance.near_fade)
        frame.near_fade = near_fade_of(*appearance.near_fade, placement.spacing());
    Sequence sequence;
    for (std::size_t i = 0; i < views.size(); ++i) {
        frame.eyes[i] = eye_block(views[i], placement, appearance);
        set_viewport(*gl_, views[i], static_cast<GLuint>(i));
        sequence = sequence_of(views[i], placement, cells, footprint, blended, appearance);
        // A shader that may read a sequence needs one of its type bound, also where it reads none.
        gl_->BindTextureUnit(static_cast<GLuint>(1 + i),
                             sequence.texture != 0 ? sequence.texture : cells.texture());
    }
    if (views.size() == 1)
        gl_->BindTextureUnit(2, cells.texture());
    frame.order_begin = sequence.begin;
    frame.order_step = sequence.step;
    gl_->NamedBufferData(frame_.name(), sizeof(frame), &frame, GL_STREAM_DRAW);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_.name());
    gl_->BindTextureUnit(0, cells.texture());
    if (appearance.values)
        gl_->BindTextureUnit(kColorMapUnit, appearance.values->map);
    // Display values go into the target as they are.
    if (!frame.linear_light)
        gl_->Disable(GL_FRAMEBUFFER_SRGB);

    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    gl_->DepthMask(blended ? GL_FALSE : GL_TRUE);
    gl_->Disable(GL_CULL_FACE); // a mirrored volume turns every quad over
    if (blended) {
        blend_over(*gl_);
    } else {
        gl_->Disable(GL_BLEND);
    }
    if (footprint == Footprint::surface)
        surface_.draw(quads_, cells, blended, views.size());
    else
        draw_footprints(sequence.cells, static_cast<int>(views.size()), footprint,
                        form_of(views, placement, footprint));
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
    gl_->Disable(GL_BLEND);
    gl_->DepthMask(GL_TRUE);
    gl_->UseProgram(0);
}

CellPass::Form CellPass::form_of(std::span<const View> views, const Placement& placement,
                                 Footprint footprint) const {
    const bool flat = shapes_.shape == CellShape::plane;
    // Ellipsoids on planes lie up to a cell's half diagonal beside the cell's middle.
    const float radius = shapes_.radius_of(footprint);
    const float reach = flat                           ? 1.0f + kFarthestPlane / radius
                        : footprint == Footprint::quad ? kReachOfRectangle
                                                       : 1.0f;
    Form form = is_round(footprint) ? Form::points : Form::squares;
    for (const View& view : views) {
        if (!points_serve(view, placement, radius, reach, largest_point_))
            return Form::quads;
        if (!is_round(footprint) && !footprints_are_squares(view, placement, radius))
            form = Form::points;
    }
    return form;
}

CellPass::Sequence CellPass::sequence_of(const View& view, const Placement& placement,
                                         const CellBuffers& cells, Footprint footprint,
                                         bool blended, const CellAppearance& appearance) {
    const auto all = static_cast<int>(cells.size());
    const bool nearest_first = seen_only_ && footprint == Footprint::quad;
    if (!blended && !nearest_first)
        return {.cells = cells.size()};
    const glm::vec4 eye = eye_in_index(view, placement);
    const TraversalKey key = traversal_key(eye, glm::ivec3(placement.extent), placement.spacing());
    // In linear light less than a step of the display's values shows where these are dark.
    const bool leaves_out =
        seen_only_ && !all_cells_ && footprint != Footprint::surface &&
        !(blended && appearance.linear_light) && hides_what_is_behind(appearance, placement) &&
        (shapes_.shape == CellShape::voxel || cells.slots().planes.size() == cells.size());
    if (!leaves_out)
        return blended ? Sequence{cells.size(), orders_.texture(cells, key), 0, 1}
                       : Sequence{cells.size(), orders_.texture(cells, key), all - 1, -1};
    const std::span<const std::uint32_t> order = orders_.order(cells, key);
    const SplatShape shape{shapes_.shape, shapes_.radius_of(footprint)};
    const std::span<const std::uint32_t> seen =
        blended
            ? seen_splats_.find(view, placement, shape, gaussian_falloff(), cells.slots(), order)
            : seen_.find(view, placement, shape, cells.slots(), order);
    gl_->NamedBufferData(seen_slots_.name(), static_cast<GLsizeiptr>(seen.size_bytes()),
                         seen.data(), GL_STREAM_DRAW);
    gl_->TextureBuffer(seen_texture_.name(), GL_R32UI, seen_slots_.name());
    return {seen.size(), seen_texture_.name(), 0, 1};
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
