// Finds as many cells as a picture can hold: of the volume itself where they fit, else of coarser
// levels of detail.
#pragma once

#include "index/detail/detail_regions.h"
#include "index/search/first_crossing.h"
#include "index/search/layer_search.h"
#include "index/surface/cell_set.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

namespace isochron::index {

/// Cells of mixed levels, as Extraction has them.
struct DetailCells {
    std::vector<CellSet> surfaces;
    std::vector<std::uint16_t> colors;
    std::vector<std::uint8_t> levels; ///< by region
    unsigned coarsest = 0;            ///< level of the largest cells
    std::size_t cells() const;        ///< cells of all surfaces
};

/// Every region gets the level that the query wishes. If that makes too many cells, all wishes
/// become coarser by a part of a level, again and again; a region whose wish reaches the next level
/// takes it. The last step may change more regions than it must: those nearest to the middle of the
/// volume stay finer as long as there is room. So levels depend on the query and the data alone.
/// Cells are counted on the coarsest level, then on finer ones until there are too many; each finer
/// level is assumed to have four times as many.
/// Active cells that the levels lose (lost_cells.h) are added as cells of level 0, as large as they
/// are. They are thinned (cell_thinning.h) to the room that is left below `most_cells`, but not to
/// less than a quarter. Not thread-safe: keeps its work space.
class DetailSearch {
  public:
    explicit DetailSearch(std::shared_ptr<const IndexFile> file);

    enum class Outcome : std::uint8_t {
        stopped, ///< the result is incomplete
        whole,   ///< all regions should be at level 0; nothing is filled in
        made
    };
    /// The number of active cells of the volume itself; empty when stopped, or if the index has no
    /// values of it. @throws Error as ChunkStore does
    std::optional<std::uint64_t> count(const SurfacesQuery& query, const std::stop_token& stop);

    /// @param query with `most_cells` above 0
    /// @param volume_cells number of active cells of the volume itself, where it is known
    /// @throws Error as ChunkStore does
    Outcome find(const SurfacesQuery& query, std::optional<std::uint64_t> volume_cells,
                 DetailCells& result, const std::stop_token& stop);

  private:
    struct LevelCells {
        std::vector<CellSet> surfaces; ///< with points of the level's own grid
        std::vector<std::vector<std::uint16_t>> colors;
        std::size_t cells = 0;
    };
    using Levels = std::vector<std::uint8_t>;

    LayerSearch& searcher(unsigned level);
    StepView step(Instant at, unsigned level) const { return step_in_chunks(*file_, at, level); }
    bool search(const SurfacesQuery& query, unsigned level, const ChunkFilter& only,
                LevelCells& found, const std::stop_token& stop);
    bool color(const Query& query, unsigned level, const CellSet& set,
               std::vector<std::uint16_t>& colors, const std::stop_token& stop);
    const FirstCrossings* crossings(double isovalue, unsigned level, const std::stop_token& stop);
    bool count_down(const SurfacesQuery& query, const std::stop_token& stop);
    double expected_cells(const Levels& levels) const;
    double expected_cells(std::size_t region, unsigned level) const;
    unsigned finest_that_fits(double most) const;
    double least_cells_of_volume(const SurfacesQuery& query) const;
    Levels lifted(const SurfacesQuery& query, unsigned coarser, unsigned finest) const;
    std::pair<Levels, unsigned> lifted_to_fit(const SurfacesQuery& query, unsigned coarser,
                                              unsigned finest) const;
    unsigned coarsest_lift(const SurfacesQuery& query) const;
    ChunkFilter chunks_of(const Levels& levels, unsigned level) const;
    bool gather(const SurfacesQuery& query, const Levels& levels, DetailCells& result,
                const std::stop_token& stop);
    bool add_lost(const SurfacesQuery& query, unsigned finest, DetailCells& result,
                  const std::stop_token& stop);
    void append(const LevelCells& from, const Levels& levels, unsigned level, DetailCells& result);

    std::shared_ptr<const IndexFile> file_;
    DetailRegions regions_;
    std::vector<std::uint32_t> by_place_; ///< regions, from the middle outwards
    unsigned top_;                        ///< the coarsest level
    bool by_bricks_;
    std::vector<std::unique_ptr<LayerSearch>> searchers_; ///< by level
    std::map<unsigned, LevelCells> known_;                ///< whole levels, of the query
    unsigned counted_ = 0;               ///< the finest level whose cells are all counted
    std::vector<std::size_t> in_region_; ///< cells of that level
    double level_zero_ = 1; ///< expected cells of level 0, divided by those in in_region_
    std::vector<std::vector<std::uint16_t>> colors_; ///< colors of the result, by surface
    CellColoring coloring_ = CellColoring::none;     ///< coloring that the query asks for
    std::optional<ColorSource> source_; ///< source of the colors, where they are values
    std::map<std::pair<double, unsigned>, FirstCrossingsPtr> crossings_; ///< by isovalue and level
};

} // namespace isochron::index
