// Planes of a step that are needed once more: in memory, or in a file where they are too many.
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
    /// @param bytes of all planes of a step @param most that may be in memory @param beside as of
    ///        ScratchFile
    PlaneStore(std::uint64_t bytes, std::uint64_t most, const std::filesystem::path& beside);

    void append(std::span<const std::byte> planes);
    /// Gives back what has been appended, piece by piece, and begins anew.
    void drain(const std::function<void(std::span<const std::byte>)>& take);

  private:
    std::uint64_t all_; ///< [bytes]
    std::optional<ScratchFile> file_;
    std::vector<std::byte> bytes_; ///< all, or a piece of the file
    std::uint64_t end_ = 0;
};

} // namespace isochron::index
