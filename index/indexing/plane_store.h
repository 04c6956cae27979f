// Keeps planes of a step that are needed once more: in memory, or in a file if there are too many.
#pragma once

#include "index/system/scratch_file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

class PlaneStore {
  public:
    /// @param bytes of all planes of a step @param most bytes that may be in memory @param beside
    ///        see ScratchFile
    PlaneStore(std::uint64_t bytes, std::uint64_t most, const std::filesystem::path& beside);

    void append(std::span<const std::byte> planes);
    /// Gives back the appended planes, piece by piece, and empties the store.
    void drain(const std::function<void(std::span<const std::byte>)>& take);
    /// Gives the memory of an empty store back.
    void release() { std::vector<std::byte>().swap(bytes_); }

  private:
    std::uint64_t all_; ///< [bytes]
    std::optional<ScratchFile> file_;
    std::vector<std::byte> bytes_; ///< all, or a piece of the file
    std::uint64_t end_ = 0;
};

} // namespace isochron::index
