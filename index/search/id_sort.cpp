// Sorts sets of cell ids.
#include "index/search/id_sort.h"

#include <algorithm>
#include <bit>
#include <span>

namespace isochron::index {
namespace {

struct Marks {
    std::vector<std::uint64_t> of_ids, of_words; ///< bits: of each id; of each word that is not 0
};

/// Sorts ids of the `cells` cells from `first` on. @return how many different ones there are
std::size_t sort_some(std::span<CellId> ids, std::uint64_t first, std::uint64_t cells) {
    if (ids.size() < cells / 4096) { // comparing is faster than going through all words
        std::sort(ids.begin(), ids.end());
        const auto end = std::unique(ids.begin(), ids.end());
        return static_cast<std::size_t>(std::lower_bound(ids.begin(), end, first + cells) -
                                        ids.begin());
    }
    // Marks of moderate size are kept, all 0 between calls: fresh memory takes longer than marking.
    constexpr std::size_t kKeptWords = 1 << 20;
    thread_local Marks kept;
    Marks fresh;
    const std::size_t words = (cells + 63) / 64;
    Marks& marks = words > kKeptWords ? fresh : kept;
    if (marks.of_ids.size() < words) {
        marks.of_ids.resize(words);
        marks.of_words.resize((words + 63) / 64);
    }
    // With many ids, nearly every word has one, so that marks of words gain nothing.
    const bool many = ids.size() >= cells / 256;
    for (const CellId each : ids)
        if (const std::uint64_t id = each - first; id < cells) {
            marks.of_ids[id / 64] |= std::uint64_t{1} << id % 64;
            if (!many)
                marks.of_words[id / 4096] |= std::uint64_t{1} << id / 64 % 64;
        }
    std::size_t out = 0;
    const auto take = [&](std::size_t word) {
        for (std::uint64_t& bits = marks.of_ids[word]; bits != 0; bits &= bits - 1)
            ids[out++] = static_cast<CellId>(first + word * 64 + std::countr_zero(bits));
    };
    if (many)
        for (std::size_t word = 0; word < words; ++word)
            take(word);
    else
        for (std::size_t group = 0; group < words; group += 64)
            for (std::uint64_t& some = marks.of_words[group / 64]; some != 0; some &= some - 1)
                take(group + std::countr_zero(some));
    return out;
}

} // namespace

void sort_ids(std::vector<CellId>& ids, std::uint64_t cells) {
    ids.resize(sort_some(ids, 0, cells));
}

void sort_ids(std::vector<CellId>& ids, std::uint64_t cells, std::uint64_t group) {
    std::size_t out = 0;
    for (auto at = ids.begin(); at != ids.end();) {
        const std::uint64_t first = *at / group * group;
        const auto end =
            std::find_if(at, ids.end(), [&](CellId id) { return id - first >= group; });
        const std::size_t count =
            first < cells ? sort_some({at, end}, first, std::min(group, cells - first)) : 0;
        std::copy_n(at, count, ids.begin() + static_cast<std::ptrdiff_t>(out));
        out += count;
        at = end;
    }
    ids.resize(out);
}

} // namespace isochron::index
