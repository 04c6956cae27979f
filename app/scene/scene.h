// Draws what the eyes see: the cells, the volume's box with its numbers, the legend, the wand and
// the floor.
#pragma once

#include "app/config/config.h"
#include "app/frame/explorer_state.h"
#include "app/scene/axes.h"
#include "app/scene/guides.h"
#include "app/scene/legend.h"
#include "app/scene/shown_panel.h"
#include "index/volume/volume_series.h"
#include "interaction/pointed.h"
#include "interaction/tools/tool.h"
#include "render/cells/cell_buffers.h"
#include "render/drawing/cell_pass.h"
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

/// What a call of `Scene::draw` draws of a picture: all of it, or one of several slices, which come
/// in the order: beginning, cells, end. All slices give the same picture as the whole, to the bit.
struct SceneSlice {
    bool begins = true; ///< what comes before the cells
    render::DrawPart cells = {};
    bool ends = true; ///< what comes after the cells
};

class Scene {
  public:
    Scene(const render::Gl& gl, const index::SeriesInfo& info, const Config& config);

    /// There may be two sets: one for moving pictures, and one with more detail for pictures at
    /// rest, which is drawn only if `draw_at_rest` says so. The one for moving pictures stays, so
    /// that it can be drawn at once when something moves.
    enum class Use : std::uint8_t { always, at_rest };

    /// Uploads the newest set to the GPU, at most the configured number of bytes per call; shows it
    /// when it is complete.
    void upload(const index::ExtractionPtr& newest,
                render::SendVolume volume = render::SendVolume::with_cells, Use use = Use::always);
    /// Pictures do not depend on earlier sets from now on: see render::CellBuffers::send_whole.
    void send_whole();
    /// Uploads a set without showing it; a later `upload` of the same set shows it.
    /// @return true when it is completely on the GPU
    bool stage(const index::ExtractionPtr& set, Use use = Use::always) {
        return buffers(use).stage(set, upload_bytes_);
    }
    /// Draws the set for pictures at rest from now on, if it shows these surfaces; else the other.
    void draw_at_rest(bool at_rest, const index::SurfacesQuery& surfaces);
    /// The set that is drawn.
    const index::ExtractionPtr& shown() const { return drawn().shown(); }
    /// The set for this use, drawn or not; null if there is none.
    const index::ExtractionPtr& held(Use use) const {
        static const index::ExtractionPtr none;
        return use == Use::always ? cells_.shown() : resting_ ? resting_->shown() : none;
    }
    /// Whether nothing more is uploaded for the shown cells: their volume is there, or too large.
    bool is_complete() const { return !drawn().wants_volume(); }
    /// The same for the set of this use, drawn or not; also where there is none.
    bool is_complete(Use use) const {
        const render::CellBuffers* sets = use == Use::always ? &cells_
                                          : resting_         ? &*resting_
                                                             : nullptr;
        return !sets || !sets->shown() || !sets->wants_volume();
    }
    /// Why this set cannot be shown; empty if it can.
    std::string refusal(const index::ExtractionPtr& set) const;

    render::UploadCount uploaded() const;

    /// The footprints that the shown cells can be drawn with: a very large set has no room for its
    /// surface, and on a GPU cells have no mesh.
    render::FootprintSet footprints() const;
    /// The same, and `mesh` if the cells could be drawn so after asking for them with a mesh.
    render::FootprintSet possible_footprints() const;
    std::size_t surface_limit() const { return cells_.corner_limit(); } ///< cells
    /// Makes ready for a set for pictures at rest: that takes longer than a frame may.
    void prepare_for_rest();
    /// The views of the last pictures in windows or a headset, and where the volume was.
    std::span<const render::View> views() const { return views_; }
    void forget_views() { views_.clear(); }
    void note_views(std::span<const render::View> views) {
        views_.insert(views_.end(), views.begin(), views.end());
    }

    /// The driver's features that do not work as promised and are not used, a line each.
    std::vector<std::string> given_up() const;

    /// Makes ready for another array of the same shape. Call it before the first frame.
    void prepare_for(const index::SeriesInfo& array);
    /// Sets the array whose name and unit stand beside its values.
    void set_array(const index::SeriesInfo& array);
    void set_guides(const Guides& guides) { guides_ = lines_of(guides); }
    void set_panel(const std::optional<ShownPanel>& panel) { panel_ = panel; }
    void set_pointed(const std::optional<interaction::Pointed>& pointed) { pointed_ = pointed; }
    /// Sets what is drawn for tools, and the plane that cuts the surfaces.
    void set_tools(const interaction::ToolDrawing& drawing, const interaction::ClipPlane& clip);
    /// Shows the data's axes and a scale bar in a corner.
    void set_orientation(bool shown) { orientation_ = shown; }
    /// Sets the caption in the corner of the picture; empty: none.
    void set_caption(const std::string& words) { caption_ = words; }
    void set_veil(const render::Veil& veil) { veil_ = veil; }

    /// Sets the distance at which cells near a viewer fade, and where the viewers are.
    void set_near_fade(const interaction::ComfortOptions& comfort,
                       std::span<const stereo::ViewerPose> viewers);

    /// Sets what is the same for all eyes in the next frames: colors, and the edges of the box that
    /// carry numbers.
    /// @param head viewer for whom these edges are chosen
    /// @param scale of the values that colors stand for; empty: colors tell surfaces apart
    void look(const ExplorerState& state, const interaction::Pose& head,
              const std::optional<ColorScale>& scale);

    /// Draws into the views' viewports of the bound framebuffer; the cells of two views in one pass
    /// if the driver can.
    /// @param wand drawn as a ray; empty: none
    /// @return work of the slice that is done, after which the next one begins: see
    /// `render::CellPass::draw`
    std::size_t draw(std::span<const render::View> views,
                     const interaction::Similarity& room_from_physical, render::Footprint footprint,
                     const std::optional<interaction::Pose>& wand, const SceneSlice& slice = {});
    /// Draws a cell in each way in which cells are drawn, and what stands beside them.
    void warm_up(std::span<const render::View> views,
                 const interaction::Similarity& room_from_physical);
    /// Work of drawing the cells into so many views, in the units of `SceneSlice::cells`.
    std::size_t work(std::size_t views, render::Footprint footprint) const;
    /// Does some of the work that comes before a slice with this footprint.
    /// @param most of it, in the same units @return how much was done; 0: none is left
    std::size_t prepare_slices(render::Footprint footprint, std::size_t most);

    /// Over a finished picture: a wand's ray, and what a cursor is over.
    void draw_aids(const render::View& view, const interaction::Similarity& room_from_physical,
                   const std::optional<interaction::Pose>& wand,
                   const std::optional<interaction::Pointed>& pointed);

  private:
    render::CellBuffers& buffers(Use use);
    const render::CellBuffers& drawn() const { return draws_resting_ ? *resting_ : cells_; }
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
    bool points_at_panel() const;
    void draw_over_cells(const render::View& view,
                         const interaction::Similarity& room_from_physical,
                         const std::optional<interaction::Pose>& wand);
    glm::vec3 head_of(const render::View& view) const;
    void draw_mark(const render::View& view, const interaction::Similarity& room_from_physical);
    void draw_pointed(const render::View& view, const interaction::Similarity& room_from_physical);
    std::optional<glm::vec4> cut_in(const interaction::Similarity& room_from_physical) const;
    void draw_tools(const render::View& view, const interaction::Similarity& room_from_physical);
    void draw_orientation(const render::View& view,
                          const interaction::Similarity& room_from_physical);
    bool hidden_by_panel(const render::View& view, const glm::vec3& at) const;

    const render::Gl& gl_;
    index::SeriesInfo info_;
    std::vector<index::ValueType> held_types_; ///< types of the values in bricks, of all arrays
    const std::size_t upload_bytes_;           ///< per frame
    const std::uint64_t mesh_room_;            ///< 0: no set comes with a mesh
    bool box_ = true;
    Axes axes_;
    std::vector<interaction::Isosurface> surfaces_;
    std::optional<ColorScale> scale_;
    std::optional<render::Texture> map_; ///< the last that was needed
    const render::CellAppearance configured_;
    render::CellAppearance appearance_;
    std::optional<render::BackgroundColors> background_; ///< none: the picture's own color
    bool on_light_ = false;                              ///< the background is light
    render::CellBuffers cells_;                          ///< for Use::always
    std::optional<render::CellBuffers> resting_;         ///< for Use::at_rest
    bool draws_resting_ = false, sends_whole_ = false;
    std::vector<render::View> views_;
    render::CellPass cell_pass_;
    render::LinePass line_pass_;
    std::vector<render::Line> guides_;
    render::TextPass text_pass_;
    render::PanelPass panel_pass_;
    std::optional<ShownPanel> panel_;
    std::vector<glm::vec3> heads_; ///< of viewers near whom cells fade
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
