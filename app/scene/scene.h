// What the eyes see: the cells, the volume's box with its numbers, the legend, the wand and the
// floor.
#pragma once

#include "app/config/config.h"
#include "app/frame/explorer_state.h"
#include "app/scene/axes.h"
#include "app/scene/guides.h"
#include "app/scene/legend.h"
#include "app/scene/shown_panel.h"
#include "index/volume/volume_series.h"
#include "interaction/pointed.h"
#include "interaction/tool.h"
#include "render/cells/cell_buffers.h"
#include "render/cells/cell_pass.h"
#include "render/gl/view.h"
#include "render/passes/background_pass.h"
#include "render/passes/line_pass.h"
#include "render/passes/text_pass.h"
#include "render/passes/veil_pass.h"
#include "stereo/display.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace isochron::app {

class Scene {
  public:
    Scene(const render::Gl& gl, const index::SeriesInfo& info, const Config& config);

    /// Moves the newest set to the GPU, at most the configured bytes per call.
    void upload(const index::ExtractionPtr& newest,
                render::SendVolume volume = render::SendVolume::with_cells);
    /// The same without showing it: the next `upload` of it does. @return true when it is there
    bool stage(const index::ExtractionPtr& set) { return cells_.stage(set, upload_bytes_); }
    const index::ExtractionPtr& shown() const { return cells_.shown(); }
    /// Whether the shown cells have all that they can: their volume, unless it is too large.
    bool is_complete() const { return !cells_.wants_volume(); }
    /// Why this set is not shown, and never will be; empty where it is not so.
    std::string refusal(const index::ExtractionPtr& set) const {
        return set && set == cells_.refused() ? cells_.refusal() : std::string();
    }

    const render::UploadCount& uploaded() const { return cells_.count(); }

    /// That the shown cells can be drawn with: a very large set has no room for its surface, and
    /// where a GPU draws cells come without a mesh.
    render::FootprintSet footprints() const;
    /// That they could be drawn with if a mesh came with them, which they may be asked for with.
    render::FootprintSet possible_footprints() const;
    std::size_t surface_limit() const { return cells_.corner_limit(); } ///< cells

    /// What the driver promises but was found not to do, a line each.
    std::vector<std::string> given_up() const;

    void set_guides(const Guides& guides) { guides_ = lines_of(guides); }
    void set_panel(const std::optional<ShownPanel>& panel) { panel_ = panel; }
    void set_pointed(const std::optional<interaction::Pointed>& pointed) { pointed_ = pointed; }
    /// What is drawn for tools, and the plane that cuts the surfaces.
    void set_tools(const interaction::ToolDrawing& drawing, const interaction::ClipPlane& clip);
    /// The data's axes and a bar of a round length stand in a corner.
    void set_orientation(bool shown) { orientation_ = shown; }
    /// Words in the corner of the picture; empty: none.
    void set_caption(const std::string& words) { caption_ = words; }
    void set_veil(const render::Veil& veil) { veil_ = veil; }

    /// Where what comes near to somebody fades, and who is there.
    void set_near_fade(const interaction::ComfortOptions& comfort,
                       std::span<const stereo::ViewerPose> viewers);

    /// What is the same for all eyes of the frames to come: colors, and the edges of the box that
    /// carry numbers.
    /// @param head whose view they are chosen for
    /// @param scale of the values that colors stand for; nothing when they tell surfaces apart
    void look(const ExplorerState& state, const interaction::Pose& head,
              const std::optional<ColorScale>& scale);

    /// Draws into the views' viewports of the bound framebuffer, the cells of two views in one pass
    /// where the driver can.
    /// @param wand drawn as a ray when given
    void draw(std::span<const render::View> views,
              const interaction::Similarity& room_from_physical, render::Footprint footprint,
              const std::optional<interaction::Pose>& wand);

    /// Over a finished picture: a wand's ray, and what a cursor is over.
    void draw_aids(const render::View& view, const interaction::Similarity& room_from_physical,
                   const std::optional<interaction::Pose>& wand,
                   const std::optional<interaction::Pointed>& pointed);

  private:
    void draw_ray(const render::View& view, const interaction::Similarity& room_from_physical,
                  const interaction::Pose& wand);
    bool writes_depth(render::Footprint footprint) const;
    render::BoxLines box_in(const render::View& view, const render::Placement& placement) const;
    void draw_among_cells(std::span<const render::View> views, const render::Placement& placement,
                          const interaction::Similarity& room_from_physical,
                          const std::optional<interaction::Pose>& wand);
    void draw_before_cells(std::span<const render::View> views, const render::Placement& placement);
    void draw_guides(const render::View& view, const interaction::Similarity& room_from_physical,
                     const std::optional<interaction::Pose>& wand);
    render::Line wand_ray(const interaction::Similarity& room_from_physical,
                          const interaction::Pose& wand) const;
    void draw_over_cells(const render::View& view,
                         const interaction::Similarity& room_from_physical);
    glm::vec3 head_of(const render::View& view) const;
    void draw_mark(const render::View& view, const interaction::Similarity& room_from_physical);
    void draw_pointed(const render::View& view, const interaction::Similarity& room_from_physical);
    std::optional<glm::vec4> cut_in(const interaction::Similarity& room_from_physical) const;
    void draw_panel(const render::View& view);
    void draw_tools(const render::View& view, const interaction::Similarity& room_from_physical);
    void draw_orientation(const render::View& view,
                          const interaction::Similarity& room_from_physical);
    bool hidden_by_panel(const render::View& view, const glm::vec3& at) const;

    const render::Gl& gl_;
    const index::SeriesInfo info_;
    const std::size_t upload_bytes_; ///< per frame
    const std::uint64_t mesh_room_;  ///< 0: no set comes with a mesh
    bool box_ = true;
    Axes axes_;
    std::vector<interaction::Isosurface> surfaces_;
    std::optional<ColorScale> scale_;
    std::optional<render::Texture> map_; ///< the last that was needed
    const render::CellAppearance configured_;
    render::CellAppearance appearance_;
    std::optional<render::BackgroundColors> background_; ///< none: the picture's own color
    bool on_light_ = false;                              ///< what is drawn on it is dark
    render::CellBuffers cells_;
    render::CellPass cell_pass_;
    render::LinePass line_pass_;
    std::vector<render::Line> guides_;
    render::TextPass text_pass_;
    render::PanelPass panel_pass_;
    std::optional<ShownPanel> panel_;
    std::vector<glm::vec3> heads_; ///< of viewers before whom cells fade
    interaction::Mark mark_;
    std::optional<interaction::Pointed> pointed_;
    std::string caption_;
    bool orientation_ = false;
    interaction::ToolDrawing tools_;
    interaction::ClipPlane clip_;
    render::BackgroundPass background_pass_;
    render::VeilPass veil_pass_;
    render::Veil veil_;
};

} // namespace isochron::app
