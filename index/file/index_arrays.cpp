// The arrays of an index: opening those after the first, and what all of them take of the file.
#include "index/error.h"
#include "index/file/index_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::index {
namespace {

/// The header as it would be of a file with this array alone.
FileHeader header_for(const ByteSource& file, FileHeader header, const ArrayPlace& place) {
    header.content_hash = place.content_hash;
    header.sections = place.sections;
    check_sections(file, header, "list of arrays");
    return header;
}

} // namespace

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

void IndexFile::verify(const Progress& progress) const {
    const auto count = static_cast<double>(arrays());
    for (std::size_t number = 0; number < arrays(); ++number)
        array(number).verify_parts([&](std::string_view phase, double done) {
            if (progress)
                progress(phase, (static_cast<double>(number) + done) / count);
        });
    check_gaps();
}

/// Adds where this array's parts lie, and how many bytes they have.
void IndexFile::add_parts(Used& used) const {
    for (const StepEntry& step : step_entries_)
        used.emplace_back(step.offset, step.bytes);
    for (const UnitEntry& unit : directory_) {
        used.emplace_back(unit.cells_offset, unit.cells_bytes);
        used.emplace_back(unit.deltas_offset, unit.deltas_bytes);
    }
    for (const Section& section : header_.sections)
        if (section.bytes > 0)
            used.emplace_back(section.offset, section.bytes);
}

IndexFile::Used IndexFile::all_parts() const {
    Used used;
    for (std::size_t number = 0; number < arrays(); ++number)
        array(number).add_parts(used);
    return used;
}

/// Checks that padding, which no checksum covers, is zero. Longer gaps hold parts of earlier
/// headers.
void IndexFile::check_gaps() const {
    Used used = all_parts();
    used.emplace_back(0, kDataBegin);
    std::ranges::sort(used);
    std::uint64_t end = 0;
    std::vector<std::byte> gap;
    for (const auto& [offset, bytes] : used) {
        gap.resize(offset > end && offset - end < kPartAlignment ? offset - end : 0);
        bytes_->read(end, gap);
        for (std::size_t i = 0; i < gap.size(); ++i)
            if (gap[i] != std::byte{0})
                throw damaged(fmt::format("byte {} is not zero", end + i));
        end = std::max(end, offset + bytes);
    }
}

} // namespace isochron::index
