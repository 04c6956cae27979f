// Sends the cells of a set in pieces.
#include "render/cells/arriving_set.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace isochron::render {
namespace {

/// Most cells handled in one call (about 1 ms), so that a large set does not delay a frame.
constexpr std::size_t kIdsLookedAt = 1 << 18;
constexpr std::size_t kMessageWord = sizeof(std::uint32_t);
/// More points than these are not kept for the next set: with a driver that draws on the processor
/// they are the process's memory.
constexpr std::size_t kPointsKept = (std::size_t{8} << 20) / sizeof(index::CellPoint);

} // namespace

ArrivingSet::ArrivingSet(const Gl& gl)
    : gl_(&gl), points_(points_array(gl)),
      message_(gl, "changed cells", GL_R32UI, kMessageWord, 1, DeviceArray::Storage::whole),
      styles_(gl, "colored cells", GL_R32UI, kMessageWord, 1, DeviceArray::Storage::whole) {}

void ArrivingSet::begin(index::ExtractionPtr set, std::unique_ptr<SlotAssignment> assignment) {
    ranked_ = assignment ? nullptr : std::make_unique<RankedPoints>(*set);
    assignment_ = std::move(assignment);
    merged_ = false;
    words_sent_ = styles_sent_ = 0;
    set_ = std::move(set);
}

index::ExtractionPtr ArrivingSet::end() {
    ranked_ = nullptr;
    assignment_ = nullptr;
    return std::exchange(set_, nullptr);
}

bool ArrivingSet::send_points(SendBudget& budget, UploadCount& count) {
    if (!merged_ && !ranked_)
        merged_ = assignment_->merge(kIdsLookedAt);
    if (merged_)
        return true;
    if (!ranked_)
        return false;
    const std::size_t all = set_->cells(), first = ranked_->given();
    const std::size_t most = std::min(kIdsLookedAt, budget.left() / sizeof(index::CellPoint));
    points_.reserve(all, DeviceArray::Contents::dropped);
    const std::span<const index::CellPoint> points = ranked_->next(most);
    gl_->NamedBufferSubData(points_.buffer(),
                            static_cast<GLintptr>(first * sizeof(index::CellPoint)),
                            static_cast<GLsizeiptr>(points.size_bytes()), points.data());
    count.ids += points.size();
    count.id_bytes += points.size_bytes();
    budget.sent += points.size_bytes();
    merged_ = ranked_->given() == all;
    return merged_;
}

bool ArrivingSet::send_changes(StagingRing& ring, SendBudget& budget, UploadCount& count) {
    return send_message(ring, budget, count) && send_styles(ring, budget, count);
}

bool ArrivingSet::send_message(StagingRing& ring, SendBudget& budget, UploadCount& count) {
    message_.reserve(assignment_->words(), DeviceArray::Contents::dropped);
    std::size_t cells = kIdsLookedAt;
    while (!assignment_->done()) {
        const std::size_t rest = (assignment_->words() - words_sent_) * kMessageWord;
        const std::size_t most = std::min(budget.left(), rest);
        const std::span<std::byte> room = ring.room(most);
        const std::size_t words =
            assignment_->message({reinterpret_cast<std::uint32_t*>(room.data()),
                                  std::min(room.size(), most) / kMessageWord},
                                 cells);
        if (words == 0)
            break;
        ring.copy(words * kMessageWord, message_.buffer(), words_sent_ * kMessageWord);
        words_sent_ += words;
        budget.sent += words * kMessageWord;
        count.id_bytes += words * kMessageWord;
    }
    return assignment_->done();
}

/// Styles also change in cells that stay, so they are sent for all cells, in the order of slots.
bool ArrivingSet::send_styles(StagingRing& ring, SendBudget& budget, UploadCount& count) {
    constexpr std::size_t kStyle = sizeof(CellPlace::style);
    if (set_->colors.empty())
        return true;
    const std::span<const CellPlace> places = assignment_->slots().places;
    styles_.reserve((places.size() * kStyle + kMessageWord - 1) / kMessageWord,
                    DeviceArray::Contents::dropped);
    while (styles_sent_ < places.size()) {
        const auto rest = places.subspan(styles_sent_);
        const std::size_t most = std::min(budget.left(), rest.size() * kStyle);
        const std::span<std::byte> room = ring.room(most);
        const std::size_t cells = std::min(room.size(), most) / kStyle;
        if (cells == 0)
            return false;
        std::ranges::transform(rest.first(cells), reinterpret_cast<std::uint16_t*>(room.data()),
                               &CellPlace::style);
        ring.copy(cells * kStyle, styles_.buffer(), styles_sent_ * kStyle);
        styles_sent_ += cells;
        budget.sent += cells * kStyle;
        count.color_bytes += cells * kStyle;
    }
    return true;
}

Slots ArrivingSet::swap_points(DeviceArray& points) {
    std::swap(points, points_);
    if (points_.capacity() > kPointsKept)
        points_ = points_array(*gl_);
    return ranked_->take();
}

DeviceArray ArrivingSet::points_array(const Gl& gl) {
    return {gl, "cells", GL_RGB32UI, sizeof(index::CellPoint), 1, DeviceArray::Storage::whole};
}

} // namespace isochron::render
