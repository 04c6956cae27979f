// Bricks of the volume on the GPU: those of the set that is drawn and of the one on its way.
#pragma once

#include "index/extraction/volume_bricks.h"
#include "render/gl/device_array.h"
#include "render/gl/staging_ring.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::render {

/// A page table says in which slot of the pool a brick lies. A brick that the pool holds with the
/// same digest is not sent again; all others are sent beside the shown ones, and what only the old
/// set needed is given up when the new one is shown.
class BrickPool {
  public:
    /// @param held type of the values of all sets
    BrickPool(const Gl& gl, const index::Grid& grid, index::ValueType held);

    /// Takes up a new set; the one before must have been shown.
    /// @param bricks live until they are shown
    void begin(const index::VolumeBricks& bricks);

    /// Whether these bricks and those of the shown set can be held at the same time.
    bool has_room_for(const index::VolumeBricks& bricks) const;
    /// Holds none, so that there is room for as many as the driver's textures hold; nothing is on
    /// its way.
    void forget();

    /// Sends at most `bytes`, of which there must be a unit of the ring, as far as the ring has
    /// room.
    /// @return bytes sent; complete or not, all that could be done now is done
    /// @throws Error when the bricks are more than the driver's textures hold
    std::size_t send(StagingRing& ring, std::size_t bytes);
    /// Whether all that the set needs has been sent.
    bool complete() const;

    /// Pages (words: brick id, slot) that change with this set: what a shader writes into the page
    /// table when the set is shown.
    const DeviceArray& page_message() const { return page_message_; }
    std::size_t page_changes() const { return page_words_.size() / 2; }

    /// The new set is drawn from now on.
    void show();

    /// Slots by brick id (R32UI).
    const DeviceArray& pages() const { return pages_; }
    /// Held values, slot after slot, kBrickVertices texels each.
    const DeviceArray& values() const { return values_; }
    /// Bricks that the pool holds now, and those it has room for.
    std::size_t size() const { return held_.size() - free_.size(); }
    std::size_t capacity() const { return held_.size(); }

  private:
    static constexpr std::uint32_t kNoSlot = ~0u;
    struct Held {
        index::BrickId brick = 0;
        std::uint64_t set = 0; ///< the latest that needs it
        index::BrickDigest digest;
    };
    std::uint32_t take_slot();
    bool place_next();
    std::size_t send_pages(StagingRing& ring, std::size_t bytes);

    DeviceArray values_, pages_, page_message_;
    std::vector<std::uint32_t> slot_of_; ///< by brick id, as the page table says; or kNoSlot
    std::vector<Held> held_;             ///< by slot
    std::vector<std::uint32_t> free_;
    std::vector<std::uint32_t> shown_; ///< slots of the shown set
    // The set on its way:
    std::uint64_t set_ = 0;
    const index::VolumeBricks* bricks_ = nullptr;
    std::vector<std::uint32_t> arriving_;   ///< slots of its bricks as far as they are placed
    std::vector<std::uint32_t> page_words_; ///< brick id and slot of those that are sent
    bool sending_ = false;                  ///< the last placed brick is on its way:
    std::size_t brick_sent_ = 0;            ///< bytes of it
    std::size_t pages_sent_ = 0;            ///< bytes of `page_words_`
};

} // namespace isochron::render
