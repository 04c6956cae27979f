// Assigns slots to volume blocks, and sends those that are missing.
#include "render/cells/block_pool.h"

#include <algorithm>
#include <span>

namespace isochron::render {
namespace {

constexpr std::size_t kFirstCapacity = 64; ///< blocks
/// Most blocks handled in one call, so that a large set does not delay a frame.
constexpr std::size_t kLookedAt = 1 << 16;

struct Format {
    GLenum texel;
    std::size_t bytes;
};
Format format_of(index::ValueType held) {
    switch (held) {
    case index::ValueType::i8: return {GL_R8I, 1};
    case index::ValueType::u8: return {GL_R8UI, 1};
    case index::ValueType::i16: return {GL_R16I, 2};
    case index::ValueType::u16: return {GL_R16UI, 2};
    default: return {GL_R32F, 4};
    }
}

} // namespace

BlockPool::BlockPool(const Gl& gl, const index::Grid& grid, index::ValueType held)
    : values_(gl, "blocks of a set", format_of(held).texel, format_of(held).bytes,
              index::kBlockVertices, DeviceArray::Storage::none),
      pages_(gl, "blocks of the volume", GL_R32UI, sizeof(std::uint32_t), 1,
             DeviceArray::Storage::whole),
      page_message_(gl, "changed blocks", GL_RG32UI, 2 * sizeof(std::uint32_t), 1,
                    DeviceArray::Storage::whole),
      slot_of_(index::BlockTiling(grid).count(), kNoSlot) {
    pages_.reserve(slot_of_.size(), DeviceArray::Contents::dropped);
}

void BlockPool::begin(const index::VolumeBlocks& blocks) {
    ++set_;
    blocks_ = &blocks;
    arriving_.clear();
    arriving_.reserve(blocks.ids.size());
    page_words_.clear();
    sending_ = false;
    pages_sent_ = 0;
}

bool BlockPool::has_room_for(const index::VolumeBlocks& blocks) const {
    std::size_t more = 0;
    for (std::size_t i = 0; i < blocks.ids.size(); ++i) {
        const std::uint32_t slot = slot_of_[blocks.ids[i]];
        more += slot == kNoSlot || held_[slot].digest != blocks.digests[i];
    }
    return size() + more <= values_.limit();
}

void BlockPool::forget() {
    for (const std::uint32_t slot : shown_) {
        slot_of_[held_[slot].block] = kNoSlot;
        free_.push_back(slot);
    }
    shown_.clear();
}

std::uint32_t BlockPool::take_slot() {
    if (free_.empty()) {
        const std::size_t before = held_.size();
        // A first set lacks all its blocks: growing step by step would copy them again and again.
        const std::size_t first_set = shown_.empty() ? blocks_->ids.size() : 0;
        values_.reserve(std::max({before + 1, first_set, kFirstCapacity}),
                        DeviceArray::Contents::kept);
        held_.resize(values_.capacity());
        for (std::size_t slot = held_.size(); slot-- > before;)
            free_.push_back(static_cast<std::uint32_t>(slot));
    }
    const std::uint32_t slot = free_.back();
    free_.pop_back();
    return slot;
}

/// Finds a slot for the next block. @return whether the block must be sent
bool BlockPool::place_next() {
    const std::size_t next = arriving_.size();
    const index::BlockId block = blocks_->ids[next];
    std::uint32_t slot = slot_of_[block];
    const bool known = slot != kNoSlot && held_[slot].digest == blocks_->digests[next];
    if (!known) {
        slot = take_slot();
        page_words_.insert(page_words_.end(), {block, slot});
    }
    held_[slot] = {block, set_, blocks_->digests[next]};
    arriving_.push_back(slot);
    return !known;
}

bool BlockPool::complete() const {
    return arriving_.size() == blocks_->ids.size() && !sending_ &&
           pages_sent_ == std::as_bytes(std::span(page_words_)).size();
}

std::size_t BlockPool::send(StagingRing& ring, std::size_t bytes) {
    std::size_t sent = 0;
    for (std::size_t looked = 0; looked < kLookedAt; ++looked) {
        if (!sending_) {
            if (arriving_.size() == blocks_->ids.size())
                break;
            sending_ = place_next();
            block_sent_ = 0;
            continue;
        }
        const auto rest = blocks_->block(arriving_.size() - 1).subspan(block_sent_);
        const std::size_t part =
            bytes - sent < StagingRing::kUnit
                ? 0
                : ring.send(rest, bytes - sent, values_.buffer(),
                            arriving_.back() * blocks_->block_bytes() + block_sent_);
        if (part == 0)
            return sent;
        sent += part;
        block_sent_ += part;
        sending_ = part < rest.size();
    }
    return sent + send_pages(ring, bytes - sent);
}

std::size_t BlockPool::send_pages(StagingRing& ring, std::size_t bytes) {
    if (sending_ || arriving_.size() < blocks_->ids.size())
        return 0;
    page_message_.reserve(page_changes(), DeviceArray::Contents::dropped);
    std::size_t sent = 0;
    for (;;) {
        const auto rest = std::as_bytes(std::span(page_words_)).subspan(pages_sent_);
        if (rest.empty() || bytes - sent < StagingRing::kUnit)
            return sent;
        const std::size_t part = ring.send(rest, bytes - sent, page_message_.buffer(), pages_sent_);
        if (part == 0)
            return sent;
        sent += part;
        pages_sent_ += part;
    }
}

void BlockPool::show() {
    for (const std::uint32_t slot : shown_)
        if (held_[slot].set != set_) {
            slot_of_[held_[slot].block] = kNoSlot;
            free_.push_back(slot);
        }
    for (std::size_t i = 0; i < page_words_.size(); i += 2)
        slot_of_[page_words_[i]] = page_words_[i + 1];
    shown_.swap(arriving_);
    blocks_ = nullptr;
}

} // namespace isochron::render
