// Chooses how many cells a picture may have, and how fine each region of the volume should be.
#pragma once

#include "index/detail/detail_regions.h"
#include "index/volume/grid.h"
#include "index/volume/query.h"
#include "render/cells/placement.h"
#include "render/gl/view.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isochron::app {

/// One choice for all eyes and windows. The number of cells is one of a few fixed ones, and small
/// changes of the budget do not change it, so that new sets are not asked for all the time.
class DetailChooser {
  public:
    /// However small the budget, moving pictures may have at least this many cells.
    static constexpr std::uint64_t kFewest = 1 << 12;
    /// Number before any time has been measured: small, as a set that takes too long to draw is
    /// drawn until the next one comes.
    static constexpr std::uint64_t kAtFirst = 1 << 13;
    /// Volumes of at most this many cells are always shown as they are.
    static constexpr std::uint64_t kSmallVolume = 1 << 18;

    /// @param most cells that a set may have at all
    DetailChooser(const index::Grid& grid, std::uint64_t most);

    /// Whether the volume is so small that nothing has to be chosen.
    bool small() const { return small_; }
    std::uint64_t most() const { return most_; }
    /// From now on sets have at most this many cells: more could not be drawn.
    void limit(std::uint64_t most) {
        most_ = std::clamp(most, std::min(kFewest, most_), most_);
        small_ = false;
        limited_ = true;
    }
    /// Cells to ask for before anything is chosen; 0: all, however many.
    /// @param live somebody waits for the picture
    std::uint64_t most_at_first(bool live) const {
        return small_ ? 0 : live ? kAtFirst : limited_ ? most_ : 0;
    }

    /// Finds the useful level of each region: log2 of the number of its voxels along a pixel, so
    /// that a voxel of that level is a pixel; below 0 where voxels are larger. Regions that no view
    /// shows count as four times as far away at rest; what moves spends no cells on those that lie
    /// 15 degrees and more beside all views, unless all cells fit. Without views, every level will be 0.
    void look(std::span<const render::View> views, const render::Placement& placement);

    /// Whether the sides of cells of level 0 were at most `kSmallCell` pixels long in the last views.
    bool cells_look_small() const;
    static constexpr double kSmallCell = 6;

    /// For a picture that changes. The number of cells grows to what fits, at most to 16 times as
    /// many at once, as costs are predicted well only near what has been drawn. It does not
    /// grow while less of the volume is seen than when it was chosen: cells that nobody sees cost
    /// little until the head turns back.
    /// @param fit cells that are expected to fit the budget; empty: not known yet
    /// @param drawn `most_cells` of the cells that are drawn
    /// @param least that the picture is recognized by: it has so many at once, whatever fits
    index::DetailQuery for_motion(std::optional<double> fit, std::uint64_t drawn,
                                  std::uint64_t least = 0);
    /// Whether a picture that moves would lack a part of what is seen: its set was chosen for other
    /// views, and spent no cells on some of the regions that these views show.
    bool lacks_what_is_seen(const index::DetailQuery& chosen) const;
    /// Whether that set is to be made anew as it would be now, even if that has fewer cells.
    bool is_for_other_views(const index::DetailQuery& chosen, const index::DetailQuery& now) const {
        return chosen != now && lacks_what_is_seen(chosen);
    }
    /// For a picture that has just come to rest: level 0 wherever a voxel is larger than half a
    /// pixel, and elsewhere a level whose voxels are at most 0.7 pixels large.
    /// @param cells that it may have
    index::DetailQuery at_first_rest(std::uint64_t cells) const;
    /// For a picture that stays at rest, and for pictures that are written: level 0 wherever a
    /// voxel is larger than an eighth of a pixel, and elsewhere a level whose voxels are at most a
    /// quarter of a pixel large. As many cells as a set may have.
    index::DetailQuery at_rest() const;

  private:
    /// A region in even coordinates, and the mean sides of its cells of level 0.
    struct Box {
        glm::vec3 low, high, cell;
    };
    Box box_of(std::size_t region, const index::Grid& grid) const;
    index::DetailQuery resting(std::uint64_t cells, double finer) const;

    index::DetailRegions regions_;
    std::vector<Box> boxes_; ///< by region
    std::uint64_t most_;
    bool small_, limited_ = false;
    int step_ = -1;                 ///< the chosen number of cells; below 0: none yet
    double seen_ = 0;               ///< share of the regions that are visible
    double seen_then_ = 0;          ///< this share when the number was chosen
    std::vector<bool> visible_;     ///< by region: some view may show it
    std::vector<bool> beside_;      ///< by region: no eye sees it, even if it turns a little
    std::vector<double> ideal_;     ///< by region: the level whose voxels are a pixel large
    std::vector<std::int8_t> kept_; ///< wishes of moving pictures
};

} // namespace isochron::app
