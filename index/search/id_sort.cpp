// Sorts sets of cell ids.
#include "index/search/id_sort.h"

#include <algorithm>
#include <bit>

namespace isochron::index {
namespace {

struct Marks {
    std::vector<std::uint64_t> of_ids, of_words; ///< bits: of each id; of each word that is not 0
};

} // namespace

void sort_ids(std::vector<CellId>& ids, std::uint64_t cells) {
    if (ids.size() < cells / 4096) { // comparing is faster than going through all words
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        ids.erase(std::lower_bound(ids.begin(), ids.end(), cells), ids.end());
        return;
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
    for (const CellId id : ids)
        if (id < cells) {
            marks.of_ids[id / 64] |= std::uint64_t{1} << id % 64;
            if (!many)
                marks.of_words[id / 4096] |= std::uint64_t{1} << id / 64 % 64;
        }
    std::size_t out = 0;
    const auto take = [&](std::size_t word) {
        for (std::uint64_t& bits = marks.of_ids[word]; bits != 0; bits &= bits - 1)
            ids[out++] = static_cast<CellId>(word * 64 + std::countr_zero(bits));
    };
    if (many)
        for (std::size_t word = 0; word < words; ++word)
            take(word);
    else
        for (std::size_t first = 0; first < words; first += 64)
            for (std::uint64_t& some = marks.of_words[first / 64]; some != 0; some &= some - 1)
                take(first + std::countr_zero(some));
    ids.resize(out);
}

} // namespace isochron::index
