// Uploads a set to the GPU: finds what changes, sends bricks and cells, then applies all at once.
#include "render/cells/cell_buffers.h"

#include "render/gl/driver.h"
#include "render/gl/driver_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <utility>

namespace isochron::render {
namespace {

/// Most cells handled in one call (about 1 ms), so that a large set does not delay a frame.
constexpr std::size_t kIdsLookedAt = 1 << 18;
constexpr std::size_t kWord = sizeof(std::uint32_t);
const Slots kNoSlots; ///< of which a set of mixed levels has none that others could keep

/// Unique among all buffers: the address alone would not do, as new buffers may reuse it.
std::uint64_t next_version() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

std::size_t rounded_to_units(std::size_t bytes) {
    return (bytes + StagingRing::kUnit - 1) / StagingRing::kUnit * StagingRing::kUnit;
}

} // namespace

CellBuffers::CellBuffers(const Gl& gl, const index::Grid& grid, std::size_t staging_bytes)
    : gl_(&gl), grid_(grid), axes_(std::make_unique<AxisTable>(gl, grid)),
      ring_(gl, rounded_to_units(staging_bytes), passes_fences(gl) ? Fences::pass : Fences::never),
      points_(points_array(gl)), next_points_(points_array(gl)),
      message_(gl, "changed cells", GL_R32UI, kWord, 1, DeviceArray::Storage::whole),
      styles_(gl, "colored cells", GL_R32UI, kWord, 1, DeviceArray::Storage::whole),
      corner_values_(corner_values_array(gl)), corner_gradients_(corner_gradients_array(gl)),
      mesh_(gl), surroundings_(gl) {}

index::Shading CellBuffers::wanted_shading(const Gl& gl) {
    return takes_processor_ways(gl) ? index::Shading::cells : index::Shading::none;
}

CellBuffers CellBuffers::of_points(const Gl& gl, std::span<const index::CellPoint> points,
                                   const index::Grid& grid, std::uint32_t largest) {
    CellBuffers cells(gl, grid, 2 * StagingRing::kUnit);
    cells.points_.reserve(points.size(), DeviceArray::Contents::dropped);
    gl.NamedBufferSubData(cells.points_.buffer(), 0, static_cast<GLsizeiptr>(points.size_bytes()),
                          points.data());
    auto slots = std::make_shared<Slots>();
    slots->largest = largest;
    for (const index::CellPoint& point : points) {
        slots->slot_of_rank.push_back(static_cast<std::uint32_t>(slots->places.size()));
        slots->places.push_back({point.x, point.y, point.z, point.style});
        slots->planes.push_back(point.plane);
    }
    cells.slots_ = std::move(slots);
    cells.version_ = next_version();
    return cells;
}

void CellBuffers::prepare(index::ValueType held) {
    bricks_.emplace(*gl_, grid_, held);
    volume_version_ = 0; // of no set
    held_ = held;
    const auto [made, is_new] = computes_.try_emplace(held, *gl_, grid_, *axes_, held);
    compute_ = &made->second;
    if (!is_new)
        return;
    const index::Extraction none;
    compute_->enter_pages(*bricks_);
    compute_->place_cells(SlotPlan(grid_, nullptr, *slots_, none), none, message_, points_);
    compute_->set_styles(none, styles_, points_);
    compute_->fill_planes(none, *bricks_, points_);
    compute_->fill_corners(none, *bricks_, points_, {0, 0}, {corner_values_, corner_gradients_});
}

/// Makes ready for values of this type; drops bricks of another.
void CellBuffers::hold(index::ValueType held) {
    if (!bricks_ || held_ != held)
        prepare(held);
}

bool CellBuffers::upload(const index::ExtractionPtr& newest, std::size_t byte_budget,
                         SendVolume volume) {
    const std::size_t most = std::max(byte_budget, StagingRing::kUnit);
    std::size_t sent = 0;
    bool changed = false;
    const bool volume_of_shown = !arriving_ && (sending_bricks_ || !newest || newest == shown_);
    try {
        while (take_up(newest, volume, most, sent) && send_on(most, sent)) {
            show();
            changed = true;
        }
    } catch (const OutOfMemory& why) {
        give_up(arriving_ ? arriving_ : volume_of_shown ? nullptr : newest, why);
    }
    ring_.end_frame();
    return changed;
}

bool CellBuffers::stage(const index::ExtractionPtr& set, std::size_t byte_budget) {
    const std::size_t most = std::max(byte_budget, StagingRing::kUnit);
    std::size_t sent = 0;
    bool complete = false;
    try {
        complete = take_up(set, SendVolume::with_cells, most, sent)
                       ? send_on(most, sent)
                       : set == refused_ || (set == shown_ && !wants_volume());
    } catch (const OutOfMemory& why) {
        give_up(arriving_ ? arriving_ : set, why);
        complete = true;
    }
    ring_.end_frame();
    return complete;
}

/// Whether the shown set's volume is missing and could be sent.
bool CellBuffers::wants_volume() const {
    return !has_volume() && no_volume_version_ != version_ && !shown_->coarse() &&
           shown_->bricks.ids.size() <= bricks_->values().limit();
}

/// Drops what is being sent: the set, or without one the volume of the shown set.
void CellBuffers::give_up(const index::ExtractionPtr& set, const OutOfMemory& why) {
    if (set && set != shown_) {
        refused_ = set;
        refusal_ = fmt::format("step {}: {}, so the last cells stay", set->query.step, why.what());
    } else {
        no_volume_version_ = version_;
    }
    arriving_ = nullptr;
    ranked_ = nullptr;
    plan_ = nullptr;
    sending_bricks_ = sending_mesh_ = false;
    volume_version_ = 0; // of no set
    if (bricks_)         // which may have got only a part
        bricks_.emplace(*gl_, grid_, held_);
}

/// Begins to send a new set, or the volume of the shown one, if there is anything to send.
/// @return whether a set is arriving
bool CellBuffers::take_up(const index::ExtractionPtr& newest, SendVolume volume, std::size_t bytes,
                          std::size_t& sent) {
    if (arriving_)
        return true;
    const bool shown = !newest || newest == shown_ || newest == refused_;
    if (sending_bricks_ || (shown && volume == SendVolume::with_cells))
        send_volume_of_shown(bytes, sent);
    if (sending_bricks_ || shown)
        return false;
    return begin(newest, volume);
}

/// Drops the bricks of the shown set if both do not fit together.
/// @return false when these bricks alone do not fit
bool CellBuffers::make_room_for(const index::VolumeBricks& bricks) {
    if (bricks.ids.size() > bricks_->values().limit())
        return false;
    if (!bricks_->has_room_for(bricks)) {
        bricks_->forget();
        volume_version_ = 0; // of no set
    }
    return true;
}

/// @return false when the set is refused
bool CellBuffers::begin(index::ExtractionPtr set, SendVolume volume) {
    hold(set->bricks.held);
    const bool with_points = set->shaded();
    refused_ = nullptr;
    refusal_.clear();
    if (set->cells() > points_.limit())
        refusal_ = fmt::format("{} cells at step {}: this GL can draw at most {}, so the last ones "
                               "stay",
                               set->cells(), set->query.step, points_.limit());
    else if (!with_points && !set->coarse() && !make_room_for(set->bricks))
        refusal_ = fmt::format("{} bricks of the volume at step {}: this GL holds at most {}, so "
                               "the last cells stay",
                               set->bricks.ids.size(), set->query.step, bricks_->values().limit());
    if (!refusal_.empty()) {
        refused_ = std::move(set);
        return false;
    }
    if (set->coarse() ||
        (with_points && volume == SendVolume::with_cells && !make_room_for(set->bricks)))
        volume = SendVolume::never;
    if (with_points)
        ranked_ = std::make_unique<RankedPoints>(*set);
    else
        plan_ = !by_changes_ || (shown_ && shown_->coarse())
                    ? std::make_unique<SlotPlan>(grid_, nullptr, kNoSlots, *set)
                    : std::make_unique<SlotPlan>(grid_, shown_.get(), *slots_, *set);
    merged_ = false;
    words_sent_ = styles_sent_ = 0;
    sending_bricks_ = volume == SendVolume::with_cells || !ranked_;
    if (sending_bricks_)
        bricks_->begin(set->bricks);
    sending_mesh_ = ranked_ && set->meshed();
    if (sending_mesh_)
        mesh_.begin(*set);
    arriving_ = std::move(set);
    return true;
}

/// Sends more of the arriving set. @return whether all of it is on the GPU
bool CellBuffers::send_on(std::size_t bytes, std::size_t& sent) {
    merged_ = merged_ || (ranked_ ? send_points(bytes, sent) : plan_->merge(kIdsLookedAt));
    if (!merged_)
        return false;
    if (sending_bricks_ && !send_bricks(bytes, sent))
        return false;
    if (sending_mesh_ && !send_mesh(bytes, sent))
        return false;
    return ranked_ || (send_message(bytes, sent) && send_styles(bytes, sent));
}

/// Sends points where the shown ones are not. @return whether all are on the GPU
bool CellBuffers::send_points(std::size_t bytes, std::size_t& sent) {
    const std::size_t all = arriving_->cells(), first = ranked_->given();
    const std::size_t most = std::min(kIdsLookedAt, (bytes - sent) / sizeof(index::CellPoint));
    next_points_.reserve(all, DeviceArray::Contents::dropped);
    const std::span<const index::CellPoint> points = ranked_->next(most);
    gl_->NamedBufferSubData(next_points_.buffer(),
                            static_cast<GLintptr>(first * sizeof(index::CellPoint)),
                            static_cast<GLsizeiptr>(points.size_bytes()), points.data());
    count_.ids += points.size();
    count_.id_bytes += points.size_bytes();
    sent += points.size_bytes();
    return ranked_->given() == all;
}

/// @return whether all bricks are on the GPU
bool CellBuffers::send_bricks(std::size_t bytes, std::size_t& sent) {
    if (!bricks_->complete()) {
        const std::size_t part = bricks_->send(ring_, bytes - sent);
        sent += part;
        count_.brick_bytes += part;
    }
    return bricks_->complete();
}

/// @return whether the whole mesh is on the GPU
bool CellBuffers::send_mesh(std::size_t bytes, std::size_t& sent) {
    if (!mesh_.complete() && sent < bytes) {
        const std::size_t part = mesh_.send(bytes - sent);
        sent += part;
        count_.mesh_bytes += part;
    }
    return mesh_.complete();
}

/// Like a set, a volume whose transfer has begun is completed before a newer set begins.
void CellBuffers::send_volume_of_shown(std::size_t bytes, std::size_t& sent) {
    if (!shown_ || has_volume() || no_volume_version_ == version_ || shown_->coarse())
        return;
    if (!sending_bricks_) {
        hold(shown_->bricks.held);
        if (!make_room_for(shown_->bricks))
            return;
        sending_bricks_ = true;
        bricks_->begin(shown_->bricks);
    }
    if (!send_bricks(bytes, sent))
        return;
    compute_->enter_pages(*bricks_);
    bricks_->show();
    sending_bricks_ = false;
    volume_version_ = version_;
}

bool CellBuffers::send_message(std::size_t bytes, std::size_t& sent) {
    message_.reserve(plan_->words(), DeviceArray::Contents::dropped);
    std::size_t cells = kIdsLookedAt;
    while (!plan_->done()) {
        const std::size_t rest = (plan_->words() - words_sent_) * kWord;
        const std::size_t most = std::min(bytes - sent, rest);
        const std::span<std::byte> room = ring_.room(most);
        const std::size_t words = plan_->message(
            {reinterpret_cast<std::uint32_t*>(room.data()), std::min(room.size(), most) / kWord},
            cells);
        if (words == 0)
            break;
        ring_.copy(words * kWord, message_.buffer(), words_sent_ * kWord);
        words_sent_ += words;
        sent += words * kWord;
        count_.id_bytes += words * kWord;
    }
    return plan_->done();
}

/// Styles also change in cells that stay, so they are sent for all cells, in the order of slots.
bool CellBuffers::send_styles(std::size_t bytes, std::size_t& sent) {
    constexpr std::size_t kStyle = sizeof(CellPlace::style);
    if (arriving_->colors.empty())
        return true;
    const std::span<const CellPlace> places = plan_->slots().places;
    styles_.reserve((places.size() * kStyle + kWord - 1) / kWord, DeviceArray::Contents::dropped);
    while (styles_sent_ < places.size()) {
        const auto rest = places.subspan(styles_sent_);
        const std::size_t most = std::min(bytes - sent, rest.size() * kStyle);
        const std::span<std::byte> room = ring_.room(most);
        const std::size_t count = std::min(room.size(), most) / kStyle;
        if (count == 0)
            return false;
        std::ranges::transform(rest.first(count), reinterpret_cast<std::uint16_t*>(room.data()),
                               &CellPlace::style);
        ring_.copy(count * kStyle, styles_.buffer(), styles_sent_ * kStyle);
        styles_sent_ += count;
        sent += count * kStyle;
        count_.color_bytes += count * kStyle;
    }
    return true;
}

void CellBuffers::show() {
    if (sending_bricks_)
        compute_->enter_pages(*bricks_);
    count_.whole_ids += arriving_->cells();
    slots_ = std::make_shared<const Slots>(ranked_ ? take_points() : place_cells());
    if (sending_bricks_)
        bricks_->show();
    ++count_.sets;
    ranked_ = nullptr;
    plan_ = nullptr;
    shown_ = std::move(arriving_);
    arriving_ = nullptr;
    version_ = next_version();
    count_.surrounding_bytes += surroundings_.show(shown_->surroundings);
    if (std::exchange(sending_bricks_, false))
        volume_version_ = version_;
    if (std::exchange(sending_mesh_, false)) {
        mesh_.show();
        mesh_version_ = version_;
    }
}

/// Turns to the points of the arriving set. @return their slots
Slots CellBuffers::take_points() {
    std::swap(points_, next_points_);
    return ranked_->take();
}

/// Applies the message of the arriving set. @return the new slots
Slots CellBuffers::place_cells() {
    points_.reserve(arriving_->cells(), DeviceArray::Contents::kept);
    compute_->place_cells(*plan_, *arriving_, message_, points_);
    if (!arriving_->colors.empty() || (shown_ && !shown_->colors.empty()))
        compute_->set_styles(*arriving_, styles_, points_);
    compute_->fill_planes(*arriving_, *bricks_, points_);
    count_.ids += plan_->ids();
    return plan_->take();
}

std::size_t CellBuffers::compute_corners(std::size_t most) {
    if (!shown_)
        return 0;
    const std::size_t cells = shown_->cells();
    if (corners_version_ != version_) {
        assert(has_volume());
        corner_values_.reserve(cells, DeviceArray::Contents::dropped);
        corner_gradients_.reserve(cells, DeviceArray::Contents::dropped);
        corners_version_ = version_;
        corners_done_ = 0;
    }
    const std::size_t count = std::min(most, cells - corners_done_);
    if (count > 0)
        compute_->fill_corners(*shown_, *bricks_, points_, {corners_done_, count},
                               {corner_values_, corner_gradients_});
    corners_done_ += count;
    return count;
}

void CellBuffers::write_corners(DrawPart cells, const CellCompute::Corners& to) const {
    assert(has_volume());
    compute_->fill_corners(*shown_, *bricks_, points_, cells, to);
}

DeviceArray CellBuffers::points_array(const Gl& gl) {
    return {gl, "cells", GL_RGB32UI, sizeof(index::CellPoint), 1, DeviceArray::Storage::whole};
}

DeviceArray CellBuffers::corner_values_array(const Gl& gl) {
    return {gl, "cells", GL_RGBA32F, 4 * sizeof(float), 2, DeviceArray::Storage::none};
}

DeviceArray CellBuffers::corner_gradients_array(const Gl& gl) {
    return {gl, "cells", GL_RGBA32UI, 4 * kWord, 4, DeviceArray::Storage::none};
}

} // namespace isochron::render
