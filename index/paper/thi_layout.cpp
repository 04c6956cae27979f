// The byte layout of a THI tree, and the checks that a search relies on.
#include "index/paper/thi_layout.h"

#include "index/error.h"
#include "index/paper/time_tree.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace isochron::index {
namespace {

static_assert(std::endian::native == std::endian::little, "the parts are used as they lie");

std::uint64_t time_nodes(const ThiHeader& header) {
    return 2 * std::uint64_t{header.steps} - 1;
}

template <template <class> class Array, class Byte>
ThiParts<Array> parts_of(const ThiHeader& header, std::span<Byte> bytes) {
    const auto offsets = thi_offsets(header, bytes.size());
    const std::uint64_t nodes = time_nodes(header);
    const auto at = [&]<class T>(Array<T> empty, std::size_t part, std::uint64_t count) {
        using Pointer = typename decltype(empty)::pointer;
        return Array<T>(reinterpret_cast<Pointer>(bytes.data() + offsets[part]), count);
    };
    using Keys = Array<OrderKey>;
    using Numbers = Array<std::uint32_t>;
    return {at(Keys{}, 0, header.elements),
            at(Array<ThiNodeStart>{}, 1, nodes + 1),
            at(Numbers{}, 2, nodes * (header.elements + 1)),
            at(Numbers{}, 3, nodes * header.elements),
            {at(Array<CellId>{}, 4, header.entries), at(Keys{}, 5, header.entries),
             at(Array<CellId>{}, 6, header.entries), at(Keys{}, 7, header.entries)},
            at(Array<IntervalNode>{}, 8, header.interval_nodes)};
}

void require(bool holds, const char* what) {
    if (!holds)
        throw Error("THI tree: {}", what);
}

void check_starts(const ThiHeader& header, std::span<const ThiNodeStart> starts) {
    require(starts.front().entry == 0 && starts.front().interval_node == 0,
            "the first time node does not begin at 0");
    for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
        const std::uint64_t entries = starts[i + 1].entry - starts[i].entry;
        const std::uint64_t nodes = starts[i + 1].interval_node - starts[i].interval_node;
        // If numbers decrease, the difference wraps around and is too large.
        require(entries < IntervalNode::kNone && nodes < IntervalNode::kNone,
                "time nodes out of order");
    }
    require(starts.back().entry == header.entries &&
                starts.back().interval_node == header.interval_nodes,
            "the last time node does not end with the tree");
}

void check_time_node(std::span<const std::uint32_t> row_starts,
                     std::span<const std::uint32_t> roots, std::span<const IntervalNode> nodes,
                     std::uint64_t entries) {
    require(std::is_sorted(row_starts.begin(), row_starts.end()) && row_starts.back() <= entries,
            "rows out of order");
    for (const std::uint32_t root : roots)
        require(root == IntervalNode::kNone || root < nodes.size(), "no such interval tree");
    for (std::size_t number = 0; number < nodes.size(); ++number) {
        const IntervalNode& node = nodes[number];
        require(node.begin <= node.end && node.end <= entries, "interval list out of range");
        for (const std::uint32_t child : {node.left, node.right})
            // Since child numbers only grow, every descent ends.
            require(child == IntervalNode::kNone || (child > number && child < nodes.size()),
                    "interval tree out of order");
    }
}

} // namespace

std::array<std::uint64_t, 10> thi_offsets(const ThiHeader& header, std::uint64_t limit) {
    const std::uint64_t nodes = time_nodes(header);
    const std::array<std::pair<std::uint64_t, std::uint64_t>, 9> parts{
        {{header.elements, sizeof(OrderKey)},
         {nodes + 1, sizeof(ThiNodeStart)},
         {nodes * (std::uint64_t{header.elements} + 1), sizeof(std::uint32_t)},
         {nodes * header.elements, sizeof(std::uint32_t)},
         {header.entries, sizeof(CellId)},
         {header.entries, sizeof(OrderKey)},
         {header.entries, sizeof(CellId)},
         {header.entries, sizeof(OrderKey)},
         {header.interval_nodes, sizeof(IntervalNode)}}};
    std::array<std::uint64_t, 10> offsets{};
    std::uint64_t offset = sizeof(ThiHeader);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto [count, size] = parts[i];
        offsets[i] = offset;
        require(count <= (limit - offset) / size, "larger than its block");
        offset = (offset + count * size + 7) / 8 * 8;
        require(offset <= limit, "larger than its block");
    }
    offsets.back() = offset;
    return offsets;
}

ThiParts<Readable> thi_parts(const ThiHeader& header, std::span<const std::byte> bytes) {
    return parts_of<Readable>(header, bytes);
}

ThiParts<Writable> thi_parts(const ThiHeader& header, std::span<std::byte> bytes) {
    return parts_of<Writable>(header, bytes);
}

ThiHeader check_thi_bytes(std::span<const std::byte> bytes) {
    ThiHeader header;
    require(bytes.size() >= sizeof header, "shorter than its header");
    require(reinterpret_cast<std::uintptr_t>(bytes.data()) % 8 == 0, "not aligned to 8 bytes");
    std::memcpy(&header, bytes.data(), sizeof header);
    require(header.magic == ThiHeader::kMagic, "not a tree of this version");
    require(header.steps >= 1 && header.steps < 1u << 31, "number of steps");
    require(header.lattice >= 1 && header.lattice <= 4096, "lattice not in 1 to 4096");
    require(header.max_variation >= 1 && header.max_variation <= 64,
            "max variation not in 1 to 64");
    require(header.elements <= header.lattice, "more lattice lines than asked for");
    require(thi_offsets(header, bytes.size()).back() == bytes.size(), "its block is too long");

    const ThiParts<Readable> parts = thi_parts(header, bytes);
    check_starts(header, parts.node_starts);
    const std::size_t elements = header.elements;
    for (std::size_t i = 0; i + 1 < parts.node_starts.size(); ++i) {
        const ThiNodeStart start = parts.node_starts[i], end = parts.node_starts[i + 1];
        check_time_node(parts.row_starts.subspan(i * (elements + 1), elements + 1),
                        parts.roots.subspan(i * elements, elements),
                        parts.interval_nodes.subspan(start.interval_node,
                                                     end.interval_node - start.interval_node),
                        end.entry - start.entry);
    }
    return header;
}

} // namespace isochron::index
