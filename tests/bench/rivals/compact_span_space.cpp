// A span space whose AL and DR share their ids.
#include "tests/bench/rivals/compact_span_space.h"

#include "tests/bench/rivals/owned_lists.h"

#include <algorithm>
#include <cstring>

namespace isochron::bench {

using index::CellId;
using index::IntervalNode;
using index::OrderKey;

namespace {

/// Calls `f` with the narrowest type that counts below `length`.
template <class F>
void visit_place_type(std::uint32_t length, F&& f) {
    if (length <= 1u << 8)
        f(std::uint8_t{});
    else if (length <= 1u << 16)
        f(std::uint16_t{});
    else
        f(std::uint32_t{});
}

} // namespace

CompactSpanSpace::CompactSpanSpace(std::vector<index::Interval> entries,
                                   std::span<const OrderKey> lines)
    : lines_(lines), roots_(lines.size()) {
    OwnedLists lists(entries.size());
    std::vector<std::uint32_t> row_starts(lines.size() + 1);
    index::build_span_space(std::move(entries), {lines, row_starts, roots_, lists.writable()},
                            tree_);
    const auto [low_ids, low_keys, high_ids, high_keys] = lists.readable();
    ids_.assign(low_ids.begin(), low_ids.end());
    lists_.reserve(lines.size() + tree_.size());
    for (std::size_t row = 0; row < lines.size(); ++row)
        lists_.push_back(
            add(row_starts[row],
                lists.readable().part(row_starts[row], row_starts[row + 1] - row_starts[row])));
    for (const IntervalNode& node : tree_)
        lists_.push_back(add(node.begin, lists.readable().part(node.begin, node.end - node.begin)));
}

CompactSpanSpace::List CompactSpanSpace::add(std::uint32_t begin,
                                             const index::Lists<index::Readable>& lists) {
    const auto length = static_cast<std::uint32_t>(lists.low_ids.size());
    List list{begin, begin + length, static_cast<std::uint32_t>(places_.size()),
              add_keys(lists.low_keys), add_keys(lists.high_keys)};
    // Where every cell of the list is in AL, in the order of the ids.
    std::vector<std::pair<CellId, std::uint32_t>> place_of(length);
    for (std::uint32_t i = 0; i < length; ++i)
        place_of[i] = {lists.low_ids[i], i};
    std::sort(place_of.begin(), place_of.end());
    visit_place_type(length, [&]<class Place>(Place) {
        places_.resize(places_.size() + length * sizeof(Place));
        std::uint8_t* out = places_.data() + list.places;
        for (const CellId id : lists.high_ids) {
            const auto found =
                std::lower_bound(place_of.begin(), place_of.end(), std::pair{id, 0u});
            const auto place = static_cast<Place>(found->second);
            std::memcpy(out, &place, sizeof place);
            out += sizeof place;
        }
    });
    return list;
}

CompactSpanSpace::Keys CompactSpanSpace::add_keys(std::span<const OrderKey> keys) {
    std::vector<OrderKey> distinct;
    std::vector<std::uint32_t> ends;
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
        if (distinct.empty() || distinct.back() != keys[i]) {
            distinct.push_back(keys[i]);
            ends.push_back(i);
        }
        ends.back() = i + 1;
    }
    const auto begin = static_cast<std::uint32_t>(keys_.size());
    if (2 * distinct.size() < keys.size()) {
        keys_.insert(keys_.end(), distinct.begin(), distinct.end());
        keys_.insert(keys_.end(), ends.begin(), ends.end());
        return {begin, static_cast<std::uint32_t>(distinct.size())};
    }
    keys_.insert(keys_.end(), keys.begin(), keys.end());
    return {begin, static_cast<std::uint32_t>(keys.size())};
}

std::uint64_t CompactSpanSpace::bytes() const {
    return roots_.size() * sizeof(std::uint32_t) + tree_.size() * sizeof(IntervalNode) +
           lists_.size() * sizeof(List) + ids_.size() * sizeof(CellId) + places_.size() +
           keys_.size() * sizeof(std::uint32_t);
}

/// Number of entries of a list before the first key that is not `before`.
template <class Before>
std::uint32_t CompactSpanSpace::prefix(const List& list, const Keys& keys, Before&& before) const {
    const std::uint32_t* first = keys_.data() + keys.begin;
    const auto distinct =
        static_cast<std::uint32_t>(std::partition_point(first, first + keys.count, before) - first);
    if (keys.count == list.length() || distinct == 0)
        return distinct;
    return first[keys.count + distinct - 1];
}

void CompactSpanSpace::collect_low(const List& list, OrderKey threshold,
                                   std::vector<CellId>& out) const {
    const auto count = prefix(list, list.low, [&](OrderKey key) { return key < threshold; });
    const CellId* first = ids_.data() + list.begin;
    out.insert(out.end(), first, first + count);
}

void CompactSpanSpace::collect_high(const List& list, OrderKey threshold,
                                    std::vector<CellId>& out) const {
    const auto count = prefix(list, list.high, [&](OrderKey key) { return key >= threshold; });
    const CellId* ids = ids_.data() + list.begin;
    const std::size_t before = out.size();
    out.resize(before + count);
    visit_place_type(list.length(), [&]<class Place>(Place place) {
        for (std::uint32_t i = 0; i < count; ++i) {
            std::memcpy(&place, places_.data() + list.places + i * sizeof place, sizeof place);
            out[before + i] = ids[place];
        }
    });
}

void CompactSpanSpace::search(OrderKey threshold, std::vector<CellId>& out) const {
    const auto list_of = [&](const IntervalNode& node) -> const List& {
        return lists_[lines_.size() + static_cast<std::size_t>(&node - tree_.data())];
    };
    index::visit_span_space(
        lines_, threshold, [&](std::size_t row) { collect_low(lists_[row], threshold, out); },
        [&](std::size_t row) { collect_high(lists_[row], threshold, out); },
        [&](std::size_t row) {
            index::visit_interval_tree(
                tree_, roots_[row], threshold,
                [&](const IntervalNode& node) { collect_low(list_of(node), threshold, out); },
                [&](const IntervalNode& node) { collect_high(list_of(node), threshold, out); });
        });
}

} // namespace isochron::bench
