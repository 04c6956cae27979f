// Reads everything that a checksum covers, and what lies between.
#include "index/file/index_file.h"
#include "index/system/parallel.h"
#include "index/system/read_ahead.h"
#include "index/system/running_checksum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace isochron::index {
namespace {

constexpr std::size_t kPlacesTogether = 64; ///< that a thread decodes at a time

/// Reads steps layer by layer, each with all cores, and keeps one layer.
class LayerCheck {
  public:
    explicit LayerCheck(const IndexFile& file) : file_(file) {}

    /// @return the checksum of the values; of none if the file does not have them
    std::uint64_t values_of(const ChunkStore& store, std::uint32_t step) {
        const SeriesInfo& info = store.info();
        const std::size_t plane =
            std::size_t{info.grid.vertices[0]} * info.grid.vertices[1] * size_of(info.type);
        std::vector<std::uint32_t> places(store.grid().chunks_of_layer());
        std::iota(places.begin(), places.end(), 0u);
        const std::size_t pieces = (places.size() + kPlacesTogether - 1) / kPlacesTogether;
        const auto fetch = [&](std::uint32_t layer) {
            return store.fetch(step, layer, places, {});
        };
        std::optional<ReadAhead> ahead; // the disk has all of a small step in a few requests
        if (!store.is_small())
            ahead.emplace(store.grid().layers(), fetch);
        for (std::uint32_t layer = 0; layer < store.grid().layers(); ++layer) {
            check_since(store, step, layer);
            planes_.resize(store.carries_values() ? store.grid().size(layer, 0)[2] * plane : 0);
            if (ahead)
                ahead->reach(layer);
            else
                fetch(layer);
            parallel_for(pieces, thread_count(0),
                         [&](std::size_t piece, unsigned) {
                             const std::size_t first = piece * kPlacesTogether;
                             const auto some = std::span(places).subspan(
                                 first, std::min(kPlacesTogether, places.size() - first));
                             store.decode(step, layer, some, planes_, {});
                         },
                         {});
            checksum_.add(planes_);
        }
        return checksum_.take();
    }

  private:
    /// A chunk that stays does so since the same step as in the step before.
    void check_since(const ChunkStore& store, std::uint32_t step, std::uint32_t layer) const {
        if (step == 0)
            return;
        const ChunkLayerPtr now = store.layer(step, layer), before = store.layer(step - 1, layer);
        for (std::uint32_t place = 0; place < now->since.size(); ++place)
            if (now->since[place] < step && now->since[place] != before->since[place])
                throw file_.damaged(fmt::format("step {}: a chunk of layer {} stays since step {}, "
                                                "in the step before since step {}",
                                                step, layer, now->since[place],
                                                before->since[place]));
    }

    const IndexFile& file_;
    std::vector<std::byte> planes_;
    RunningChecksum checksum_;
};

void expect_checksum(const IndexFile& file, std::uint64_t found, std::uint32_t step,
                     std::uint64_t checksum, const char* called) {
    if (found != checksum)
        throw file.damaged(
            fmt::format("the checksum of the {} of step {} does not match", called, step));
}

/// Checks the values of a step. @param store its chunks; null: they are read from its source
/// @param load reads the whole step
void check_step(const IndexFile& file, LayerCheck& layers, const ChunkStore* store,
                LoadedStep (IndexFile::*load)(std::uint32_t) const, std::uint32_t step,
                std::uint64_t checksum, const char* called) {
    const std::uint64_t of_chunks = store ? layers.values_of(*store, step) : 0;
    if (store && store->carries_values())
        return expect_checksum(file, of_chunks, step, checksum, called);
    const LoadedStep loaded = (file.*load)(step);
    expect_checksum(file, checksum_of(loaded.values.step_bytes(step)), step, checksum, called);
}

/// Checks the levels of detail by reading them: their chunks and tables have their own checksums.
void check_details(const IndexFile& file, LayerCheck& layers, const Progress& progress) {
    const std::size_t steps = file.info().steps();
    for (const bool colors : {false, true})
        for (std::size_t level = 1; level < file.detail_levels(); ++level)
            for (std::uint32_t step = 0; (!colors || file.color()) && step < steps; ++step) {
                if (progress)
                    progress("levels of detail",
                             static_cast<double>(step) / static_cast<double>(steps));
                const ChunkStore& store = colors ? *file.color_chunks(level) : file.chunks(level);
                layers.values_of(store, step);
                if (!colors && file.plan().tiers.has(Tier::bricks))
                    store.levels(step);
            }
}

void check_parts(const IndexFile& file, const Progress& progress) {
    const std::span<const std::uint64_t> checksums = file.checksums();
    const auto total = static_cast<double>(checksums.size());
    LayerCheck layers(file);
    std::size_t next = 0;
    const auto take = [&](const char* called) {
        if (progress)
            progress(called, static_cast<double>(next) / total);
        return checksums[next++];
    };
    const std::size_t steps = file.info().steps();
    for (std::uint32_t step = 0; step < steps; ++step) {
        check_step(file, layers, &file.chunks(), &IndexFile::load, step, take("volume"), "volume");
        if (file.plan().tiers.has(Tier::bricks))
            file.chunks().levels(step);
    }
    std::vector<std::byte> part;
    for (const UnusedParts& two : file.unused())
        for (const auto& [offset, bytes] : two.parts) {
            part.resize(bytes);
            file.bytes().read(offset, part);
            if (checksum_of(part) != take("what is no longer used"))
                throw file.damaged("the checksum of a part that is no longer used does not match");
        }
    if (file.plan().tiers.has(Tier::tree))
        file.tree_bytes();
    for (std::uint32_t step = 0; file.color() && step < steps; ++step)
        check_step(file, layers, file.color_chunks(), &IndexFile::load_color, step, take("colors"),
                   "colors");
    check_details(file, layers, progress);
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
