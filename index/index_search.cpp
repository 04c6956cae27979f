// The search over an open index, as the worker runs it.
#include "index/error.h"
#include "index/extractor.h"
#include "index/id_sort.h"
#include "index/scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace isochron::index {
namespace {

constexpr std::size_t kChunk = 1 << 16;     ///< candidates between two looks at the stop token
constexpr std::size_t kScanChunk = 1 << 22; ///< cells between two looks at the stop token

class IndexSearch {
  public:
    IndexSearch(std::shared_ptr<const IndexFile> file, bool use_tree)
        : file_(std::move(file)), use_tree_(use_tree),
          keys_(file_->values().type, file_->values().scaling) {}

    CellSetPtr operator()(const Query& query, const std::stop_token& stop) {
        const StepValues& values = file_->values();
        if (query.step >= values.steps)
            throw Error(fmt::format("step {}: expected 0 to {}", query.step, values.steps - 1));
        const auto started = Clock::now();
        auto set = std::make_shared<CellSet>();
        set->query = query;
        // First asked for here, on the worker: the tree is checked then.
        const ThiTree* tree = use_tree_ ? file_->tree() : nullptr;
        const bool searched = !std::isfinite(query.isovalue) ||
                              (tree ? search_tree(*tree, *set, stop) : search_all(*set, stop));
        const auto found = Clock::now();
        if (!searched || !shade_cells(values, *set, stop))
            return nullptr;
        set->search_time = found - started;
        set->shading_time = Clock::now() - found;
        return set;
    }

  private:
    using Clock = std::chrono::steady_clock;

    bool search_tree(const ThiTree& tree, CellSet& set, const std::stop_token& stop) {
        const StepValues& values = file_->values();
        set.reused =
            tree.search_incremental(cursor_, set.query.step, keys_.threshold(set.query.isovalue));
        set.candidates = cursor_.cells.size();
        // Ascending first: the test then walks through the volume instead of jumping about in it.
        candidates_ = cursor_.cells;
        sort_ids(candidates_, values.grid.cell_count());
        set.ids.reserve(candidates_.size());
        for (std::size_t at = 0; at < candidates_.size(); at += kChunk) {
            if (stop.stop_requested())
                return false;
            const auto first = candidates_.begin() + static_cast<std::ptrdiff_t>(at);
            chunk_.assign(first, first + static_cast<std::ptrdiff_t>(
                                             std::min(kChunk, candidates_.size() - at)));
            keep_active(values, set.query, chunk_);
            set.ids.insert(set.ids.end(), chunk_.begin(), chunk_.end());
        }
        return !stop.stop_requested();
    }

    /// Slab by slab of whole z layers, so that a stop is noticed within one.
    bool search_all(CellSet& set, const std::stop_token& stop) {
        StepValues slab = file_->values();
        const auto [width, height, depth] = slab.grid.cells();
        const std::uint64_t layer_cells = std::uint64_t{width} * height;
        const std::uint64_t layer_bytes =
            std::uint64_t{slab.grid.vertices[0]} * slab.grid.vertices[1] * size_of(slab.type);
        const auto layers = static_cast<std::uint32_t>(
            std::clamp<std::uint64_t>(kScanChunk / layer_cells, 1, depth));
        for (std::uint32_t z = 0; z < depth; z += layers) {
            if (stop.stop_requested())
                return false;
            slab.first = file_->values().first + z * layer_bytes;
            slab.grid.vertices[2] = std::min(layers, depth - z) + 1;
            chunk_.clear();
            scan(slab, set.query, chunk_);
            for (const CellId id : chunk_)
                set.ids.push_back(static_cast<CellId>(id + z * layer_cells));
        }
        set.candidates = set.ids.size();
        return true;
    }

    std::shared_ptr<const IndexFile> file_;
    bool use_tree_;
    KeyMap keys_;
    ThiTree::Cursor cursor_;
    std::vector<CellId> candidates_, chunk_; ///< kept for their memory
};

/// `std::function` wants something that can be copied; the state of a search must not be.
Search shared(std::shared_ptr<IndexSearch> search) {
    return [search = std::move(search)](const Query& query, const std::stop_token& stop) {
        return (*search)(query, stop);
    };
}

} // namespace

Search search_in(std::shared_ptr<const IndexFile> file) {
    return shared(std::make_shared<IndexSearch>(std::move(file), true));
}

Search scan_in(std::shared_ptr<const IndexFile> file) {
    return shared(std::make_shared<IndexSearch>(std::move(file), false));
}

} // namespace isochron::index
