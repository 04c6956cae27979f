// The byte layout of a THI tree, for its builder and its search.
#pragma once

#include "index/paper/interval_tree.h"
#include "index/volume/order_key.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

/// The first bytes of the block. The parts follow in the order of ThiParts, each at a multiple of
/// 8.
struct ThiHeader {
    static constexpr std::array<char, 8> kMagic{'I', 'S', 'O', 'T', 'H', 'I', '0', '1'};
    std::array<char, 8> magic = kMagic;
    std::uint32_t steps = 0;
    std::uint32_t lattice = 0;       ///< as asked for
    std::uint32_t max_variation = 0; ///< as asked for
    std::uint32_t elements = 0;      ///< lines of the lattice, at most as many as asked for
    std::uint64_t entries = 0;
    std::uint64_t interval_nodes = 0;
};
static_assert(sizeof(ThiHeader) == 40);

/// Where the parts of a time node begin; they end where the parts of the next node begin.
struct ThiNodeStart {
    std::uint64_t entry;
    std::uint64_t interval_node;
};

/// The parts. Time nodes are numbered as in TimeNode. Numbers of entries and interval nodes are
/// relative to the time node's first. A time node's entries are the cells off the diagonal, row by
/// row of span space, then the lists of the interval trees of the diagonal elements.
template <template <class> class Array>
struct ThiParts {
    Array<OrderKey> lines;           ///< lines of the lattice
    Array<ThiNodeStart> node_starts; ///< time nodes + 1
    Array<std::uint32_t> row_starts; ///< (elements + 1) for each time node; the last is an end
    Array<std::uint32_t> roots;      ///< an interval tree for each time node and element
    Lists<Array> lists;              ///< all entries
    Array<IntervalNode> interval_nodes;
};

/// Byte offset of every part, then the size of the whole block.
/// @throws Error when a block of `limit` bytes cannot hold them
std::array<std::uint64_t, 10> thi_offsets(const ThiHeader& header, std::uint64_t limit);

/// The parts of a block. Its size must fit the header.
ThiParts<Readable> thi_parts(const ThiHeader& header, std::span<const std::byte> bytes);
ThiParts<Writable> thi_parts(const ThiHeader& header, std::span<std::byte> bytes);

/// Checks the header, the size of the block and every offset that a search uses.
/// @throws Error saying what is damaged
ThiHeader check_thi_bytes(std::span<const std::byte> bytes);

} // namespace isochron::index
