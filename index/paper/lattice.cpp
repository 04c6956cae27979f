// The lattice that divides span space, and the set of distinct extremes from which it is made.
#include "index/paper/lattice.h"

#include <algorithm>
#include <bit>

namespace isochron::index {

DistinctKeys::~DistinctKeys() {
    for (const auto& page : pages_)
        delete page.load();
}

void DistinctKeys::insert(OrderKey key) {
    std::atomic<Page*>& slot = pages_[key >> 16];
    Page* page = slot.load(std::memory_order_acquire);
    if (!page) {
        auto fresh = std::make_unique<Page>();
        if (slot.compare_exchange_strong(page, fresh.get()))
            page = fresh.release();
    }
    auto& word = page->words[(key & 0xffff) / 64];
    const std::uint64_t bit = std::uint64_t{1} << (key % 64);
    // Most keys are in the set already, and reading first keeps the cache line shared by threads.
    if (!(word.load(std::memory_order_relaxed) & bit))
        word.fetch_or(bit, std::memory_order_relaxed);
}

std::uint64_t DistinctKeys::count() const {
    std::uint64_t count = 0;
    for (const auto& slot : pages_)
        if (const Page* page = slot.load())
            for (const auto& word : page->words)
                count += static_cast<std::uint64_t>(std::popcount(word.load()));
    return count;
}

std::vector<OrderKey> DistinctKeys::at_ranks(std::span<const std::uint64_t> ranks) const {
    std::vector<OrderKey> keys;
    std::uint64_t before = 0;
    for (std::size_t number = 0; number < kPages && keys.size() < ranks.size(); ++number) {
        const Page* page = pages_[number].load();
        if (!page)
            continue;
        for (std::size_t i = 0; i < page->words.size() && keys.size() < ranks.size(); ++i) {
            const std::uint64_t word = page->words[i].load();
            const auto here = static_cast<std::uint64_t>(std::popcount(word));
            while (keys.size() < ranks.size() && ranks[keys.size()] < before + here) {
                std::uint64_t rest = word;
                for (std::uint64_t skip = ranks[keys.size()] - before; skip > 0; --skip)
                    rest &= rest - 1;
                keys.push_back(static_cast<OrderKey>(number << 16 | i * 64) +
                               static_cast<OrderKey>(std::countr_zero(rest)));
            }
            before += here;
        }
    }
    return keys;
}

std::vector<OrderKey> lattice_lines(const DistinctKeys& extremes, std::uint32_t lattice) {
    const std::uint64_t count = extremes.count();
    const std::uint64_t elements = std::min<std::uint64_t>(lattice, count);
    std::vector<std::uint64_t> last_of_sublist(elements);
    for (std::uint64_t i = 0; i < elements; ++i)
        last_of_sublist[i] = (i + 1) * count / elements - 1;
    return extremes.at_ranks(last_of_sublist);
}

std::uint32_t element_of(std::span<const OrderKey> lines, OrderKey key) {
    return static_cast<std::uint32_t>(std::lower_bound(lines.begin(), lines.end(), key) -
                                      lines.begin());
}

std::uint32_t element_near(std::span<const OrderKey> lines, OrderKey key, std::uint32_t guess) {
    if (key <= lines[guess] && (guess == 0 || lines[guess - 1] < key))
        return guess;
    return element_of(lines, key);
}

} // namespace isochron::index
