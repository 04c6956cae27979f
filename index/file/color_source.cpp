// The arrays by which surfaces of an index can be colored.
#include "index/file/color_source.h"

namespace isochron::index {
namespace {

/// The array of values alone belongs to the first array of the file.
const ColorArray* values_alone_of(const IndexFile& file) {
    return file.array(0).color();
}

ColorArray described(const IndexFile& file) {
    const SeriesInfo& info = file.info();
    const IndexStats& stats = file.stats();
    return {.array = info.array,
            .value_unit = info.value_unit,
            .type = info.type,
            .scaling = info.scaling,
            .low = stats.low,
            .high = stats.high,
            .nan_values = stats.nan_values};
}

} // namespace

std::size_t ColorSource::count(const IndexFile& file) {
    const std::size_t arrays = file.arrays();
    if (values_alone_of(file))
        return arrays + 1;
    return arrays > 1 ? arrays : 0;
}

ColorSource::ColorSource(const IndexFile& file, std::size_t number)
    : file_(&file.array(0)), values_alone_(number == 0 && values_alone_of(file)) {
    if (values_alone_) {
        array_ = *file_->color();
        return;
    }
    file_ = &file.array(number - (values_alone_of(file) ? 1 : 0));
    array_ = described(*file_);
}

const ChunkStore* ColorSource::chunks(std::size_t level) const {
    if (values_alone_)
        return file_->color_chunks(level);
    return level == 0 && file_->referral() ? nullptr : &file_->chunks(level);
}

StepView ColorSource::step(const StepView& surfaces) const {
    if (surfaces.by_chunks())
        return {*chunks(surfaces.level()), surfaces.at(), surfaces.level()};
    return {{&surfaces.grid(), array_.type, array_.scaling, surfaces.steps()},
            chunks(),
            surfaces.at(),
            [file = file_, alone = values_alone_](std::uint32_t step, const std::stop_token& stop) {
                return alone ? file->load_color(step, stop) : file->load(step, stop);
            }};
}

std::vector<std::string> color_source_names(const IndexFile& file) {
    std::vector<std::string> names;
    for (std::size_t number = 0; number < ColorSource::count(file); ++number)
        names.push_back(ColorSource(file, number).array().array);
    return names;
}

std::optional<std::size_t> color_source_named(const IndexFile& file, std::string_view name) {
    for (std::size_t number = 0; number < ColorSource::count(file); ++number)
        if (ColorSource(file, number).array().array == name)
            return number;
    return std::nullopt;
}

std::size_t color_source_called(const IndexFile& file, std::string_view name,
                                std::size_t surfaces) {
    if (const auto named = name.empty() ? std::nullopt : color_source_named(file, name))
        return *named;
    if (values_alone_of(file))
        return 0;
    const std::size_t count = ColorSource::count(file), other = surfaces == 0 && count > 1 ? 1 : 0;
    for (std::size_t number = other; number < count; ++number)
        if (const ColorArray array = ColorSource(file, number).array();
            number != surfaces && array.low < array.high)
            return number;
    return other;
}

} // namespace isochron::index
