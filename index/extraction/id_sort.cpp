// Ascending order for sets of cell ids.
#include "index/extraction/id_sort.h"

#include <algorithm>
#include <bit>

namespace isochron::index {

void sort_ids(std::vector<CellId>& ids, std::uint64_t cells) {
    if (ids.size() < cells / 256) { // the bits' words would outnumber the comparisons
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        ids.erase(std::lower_bound(ids.begin(), ids.end(), cells), ids.end());
        return;
    }
    std::vector<std::uint64_t> marked((cells + 63) / 64);
    for (const CellId id : ids)
        if (id < cells)
            marked[id / 64] |= std::uint64_t{1} << id % 64;
    std::size_t out = 0;
    for (std::size_t word = 0; word < marked.size(); ++word)
        for (std::uint64_t bits = marked[word]; bits != 0; bits &= bits - 1)
            ids[out++] = static_cast<CellId>(word * 64 + std::countr_zero(bits));
    ids.resize(out);
}

} // namespace isochron::index
