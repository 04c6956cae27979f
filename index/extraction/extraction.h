// The result of one request: the active cells of its surfaces and the bricks behind them.
#pragma once

#include "index/extraction/index_search.h"
#include "index/extraction/surroundings.h"
#include "index/extraction/volume_bricks.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Immutable once published; whoever shows it reads nothing of the file.
struct Extraction {
    SurfacesQuery query;
    std::vector<CellSet> surfaces; ///< one for each isovalue; points and rows where asked for
    std::vector<float> levels;     ///< of the isovalues, in brick units: see BrickLevels
    /// Coordinates of the cells, surface after surface in the order of ids; empty where none were
    /// asked for, and where the index has no second array to color by.
    std::vector<std::uint16_t> colors;
    VolumeBricks bricks;           ///< of the step, for all surfaces
    SurroundingField surroundings; ///< of all surfaces; none where there are no cells
    std::chrono::nanoseconds gather_time{0};

    std::size_t cells() const; ///< of all surfaces: one that is active in two counts twice
    bool shaded() const;       ///< whether every cell has its point, with its normal
    bool meshed() const;       ///< whether every surface that has cells has a mesh
    std::uint64_t candidates() const;
    std::uint64_t reused() const;
    std::chrono::nanoseconds search_time() const;
};

using ExtractionPtr = std::shared_ptr<const Extraction>;

/// Computes one extraction; runs on the worker only, keeps the state of incremental search.
/// Returns null when stopped. Throws to report a failure.
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

/// As below, from whatever `newest` holds when it is called.
Extract extract_from_newest(std::shared_ptr<const NewestIndex> newest, Shading shading);

/// The extraction from an open index: each surface has an incremental search of its own. Copies
/// share their state. What it makes throws Error for a step that the series does not have and for
/// other than 1 to kMostSurfaces isovalues.
/// @param method instead of the cheapest; the file must have that tier
/// @param shading whether the sets get points, for renderers that do not make normals themselves
Extract extract_from(std::shared_ptr<const IndexFile> file,
                     std::optional<SearchMethod> method = std::nullopt,
                     Shading shading = Shading::none);

} // namespace isochron::index
