// Ascending order for sets of cell ids.
#include "index/extraction/id_sort.h"

#include <algorithm>
#include <bit>

namespace isochron::index {

void sort_ids(std::vector<CellId>& ids, std::uint64_t cells) {
    if (ids.size() < cells / 1024) { // going through the words would take longer than comparing
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        ids.erase(std::lower_bound(ids.begin(), ids.end(), cells), ids.end());
        return;
    }
    // All zero between calls where they are kept: fresh memory costs more than the marks.
    constexpr std::size_t kKeptWords = 1 << 20;
    thread_local std::vector<std::uint64_t> kept;
    const std::size_t words = (cells + 63) / 64;
    std::vector<std::uint64_t> fresh;
    std::vector<std::uint64_t>& marked = words > kKeptWords ? fresh : kept;
    if (marked.size() < words)
        marked.resize(words);
    for (const CellId id : ids)
        if (id < cells)
            marked[id / 64] |= std::uint64_t{1} << id % 64;
    std::size_t out = 0;
    for (std::size_t word = 0; word < words; ++word) {
        for (std::uint64_t bits = marked[word]; bits != 0; bits &= bits - 1)
            ids[out++] = static_cast<CellId>(word * 64 + std::countr_zero(bits));
        marked[word] = 0;
    }
    ids.resize(out);
}

} // namespace isochron::index
