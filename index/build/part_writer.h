// Parts of a section, of which nobody knows the sizes before they are made.
#pragma once

#include "index/system/byte_sink.h"
#include "index/system/scratch_file.h"
#include "index/system/team.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace isochron::index {

/// Every member of a team writes its parts one behind the other; in the file those of all members
/// follow each other in order of rank. The first member's lie where they belong at once; those of
/// the others wait in a file of their own until the sizes of those before them are known. Every
/// function but the first two is called by all members, in the same order.
class PartWriter {
  public:
    /// @param offset where the section begins in the file
    PartWriter(ByteSink& file, std::uint64_t offset, const std::filesystem::path& spill,
               const Team& team);

    /// Puts bytes behind what there is. @return where, from the member's first byte
    std::uint64_t append(std::span<const std::byte> bytes);
    /// Leaves zeros up to the next multiple. @return where what is appended next begins
    std::uint64_t align(std::uint64_t alignment);

    /// Where the parts of a member lie in the section.
    struct Placed {
        std::uint64_t start = 0; ///< of this member's parts
        std::uint64_t bytes = 0; ///< of all members' parts
    };
    Placed place(Team& team);

  private:
    ByteSink& file_;
    std::uint64_t offset_, end_ = 0;
    std::optional<ScratchFile> spilled_;
};

} // namespace isochron::index
