// The second array of a series in an open file.
#include "index/file/color_array.h"

#include "index/error.h"
#include "index/file/file_layout.h"
#include "index/file/metadata.h"

#include <fmt/format.h>

namespace isochron::index {

ColorSection::ColorSection(std::span<const std::byte> section, const std::filesystem::path& index,
                           const SeriesInfo& volume, const ColorArray& array,
                           const std::optional<Referral>& referral)
    : section_(section), info_(volume), referral_(referral) {
    info_.array = array.array;
    info_.value_unit = array.value_unit;
    info_.type = array.type;
    info_.scaling = array.scaling;
    const std::uint64_t expected = bytes(volume, array.type, !referral);
    if (section.size() != expected)
        throw Error(fmt::format("colors of {} bytes, expected {}", section.size(), expected));
    if (!referral_)
        return;
    referral_->options.array = array.chosen_array;
    referral_->options.component = array.chosen_component;
    source_ = std::make_unique<StepSource>(
        index, info_, *referral_,
        std::vector<std::uint64_t>(checksums().begin(), checksums().end()));
}

LoadedStep ColorSection::load(std::uint32_t step) const {
    if (source_)
        return source_->load(step);
    const std::size_t stride = step_stride(info_.step_bytes());
    return {{.grid = info_.grid,
             .type = info_.type,
             .scaling = info_.scaling,
             .steps = info_.steps(),
             .first = section_.data() + table_bytes(info_.steps()) + step * stride,
             .stride = stride,
             .first_step = step},
            nullptr};
}

bool ColorSection::matches(std::uint32_t step) const {
    const LoadedStep loaded = load(step);
    return checksum_of(loaded.values.step_bytes(step)) == checksums()[step];
}

std::vector<std::pair<std::uint64_t, std::uint64_t>> ColorSection::parts() const {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> parts{
        {0, info_.steps() * sizeof(std::uint64_t)}};
    for (std::size_t step = 0; !source_ && step < info_.steps(); ++step)
        parts.emplace_back(table_bytes(info_.steps()) + step * step_stride(info_.step_bytes()),
                           info_.step_bytes());
    return parts;
}

std::uint64_t ColorSection::table_bytes(std::size_t steps) {
    return align_up(steps * sizeof(std::uint64_t), kPartAlignment);
}

std::uint64_t ColorSection::bytes(const SeriesInfo& volume, ValueType type, bool with_values) {
    const std::size_t step_bytes = volume.grid.vertex_count() * size_of(type);
    return table_bytes(volume.steps()) +
           (with_values ? volume.steps() * step_stride(step_bytes) : 0);
}

std::span<const std::uint64_t> ColorSection::checksums() const {
    return {reinterpret_cast<const std::uint64_t*>(section_.data()), info_.steps()};
}

} // namespace isochron::index
