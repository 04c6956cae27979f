// Reads everything that a checksum covers, and what lies between.
#include "index/error.h"
#include "index/file/index_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace isochron::index {
namespace {

void check_step(const IndexFile& file, const LoadedStep& loaded, std::uint32_t step,
                std::uint64_t checksum, const char* called) {
    if (checksum_of(loaded.values.step_bytes(step)) != checksum)
        throw file.damaged(
            fmt::format("the checksum of the {} of step {} does not match", called, step));
}

/// Checks the levels of detail by reading them: their chunks and tables have their own checksums.
void check_details(const IndexFile& file, const Progress& progress) {
    const std::size_t steps = file.info().steps();
    for (const bool colors : {false, true})
        for (std::size_t level = 1; level < file.detail_levels(); ++level)
            for (std::uint32_t step = 0; (!colors || file.color()) && step < steps; ++step) {
                if (progress)
                    progress("levels of detail",
                             static_cast<double>(step) / static_cast<double>(steps));
                const ChunkStore& store = colors ? *file.color_chunks(level) : file.chunks(level);
                store.whole(step);
                if (!colors && file.plan().tiers.has(Tier::bricks))
                    store.levels(step);
            }
}

void check_parts(const IndexFile& file, const Progress& progress) {
    const std::span<const std::uint64_t> checksums = file.checksums();
    const auto total = static_cast<double>(checksums.size());
    std::size_t next = 0;
    const auto take = [&](const char* called) {
        if (progress)
            progress(called, static_cast<double>(next) / total);
        return checksums[next++];
    };
    const std::size_t steps = file.info().steps();
    for (std::uint32_t step = 0; step < steps; ++step) {
        check_step(file, file.load(step), step, take("volume"), "volume");
        if (file.plan().tiers.has(Tier::bricks))
            file.chunks().levels(step);
    }
    for (std::size_t unit = 0; unit < file.directory().size(); ++unit) {
        const auto held = file.cells()->hold(); // frees memory beyond the budget
        for (const bool deltas : {false, true})
            if (checksum_of(file.read_unit(unit, deltas)) != take("units"))
                throw file.damaged("the checksum of the units does not match");
        file.cells()->verify_unit(unit);
    }
    if (file.plan().tiers.has(Tier::tree))
        file.tree_bytes();
    for (std::uint32_t step = 0; file.color() && step < steps; ++step)
        check_step(file, file.load_color(step), step, take("colors"), "colors");
    check_details(file, progress);
}

/// Checks that padding, which no checksum covers, is zero. Longer gaps hold parts of earlier
/// headers.
void check_gaps(const IndexFile& file) {
    IndexFile::Parts used = file.parts();
    used.emplace_back(0, kDataBegin);
    std::ranges::sort(used);
    std::uint64_t end = 0;
    std::vector<std::byte> gap;
    for (const auto& [offset, bytes] : used) {
        gap.resize(offset > end && offset - end < kPartAlignment ? offset - end : 0);
        file.bytes().read(end, gap);
        for (std::size_t i = 0; i < gap.size(); ++i)
            if (gap[i] != std::byte{0})
                throw file.damaged(fmt::format("byte {} is not zero", end + i));
        end = std::max(end, offset + bytes);
    }
}

} // namespace

void check_index(const IndexFile& file, const Progress& progress) {
    const auto count = static_cast<double>(file.arrays());
    for (std::size_t number = 0; number < file.arrays(); ++number)
        check_parts(file.array(number), [&](std::string_view phase, double done) {
            if (progress)
                progress(phase, (static_cast<double>(number) + done) / count);
        });
    check_gaps(file);
}

} // namespace isochron::index
