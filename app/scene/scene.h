// Draws what the eyes see: the cells, the volume's box with its numbers, the legend, the wand and
// the floor.
//
//     scene.cells().upload(newest);
//     scene.draw(picture, views);
#pragma once

#include "app/config/config.h"
#include "app/scene/axis_labels.h"
#include "app/scene/callouts.h"
#include "app/scene/cell_sets.h"
#include "app/scene/cell_warm_up.h"
#include "app/scene/cells_picture.h"
#include "app/scene/legend.h"
#include "app/scene/moving_cells.h"
#include "app/scene/orientation.h"
#include "app/scene/picture.h"
#include "index/volume/volume_series.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/view.h"
#include "render/passes/background_pass.h"
#include "render/passes/line_pass.h"
#include "render/passes/panel_pass.h"
#include "render/drawing/ghost_pass.h"
#include "render/drawing/slice_pass.h"
#include "render/drawing/triangle_pass.h"
#include "render/passes/text_pass.h"
#include "render/passes/veil_pass.h"

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// What a call of `Scene::draw` draws of a picture: all of it, or one of several parts, which come
/// in the order: beginning, cells, end. All parts give the same picture as the whole, to the bit.
struct ScenePart {
    bool begins = true; ///< what comes before the cells
    render::DrawPart cells = {};
    bool ends = true;   ///< what comes after the cells
    bool keeps = false; ///< its cells are kept, for pictures that differ in what lies over them
};

/// What the colors of the ghosts mean, by time: those of the first surface that is seen.
std::vector<LegendLine> lines_of_ghosts(const Picture& picture);

/// What it draws depends on the picture alone, and on the cells that `cells()` shows.
class Scene {
  public:
    /// @param gl outlives the scene
    Scene(const render::Gl& gl, const index::SeriesInfo& info, const Config& config);

    CellSets& cells() { return cells_; }
    const CellSets& cells() const { return cells_; }

    /// The driver's features that do not work as promised and are not used, a line each.
    std::vector<std::string> given_up() const;

    /// Draws into the views' viewports of the bound framebuffer; the cells of two views in one pass
    /// if the driver can.
    /// @return work of the part that is done, after which the next one begins: see
    /// `render::CellPass::draw`
    std::size_t draw(const Picture& picture, std::span<const render::View> views,
                     const ScenePart& part = {});
    /// Draws a cell in one of the ways in which cells are drawn: called for each way in turn. What
    /// stands beside cells is drawn by `draw`.
    /// @param way from 0 @return the share of the ways that is done; 1: that was the last
    float warm_up(const Picture& picture, std::span<const render::View> views, std::size_t way);

    /// From now on cells are drawn only in ways that `prepare` has drawn.
    /// @return ways that this picture needs, which come first
    std::vector<std::size_t> begin_in_few_ways(const Picture& picture);
    /// Draws a cell in this way.
    void prepare(std::size_t way, std::span<const render::View> views);
    /// The ways in which no cell was drawn yet.
    std::vector<std::size_t> ways_left() const;
    /// How cells are drawn, for a context beside this one; while there are ways left.
    const CellDrawing& cell_drawing() const { return few_->drawing; }
    /// Whether cells can be drawn so without a program that is still to be compiled.
    bool is_ready(render::Footprint footprint, bool opaque, bool translucent, bool by_value) const;
    /// Whether the last picture can be moved, and cells be drawn in few pixels.
    bool is_ready_to_move() const { return !few_ || few_->drawn[0]; }
    /// Work of drawing the cells into so many views, in the units of `ScenePart::cells`.
    std::size_t work(const Picture& picture, std::size_t views);
    /// Does some of the work that comes before the parts of a picture.
    /// @param most of it, in the same units @return how much was done; 0: none is left
    std::size_t prepare_parts(const Picture& picture, std::size_t most);

    /// As `CellsPicture::movable`.
    const Picture* movable_picture(std::size_t viewports) const { return kept_.movable(viewports); }
    /// Whether the cells of this picture are kept or moved, so that drawing it takes no time for them.
    /// @param viewports that show it
    bool keeps_cells(const Picture& picture, std::size_t viewports) const {
        return picture.moved || kept_.hold(picture, viewports);
    }

    /// Further pictures draw their cells anew.
    void forget_cells() { kept_.forget(); }

    /// Over a finished picture: a wand's ray, and what a cursor is over.
    void draw_aids(const Picture& picture, const Aids& aids, const render::View& view);

  private:
    /// Words tell of this array from now on.
    void speak_of(const ShownValues& values);
    render::CellAppearance appearance_of(const Picture& picture);
    render::Placement placement_of(const Picture& picture) const;
    /// The texture of a scale's colors, kept with those of the last scales.
    const render::Texture& map_of(const ColorScale& scale);
    void draw_slices(std::span<const render::View> views, const Picture& picture,
                     const render::Placement& placement);
    /// What stands beside the surfaces, before or after the cells are drawn.
    void draw_beside(std::span<const render::View> views, const Picture& picture,
                     const render::Placement& placement, const render::CellAppearance& appearance,
                     bool opaque, render::TriangleShare share);
    void draw_ghosts(std::span<const render::View> views, const Picture& picture,
                     const render::Placement& placement, const render::CellAppearance& appearance,
                     render::TriangleShare share);
    /// Surfaces of other arrays, opaque or translucent ones.
    void draw_further(std::span<const render::View> views, const Picture& picture,
                      const render::Placement& placement, const render::CellAppearance& appearance,
                      bool opaque, render::TriangleShare share);
    void draw_among_cells(std::span<const render::View> views, const Picture& picture,
                          const render::Placement& placement);
    /// Legend, scale bar with axes, and caption of a view, as far as the picture has them.
    struct CornerWords {
        std::vector<render::ScreenQuad> legend, caption;
        Orientation orientation;
    };
    CornerWords words_in_corners(const render::View& view, const Picture& picture) const;
    void draw_before_cells(std::span<const render::View> views, const Picture& picture,
                           const render::Placement& placement,
                           std::span<const CornerWords> corners);
    /// The words that stand beside places, and where, and those in the corners.
    struct Words {
        std::span<const Callout> callouts;
        std::span<const CalloutPaper> papers;
        bool whole_pixels; ///< one eye sees them
        const CornerWords& corners;
    };
    void draw_over_cells(const render::View& view, const Picture& picture, const Words& words);
    void draw_panel(const render::View& view, const Picture& picture);
    void draw_ray(const render::View& view, const Picture& picture, const Aids& aids);
    void draw_callout(const render::View& view, const Picture& picture, const Callout& callout,
                      const CalloutPaper& paper, bool whole_pixels);
    void draw_tools(const render::View& view, const Picture& picture);
    void draw_orientation(const render::View& view, const Picture& picture,
                          const Orientation& shown);

    const render::Gl& gl_;
    index::SeriesInfo info_;
    render::CellAppearance configured_; ///< on which a picture's appearance is based
    CellSets cells_;
    std::deque<std::pair<ColorScale, render::Texture>> maps_; ///< textures of the last scales
    CellsPicture kept_;
    const render::CellShape shape_;
    render::CellPass cell_pass_;
    /// The ways in which cells are drawn, while not all are ready.
    struct FewWays {
        CellDrawing drawing;
        CellWarmUp warm_up;
        std::vector<bool> drawn; ///< by way
        FewWays(const render::Gl& gl, CellDrawing how)
            : drawing(std::move(how)), warm_up(gl, drawing), drawn(warm_up.ways()) {}
    };
    std::optional<FewWays> few_;
    render::LinePass line_pass_;
    render::SlicePass slice_pass_;
    render::TrianglePass triangle_pass_;
    render::GhostPass ghost_pass_, further_pass_, opaque_further_pass_;
    render::TextPass text_pass_;
    render::PanelPass panel_pass_;
    render::BackgroundPass background_pass_;
    MovingCells moving_;
    render::VeilPass veil_pass_;
};

} // namespace isochron::app
