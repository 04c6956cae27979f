// Blocks of a file on a web server, kept on this machine's disk from one run to the next.
#pragma once

#include "index/system/descriptor.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

namespace isochron::index {

/// Keeps blocks in two files of a folder: the blocks at their places, and a sum of each, so that a block that was
/// written in part is none. Several processes may use the same files. Thread-safe; a disk that is full or
/// fails keeps nothing more.
class BlockStore {
  public:
    /// @param folder of all such stores @param key names a content: address, tag and size of the file
    /// @param budget [bytes] of the folder: what was used longest ago goes; 0: nothing is kept
    BlockStore(const std::optional<std::filesystem::path>& folder, std::string_view key,
               std::uint32_t block_bytes, std::uint64_t budget);

    /// Fills `out` with a block. @return false: it is not kept
    bool get(std::uint64_t block, std::span<char> out) const;
    void put(std::uint64_t block, std::string_view bytes);
    bool has(std::uint64_t block) const;

  private:
    std::uint64_t sum_at(std::uint64_t block) const;

    std::uint32_t block_bytes_;
    Descriptor blocks_, sums_;
    std::atomic<std::int64_t> room_ = 0; ///< [bytes] that may be added
};

/// The budget: 4 GiB, or so many MiB as the environment variable ISOCHRON_LINK_CACHE says.
std::uint64_t link_cache_budget();

} // namespace isochron::index
