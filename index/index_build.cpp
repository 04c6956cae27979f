// Writing of .isochron files: one pass over the series, then the tree over what was written.
#include "index/error.h"
#include "index/file_layout.h"
#include "index/index_file.h"
#include "index/mapped_file.h"
#include "index/metadata.h"
#include "index/new_file.h"
#include "index/value_stats.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace isochron::index {
namespace {

/// A slip of the hand must not cost anybody a volume.
void refuse_foreign_file(const std::filesystem::path& out) {
    std::ifstream file(out, std::ios::binary);
    std::array<char, 8> start{};
    file.read(start.data(), start.size());
    if (file.gcount() > 0 && start != FileHeader{}.magic)
        throw Error(
            fmt::format("{}: exists and is not an isochron index: not replaced", out.string()));
}

/// Reads every step once into the volume section; fills its checksum and the range.
Section write_volume(VolumeSeries& series, NewFile& file, IndexStats& stats,
                     const Progress& progress) {
    const SeriesInfo& info = series.info();
    const std::size_t stride = step_stride(info.step_bytes());
    Section volume{.offset = kSectionAlignment, .bytes = info.steps() * stride};
    file.reserve(volume.offset + volume.bytes);
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(),
                                                                        XXH3_freeState);
    XXH3_64bits_reset(hash.get());
    std::vector<std::byte> step(stride); // its padding stays zero
    const std::span<std::byte> stored(step.data(), info.step_bytes());
    stats.low = std::numeric_limits<double>::infinity();
    stats.high = -stats.low;
    for (std::size_t t = 0; t < info.steps(); ++t) {
        if (progress)
            progress("reading", static_cast<double>(t) / static_cast<double>(info.steps()));
        series.read(t, stored);
        add_range(info.type, info.scaling, stored, stats.low, stats.high, stats.nan_values);
        XXH3_64bits_update(hash.get(), step.data(), step.size());
        file.write_at(volume.offset + t * stride, step);
    }
    if (stats.low > stats.high)
        stats.low = stats.high = 0; // no finite value at all
    volume.checksum = XXH3_64bits_digest(hash.get());
    return volume;
}

void count_values(const StepValues& values, IndexStats& stats, const Progress& progress) {
    stats.histogram.assign(kHistogramBins, 0);
    const std::size_t bytes = values.grid.vertex_count() * size_of(values.type);
    for (std::size_t t = 0; t < values.steps; ++t) {
        if (progress)
            progress("counting", static_cast<double>(t) / static_cast<double>(values.steps));
        add_histogram(values.type, values.scaling, {values.first + t * values.stride, bytes},
                      stats.low, stats.high, stats.histogram);
    }
}

/// Of everything that decides what a query answers and where it lies.
std::uint64_t content_hash(const SeriesInfo& info, std::uint64_t volume_checksum) {
    std::vector<double> numbers(info.grid.vertices.begin(), info.grid.vertices.end());
    for (const glm::dvec3& v : {info.grid.origin, info.grid.spacing, info.grid.direction[0],
                                info.grid.direction[1], info.grid.direction[2]})
        numbers.insert(numbers.end(), {v.x, v.y, v.z});
    numbers.insert(numbers.end(),
                   {static_cast<double>(info.type), info.scaling.slope, info.scaling.intercept});
    numbers.insert(numbers.end(), info.times.begin(), info.times.end());
    return XXH3_64bits_withSeed(numbers.data(), numbers.size() * sizeof(double), volume_checksum);
}

Section append(NewFile& file, const Section& previous, std::span<const std::byte> bytes) {
    const Section section{.offset = align_up(previous.offset + previous.bytes, kSectionAlignment),
                          .bytes = bytes.size(),
                          .checksum = checksum_of(bytes)};
    file.write_at(section.offset, bytes);
    return section;
}

} // namespace

void build_index(VolumeSeries& series, const std::filesystem::path& out,
                 const BuildOptions& options, const Progress& progress) {
    Metadata metadata{.info = series.info(), .stats = {}, .options = options};
    SeriesInfo& info = metadata.info;
    try {
        check_limits(info);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", info.sources.empty() ? "series" : info.sources.front(),
                                error.what()));
    }
    NewFile file(out);
    refuse_foreign_file(out);
    const std::uint64_t cell_steps = info.grid.cell_count() * info.steps();
    if (!options.exact_only && cell_steps > options.max_tree_cell_steps) {
        metadata.options.exact_only = true;
        info.notes.push_back(fmt::format(
            "no tree: {} million cell-steps, a tree is built for up to {} million; queries scan "
            "the volume",
            cell_steps / 1'000'000, options.max_tree_cell_steps / 1'000'000));
    }

    FileHeader header;
    const Section volume = write_volume(series, file, metadata.stats, progress);
    std::vector<std::byte> tree;
    {
        const MappedFile written(file.temporary());
        const StepValues values{.grid = info.grid,
                                .type = info.type,
                                .scaling = info.scaling,
                                .steps = info.steps(),
                                .first = written.bytes().data() + volume.offset,
                                .stride = step_stride(info.step_bytes())};
        count_values(values, metadata.stats, progress);
        if (!metadata.options.exact_only)
            tree = build_thi_tree(values, options.tree, progress);
    }
    header.content_hash = content_hash(info, volume.checksum);
    header.section(SectionKind::volume) = volume;
    header.section(SectionKind::tree) = append(file, volume, tree);
    const std::string text = to_json(metadata);
    header.section(SectionKind::metadata) =
        append(file, header.section(SectionKind::tree), std::as_bytes(std::span(text)));
    const Section& last = header.section(SectionKind::metadata);
    header.file_bytes = last.offset + last.bytes;
    file.write_at(0, header_bytes(header));
    if (progress)
        progress("flushing to disk", 0.0);
    file.commit();
}

} // namespace isochron::index
