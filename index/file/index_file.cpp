// Opens and reads .isochron files.
#include "index/file/index_file.h"

#include "index/file/detail_levels.h"
#include "index/file/sections/step_levels.h"
#include "index/scan/bricks.h"
#include "index/system/links/link_source.h"
#include "index/system/memory_limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace isochron::index {
namespace {

constexpr std::uint64_t kMaxMetadataBytes = 256 << 20;
constexpr std::uint64_t kPage = 4096;
constexpr std::uint32_t kMostLevels = 64; ///< levels of detail of an array and of its colors

const char* section_name(SectionKind kind) {
    return kSectionNames[static_cast<std::size_t>(kind)];
}

/// The header as it would be of a file with this array alone.
FileHeader header_for(const ByteSource& file, FileHeader header, const ArrayPlace& place) {
    header.content_hash = place.content_hash;
    header.sections = place.sections;
    check_sections(file, header, "list of arrays");
    return header;
}

/// A step whose values and bricks come from two places.
struct JoinedStep {
    LoadedStep values, bricks;
};

} // namespace

IndexFile::IndexFile(std::unique_ptr<ByteSource> bytes, std::uint64_t cache_bytes)
    : bytes_(std::move(bytes)), cache_bytes_(cache_bytes ? cache_bytes : memory_limit() / 4),
      cache_(std::make_shared<ByteCache>(cache_bytes_)), header_(checked_header(*bytes_)) {
    read();
    open_further();
}

IndexFile::IndexFile(const IndexFile& first, const ArrayPlace& place)
    : first_(&first), bytes_(first.bytes_), cache_bytes_(first.cache_bytes_), cache_(first.cache_),
      header_(header_for(*bytes_, first.header_, place)),
      number_(static_cast<std::uint32_t>(first.further_.size() + 1)) {
    read();
    expect_same_shape(first);
}

void IndexFile::open_further() {
    for (const ArrayPlace& place : metadata_.further)
        further_.push_back(std::unique_ptr<IndexFile>(new IndexFile(*this, place)));
}

void IndexFile::expect_same_shape(const IndexFile& first) const {
    const SeriesInfo &info = metadata_.info, &of_first = first.info();
    if (info.grid != of_first.grid || info.times != of_first.times)
        throw damaged(fmt::format("array {} has another grid or other times than array {}",
                                  info.array, of_first.array));
    if (first.array_called(info.array))
        throw damaged(fmt::format("two arrays are called {}", info.array));
    if (metadata_.referral.has_value() != first.referral().has_value())
        throw damaged(fmt::format("only one of the arrays {} and {} refers to its sources",
                                  of_first.array, info.array));
    if (metadata_.color || !metadata_.further.empty())
        throw damaged(fmt::format("array {} has arrays of its own", info.array));
}

std::optional<std::size_t> IndexFile::array_called(std::string_view name) const {
    for (std::size_t number = 0; number < arrays(); ++number)
        if (array(number).info().array == name)
            return number;
    return std::nullopt;
}

void IndexFile::read() {
    if (const std::uint64_t size = header_.section(SectionKind::metadata).bytes;
        size > kMaxMetadataBytes)
        throw damaged(fmt::format("metadata of {} bytes", size));
    if (remote_of(*bytes_)) // one request for all but the tree
        for (const Section& each : header_.sections)
            if (&each != &header_.section(SectionKind::tree))
                bytes_->expect(each.offset, each.bytes);
    const auto text = section<char>(SectionKind::metadata);
    try {
        metadata_ = metadata_from_json({text.data(), text.size()});
    } catch (const Error& error) {
        throw damaged(fmt::format("metadata: {}", error.what()));
    }
    step_entries_ = section<StepEntry>(SectionKind::steps);
    unused_ = section<UnusedParts>(SectionKind::directory);
    checksums_ = section<std::uint64_t>(SectionKind::checksums);
    set_arrays();
    check_unused();
    IndexStats& stats = metadata_.stats;
    stats.file_bytes = header_.file_bytes;
    stats.tree_bytes = header_.section(SectionKind::tree).bytes;
}

/// Reads a section and checks its checksum.
template <class T>
std::vector<T> IndexFile::section(SectionKind kind) const {
    const Section& where = header_.section(kind);
    std::vector<T> items(where.bytes / sizeof(T));
    const auto bytes = std::as_writable_bytes(std::span(items));
    if (bytes.size() != where.bytes)
        throw damaged(fmt::format("section {} of {} bytes", section_name(kind), where.bytes));
    bytes_->read(where.offset, bytes);
    if (checksum_of(bytes) != where.checksum)
        throw mismatch(kind);
    return items;
}

bool IndexFile::lies_within(std::uint64_t offset, std::uint64_t bytes) const {
    return offset % kPartAlignment == 0 && offset >= kDataBegin && offset <= header_.file_bytes &&
           bytes <= header_.file_bytes - offset;
}

/// @param number index of the array in the section `steps` @param fine whether it is level 0
ChunkArray IndexFile::level_of(const std::string& called, std::size_t number,
                               const SeriesInfo& info, bool fine) const {
    ChunkArray array{.called = called,
                     .number = static_cast<std::uint32_t>(number_ * kMostLevels + number),
                     .info = info,
                     .steps = {},
                     .has_bricks = number < details_ && metadata_.plan.tiers.has(Tier::bricks),
                     .has_values = !metadata_.referral || !fine,
                     .has_since = has_since()};
    const ChunkGrid grid(info.grid);
    const std::uint64_t tables =
        layer_table_bytes(grid.chunks_of_layer(), array.has_since) * grid.layers();
    for (std::size_t step = 0; step < steps(); ++step) {
        const StepEntry& entry = step_entries_[number * steps() + step];
        const bool has_levels = array.has_bricks && has_step_levels(info.type);
        if (!lies_within(entry.offset, entry.bytes) || entry.tables > entry.bytes ||
            entry.bytes - entry.tables < tables ||
            (!has_levels && entry.bytes - entry.tables > tables))
            throw damaged(
                fmt::format("step {} of the {} lies outside the file", step, array.called));
        array.steps.push_back(entry);
    }
    return array;
}

/// All levels of an array. @param first index of the finest in the section `steps`
std::vector<std::unique_ptr<ChunkStore>> IndexFile::array_of(const char* called, std::size_t first,
                                                             const SeriesInfo& info) {
    std::vector<std::unique_ptr<ChunkStore>> levels;
    SeriesInfo of_level = info;
    for (const Grid& grid : detail_grids(info.grid)) {
        const std::size_t level = levels.size();
        of_level.grid = grid;
        levels.push_back(std::make_unique<ChunkStore>(
            *bytes_, *cache_,
            level_of(level == 0 ? called : fmt::format("{} at level {}", called, level),
                     first + level, of_level, level == 0)));
        std::uint64_t& bytes = level > 0   ? metadata_.stats.detail_bytes
                               : first > 0 ? metadata_.stats.color_bytes
                                           : metadata_.stats.volume_bytes;
        for (std::size_t step = 0; step < steps(); ++step)
            bytes += step_entries_[(first + level) * steps() + step].bytes;
    }
    return levels;
}

void IndexFile::set_arrays() {
    details_ = detail_grids(metadata_.info.grid).size();
    const std::size_t arrays = metadata_.color ? 2 : 1;
    if (const std::size_t entries = arrays * details_ * steps(); step_entries_.size() != entries)
        throw damaged(
            fmt::format("{} steps of chunks, expected {}", step_entries_.size(), entries));
    const std::size_t checksums = (arrays + 1) * steps() + 2 * unused_.size();
    if (checksums_.size() != checksums)
        throw damaged(fmt::format("{} checksums, expected {}", checksums_.size(), checksums));
    const auto sums = checksums_.begin();
    const auto count = static_cast<std::ptrdiff_t>(steps());
    volume_ = array_of("volume", 0, metadata_.info);
    if (metadata_.referral)
        source_ = std::make_unique<StepSource>(bytes_->name(), metadata_.info, *metadata_.referral,
                                               std::vector(sums, sums + count));
    IndexStats& stats = metadata_.stats;
    stats.bricks_bytes = metadata_.plan.tiers.has(Tier::bricks)
                             ? chunks().grid().count() * sizeof(ChunkBricks) * steps()
                             : 0;
    stats.volume_bytes -= std::min(stats.volume_bytes, stats.bricks_bytes);
    if (!metadata_.color)
        return;
    SeriesInfo info = metadata_.info;
    info.array = metadata_.color->array;
    info.value_unit = metadata_.color->value_unit;
    info.type = metadata_.color->type;
    info.scaling = metadata_.color->scaling;
    info.digits = telling_digits(metadata_.color->low, metadata_.color->high);
    colors_ = array_of("colors", details_, info);
    if (!metadata_.referral)
        return;
    color_referral_ = metadata_.referral;
    color_referral_->options.array = metadata_.color->chosen_array;
    color_referral_->options.component = metadata_.color->chosen_component;
    const auto sums_of_colors = color_checksums();
    color_source_ = std::make_unique<StepSource>(
        bytes_->name(), colors_.front()->info(), *color_referral_,
        std::vector<std::uint64_t>(sums_of_colors.begin(), sums_of_colors.end()));
}

void IndexFile::check_unused() {
    for (const UnusedParts& two : unused_)
        for (const auto& [offset, bytes] : two.parts) {
            if (!lies_within(offset, bytes))
                throw damaged("a part that is no longer used lies outside the file");
            std::uint64_t& all = metadata_.stats.unused_bytes;
            if ((all += bytes) > header_.file_bytes)
                throw damaged("parts that are no longer used overlap");
        }
}

std::span<const std::uint64_t> IndexFile::color_checksums() const {
    return !colors_.empty() ? std::span(checksums_).subspan(steps() + 2 * unused_.size(), steps())
                            : std::span<const std::uint64_t>();
}
std::span<const std::uint64_t> IndexFile::source_states() const {
    return std::span(checksums_).last(steps());
}

ReadUse IndexFile::reading() const {
    const ByteCache::Use use = cache_->use();
    return {.bytes = bytes_->bytes_read(),
            .hits = use.hits,
            .misses = use.misses,
            .held = use.held,
            .budget = cache_bytes_};
}

LoadedStep IndexFile::load(std::uint32_t step, const std::stop_token& stop) const {
    if (!source_)
        return chunks().whole(step, stop);
    auto both = std::make_shared<JoinedStep>(JoinedStep{source_->load(step), {}});
    if (metadata_.plan.tiers.has(Tier::bricks))
        both->bricks = chunks().whole(step, stop);
    return {both->values.values, both->bricks.bricks, both};
}

bool IndexFile::better_whole(std::uint32_t step) const {
    return source_ || chunks().better_whole(step);
}

LoadedStep IndexFile::load_color(std::uint32_t step, const std::stop_token& stop) const {
    return color_source_ ? color_source_->load(step) : colors_.front()->whole(step, stop);
}

const StepValues& IndexFile::values() const {
    const std::lock_guard lock(reading_);
    if (all_)
        return values_;
    const SeriesInfo& info = metadata_.info;
    StepValues all{.grid = info.grid,
                   .type = info.type,
                   .scaling = info.scaling,
                   .steps = info.steps(),
                   .stride = step_stride(info.step_bytes())};
    const std::size_t bytes = align_up(all.stride * all.steps, kPage);
    const std::shared_ptr<std::byte> memory(
        static_cast<std::byte*>(std::aligned_alloc(kPage, bytes)),
        [](std::byte* taken) { std::free(taken); });
    if (!memory)
        throw Error("{}: no memory for {} bytes", bytes_->name(), bytes);
    for (std::uint32_t step = 0; step < info.steps(); ++step)
        std::memcpy(memory.get() + step * all.stride, load(step).values.step_bytes(step).data(),
                    info.step_bytes());
    all.first = memory.get();
    values_ = all;
    all_ = memory;
    return values_;
}

std::vector<std::uint64_t> IndexFile::tree_bytes() const {
    return section<std::uint64_t>(SectionKind::tree);
}

IndexFile::Parts IndexFile::parts() const {
    Parts parts;
    for (std::size_t number = 0; number < arrays(); ++number) {
        const IndexFile& of = array(number);
        for (const StepEntry& step : of.step_entries_)
            parts.emplace_back(step.offset, step.bytes);
        for (const UnusedParts& two : of.unused_)
            for (const auto& [offset, bytes] : two.parts)
                parts.emplace_back(offset, bytes);
        for (const Section& section : of.header_.sections)
            if (section.bytes > 0)
                parts.emplace_back(section.offset, section.bytes);
    }
    return parts;
}

void IndexFile::verify(const Progress& progress) const {
    check_index(*this, progress);
}

Error IndexFile::damaged(const std::string& what) const {
    return Error("{}: damaged: {}", bytes_->name(), what);
}
Error IndexFile::mismatch(SectionKind kind) const {
    return damaged(fmt::format("the checksum of section {} does not match", section_name(kind)));
}

std::shared_ptr<const IndexFile> IndexFile::open(std::unique_ptr<ByteSource> bytes,
                                                 std::uint64_t cache_bytes) {
    return std::shared_ptr<const IndexFile>(new IndexFile(std::move(bytes), cache_bytes));
}

} // namespace isochron::index
