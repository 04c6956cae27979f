// Writes parts whose sizes are not known before they are made.
#pragma once

#include "index/system/byte_sink.h"
#include "index/system/scratch_file.h"
#include "index/system/team.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace isochron::index {

/// Every member of a team writes its parts one after the other. In the file, the parts of rank 0
/// come first, then the parts of rank 1, and so on. Rank 0 writes its parts to their final place at
/// once; the other ranks write to temporary files until the sizes of all parts before theirs are
/// known. All members call `place` together.
class PartWriter {
  public:
    /// @param offset where the parts begin in the file @param spill name of the temporary file
    PartWriter(ByteSink& file, std::uint64_t offset, const std::filesystem::path& spill,
               const Team& team);

    /// Appends bytes. @return their offset from this member's first byte
    std::uint64_t append(std::span<const std::byte> bytes);
    /// Leaves zeros up to the next multiple. @return the offset of what is appended next
    std::uint64_t align(std::uint64_t alignment);

    /// Reads and replaces what was appended, before `place`: on ranks above 0 only.
    void read(std::uint64_t offset, std::span<std::byte> out) const { spilled_->read(offset, out); }
    void replace(std::uint64_t offset, std::span<const std::byte> bytes) {
        spilled_->write_at(offset, bytes);
    }

    /// Where the parts of a member lie.
    struct Placed {
        std::uint64_t start = 0; ///< where this member's parts begin, from `offset`
        std::uint64_t bytes = 0; ///< size of all members' parts
    };
    Placed place(Team& team);

  private:
    ByteSink& file_;
    std::uint64_t offset_, end_ = 0;
    std::optional<ScratchFile> spilled_;
};

} // namespace isochron::index
