// Opening of .isochron files.
#include "index/file/index_file.h"

#include "index/scan/bricks.h"
#include "index/volume/chunking.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

constexpr std::uint64_t kMaxMetadataBytes = 256 << 20;

const char* section_name(SectionKind kind) {
    return kSectionNames[static_cast<std::size_t>(kind)];
}

} // namespace

IndexFile::IndexFile(const std::filesystem::path& path)
    : name_(path.string()), file_(path), header_(checked_header(name_, file_.bytes())) {
    for (const SectionKind kind :
         {SectionKind::metadata, SectionKind::directory, SectionKind::checksums})
        check(kind);
    const auto bytes = section(SectionKind::metadata);
    if (bytes.size() > kMaxMetadataBytes)
        throw damaged(fmt::format("metadata of {} bytes", bytes.size()));
    try {
        metadata_ = metadata_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    } catch (const Error& error) {
        throw damaged(fmt::format("metadata: {}", error.what()));
    }
    set_values();
    set_bricks();
    set_cells();
    if (checksums().size() != checksum_count_)
        throw damaged(
            fmt::format("{} checksums, expected {}", checksums().size(), checksum_count_));
    if (metadata_.referral)
        source_ = std::make_unique<StepSource>(
            path, metadata_.info, *metadata_.referral,
            std::vector<std::uint64_t>(checksums().begin(),
                                       checksums().begin() + std::ptrdiff_t(steps())));
    set_colors(path);
    IndexStats& stats = metadata_.stats;
    stats.color_bytes = header_.colors.bytes;
    stats.file_bytes = header_.file_bytes;
    stats.volume_bytes = header_.section(SectionKind::volume).bytes;
    stats.bricks_bytes = header_.section(SectionKind::bricks).bytes;
    stats.tree_bytes = header_.section(SectionKind::tree).bytes;
}

const StepValues& IndexFile::values() const {
    if (source_)
        throw Error(fmt::format("{}: refers to its values instead of carrying them", name_));
    return values_;
}

LoadedStep IndexFile::load(std::uint32_t step) const {
    if (source_)
        return source_->load(step);
    StepValues window = values_;
    window.first += step * window.stride;
    window.first_step = step;
    return {window, nullptr};
}

std::span<const std::uint8_t> IndexFile::bricks(std::uint32_t step) const {
    if (brick_bytes_ == 0)
        return {};
    const auto bytes = section(SectionKind::bricks).subspan(step * brick_stride_, brick_bytes_);
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

const ThiTree* IndexFile::tree() const {
    std::call_once(tree_checked_, [this] {
        const auto bytes = section(SectionKind::tree);
        if (bytes.empty())
            return;
        check(SectionKind::tree);
        try {
            tree_ = std::make_unique<ThiTree>(bytes);
        } catch (const Error& error) {
            throw damaged(fmt::format("tree: {}", error.what()));
        }
        if (tree_->steps() != steps())
            throw damaged(
                fmt::format("tree of {} steps, the volume has {}", tree_->steps(), steps()));
    });
    return tree_.get();
}

void IndexFile::verify(const Progress& progress) const {
    std::size_t next = 0;
    const auto total = static_cast<double>(checksum_count_);
    const auto expect = [&](std::span<const std::byte> bytes, SectionKind kind) {
        if (progress)
            progress(section_name(kind), static_cast<double>(next) / total);
        if (checksum_of(bytes) != checksums()[next++])
            throw mismatch(kind);
    };
    for (std::uint32_t step = 0; step < steps(); ++step) {
        const LoadedStep loaded = load(step);
        expect(loaded.values.step_bytes(step), SectionKind::volume);
    }
    if (brick_bytes_ > 0)
        for (std::uint32_t step = 0; step < steps(); ++step)
            expect(std::as_bytes(bricks(step)), SectionKind::bricks);
    for (const UnitEntry& unit : directory_) {
        expect(part(unit.cells_offset, unit.cells_bytes), SectionKind::units);
        expect(part(unit.deltas_offset, unit.deltas_bytes), SectionKind::units);
    }
    if (cells_)
        cells_->verify();
    if (metadata_.plan.tiers.has(Tier::tree))
        check(SectionKind::tree);
    for (std::uint32_t step = 0; colors_ && step < steps(); ++step)
        if (!colors_->matches(step))
            throw damaged(
                fmt::format("the checksum of the colors of step {} does not match", step));
    check_gaps();
}

std::span<const std::byte> IndexFile::section(SectionKind kind) const {
    const Section& section = header_.section(kind);
    return file_.bytes().subspan(section.offset, section.bytes);
}
std::span<const std::byte> IndexFile::part(std::uint64_t offset, std::uint64_t bytes) const {
    return section(SectionKind::units).subspan(offset, bytes);
}

Error IndexFile::damaged(const std::string& what) const {
    return Error(fmt::format("{}: damaged: {}", name_, what));
}
Error IndexFile::mismatch(SectionKind kind) const {
    return damaged(fmt::format("the checksum of section {} does not match", section_name(kind)));
}

void IndexFile::check(SectionKind kind) const {
    if (checksum_of(section(kind)) != header_.section(kind).checksum)
        throw mismatch(kind);
}

std::span<const std::uint64_t> IndexFile::checksums() const {
    const auto bytes = section(SectionKind::checksums);
    return {reinterpret_cast<const std::uint64_t*>(bytes.data()),
            bytes.size() / sizeof(std::uint64_t)};
}

/// Padding is zero and lies outside every checksum.
void IndexFile::check_gaps() const {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> used{{0, kSectionAlignment}};
    const auto use = [&](SectionKind kind, std::uint64_t offset, std::uint64_t bytes) {
        used.emplace_back(header_.section(kind).offset + offset, bytes);
    };
    if (!source_)
        for (std::size_t step = 0; step < steps(); ++step)
            use(SectionKind::volume, step * values_.stride, metadata_.info.step_bytes());
    for (std::size_t step = 0; brick_bytes_ > 0 && step < steps(); ++step)
        use(SectionKind::bricks, step * brick_stride_, brick_bytes_);
    for (const UnitEntry& unit : directory_) {
        use(SectionKind::units, unit.cells_offset, unit.cells_bytes);
        use(SectionKind::units, unit.deltas_offset, unit.deltas_bytes);
    }
    for (const SectionKind kind :
         {SectionKind::tree, SectionKind::directory, SectionKind::checksums, SectionKind::metadata})
        use(kind, 0, header_.section(kind).bytes);
    if (colors_)
        for (const auto& [offset, bytes] : colors_->parts())
            used.emplace_back(header_.colors.offset + offset, bytes);
    std::sort(used.begin(), used.end());
    std::uint64_t end = 0;
    for (const auto& [offset, bytes] : used) {
        for (std::uint64_t at = end; at < offset; ++at)
            if (file_.bytes()[at] != std::byte{0})
                throw damaged(fmt::format("byte {} is not zero", at));
        end = std::max(end, offset + bytes);
    }
}

void IndexFile::set_values() {
    const SeriesInfo& info = metadata_.info;
    checksum_count_ = steps();
    if (metadata_.referral)
        return;
    const auto volume = section(SectionKind::volume);
    values_ = {.grid = info.grid,
               .type = info.type,
               .scaling = info.scaling,
               .steps = info.steps(),
               .first = volume.data(),
               .stride = step_stride(info.step_bytes())};
    // Division, since the product of damaged numbers could wrap.
    if (volume.size() / values_.steps != values_.stride || volume.size() % values_.steps)
        throw damaged(fmt::format("volume of {} bytes, expected {} steps of {}", volume.size(),
                                  values_.steps, values_.stride));
}

void IndexFile::set_bricks() {
    if (!metadata_.plan.tiers.has(Tier::bricks))
        return;
    brick_bytes_ = BrickGrid(metadata_.info.grid).bytes_per_step();
    brick_stride_ = align_up(brick_bytes_, kPartAlignment);
    const std::uint64_t bytes = section(SectionKind::bricks).size();
    if (bytes / steps() != brick_stride_ || bytes % steps())
        throw damaged(fmt::format("bricks of {} bytes, expected {} steps of {}", bytes, steps(),
                                  brick_stride_));
    checksum_count_ += steps();
}

void IndexFile::set_cells() {
    const auto bytes = section(SectionKind::directory);
    directory_ = {reinterpret_cast<const UnitEntry*>(bytes.data()),
                  bytes.size() / sizeof(UnitEntry)};
    if (!metadata_.plan.tiers.has(Tier::cells)) {
        if (!bytes.empty())
            throw damaged("a directory of cells that there are none of");
        return;
    }
    const Grid& grid = metadata_.info.grid;
    if (grid.cells()[0] > Chunking::kMaxCells)
        throw damaged(fmt::format("cells in rows of {}", grid.cells()[0]));
    const std::uint64_t expected = Chunking(grid).count() * std::uint64_t{epoch_count(steps())};
    if (directory_.size() != expected || bytes.size() % sizeof(UnitEntry))
        throw damaged(
            fmt::format("directory of {} units, expected {}", directory_.size(), expected));
    const std::uint64_t size = section(SectionKind::units).size();
    const bool with_deltas = metadata_.plan.tiers.has(Tier::deltas);
    CellTier::Units cells, deltas;
    for (const UnitEntry& unit : directory_) {
        for (const auto& [offset, length] : {std::pair{unit.cells_offset, unit.cells_bytes},
                                             std::pair{unit.deltas_offset, unit.deltas_bytes}})
            if (offset > size || length > size - offset || offset % kPartAlignment)
                throw damaged("a unit of cells lies outside its section");
        cells.push_back(part(unit.cells_offset, unit.cells_bytes));
        if (with_deltas)
            deltas.push_back(part(unit.deltas_offset, unit.deltas_bytes));
        metadata_.stats.cells_bytes += unit.cells_bytes;
        metadata_.stats.deltas_bytes += unit.deltas_bytes;
    }
    checksum_count_ += 2 * directory_.size();
    file_.expect_scattered_reads(section(SectionKind::units));
    cells_.emplace(Chunking(grid), static_cast<std::uint32_t>(steps()), cells, deltas);
}

void IndexFile::set_colors(const std::filesystem::path& path) {
    const Section& section = header_.colors;
    if (metadata_.color.has_value() != (section.bytes > 0))
        throw damaged(metadata_.color ? "no section of colors" : "colors of no array");
    if (!metadata_.color)
        return;
    const auto bytes = file_.bytes().subspan(section.offset, section.bytes);
    const std::uint64_t table = steps() * sizeof(std::uint64_t);
    if (bytes.size() < table || checksum_of(bytes.first(table)) != section.checksum)
        throw damaged("the checksum of the table of colors does not match");
    try {
        colors_ = std::make_unique<ColorSection>(bytes, path, metadata_.info, *metadata_.color,
                                                 metadata_.referral);
    } catch (const Error& error) {
        throw damaged(error.what());
    }
}

std::shared_ptr<const IndexFile> IndexFile::open(const std::filesystem::path& path) {
    return std::shared_ptr<const IndexFile>(new IndexFile(path));
}

} // namespace isochron::index
