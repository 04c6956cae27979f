// Pool of volume blocks (8^3 vertices each) on the GPU: of the shown set and of the arriving one.
#pragma once

#include "index/extraction/volume_blocks.h"
#include "render/gl/device_array.h"
#include "render/gl/staging_ring.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::render {

/// A page table says in which slot of the pool a block lies. A block that the pool already holds,
/// with the same digest, is not sent again. Other blocks of a new set are sent to free slots; when
/// the new set is shown, slots that only the old set needed become free.
class BlockPool {
  public:
    /// @param held type of the values of all sets
    BlockPool(const Gl& gl, const index::Grid& grid, index::ValueType held);

    /// Begins to send a new set; the previous one must have been shown.
    /// @param blocks live until `show`
    void begin(const index::VolumeBlocks& blocks);

    /// Whether the pool can hold these blocks and the blocks of the shown set together.
    bool has_room_for(const index::VolumeBlocks& blocks) const;
    /// Drops all blocks, which makes room for as many as the driver's textures can hold. Call it
    /// only while no set is being sent.
    void forget();

    /// Sends at most `bytes`, as far as the ring has room.
    /// @param bytes at least one unit of the ring
    /// @return bytes sent
    /// @throws Error when the driver's textures cannot hold the blocks
    std::size_t send(StagingRing& ring, std::size_t bytes);
    /// Whether everything that the new set needs has been sent.
    bool complete() const;

    /// Changes of the page table (two words each: block id, slot), which a shader applies when the
    /// new set is shown.
    const DeviceArray& page_message() const { return page_message_; }
    std::size_t page_changes() const { return page_words_.size() / 2; }

    /// Makes the new set the shown one.
    void show();

    /// Slots by block id (R32UI).
    const DeviceArray& pages() const { return pages_; }
    /// Held values, slot after slot, kBlockVertices texels each.
    const DeviceArray& values() const { return values_; }
    /// Number of blocks that the pool holds, and that it has memory for.
    std::size_t size() const { return held_.size() - free_.size(); }
    std::size_t capacity() const { return held_.size(); }

  private:
    static constexpr std::uint32_t kNoSlot = ~0u;
    struct Held {
        index::BlockId block = 0;
        std::uint64_t set = 0; ///< number of the latest set that needs it
        index::BlockDigest digest;
    };
    std::uint32_t take_slot();
    bool place_next();
    std::size_t send_pages(StagingRing& ring, std::size_t bytes);

    DeviceArray values_, pages_, page_message_;
    std::vector<std::uint32_t> slot_of_; ///< by block id, as in the page table; or kNoSlot
    std::vector<Held> held_;             ///< by slot
    std::vector<std::uint32_t> free_;
    std::vector<std::uint32_t> shown_; ///< slots of the shown set
    // The arriving set:
    std::uint64_t set_ = 0;
    const index::VolumeBlocks* blocks_ = nullptr;
    std::vector<std::uint32_t> arriving_;   ///< slots of its blocks placed so far
    std::vector<std::uint32_t> page_words_; ///< block id and slot of each block that is sent
    bool sending_ = false;                  ///< the last placed block is sent only in part
    std::size_t block_sent_ = 0;            ///< bytes of this block sent so far
    std::size_t pages_sent_ = 0;            ///< bytes of `page_words_` sent so far
};

} // namespace isochron::render
