// Draws what the eyes see: the cells, the volume's box, the legend, the wand and the floor.
#include "app/scene/scene.h"

#include "app/scene/caption.h"
#include "app/scene/font.h"
#include "app/scene/look.h"
#include "app/scene/overlay_colors.h"
#include "interaction/navigation/navigation.h"
#include "render/gl/driver.h"
#include "render/gl/shader.h"
#include "render/gl/viewport.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>

namespace isochron::app {
namespace {

/// What words cover; empty without words.
std::optional<TextRectangle> covered_by(std::span<const render::ScreenQuad> quads) {
    std::optional<TextRectangle> covered;
    for (const render::ScreenQuad& quad : quads) {
        const glm::vec2 at(quad.at);
        const TextRectangle before = covered.value_or(TextRectangle{at + quad.low, at});
        covered = {glm::min(before.low, at + quad.low), glm::max(before.high, at + quad.high)};
    }
    return covered;
}

constexpr float kWandLength = 1.2f; // meters
// Widths of lines [pixel], of words that are 15 pixels high at most.
constexpr float kThin = 1.5f, kPointing = 2.5f; ///< its ray
constexpr float kToolLine = 2.0f, kAxisLine = 2.5f;
constexpr float kFront = 0.4f; ///< share of the opacity that edges of the box have before the cells
/// Depth of things that no cell hides: among them, the first that is drawn hides the others.
constexpr double kOverCells = 1e-6;
constexpr glm::vec4 kBoxColor(0.45f, 0.50f, 0.56f, 0.55f);
constexpr glm::vec4 kBoxOnLight(0.25f, 0.28f, 0.32f, 0.8f);
constexpr glm::vec4 kWandColor(1.0f, 0.77f, 0.36f, 0.9f);

bool blends_light(const render::Gl& gl, Blending blending) {
    return blending == Blending::automatic ? !render::draws_in_software(gl)
                                           : blending == Blending::linear;
}

bool same_map(const ColorScale& a, const ColorScale& b) {
    return a.map == b.map && a.colors == b.colors && a.use == b.use;
}

/// The head of the viewer whose eye this is: the nearest one, as eyes are closer than heads.
glm::vec3 head_of(const render::View& view, std::span<const stereo::ViewerPose> viewers) {
    const glm::vec3 eye = view.eye_in_room();
    return std::ranges::min_element(viewers, {},
                                    [&](const stereo::ViewerPose& viewer) {
                                        return glm::distance(viewer.head.position, eye);
                                    })
        ->head.position;
}

glm::vec3 in_room(const Picture& picture, const glm::dvec3& at) {
    return glm::vec3(interaction::transform(picture.room_from_physical, at));
}

/// The planes that cut the surfaces, in the room.
std::vector<glm::vec4> cuts_of(const Picture& picture) {
    std::vector<glm::vec4> planes;
    for (const interaction::ClipPlane& cut : picture.cuts) {
        const glm::dvec3 normal =
            interaction::normal_in_room(picture.room_from_physical, cut.normal);
        const glm::dvec3 at = interaction::transform(picture.room_from_physical, cut.point);
        planes.emplace_back(glm::dvec4(normal, -glm::dot(normal, at)));
    }
    return planes;
}

bool hidden_by_panel(const Picture& picture, const render::View& view, const glm::vec3& at) {
    const auto& panel = picture.audience.panel;
    return panel && render::hides(panel->quad, view.eye_in_room(), at);
}

/// Whether the wand's ray ends on the panel: then the ray is in front of everything that is behind
/// the panel.
bool points_at_panel(const Picture& picture) {
    return picture.audience.panel && picture.audience.panel->ray && !picture.pointed;
}

/// The wand's ray: to the place that it points at, else to the panel, else straight ahead.
render::Line wand_ray(const Picture& picture, const Aids& aids) {
    const auto& panel = picture.audience.panel;
    const interaction::Pose& wand = *aids.wand;
    const float length = panel && panel->ray ? *panel->ray : kWandLength;
    const glm::vec3 end = aids.pointed
                              ? in_room(picture, aids.pointed->point.position)
                              : wand.position + wand.orientation * glm::vec3(0, 0, -length);
    return {wand.position, end, kWandColor};
}

/// Whether the cells write depth, so that they hide things behind them that are drawn later.
bool writes_depth(render::Footprint footprint, const render::CellAppearance& appearance) {
    return footprint == render::Footprint::quad ||
           (render::has_layers(footprint) &&
            std::ranges::none_of(appearance.surfaces, render::is_translucent));
}

float width_of(float line, const render::View& view, const Picture& picture) {
    return line * line_scale(view.size, picture.layout.text);
}

/// What the panel covers of an upper corner; empty: nothing.
std::optional<TextRectangle> upper_corner(const render::View& view, const PictureLayout& layout,
                                          bool right) {
    const glm::vec2 size(view.size),
        covered = text_height(view.size, layout.text) * layout.corners[right ? 1 : 0];
    if (covered == glm::vec2(0.0f))
        return std::nullopt;
    const float left = right ? size.x - covered.x : 0.0f;
    return TextRectangle{{left, size.y - covered.y}, {left + covered.x, size.y}};
}

OverlayColors overlay_of(const Picture& picture) {
    return overlay_colors_on(picture.look.background);
}

std::vector<LegendLine> lines_of_further(const Picture& picture) {
    std::vector<LegendLine> lines;
    const std::vector<std::string> words = words_of(picture.further);
    for (std::size_t i = 0; i < words.size(); ++i) {
        const ShownFurther& each = picture.further[i];
        lines.push_back(
            {each.by_values && picture.scale ? std::nullopt : std::optional(each.look.color),
             words[i]});
    }
    return lines;
}

render::BoxLines box_in(const render::View& view, const Picture& picture,
                        const render::Placement& placement) {
    const glm::vec4 eye(view.eye_in_room(), 1.0f);
    render::BoxLines box = render::box_lines(
        placement.extent, is_light(picture.look.background) ? kBoxOnLight : kBoxColor,
        glm::vec3(glm::inverse(placement.room_from_index) * eye));
    for (render::Line& line : box.front)
        line.color.w *= kFront;
    return box;
}

} // namespace

std::vector<LegendLine> lines_of_ghosts(const Picture& picture) {
    std::vector<LegendLine> lines;
    const auto seen =
        std::ranges::find_if(picture.isosurfaces, [](const interaction::Isosurface& surface) {
            return surface.of_shown_array() && surface.opacity > 0;
        });
    for (const ShownGhost& ghost : picture.ghosts)
        if (seen != picture.isosurfaces.end())
            lines.push_back(
                {ghost.colors[static_cast<std::size_t>(seen - picture.isosurfaces.begin())],
                 fmt::format("step {}, {}", step_number(ghost.surfaces->query.instant),
                             ghost.earlier ? "earlier" : "later")});
    return lines;
}

Scene::Scene(const render::Gl& gl, const index::SeriesInfo& info, const Config& config)
    : gl_(gl), info_(info), configured_(config.rendering.appearance), cells_(gl, info.grid, config),
      kept_(gl), shape_(config.rendering.cell_shape),
      cell_pass_(gl, {.shape = shape_}, render::prelude_for(info.grid)), line_pass_(gl),
      slice_pass_(gl, info.grid), triangle_pass_(gl, info.grid), ghost_pass_(gl, info.grid),
      further_pass_(gl, info.grid), opaque_further_pass_(gl, info.grid, render::GhostKind::opaque),
      text_pass_(gl, room_font), panel_pass_(gl), background_pass_(gl), moving_(gl, info.grid),
      veil_pass_(gl) {
    configured_.linear_light = blends_light(gl, config.rendering.blending);
    configured_.near_fade.reset();
    if (const glm::vec2 near = config.comfort.near_fade; near.y > 0)
        configured_.near_fade = {.gone = near.x, .whole = near.y};
    cells_.prepare_for(info);
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

/// How the cells look, apart from where somebody's eyes are.
render::CellAppearance Scene::appearance_of(const Picture& picture) {
    render::CellAppearance appearance = configured_;
    for (std::size_t i = 0; i < picture.isosurfaces.size(); ++i)
        if (picture.isosurfaces[i].of_shown_array()) // the others have no cells
            appearance.surfaces[i] = {picture.isosurfaces[i].color, picture.isosurfaces[i].opacity};
    appearance.values.reset();
    if (picture.scale)
        appearance.values = value_colors(*picture.scale, map_of(*picture.scale));
    set_look(appearance, configured_, picture.look);
    appearance.cuts = cuts_of(picture);
    appearance.mesh_level = picture.mesh_level;
    return appearance;
}

const render::Texture& Scene::map_of(const ColorScale& scale) {
    constexpr std::size_t kScales = 2; // those of surfaces and of slices
    const auto known =
        std::ranges::find_if(maps_, [&](const auto& each) { return same_map(each.first, scale); });
    if (known != maps_.end()) {
        std::rotate(known, known + 1, maps_.end()); // the last that was needed stays longest
        return maps_.back().second;
    }
    if (maps_.size() == kScales)
        maps_.pop_front();
    maps_.emplace_back(scale, render::color_map_texture(gl_, colors_of(scale)));
    return maps_.back().second;
}

/// Before the cells: slices are opaque, and hide by their depth what is behind them.
void Scene::draw_slices(std::span<const render::View> views, const Picture& picture,
                        const render::Placement& placement) {
    std::vector<index::SliceValuesPtr> values;
    for (const ShownSlice& slice : picture.slices)
        values.push_back(slice.values);
    slice_pass_.hold(values);
    for (const ShownSlice& slice : picture.slices) {
        const auto [low, high] = slice.scale.whole;
        const double half = high / 2 - low / 2;
        std::vector<render::Isoline> lines;
        for (const interaction::Isosurface& line : slice.lines)
            if (half > 0)
                lines.push_back(
                    {static_cast<float>((line.isovalue / 2 - low / 2) / half), line.color});
        for (const render::View& view : views)
            slice_pass_.draw(view, placement.room_from_index, *slice.values,
                             value_colors(slice.scale, map_of(slice.scale)), lines,
                             width_of(kThin, view, picture));
    }
}

void Scene::draw_beside(std::span<const render::View> views, const Picture& picture,
                        const render::Placement& placement,
                        const render::CellAppearance& appearance, bool opaque,
                        render::TriangleShare share) {
    std::vector<index::TriangleMeshPtr> meshes;
    for (const ShownTriangles& each : picture.beside)
        meshes.push_back(each.mesh);
    triangle_pass_.hold(meshes);
    for (const ShownTriangles& each : picture.beside)
        if ((each.look.opacity >= 1) == opaque)
            for (const render::View& view : views)
                triangle_pass_.draw(view, placement, *each.mesh, each.look, appearance, share);
}

void Scene::draw_ghosts(std::span<const render::View> views, const Picture& picture,
                        const render::Placement& placement,
                        const render::CellAppearance& appearance, render::TriangleShare share) {
    std::vector<render::GhostMesh> meshes;
    for (const ShownGhost& ghost : picture.ghosts)
        for (std::size_t i = 0; i < ghost.colors.size(); ++i)
            if (const index::CellMeshPtr& mesh = ghost.surfaces->meshes[i];
                mesh && picture.isosurfaces[i].opacity > 0)
                meshes.push_back({mesh, ghost.colors[i]});
    ghost_pass_.hold(meshes);
    for (const render::View& view : views)
        if (!meshes.empty())
            ghost_pass_.draw(view, placement, picture.ghosts.front().opacity, appearance, share);
}

void Scene::draw_further(std::span<const render::View> views, const Picture& picture,
                         const render::Placement& placement,
                         const render::CellAppearance& appearance, bool opaque,
                         render::TriangleShare share) {
    std::vector<render::GhostMesh> meshes;
    for (const ShownFurther& each : picture.further)
        if (each.mesh() && (each.look.opacity >= 1) == opaque)
            meshes.push_back({each.mesh(), each.look.color, each.look.opacity,
                              each.by_values && picture.scale.has_value()});
    render::GhostPass& pass = opaque ? opaque_further_pass_ : further_pass_;
    pass.hold(meshes);
    for (const render::View& view : views)
        pass.draw(view, placement, 1.0f, appearance, share);
}

render::Placement Scene::placement_of(const Picture& picture) const {
    return render::Placement::of(info_.grid, matrix(picture.room_from_physical));
}

void Scene::speak_of(const ShownValues& values) {
    info_.array = values.array;
    info_.value_unit = values.unit;
    info_.type = values.type;
    info_.digits = values.digits;
}

std::size_t Scene::draw(const Picture& picture, std::span<const render::View> views,
                        const ScenePart& part) {
    speak_of(picture.values);
    const render::Placement placement = placement_of(picture);
    const render::Footprint footprint = cells_.footprint_for(picture);
    const bool is_whole = part.begins && part.ends && part.cells == render::DrawPart{};
    const bool again = is_whole && kept_.draw_again(picture, views);
    const auto background = background_of(picture.look);
    if (background && part.begins && !again && !picture.transparent)
        for (const render::View& view : views)
            background_pass_.draw(view, *background);
    // Lines have soft edges, which blend with the pixels below, so lines come after the cells. Only
    // splats write no depth: lines that splats may hide are drawn before the splats.
    render::CellAppearance appearance = appearance_of(picture);
    const bool moved =
        picture.moved && is_whole && !again && moving_.draw_moved(kept_, picture, views);
    const bool layers = is_whole && is_ready_to_move() && moving_.draws_layers(picture, footprint);
    const bool depth =
        moved || !picture.surfaces || (writes_depth(footprint, appearance) && !layers);
    if (appearance.near_fade && !views.empty()) // all views are of one viewer
        appearance.near_fade->between_eyes = head_of(views.front(), picture.audience.viewers);
    using Share = render::TriangleShare;
    const auto beside = [&](bool opaque, Share share) {
        draw_beside(views, picture, placement, appearance, opaque, share);
        draw_further(views, picture, placement, appearance, opaque, share);
        if (!opaque)
            draw_ghosts(views, picture, placement, appearance, share);
    };
    if (part.begins && !again && !moved) {
        draw_slices(views, picture, placement);
        beside(true, Share::all);
    }
    if (!depth && part.begins) {
        draw_among_cells(views, picture, placement);
        beside(false, Share::beyond);
    }
    if (!moved && picture.surfaces &&
        render::CellPass::needs_corners(cells_.drawn(), footprint, appearance))
        cells_.compute_corners();
    std::size_t done = 0;
    const MovingCells::Cells cells{cell_pass_, cells_.drawn(), appearance};
    const bool anew = !again && !moved;
    if (!picture.surfaces)
        ; // only what stands beside them
    else if (anew && is_whole && picture.resolution > 0 && footprint == render::Footprint::quad)
        moving_.draw_in_few_pixels(cells, picture, views);
    else if (anew && layers)
        moving_.draw_in_layers(cells, picture, footprint, views);
    else if (anew)
        done = cell_pass_.draw(views, placement, cells_.drawn(), footprint, appearance, part.cells);
    if (!part.ends)
        return done;
    if (depth && part.keeps && anew && footprint == picture.footprint)
        kept_.keep(picture, views);
    beside(false, depth ? Share::all : Share::before);
    if (depth)
        draw_among_cells(views, picture, placement);
    std::vector<CornerWords> corners;
    for (const render::View& view : views)
        corners.push_back(words_in_corners(view, picture));
    draw_before_cells(views, picture, placement, corners);
    const auto callouts = callouts_of(picture, picture.pointed, info_);
    const auto papers = papers_of(callouts, text_pass_.atlas(), views, picture.layout.text,
                                  picture.layout.free.top > 0);
    for (std::size_t i = 0; i < views.size(); ++i)
        draw_over_cells(views[i], picture, {callouts, papers, views.size() == 1, corners[i]});
    return done;
}

std::vector<std::size_t> Scene::begin_in_few_ways(const Picture& picture) {
    CellDrawing drawing{.grid = info_.grid,
                        .shapes = {.shape = shape_},
                        .prelude = render::prelude_for(info_.grid),
                        .meshes = cells_.may_have_meshes(),
                        .picture = picture,
                        .appearance = appearance_of(picture)};
    drawing.appearance.values.reset(); // whose texture belongs to this context
    few_.emplace(gl_, std::move(drawing));
    const std::size_t ways = few_->drawn.size();
    cell_pass_.use_points(false); // quads serve everywhere
    std::vector<std::size_t> needed;
    bool quad = false; // in one size
    for (std::size_t way = 1; way < ways; ++way) {
        const CellWarmUp& warm_up = few_->warm_up;
        const bool is_quad = warm_up.draws(way, render::Footprint::quad, false, false);
        bool surface = false;
        for (const bool translucent : {false, true})
            surface |= interaction::any_is(picture.isosurfaces, translucent) &&
                       warm_up.draws(way, render::Footprint::surface, translucent,
                                     picture.scale.has_value());
        if (surface || (is_quad && !std::exchange(quad, true)))
            needed.push_back(way);
    }
    return needed;
}

void Scene::prepare(std::size_t way, std::span<const render::View> views) {
    render::CellAppearance& appearance = few_->drawing.appearance;
    if (appearance.near_fade && !views.empty())
        appearance.near_fade->between_eyes =
            head_of(views.front(), few_->drawing.picture.audience.viewers);
    const bool later = few_->drawn.front() || way == 0; // after the first picture
    cell_pass_.use_points(later);
    few_->warm_up.draw(way, cell_pass_, moving_, views, few_->drawing);
    cell_pass_.use_points(false);
    if (way == 0) {
        background_pass_.link();
        veil_pass_.link();
        panel_pass_.link();
    }
    // Quads are drawn as points only later.
    few_->drawn[way] = later || !few_->warm_up.draws(way, render::Footprint::quad, false, false);
    if (ways_left().empty()) {
        few_.reset();
        cell_pass_.use_points(true);
    }
}

std::vector<std::size_t> Scene::ways_left() const {
    std::vector<std::size_t> left;
    for (std::size_t way = 0; few_ && way < few_->drawn.size(); ++way)
        if (!few_->drawn[way])
            left.push_back(way);
    return left;
}

bool Scene::is_ready(render::Footprint footprint, bool opaque, bool translucent,
                     bool by_value) const {
    const auto ready = [&](bool lets_light_through) {
        for (const std::size_t way : ways_left())
            if (few_->warm_up.draws(way, footprint, lets_light_through, by_value))
                return false;
        return true;
    };
    return !few_ || footprint == render::Footprint::quad ||
           ((!opaque || ready(false)) && (!translucent || ready(true)));
}

float Scene::warm_up(const Picture& picture, std::span<const render::View> views, std::size_t way) {
    if (way == 0) {
        begin_in_few_ways(picture);
        few_->drawn[0] = true; // all of them come now, with points
    }
    const std::size_t ways = few_->drawn.size();
    prepare(way, views);
    return static_cast<float>(way + 1) / static_cast<float>(ways);
}

std::size_t Scene::work(const Picture& picture, std::size_t views) {
    if (!picture.surfaces)
        return 0;
    return cell_pass_.work(views, cells_.drawn(), cells_.footprint_for(picture),
                           appearance_of(picture));
}

std::size_t Scene::prepare_parts(const Picture& picture, std::size_t most) {
    // Computing the corners of so many cells takes about as long as drawing one cell.
    constexpr std::size_t kCorners = 8;
    if (!picture.surfaces ||
        !render::CellPass::needs_corners(cells_.drawn(), cells_.footprint_for(picture),
                                         appearance_of(picture)))
        return 0;
    const std::size_t cells = cells_.compute_corners(kCorners * most);
    return (cells + kCorners - 1) / kCorners;
}

void Scene::draw_among_cells(std::span<const render::View> views, const Picture& picture,
                             const render::Placement& placement) {
    const std::vector<render::Line> guides = lines_of(picture.guides);
    for (const render::View& view : views) {
        if (picture.bounding_box)
            line_pass_.draw(view, placement.room_from_index, box_in(view, picture, placement).back,
                            width_of(kThin, view, picture));
        if (!guides.empty())
            line_pass_.draw(view, glm::mat4(1.0f), guides);
        if (!points_at_panel(picture))
            draw_ray(view, picture, {picture.audience.wand, picture.pointed});
    }
}

Scene::CornerWords Scene::words_in_corners(const render::View& view, const Picture& picture) const {
    const OverlayColors overlay = overlay_of(picture);
    const float share = picture.layout.text;
    const auto chip = upper_corner(view, picture.layout, false),
               cube = upper_corner(view, picture.layout, true);
    CornerWords words;
    if (picture.legend) {
        std::vector<ColorScale> scales;
        if (picture.scale && picture.surfaces)
            scales.push_back(*picture.scale);
        for (const ShownSlice& slice : picture.slices)
            if (std::ranges::find(scales, slice.scale) == scales.end())
                scales.push_back(slice.scale);
        words.legend =
            legend_quads({picture.isosurfaces, info_.value_unit, info_.digits, scales,
                          picture.scale && picture.surfaces, overlay, picture.values.array,
                          lines_of_further(picture), lines_of_ghosts(picture)},
                         text_pass_, view.size, share, cube ? cube->low.y : 0.0f);
    }
    if (picture.orientation)
        words.orientation = orientation_in(view, picture.room_from_physical, info_, text_pass_,
                                           overlay, share, chip ? chip->low.y : 0.0f);
    if (!picture.caption.empty())
        words.caption = caption_quads(picture.caption, text_pass_, view.size, overlay, share);
    return words;
}

/// The edges of the box that no cell hides. The numbers are on its outline, where no cell is in front
/// of them or behind.
void Scene::draw_before_cells(std::span<const render::View> views, const Picture& picture,
                              const render::Placement& placement,
                              std::span<const CornerWords> corners) {
    if (!picture.bounding_box)
        return;
    Axes axes = axes_for(info_, placement, picture.audience.viewers.front().head, views);
    set_colors(axes, overlay_of(picture));
    std::array<Covered, 5> taken;
    for (const CornerWords& words : corners) {
        taken[0].push_back(covered_by(words.legend));
        taken[1].push_back(covered_by(words.orientation.quads));
        taken[2].push_back(covered_by(words.caption));
    }
    for (const render::View& view : views)
        for (const bool right : {false, true})
            taken[right ? 4 : 3].push_back(upper_corner(view, picture.layout, right));
    const std::vector<render::Label> labels =
        labels_with_room(axes.labels, text_pass_.atlas(), placement, views, picture.layout.text,
                         {taken.begin(), taken.end()});
    for (const render::View& view : views) {
        render::BoxLines box = box_in(view, picture, placement);
        std::vector<render::Line> lines = std::move(box.outline);
        lines.insert(lines.end(), box.front.begin(), box.front.end());
        lines.insert(lines.end(), axes.ticks.begin(), axes.ticks.end());
        line_pass_.draw(view, placement.room_from_index, lines, width_of(kThin, view, picture));
        std::vector<render::ScreenQuad> quads;
        for (const render::Label& label : labels)
            text_pass_.set(label, text_height(view.size, picture.layout.text), quads);
        text_pass_.draw(view, placement.room_from_index, quads, render::TextPass::Depth::tested,
                        views.size() == 1);
    }
}

/// What no cell hides.
void Scene::draw_over_cells(const render::View& view, const Picture& picture, const Words& words) {
    draw_panel(view, picture);
    draw_tools(view, picture);
    for (std::size_t i = 0; i < words.callouts.size(); ++i)
        draw_callout(view, picture, words.callouts[i], words.papers[i], words.whole_pixels);
    veil_pass_.draw(view, picture.veil);
    const auto draw = [&](std::span<const render::ScreenQuad> quads) {
        if (!quads.empty())
            text_pass_.draw(render::pixel_view(view), glm::mat4(1.0f), quads,
                            render::TextPass::Depth::none, true);
    };
    draw(words.corners.legend);
    if (picture.orientation)
        draw_orientation(view, picture, words.corners.orientation);
    draw(words.corners.caption);
    if (!picture.title.words.empty() && picture.title.opacity > 0.0f)
        draw(title_quads(picture.title.words, picture.title.opacity, text_pass_, view.size,
                         overlay_of(picture), picture.layout.text));
}

/// The panel is drawn over the cells so that viewers who stand among them can read it with both
/// eyes.
void Scene::draw_panel(const render::View& view, const Picture& picture) {
    if (!picture.audience.panel)
        return;
    gl_.DepthRange(kOverCells, kOverCells);
    panel_pass_.draw(view, picture.audience.panel->quad);
    gl_.DepthRange(0.0, 0.0); // before the panel
    if (points_at_panel(picture))
        draw_ray(view, picture, {picture.audience.wand, picture.pointed});
    gl_.DepthRange(0.0, 1.0);
}

void Scene::draw_ray(const render::View& view, const Picture& picture, const Aids& aids) {
    if (!aids.wand)
        return;
    const std::array ray{wand_ray(picture, aids)};
    line_pass_.draw(view, glm::mat4(1.0f), ray,
                    width_of(picture.audience.panel ? kPointing : kThin, view, picture));
}

/// Drawn over the cells, as distances are measured through them.
void Scene::draw_tools(const render::View& view, const Picture& picture) {
    const interaction::ToolDrawing& tools = picture.tools;
    if (tools.lines.empty())
        return;
    std::vector<render::Line> lines;
    for (const interaction::ToolLine& line : tools.lines)
        lines.push_back({in_room(picture, line.from), in_room(picture, line.to), line.color});
    gl_.DepthRange(kOverCells, kOverCells);
    line_pass_.draw(view, glm::mat4(1.0f), lines, width_of(kToolLine, view, picture));
    gl_.DepthRange(0.0, 1.0);
}

/// Drawn over the surface that it lies on, but not over the panel.
void Scene::draw_callout(const render::View& view, const Picture& picture, const Callout& callout,
                         const CalloutPaper& paper, bool whole_pixels) {
    if (!hidden_by_panel(picture, view, callout.at))
        text_pass_.draw(view, glm::mat4(1.0f),
                        callout_quads(callout, paper, text_pass_, view.size, overlay_of(picture),
                                      picture.layout.text),
                        render::TextPass::Depth::none, whole_pixels);
}

void Scene::draw_orientation(const render::View& view, const Picture& picture,
                             const Orientation& shown) {
    const render::View pixels = render::pixel_view(view);
    gl_.DepthRange(0.0, 0.0); // nearer than all that has been drawn
    for (const render::Line& line : shown.lines)
        line_pass_.draw(pixels, glm::mat4(1.0f), std::span(&line, 1),
                        width_of(kAxisLine, view, picture));
    gl_.DepthRange(0.0, 1.0);
    text_pass_.draw(pixels, glm::mat4(1.0f), shown.quads, render::TextPass::Depth::none, true);
}

void Scene::draw_aids(const Picture& picture, const Aids& aids, const render::View& view) {
    speak_of(picture.values);
    gl_.Enable(GL_SCISSOR_TEST);
    render::set_viewport(gl_, view);
    gl_.DepthMask(GL_TRUE);
    gl_.Clear(GL_DEPTH_BUFFER_BIT); // depths of the aids before
    draw_ray(view, picture, aids);
    const auto callouts = callouts_of(picture, aids.pointed, info_);
    if (aids.pointed && !callouts.empty()) // the others are part of the picture
        draw_callout(view, picture, callouts.back(),
                     papers_of(callouts, text_pass_.atlas(), std::span(&view, 1),
                               picture.layout.text, picture.layout.free.top > 0)
                         .back(),
                     stereo::eyes_of(picture.audience.stereo).size() == 1);
    gl_.Disable(GL_SCISSOR_TEST);
}

} // namespace isochron::app
