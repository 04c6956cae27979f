// Draws what the eyes see: the cells, the volume's box, the legend, the wand and the floor.
#include "app/scene/scene.h"

#include "app/scene/axis_labels.h"
#include "app/scene/caption.h"
#include "app/scene/font.h"
#include "app/scene/look.h"
#include "app/scene/mark.h"
#include "app/scene/orientation.h"
#include "interaction/navigation/navigation.h"
#include "render/gl/driver.h"
#include "render/gl/shader.h"
#include "render/gl/viewport.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <array>

namespace isochron::app {
namespace {

constexpr float kWandLength = 1.2f;             // meters
constexpr float kThin = 1.5f, kPointing = 2.5f; ///< [pixel] width of its ray
constexpr float kToolLine = 2.0f;               ///< [pixel]
/// Depth of what no cell hides: the first of it hides what is drawn after it.
constexpr double kOverCells = 1e-6;
constexpr glm::vec4 kBoxColor(0.45f, 0.50f, 0.56f, 0.55f);
constexpr glm::vec4 kBoxOnLight(0.25f, 0.28f, 0.32f, 0.8f);
constexpr glm::vec4 kWandColor(1.0f, 0.77f, 0.36f, 0.9f);
constexpr float kFontPixels = 32.0f; ///< height of rasterized glyphs, which are drawn smaller

bool blends_light(const render::Gl& gl, Blending blending) {
    return blending == Blending::automatic ? !render::draws_in_software(gl)
                                           : blending == Blending::linear;
}

} // namespace

Scene::Scene(const render::Gl& gl, const index::SeriesInfo& info, const Config& config)
    : gl_(gl), info_(info), upload_bytes_(std::size_t{1024} * config.upload_kilobytes_per_frame),
      mesh_room_(
          render::CellBuffers::wanted_shading(gl) == index::Shading::none ? 0 : config.mesh_room()),
      configured_(config.appearance), appearance_(configured_), cells_(gl, info.grid),
      cell_pass_(gl, {.shape = config.cell_shape}, render::prelude_for(info.grid)), line_pass_(gl),
      text_pass_(gl, room_font(kFontPixels)), panel_pass_(gl), background_pass_(gl),
      veil_pass_(gl) {
    appearance_.linear_light = blends_light(gl, config.blending);
    prepare_for(info);
}

void Scene::prepare_for(const index::SeriesInfo& array) {
    // The storage of values depends only on their type, not on their range.
    held_types_.push_back(index::BrickValues(array.type, array.scaling, 0, 1).held());
    cells_.prepare(held_types_.back());
}

void Scene::set_array(const index::SeriesInfo& array) {
    if (info_.array == array.array)
        return;
    info_.array = array.array;
    info_.value_unit = array.value_unit;
}

std::vector<std::string> Scene::given_up() const {
    std::vector<std::string> lines;
    if (!cell_pass_.draws_two_views_at_once() &&
        render::has_extension(gl_, render::kTwoEyesExtension))
        lines.emplace_back("draws do not reach two viewports, so eyes are drawn one by one");
    if (!cells_.has_fences())
        lines.emplace_back("fences are never passed, so uploads may wait for the GPU");
    return lines;
}

render::FootprintSet Scene::footprints() const {
    auto footprints = render::FootprintSet::up_to(render::Footprint::gaussian);
    if (drawn().has_mesh())
        footprints.add(render::Footprint::mesh);
    if (drawn().has_volume() && drawn().size() <= drawn().corner_limit())
        footprints.add(render::Footprint::surface);
    return footprints;
}

render::FootprintSet Scene::possible_footprints() const {
    render::FootprintSet possible = footprints();
    const index::ExtractionPtr& set = shown();
    const bool asked = set && set->query.mesh_room > 0;
    if (set && !asked && !set->coarse() && index::least_mesh_bytes(set->cells()) <= mesh_room_)
        possible.add(render::Footprint::mesh);
    return possible;
}

void Scene::look(const ExplorerState& state, const interaction::Pose& head,
                 const std::optional<ColorScale>& scale) {
    surfaces_ = state.isosurfaces;
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
        appearance_.surfaces[i] = {surfaces_[i].color, surfaces_[i].opacity};
    const auto same_colors = [](const ColorScale& a, const ColorScale& b) {
        return a.map == b.map && a.colors == b.colors && a.use == b.use;
    };
    if (scale && (!scale_ || !same_colors(*scale_, *scale)))
        map_.emplace(render::color_map_texture(gl_, colors_of(*scale)));
    scale_ = scale;
    appearance_.values.reset();
    if (scale) {
        const auto share = [&](double value) {
            const double half = scale->whole[1] / 2 - scale->whole[0] / 2;
            return half > 0 ? static_cast<float>((value / 2 - scale->whole[0] / 2) / half) : 0.0f;
        };
        appearance_.values = {.map = map_->name(),
                              .low = share(scale->range[0]),
                              .high = share(scale->range[1]),
                              .bands = scale->use.bands > 0};
        if (scale->logarithmic)
            appearance_.values->ratio = static_cast<float>(scale->range[1] / scale->range[0]);
    }
    set_look(appearance_, configured_, state.look);
    background_ = background_of(state.look);
    on_light_ = state.look.background == interaction::Background::light;
    mark_ = state.mark;
    box_ = state.bounding_box;
    axes_ =
        box_ ? axes_for(info_, render::Placement::of(info_.grid, matrix(state.room_from_physical)),
                        head)
             : Axes{};
    if (on_light_)
        darken(axes_);
}

void Scene::set_near_fade(const interaction::ComfortOptions& comfort,
                          std::span<const stereo::ViewerPose> viewers) {
    heads_.clear();
    appearance_.near_fade.reset();
    if (!(comfort.near_whole > 0))
        return;
    appearance_.near_fade = {.gone = comfort.near_gone, .whole = comfort.near_whole};
    for (const stereo::ViewerPose& viewer : viewers)
        heads_.push_back(viewer.head.position);
}

/// The head of the viewer whose eye this is: the nearest one, as eyes are closer than heads.
glm::vec3 Scene::head_of(const render::View& view) const {
    const glm::vec3 eye = view.eye_in_room();
    return *std::ranges::min_element(
        heads_, {}, [&](const glm::vec3& head) { return glm::distance(head, eye); });
}

void Scene::set_tools(const interaction::ToolDrawing& drawing, const interaction::ClipPlane& clip) {
    tools_ = drawing;
    clip_ = clip;
}

std::optional<glm::vec4> Scene::cut_in(const interaction::Similarity& room_from_physical) const {
    if (!clip_.shown)
        return std::nullopt;
    const glm::dvec3 normal = interaction::normal_in_room(room_from_physical, clip_.normal);
    const glm::dvec3 at = interaction::transform(room_from_physical, clip_.point);
    return glm::vec4(glm::dvec4(normal, -glm::dot(normal, at)));
}

/// Drawn over the cells, as distances are measured through them.
void Scene::draw_tools(const render::View& view,
                       const interaction::Similarity& room_from_physical) {
    if (tools_.lines.empty() && tools_.labels.empty())
        return;
    const auto in_room = [&](const glm::dvec3& at) {
        return glm::vec3(interaction::transform(room_from_physical, at));
    };
    std::vector<render::Line> lines;
    for (const interaction::ToolLine& line : tools_.lines)
        lines.push_back({in_room(line.from), in_room(line.to), line.color});
    gl_.DepthRange(kOverCells, kOverCells);
    line_pass_.draw(view, glm::mat4(1.0f), lines, kToolLine);
    gl_.DepthRange(0.0, 1.0);
    std::vector<render::ScreenQuad> quads;
    for (const interaction::ToolLabel& label : tools_.labels)
        if (const glm::vec3 at = in_room(label.at); !hidden_by_panel(view, at))
            add_label(label.text, at, text_pass_, view.size, quads);
    text_pass_.draw(view, glm::mat4(1.0f), quads, render::TextPass::Depth::none);
}

bool Scene::hidden_by_panel(const render::View& view, const glm::vec3& at) const {
    return panel_ && render::hides(panel_->quad, view.eye_in_room(), at);
}

void Scene::draw_pointed(const render::View& view,
                         const interaction::Similarity& room_from_physical) {
    const glm::vec3 at(interaction::transform(room_from_physical, pointed_->point.position));
    if (hidden_by_panel(view, at) || pointed_->surface >= surfaces_.size())
        return;
    text_pass_.draw(view, glm::mat4(1.0f),
                    pointed_quads(*pointed_, surfaces_, at, info_, text_pass_, view.size),
                    render::TextPass::Depth::none);
}

void Scene::draw_orientation(const render::View& view,
                             const interaction::Similarity& room_from_physical) {
    const Orientation shown = orientation_in(view, room_from_physical, info_, text_pass_);
    const render::View pixels = render::pixel_view(view);
    gl_.DepthRange(0.0, 0.0); // nearer than all that has been drawn
    for (const render::Line& line : shown.lines)
        line_pass_.draw(pixels, glm::mat4(1.0f), std::span(&line, 1), 2.5f);
    gl_.DepthRange(0.0, 1.0);
    text_pass_.draw(pixels, glm::mat4(1.0f), shown.quads, render::TextPass::Depth::none);
}

/// Drawn over the surface that it lies on, but not over the panel.
void Scene::draw_mark(const render::View& view, const interaction::Similarity& room_from_physical) {
    const glm::vec3 at(interaction::transform(room_from_physical, mark_.point->position));
    if (hidden_by_panel(view, at))
        return;
    text_pass_.draw(view, glm::mat4(1.0f),
                    mark_quads(*mark_.point, at, info_, text_pass_, view.size),
                    render::TextPass::Depth::none);
}

std::size_t Scene::draw(std::span<const render::View> views,
                        const interaction::Similarity& room_from_physical,
                        render::Footprint footprint, const std::optional<interaction::Pose>& wand,
                        const SceneSlice& slice) {
    const auto placement = render::Placement::of(info_.grid, matrix(room_from_physical));
    // Rank 0 may have chosen a footprint that these cells do not have here yet.
    footprint = footprints().best(footprint);
    if (background_ && slice.begins)
        for (const render::View& view : views)
            background_pass_.draw(view, *background_);
    // Soft edges blend with what is drawn before them. What splats may hide must come before these
    // all the same, since they write no depth.
    appearance_.cut = cut_in(room_from_physical);
    const bool depth = writes_depth(footprint);
    if (!depth && slice.begins)
        draw_among_cells(views, placement, room_from_physical, wand);
    if (render::CellPass::needs_corners(drawn(), footprint, appearance_))
        (draws_resting_ ? *resting_ : cells_).compute_corners();
    if (appearance_.near_fade && !views.empty()) // all views are of one viewer
        appearance_.near_fade->between_eyes = head_of(views.front());
    const std::size_t done =
        cell_pass_.draw(views, placement, drawn(), footprint, appearance_, slice.cells);
    if (!slice.ends)
        return done;
    if (depth)
        draw_among_cells(views, placement, room_from_physical, wand);
    draw_before_cells(views, placement);
    for (const render::View& view : views)
        draw_over_cells(view, room_from_physical, wand);
    return done;
}

std::size_t Scene::work(std::size_t views, render::Footprint footprint) const {
    return cell_pass_.work(views, drawn(), footprints().best(footprint), appearance_);
}

std::size_t Scene::prepare_slices(render::Footprint footprint, std::size_t most) {
    // The corners of so many cells are computed in about the time in which one of them is drawn.
    constexpr std::size_t kCorners = 8;
    if (!render::CellPass::needs_corners(drawn(), footprints().best(footprint), appearance_))
        return 0;
    const std::size_t cells =
        (draws_resting_ ? *resting_ : cells_).compute_corners(kCorners * most);
    return (cells + kCorners - 1) / kCorners;
}

/// Whether the cells write depth, so that they hide things behind them that are drawn later.
bool Scene::writes_depth(render::Footprint footprint) const {
    return footprint == render::Footprint::quad ||
           (render::has_layers(footprint) &&
            std::ranges::all_of(appearance_.surfaces, [](const render::SurfaceAppearance& surface) {
                return surface.opacity >= 1.0f;
            }));
}

render::BoxLines Scene::box_in(const render::View& view, const render::Placement& placement) const {
    const glm::vec4 eye(view.eye_in_room(), 1.0f);
    return render::box_lines(placement.extent, on_light_ ? kBoxOnLight : kBoxColor,
                             glm::vec3(glm::inverse(placement.room_from_index) * eye));
}

void Scene::draw_among_cells(std::span<const render::View> views,
                             const render::Placement& placement,
                             const interaction::Similarity& room_from_physical,
                             const std::optional<interaction::Pose>& wand) {
    for (const render::View& view : views) {
        if (box_)
            line_pass_.draw(view, placement.room_from_index, box_in(view, placement).far);
        draw_guides(view, room_from_physical, wand);
    }
}

/// The edges of the box in front, which no cell hides. The numbers are on its outline, where no
/// cell is in front of them or behind.
void Scene::draw_before_cells(std::span<const render::View> views,
                              const render::Placement& placement) {
    if (!box_)
        return;
    const std::vector<render::Label> labels =
        labels_with_room(axes_.labels, text_pass_.atlas(), placement.room_from_index, views);
    for (const render::View& view : views) {
        std::vector<render::Line> lines = box_in(view, placement).near;
        lines.insert(lines.end(), axes_.ticks.begin(), axes_.ticks.end());
        line_pass_.draw(view, placement.room_from_index, lines);
        std::vector<render::ScreenQuad> quads;
        for (const render::Label& label : labels)
            text_pass_.set(label, text_height(view.size), quads);
        text_pass_.draw(view, placement.room_from_index, quads);
    }
}

/// The wand's ray: to the place that it points at, else to the panel, else straight ahead.
render::Line Scene::wand_ray(const interaction::Similarity& room_from_physical,
                             const interaction::Pose& wand) const {
    const float length = panel_ && panel_->ray ? *panel_->ray : kWandLength;
    const glm::vec3 end =
        pointed_ ? glm::vec3(interaction::transform(room_from_physical, pointed_->point.position))
                 : wand.position + wand.orientation * glm::vec3(0, 0, -length);
    return {wand.position, end, kWandColor};
}

void Scene::draw_guides(const render::View& view, const interaction::Similarity& room_from_physical,
                        const std::optional<interaction::Pose>& wand) {
    if (!guides_.empty())
        line_pass_.draw(view, glm::mat4(1.0f), guides_);
    if (wand && !points_at_panel())
        draw_ray(view, room_from_physical, *wand);
}

/// Whether the wand's ray ends on the panel: then it is before all that the panel is before.
bool Scene::points_at_panel() const {
    return panel_ && panel_->ray && !pointed_;
}

void Scene::draw_ray(const render::View& view, const interaction::Similarity& room_from_physical,
                     const interaction::Pose& wand) {
    const std::array ray{wand_ray(room_from_physical, wand)};
    line_pass_.draw(view, glm::mat4(1.0f), ray, panel_ ? kPointing : kThin);
}

void Scene::draw_aids(const render::View& view, const interaction::Similarity& room_from_physical,
                      const std::optional<interaction::Pose>& wand,
                      const std::optional<interaction::Pointed>& pointed) {
    pointed_ = pointed;
    gl_.Enable(GL_SCISSOR_TEST);
    render::set_viewport(gl_, view);
    gl_.DepthMask(GL_TRUE);
    gl_.Clear(GL_DEPTH_BUFFER_BIT); // of the aids before
    if (wand)
        draw_ray(view, room_from_physical, *wand);
    if (pointed_)
        draw_pointed(view, room_from_physical);
    gl_.Disable(GL_SCISSOR_TEST);
}

/// What no cell hides. The panel is drawn over them so that viewers who stand among them can read it
/// with both eyes.
void Scene::draw_over_cells(const render::View& view,
                            const interaction::Similarity& room_from_physical,
                            const std::optional<interaction::Pose>& wand) {
    if (panel_) {
        gl_.DepthRange(kOverCells, kOverCells);
        panel_pass_.draw(view, panel_->quad);
        gl_.DepthRange(0.0, 0.0); // before the panel
        if (wand && points_at_panel())
            draw_ray(view, room_from_physical, *wand);
        gl_.DepthRange(0.0, 1.0);
    }
    draw_tools(view, room_from_physical);
    if (mark_.point)
        draw_mark(view, room_from_physical);
    if (pointed_)
        draw_pointed(view, room_from_physical);
    veil_pass_.draw(view, veil_);
    text_pass_.draw(render::pixel_view(view), glm::mat4(1.0f),
                    legend_quads({surfaces_, info_.value_unit, scale_}, text_pass_, view.size),
                    render::TextPass::Depth::none);
    if (orientation_)
        draw_orientation(view, room_from_physical);
    if (!caption_.empty())
        text_pass_.draw(render::pixel_view(view), glm::mat4(1.0f),
                        caption_quads(caption_, text_pass_, view.size),
                        render::TextPass::Depth::none);
}

} // namespace isochron::app
