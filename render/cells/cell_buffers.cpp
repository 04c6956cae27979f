// Uploads a set to the GPU: finds what changes, sends blocks and cells, then applies all at once.
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

constexpr std::size_t kWord = sizeof(std::uint32_t);
const Slots kNoSlots; ///< for sets of mixed levels: no later set keeps any of their slots

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
      points_(ArrivingSet::points_array(gl)), corners_{corner_values_array(gl),
                                                       corner_gradients_array(gl)},
      corner_colors_(corner_colors_array(gl)),
      arriving_colors_(corner_colors_array(gl)), meshes_{KeptMeshes{MeshBuffers(gl)},
                                                         KeptMeshes{MeshBuffers(gl)},
                                                         KeptMeshes{MeshBuffers(gl)},
                                                         KeptMeshes{MeshBuffers(gl)}},
      surroundings_(gl), arriving_(gl) {}

index::Shading CellBuffers::wanted_shading(const Gl& gl) {
    return is_drawn_for_processor(gl) ? index::Shading::cells : index::Shading::none;
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
        slots->places.push_back({point.x, point.y, point.z, point.style});
        slots->planes.push_back(point.plane);
    }
    cells.slots_ = std::move(slots);
    cells.version_ = next_version();
    return cells;
}

void CellBuffers::prepare(index::ValueType held) {
    blocks_.emplace(*gl_, grid_, held);
    volume_version_ = 0; // no set's volume
    held_ = held;
    const auto [made, is_new] = computes_.try_emplace(held, *gl_, grid_, *axes_, held);
    compute_ = &made->second;
    if (!is_new)
        return;
    const index::Extraction none;
    compute_->enter_pages(*blocks_);
    compute_->place_cells(SlotAssignment(grid_, nullptr, *slots_, none), none, arriving_.message(),
                          points_);
    compute_->set_styles(none, arriving_.styles(), points_);
    compute_->fill_planes(none, *blocks_, points_);
    compute_->fill_corners(none, *blocks_, points_, {0, 0}, {corners_.values, corners_.gradients});
}

/// Makes ready for values of this type; drops blocks of another.
void CellBuffers::hold(index::ValueType held) {
    if (!blocks_ || held_ != held)
        prepare(held);
}

bool CellBuffers::upload(const index::ExtractionPtr& newest, std::size_t byte_budget,
                         SendVolume volume) {
    SendBudget budget{std::max(byte_budget, StagingRing::kUnit)};
    bool changed = false;
    const bool volume_of_shown = !pending() && (sending_blocks_ || !newest || newest == shown_);
    try {
        while (take_up(newest, volume, budget) && send_on(budget)) {
            show();
            changed = true;
        }
        send_later_meshes(budget);
    } catch (const OutOfMemory& why) {
        give_up(pending() ? arriving_.set() : volume_of_shown ? nullptr : newest, why);
    }
    ring_.end_frame();
    return changed;
}

bool CellBuffers::stage(const index::ExtractionPtr& set, std::size_t byte_budget) {
    SendBudget budget{std::max(byte_budget, StagingRing::kUnit)};
    bool complete = false;
    try {
        complete = take_up(set, SendVolume::with_cells, budget)
                       ? send_on(budget)
                       : set == refused() || (set == shown_ && !wants_volume());
    } catch (const OutOfMemory& why) {
        give_up(pending() ? arriving_.set() : set, why);
        complete = true;
    }
    ring_.end_frame();
    return complete;
}

/// Whether the shown set's volume is missing and could be sent.
bool CellBuffers::wants_volume() const {
    return !has_volume() && no_volume_version_ != version_ && !shown_->coarse() &&
           shown_->blocks.ids.size() <= blocks_->values().limit();
}

/// Drops what is being sent: the set, or without one the volume of the shown set.
void CellBuffers::give_up(const index::ExtractionPtr& set, const OutOfMemory& why) {
    if (set && set != shown_) {
        refused_ = {set, fmt::format("step {}: {}, so the last cells stay", set->query.instant.step,
                                     why.what())};
    } else {
        no_volume_version_ = version_;
    }
    arriving_.end();
    sending_blocks_ = false;
    colors_sent_ = 0;
    for (KeptMeshes& meshes : meshes_)
        meshes.sending = false;
    volume_version_ = 0; // no set's volume
    if (blocks_)         // which may have got only a part
        blocks_.emplace(*gl_, grid_, held_);
}

/// Begins to send a new set, or the volume of the shown one, if there is anything to send.
/// @return whether a set is arriving
bool CellBuffers::take_up(const index::ExtractionPtr& newest, SendVolume volume,
                          SendBudget& budget) {
    if (pending())
        return true;
    const bool shown = !newest || newest == shown_ || newest == refused();
    if (sending_blocks_ || (shown && volume == SendVolume::with_cells))
        send_volume_of_shown(budget);
    if (sending_blocks_ || shown)
        return false;
    return begin(newest, volume);
}

/// Drops the blocks of the shown set if both do not fit together.
/// @return false when these blocks alone do not fit
bool CellBuffers::make_room_for(const index::VolumeBlocks& blocks) {
    if (blocks.ids.size() > blocks_->values().limit())
        return false;
    if (!blocks_->has_room_for(blocks)) {
        blocks_->forget();
        volume_version_ = 0; // no set's volume
    }
    return true;
}

/// @return false when the set is refused
bool CellBuffers::begin(index::ExtractionPtr set, SendVolume volume) {
    hold(set->blocks.held);
    const bool with_points = set->shaded();
    refused_ = {};
    std::string why;
    if (set->cells() > points_.limit())
        why = fmt::format("{} cells at step {}: this GL can draw at most {}, so the last ones stay",
                          set->cells(), set->query.instant.step, points_.limit());
    else if (!with_points && !set->coarse() && !make_room_for(set->blocks))
        why =
            fmt::format("{} blocks of the volume at step {}: this GL holds at most {}, so the "
                        "last cells stay",
                        set->blocks.ids.size(), set->query.instant.step, blocks_->values().limit());
    if (!why.empty()) {
        refused_ = {std::move(set), std::move(why)};
        return false;
    }
    if (set->coarse() ||
        (with_points && volume == SendVolume::with_cells && !make_room_for(set->blocks)))
        volume = SendVolume::never;
    std::unique_ptr<SlotAssignment> assignment;
    if (!with_points)
        assignment = !by_changes_ || (shown_ && shown_->coarse())
                   ? std::make_unique<SlotAssignment>(grid_, nullptr, kNoSlots, *set)
                   : std::make_unique<SlotAssignment>(grid_, shown_.get(), *slots_, *set);
    sending_blocks_ = volume == SendVolume::with_cells || !with_points;
    colors_sent_ = 0;
    if (sending_blocks_)
        blocks_->begin(set->blocks);
    for (KeptMeshes& meshes : meshes_)
        meshes.sending = &meshes == &meshes_[0] && with_points && set->meshed();
    if (meshes_[0].sending)
        meshes_[0].buffers.begin(set->meshes(0));
    arriving_.begin(std::move(set), std::move(assignment));
    return true;
}

/// Sends more of the arriving set. @return whether all of it is on the GPU
bool CellBuffers::send_on(SendBudget& budget) {
    if (!arriving_.send_points(budget, count_))
        return false;
    if (sending_blocks_ && !send_blocks(budget))
        return false;
    if (meshes_[0].sending && !send_mesh(0, budget))
        return false;
    const bool ranked = arriving_.comes_with_points();
    if (!ranked && !arriving_.send_changes(ring_, budget, count_))
        return false;
    return !sending_blocks_ ||
           send_colors(*arriving_.set(), ranked ? kNoSlots : arriving_.assignment().slots(), ranked,
                       budget);
}

/// Sends the colors at the vertices of cells. @param ranked cells' slots are their ranks
/// @return whether all are on the GPU
bool CellBuffers::send_colors(const index::Extraction& set, const Slots& slots, bool ranked,
                              SendBudget& budget) {
    constexpr std::size_t kOfCell = 8, kBytes = kOfCell * sizeof(std::uint16_t);
    const std::size_t cells = set.corner_colors.size() / kOfCell;
    if (cells == 0)
        return true;
    if (colors_sent_ == 0) {
        arriving_colors_.reserve(cells, DeviceArray::Contents::dropped);
        colors_by_slot_.resize(ranked ? 0 : set.corner_colors.size());
        for (std::size_t rank = 0; !ranked && rank < cells; ++rank)
            std::copy_n(&set.corner_colors[kOfCell * rank], kOfCell,
                        &colors_by_slot_[kOfCell * slots.slot_of(rank)]);
    }
    const std::span<const std::uint16_t> all = ranked ? set.corner_colors : colors_by_slot_;
    const std::size_t part = std::min(budget.left() / kBytes, cells - colors_sent_);
    gl_->NamedBufferSubData(arriving_colors_.buffer(), static_cast<GLintptr>(colors_sent_ * kBytes),
                            static_cast<GLsizeiptr>(part * kBytes), &all[kOfCell * colors_sent_]);
    colors_sent_ += part;
    budget.sent += part * kBytes;
    count_.color_bytes += part * kBytes;
    return colors_sent_ == cells;
}

/// @return whether all blocks are on the GPU
bool CellBuffers::send_blocks(SendBudget& budget) {
    if (!blocks_->complete()) {
        const std::size_t part = blocks_->send(ring_, budget.left());
        budget.sent += part;
        count_.block_bytes += part;
    }
    return blocks_->complete();
}

/// @return whether all meshes of the level are on the GPU
bool CellBuffers::send_mesh(std::size_t level, SendBudget& budget) {
    MeshBuffers& mesh = meshes_[level].buffers;
    if (!mesh.complete() && budget.left() > 0) {
        const std::size_t part = mesh.send(budget.left());
        budget.sent += part;
        count_.mesh_bytes += part;
    }
    return mesh.complete();
}

/// The meshes of the shown set that come later, once they are made, the smallest first.
void CellBuffers::send_later_meshes(SendBudget& budget) {
    for (std::size_t level = meshes_.size();
         shown_ && shown_->shaded() && !pending() && level-- > 0;) {
        KeptMeshes& kept = meshes_[level];
        if (kept.version == version_)
            continue;
        if (!kept.sending) {
            std::vector<index::CellMeshPtr> made = shown_->meshes(level);
            if (made.empty())
                return;
            kept.buffers.begin(std::move(made));
            kept.sending = true;
        }
        if (!send_mesh(level, budget))
            return;
        kept.buffers.show();
        kept.sending = false;
        kept.version = version_;
    }
}

/// Like a set, a volume whose transfer has begun is completed before a newer set begins.
void CellBuffers::send_volume_of_shown(SendBudget& budget) {
    if (!shown_ || has_volume() || no_volume_version_ == version_ || shown_->coarse())
        return;
    if (!sending_blocks_) {
        hold(shown_->blocks.held);
        if (!make_room_for(shown_->blocks))
            return;
        sending_blocks_ = true;
        colors_sent_ = 0;
        blocks_->begin(shown_->blocks);
    }
    if (!send_blocks(budget) || !send_colors(*shown_, *slots_, shown_->shaded(), budget))
        return;
    std::swap(corner_colors_, arriving_colors_);
    compute_->enter_pages(*blocks_);
    blocks_->show();
    sending_blocks_ = false;
    volume_version_ = version_;
}

void CellBuffers::show() {
    if (sending_blocks_)
        compute_->enter_pages(*blocks_);
    count_.whole_ids += arriving_.set()->cells();
    slots_ = std::make_shared<const Slots>(
        arriving_.comes_with_points() ? arriving_.swap_points(points_) : place_cells());
    if (sending_blocks_)
        blocks_->show();
    ++count_.sets;
    shown_ = arriving_.end();
    version_ = next_version();
    count_.surrounding_bytes += surroundings_.show(shown_->surroundings);
    if (std::exchange(sending_blocks_, false)) {
        volume_version_ = version_;
        std::swap(corner_colors_, arriving_colors_);
    }
    if (std::exchange(meshes_[0].sending, false)) {
        meshes_[0].buffers.show();
        meshes_[0].version = version_;
    }
}

/// Applies the changes of the arriving set. @return the new slots
Slots CellBuffers::place_cells() {
    const index::Extraction& set = *arriving_.set();
    SlotAssignment& assignment = arriving_.assignment();
    points_.reserve(set.cells(), DeviceArray::Contents::kept);
    compute_->place_cells(assignment, set, arriving_.message(), points_);
    if (!set.colors.empty() || (shown_ && !shown_->colors.empty()))
        compute_->set_styles(set, arriving_.styles(), points_);
    compute_->fill_planes(set, *blocks_, points_);
    count_.ids += assignment.ids();
    return assignment.take();
}

std::size_t CellBuffers::compute_corners(std::size_t most) {
    if (!shown_)
        return 0;
    const std::size_t cells = shown_->cells();
    if (corners_.version != version_) {
        assert(has_volume());
        corners_.values.reserve(cells, DeviceArray::Contents::dropped);
        corners_.gradients.reserve(cells, DeviceArray::Contents::dropped);
        corners_.version = version_;
        corners_.done = 0;
    }
    const std::size_t count = std::min(most, cells - corners_.done);
    if (count > 0)
        compute_->fill_corners(*shown_, *blocks_, points_, {corners_.done, count},
                               {corners_.values, corners_.gradients});
    corners_.done += count;
    return count;
}

void CellBuffers::write_corners(DrawPart cells, const CellCompute::Corners& to) const {
    assert(has_volume());
    compute_->fill_corners(*shown_, *blocks_, points_, cells, to);
}

DeviceArray CellBuffers::corner_values_array(const Gl& gl) {
    return {gl, "cells", GL_RGBA32F, 4 * sizeof(float), 2, DeviceArray::Storage::none};
}

DeviceArray CellBuffers::corner_colors_array(const Gl& gl) {
    return {gl, "cells", GL_RGBA32UI, 4 * kWord, 1, DeviceArray::Storage::none};
}

DeviceArray CellBuffers::corner_gradients_array(const Gl& gl) {
    return {gl, "cells", GL_RGBA32UI, 4 * kWord, 4, DeviceArray::Storage::none};
}

} // namespace isochron::render
