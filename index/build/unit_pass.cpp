// The pass of a build that makes the cells and deltas of every chunk.
#include "index/build/unit_pass.h"

#include "index/cells/unit_builder.h"
#include "index/system/mapped_file.h"
#include "index/system/parallel.h"
#include "index/volume/chunking.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace isochron::index {
namespace {

/// Writes parts one behind the other, each from a multiple of kPartAlignment.
class PartWriter {
  public:
    PartWriter(NewFile& file, std::uint64_t offset) : file_(file), offset_(offset) {}

    /// @return where the part begins, from the first one
    std::uint64_t append(std::span<const std::byte> part) {
        const std::uint64_t at = end_;
        file_.write_at(offset_ + at, part);
        end_ = align_up(at + part.size(), kPartAlignment);
        return at;
    }
    std::uint64_t end() const { return end_; }

  private:
    NewFile& file_;
    std::uint64_t offset_, end_ = 0;
};

/// Copies what a member has spilled to its place, a piece at a time.
void copy(const std::filesystem::path& from, std::uint64_t bytes, NewFile& to,
          std::uint64_t offset) {
    if (bytes == 0)
        return;
    const MappedFile spilled(from);
    constexpr std::uint64_t kPiece = 16 << 20;
    for (std::uint64_t at = 0; at < spilled.bytes().size(); at += kPiece) {
        const auto piece =
            spilled.bytes().subspan(at, std::min(kPiece, spilled.bytes().size() - at));
        to.write_at(offset + at, piece);
        spilled.let_go(piece);
    }
}

} // namespace

UnitFindings write_units(const StepValues& values, const MappedFile& volume, const LevelMap& levels,
                         bool deltas, NewFile& file, std::uint64_t offset,
                         const std::filesystem::path& spill, unsigned threads, Team& team,
                         const Progress& progress) {
    const Chunking chunking(values.grid);
    const std::size_t units = std::size_t{epoch_count(values.steps)} * chunking.count();
    const auto [first, last] = team.share(units);
    std::vector<UnitEntry> directory;
    std::vector<std::uint64_t> checksums;
    std::uint64_t written = 0, entries = 0;
    // The first member's parts lie where they belong at once; the others must wait for the sizes
    // of those before them.
    std::optional<NewFile> spilled;
    team.together([&] {
        if (team.rank() > 0)
            spilled.emplace(spill);
        PartWriter parts(spilled ? *spilled : file, spilled ? 0 : offset);
        std::vector<UnitBuilder> builders(threads, UnitBuilder(values, levels));
        std::vector<UnitBytes> batch(threads);
        for (std::size_t at = first; at < last; at += threads) {
            const std::size_t count = std::min<std::size_t>(threads, last - at);
            if (progress)
                progress("indexing",
                         static_cast<double>(at - first) / static_cast<double>(last - first));
            parallel_for(count, threads,
                         [&](std::size_t item, unsigned worker) {
                             const auto chunk =
                                 static_cast<std::uint32_t>((at + item) % chunking.count());
                             const auto epoch =
                                 static_cast<std::uint32_t>((at + item) / chunking.count());
                             builders[worker].build(chunk, epoch, deltas, batch[item]);
                         },
                         {});
            volume.let_go(volume.bytes());
            for (std::size_t item = 0; item < count; ++item) {
                const UnitBytes& unit = batch[item];
                const std::uint64_t cells_at = parts.append(unit.cells);
                const std::uint64_t deltas_at = parts.append(unit.deltas);
                directory.push_back({cells_at, unit.cells.size(), deltas_at, unit.deltas.size()});
                entries += unit.entries;
                checksums.push_back(checksum_of(unit.cells));
                checksums.push_back(checksum_of(unit.deltas));
            }
        }
        written = parts.end();
    });
    const std::vector<std::uint64_t> sizes = team.gather_values(written);
    std::uint64_t start = 0;
    for (unsigned member = 0; member < team.rank(); ++member)
        start += sizes[member];
    team.together([&] {
        if (spilled)
            copy(spilled->temporary(), written, file, offset + start);
    });
    for (UnitEntry& entry : directory) {
        entry.cells_offset += start;
        entry.deltas_offset += start;
    }
    UnitFindings findings;
    for (const std::uint64_t size : sizes)
        findings.bytes += size;
    for (const std::uint64_t found : team.gather_values(entries))
        findings.entries += found;
    findings.directory = team.gather_items(directory);
    findings.checksums = team.gather_items(checksums);
    return findings;
}

} // namespace isochron::index
