// The bytes of a THI tree: where its parts lie, for the builder and for the search.
#pragma once

#include "index/thi/interval_tree.h"
#include "index/volume/order_key.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

/// The block begins with this; the parts follow in the order of ThiParts, each from a multiple
/// of 8.
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

/// Where the parts of a time node begin; it ends where the next begins.
struct ThiNodeStart {
    std::uint64_t entry;
    std::uint64_t interval_node;
};

/// The parts. Time nodes are numbered as in TimeNode. Numbers of entries and of interval nodes
/// count from the time node's first. A time node's entries are: for each row of span space the
/// cells off the diagonal, then the lists of the interval trees of the diagonal elements.
template <template <class> class Array>
struct ThiParts {
    Array<OrderKey> lines;           ///< of the lattice
    Array<ThiNodeStart> node_starts; ///< time nodes + 1
    Array<std::uint32_t> row_starts; ///< (elements + 1) for each time node, the last is a row's end
    Array<std::uint32_t> roots;      ///< an interval tree for each time node and element
    Lists<Array> lists;              ///< all entries
    Array<IntervalNode> interval_nodes;
};

/// Offset of every part, and the size of the whole as the last number.
/// @throws Error when a block of `limit` bytes cannot hold them
std::array<std::uint64_t, 10> thi_offsets(const ThiHeader& header, std::uint64_t limit);

/// The parts of a block, whose size fits the header.
ThiParts<Readable> thi_parts(const ThiHeader& header, std::span<const std::byte> bytes);
ThiParts<Writable> thi_parts(const ThiHeader& header, std::span<std::byte> bytes);

/// Checks the header, the size of the block and every number that a search goes by.
/// @throws Error saying what is damaged
ThiHeader check_thi_bytes(std::span<const std::byte> bytes);

} // namespace isochron::index
