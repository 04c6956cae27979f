// The pass of a build that makes the cells and deltas of every stretch.
#include "index/indexing/unit_pass.h"

#include "index/cells/unit_builder.h"
#include "index/indexing/part_writer.h"
#include "index/system/parallel.h"
#include "index/volume/stretches.h"

#include <algorithm>
#include <optional>

namespace isochron::index {

UnitFindings write_units(const StepValues& values, std::uint32_t first_epoch,
                         const MappedFile& volume, const LevelMap& levels, bool deltas,
                         ByteSink& file, std::uint64_t& end, const std::filesystem::path& spill,
                         unsigned threads, Team& team, const Progress& progress) {
    const Stretches stretches(values.grid);
    const std::size_t units =
        std::size_t{epoch_count(values.steps) - first_epoch} * stretches.count();
    const auto [first, last] = team.share(units);
    std::vector<UnitEntry> directory;
    std::vector<std::uint64_t> checksums;
    std::optional<PartWriter> parts;
    team.together([&] {
        parts.emplace(file, end, spill, team);
        std::vector<UnitBuilder> builders(threads, UnitBuilder(values, levels));
        std::vector<UnitBytes> batch(threads);
        for (std::size_t at = first; at < last; at += threads) {
            const std::size_t count = std::min<std::size_t>(threads, last - at);
            if (progress)
                progress("indexing",
                         static_cast<double>(at - first) / static_cast<double>(last - first));
            parallel_for(count, threads,
                         [&](std::size_t item, unsigned worker) {
                             const auto stretch =
                                 static_cast<std::uint32_t>((at + item) % stretches.count());
                             const auto epoch = first_epoch + static_cast<std::uint32_t>(
                                                                  (at + item) / stretches.count());
                             builders[worker].build(stretch, epoch, deltas, batch[item]);
                         },
                         {});
            volume.let_go(volume.bytes());
            for (std::size_t item = 0; item < count; ++item) {
                const UnitBytes& unit = batch[item];
                const std::uint64_t cells_at = parts->append(unit.cells);
                parts->align(kPartAlignment);
                const std::uint64_t deltas_at = parts->append(unit.deltas);
                parts->align(kPartAlignment);
                directory.push_back(
                    {cells_at, unit.cells.size(), deltas_at, unit.deltas.size(), unit.entries});
                checksums.push_back(checksum_of(unit.cells));
                checksums.push_back(checksum_of(unit.deltas));
            }
        }
    });
    const PartWriter::Placed placed = parts->place(team);
    for (UnitEntry& entry : directory) {
        entry.cells_offset += end + placed.start;
        entry.deltas_offset += end + placed.start;
    }
    end += placed.bytes;
    return {team.gather_items(directory), team.gather_items(checksums)};
}

} // namespace isochron::index
