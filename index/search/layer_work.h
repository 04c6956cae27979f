// Goes through the layers of a step with all cores, and keeps the work space of each.
#pragma once

#include "index/file/index_file.h"
#include "index/file/step_view.h"
#include "index/search/cube_search.h"
#include "index/search/step_slab.h"
#include "index/system/parallel.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <utility>
#include <vector>

namespace isochron::index {

/// Workers are numbered from 0; calls with the same number never overlap. Functions throw Error as
/// ChunkStore does.
class LayerWork {
  public:
    explicit LayerWork(std::shared_ptr<const IndexFile> file)
        : file_(std::move(file)), cubes_(thread_count(0)) {}

    using Work = std::function<void(unsigned worker, std::uint32_t layer)>;
    /// Called for a layer some layers before the work on it; may be empty.
    using Prepare = std::function<void(std::uint32_t layer)>;
    /// Gives the places of the chunks of a layer that will be needed, ascending.
    using PlacesOf = std::function<std::vector<std::uint32_t>(std::uint32_t layer)>;
    /// @param threads `threads(step)` for work that uses slabs, else as many as there are cubes
    /// @return false when stopped
    bool for_each_layer(const StepView& step, const PlacesOf& places, const Prepare& prepare,
                        const Work& work, unsigned threads, const std::stop_token& stop);

    /// As many as there is room for slabs.
    unsigned threads(const StepView& step);
    unsigned threads_without_slabs() const { return static_cast<unsigned>(cubes_.size()); }
    StepSlab& slab(unsigned worker);
    CubeSearch& cubes(unsigned worker);
    const IndexFile& file() const { return *file_; }

  private:
    std::shared_ptr<const IndexFile> file_;
    std::vector<std::unique_ptr<StepSlab>> slabs_;   ///< by worker
    std::vector<std::unique_ptr<CubeSearch>> cubes_; ///< by worker
};

} // namespace isochron::index
