// Writes the parts of all members of a team in parallel.
#include "index/indexing/part_writer.h"

#include "index/file/sections/file_layout.h"

#include <algorithm>
#include <vector>

namespace isochron::index {
namespace {

constexpr std::uint64_t kFlushed = 32 << 20; ///< [bytes] after which the disk is told to write

/// Copies the parts in a member's temporary file to their final place, a piece at a time.
void copy_spilled(const ScratchFile& from, std::uint64_t bytes, ByteSink& to,
                  std::uint64_t offset) {
    constexpr std::uint64_t kPiece = 16 << 20;
    std::vector<std::byte> piece;
    for (std::uint64_t at = 0; at < bytes; at += piece.size()) {
        piece.resize(std::min(kPiece, bytes - at));
        from.read(at, piece);
        to.write_at(offset + at, piece);
    }
}

} // namespace

PartWriter::PartWriter(ByteSink& file, std::uint64_t offset, const std::filesystem::path& spill,
                       const Team& team)
    : file_(file), offset_(offset) {
    if (team.rank() > 0)
        spilled_.emplace(spill);
}

std::uint64_t PartWriter::append(std::span<const std::byte> bytes) {
    const std::uint64_t at = end_;
    end_ += bytes.size();
    if (spilled_) {
        spilled_->write_at(at, bytes);
        return at;
    }
    file_.write_at(offset_ + at, bytes);
    if (at / kFlushed != end_ / kFlushed)
        file_.begin_flush();
    return at;
}

std::uint64_t PartWriter::align(std::uint64_t alignment) {
    return end_ = align_up(end_, alignment);
}

PartWriter::Placed PartWriter::place(Team& team) {
    const std::vector<std::uint64_t> sizes = team.gather_values(align_up(end_, kPartAlignment));
    Placed placed;
    for (unsigned member = 0; member < sizes.size(); ++member) {
        if (member < team.rank())
            placed.start += sizes[member];
        placed.bytes += sizes[member];
    }
    team.together([&] {
        if (spilled_)
            copy_spilled(*spilled_, end_, file_, offset_ + placed.start);
    });
    return placed;
}

} // namespace isochron::index
