// The lattice that divides span space, and the set of distinct extremes from which it is made.
#pragma once

#include "index/volume/order_key.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace isochron::index {

/// A set of keys: one bit for each key, in pages of 8 KiB that are allocated when a key needs them
/// (a few MiB for usual data, 512 MiB for 32-bit values spread over their whole range).
/// Threads may insert at the same time; call other functions only after all of them are done.
class DistinctKeys {
  public:
    DistinctKeys() : pages_(kPages) {}
    ~DistinctKeys();
    DistinctKeys(const DistinctKeys&) = delete;
    DistinctKeys& operator=(const DistinctKeys&) = delete;

    void insert(OrderKey key);
    std::uint64_t count() const;

    /// The keys at these ranks (0 for the smallest). @param ranks ascending, below `count()`
    std::vector<OrderKey> at_ranks(std::span<const std::uint64_t> ranks) const;

  private:
    static constexpr std::size_t kPages = 1 << 16;
    struct Page {
        std::array<std::atomic<std::uint64_t>, kPages / 64> words{};
    };
    std::vector<std::atomic<Page*>> pages_;
};

/// The lines of the lattice, the same for columns and rows (section 3.2): the sorted list of
/// distinct extremes is divided into L sublists of equal length, and the last extreme of each is a
/// line; with fewer than L extremes, each is a line. Element i holds the keys in (line i-1, line
/// i], element 0 all keys up to line 0.
std::vector<OrderKey> lattice_lines(const DistinctKeys& extremes, std::uint32_t lattice);

/// Number of the element that holds the key; `lines.size()` for keys above the last line.
std::uint32_t element_of(std::span<const OrderKey> lines, OrderKey key);

/// `element_of`, faster if the key is in element `guess`. @param guess below `lines.size()`
std::uint32_t element_near(std::span<const OrderKey> lines, OrderKey key, std::uint32_t guess);

} // namespace isochron::index
