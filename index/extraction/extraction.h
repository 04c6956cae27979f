// The result of one request: the active cells of its surfaces and the volume blocks around them.
#pragma once

#include "index/extraction/joined_cells.h"
#include "index/extraction/simplified_meshes.h"
#include "index/extraction/surroundings.h"
#include "index/extraction/volume_blocks.h"
#include "index/search/index_search.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Which cells came and went since an earlier extraction. Meshes and blocks know their own changes.
struct ExtractionChange {
    std::uint64_t from = 0; ///< the number of that extraction; 0: nothing is known
    std::vector<SurfaceChange> surfaces = {};
};

/// What the query's filter of pieces has left.
struct ToldPieces {
    std::uint64_t all = 0, kept = 0; ///< numbers, on surfaces that the filter says something of
    bool too_many_cells = false;     ///< to tell pieces apart: all cells are there
};

/// Constant once published, but for the meshes that come later. Showing it needs nothing more of
/// the file.
struct Extraction {
    SurfacesQuery query;
    std::vector<CellSet> surfaces; ///< one for each isovalue; points and rows if asked for
    std::vector<float> levels;     ///< the isovalues in block units: see BlockLevels
    /// Color coordinates of the cells, surface after surface in the order of ids; empty if none
    /// were asked for, or the index has no array to color by.
    std::vector<std::uint16_t> colors;
    /// Where cells of the volume itself are colored by values: the fine color coordinates
    /// (cell_colors.h) at the eight vertices of each cell, in the same order.
    std::vector<std::uint16_t> corner_colors;
    VolumeBlocks blocks;           ///< blocks of the step, for all surfaces
    SurroundingField surroundings; ///< field of all surfaces; none where there are no cells
    /// The level of each region's cells (detail_regions.h). Empty: all cells are the volume's own.
    /// Else cells come as points only, as detail_regions.h has them, and without the volume around
    /// them.
    std::vector<std::uint8_t> detail;
    unsigned coarsest = 0; ///< level of its largest cells
    ToldPieces pieces;
    /// Number of active cells of the volume itself, of kept pieces; empty while it is not known.
    std::optional<std::uint64_t> volume_cells;
    std::uint64_t number = 0; ///< different for each extraction of this process
    ExtractionChange change;  ///< since an extraction that was at hand
    std::chrono::nanoseconds gather_time{0};
    /// The worker puts them there if they were asked for.
    std::shared_ptr<LaterMeshes> later = std::make_shared<LaterMeshes>();

    /// Number of cells of all surfaces: a cell that is active in two counts twice.
    std::size_t cells() const;
    bool coarse() const { return !detail.empty(); } ///< whether some cells are of coarser levels
    bool shaded() const; ///< whether every cell has its point, with its normal
    bool meshed() const; ///< whether it came with a mesh of every surface that has cells
    /// The meshes of a mesh level, by surface, null where there are no cells; empty while it has none.
    std::vector<CellMeshPtr> meshes(std::size_t level) const;
    /// Triangles of these meshes; 0 while it has none.
    std::size_t triangles(std::size_t level) const;
    std::uint64_t candidates() const;
    std::uint64_t reused() const;
    std::chrono::nanoseconds search_time() const;
};

using ExtractionPtr = std::shared_ptr<const Extraction>;

/// Computes one extraction. Call it on the worker only: it keeps the state of incremental search.
/// Returns null when stopped. @throws Error when it fails
using Extract = std::function<ExtractionPtr(const SurfacesQuery&, std::stop_token)>;

/// Holds the newest state of an index that grows, for an extraction on another thread.
class NewestIndex {
  public:
    explicit NewestIndex(std::shared_ptr<const IndexFile> file) : file_(std::move(file)) {}
    void set(std::shared_ptr<const IndexFile> file) {
        const std::scoped_lock lock(mutex_);
        file_.swap(file);
    }
    std::shared_ptr<const IndexFile> get() const {
        const std::scoped_lock lock(mutex_);
        return file_;
    }

  private:
    mutable std::mutex mutex_;
    std::shared_ptr<const IndexFile> file_;
};

/// Like `extract_from`, but at each call from the array that the query names of the index that
/// `newest` holds.
Extract extract_from_newest(std::shared_ptr<const NewestIndex> newest, Shading shading);

/// Makes an extraction from an open index. Each surface has its own incremental search. Copies
/// share their state. The extraction throws Error for a step that the series does not have, and
/// unless there are 1 to kMostSurfaces isovalues.
/// @param method to use instead of the cheapest; the file must have that tier
/// @param shading whether the sets get points, for renderers that do not make normals themselves
Extract extract_from(std::shared_ptr<const IndexFile> file,
                     std::optional<SearchMethod> method = std::nullopt,
                     Shading shading = Shading::none);

} // namespace isochron::index
