// The color scale of the surfaces.
#include "app/scene/color_scale.h"

#include "app/scene/ticks.h"
#include "index/file/color_source.h"
#include "index/surface/cell_colors.h"
#include "index/volume/time_unit.h"
#include "render/gl/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::app {
namespace {

std::string with_brackets(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

/// The scale with its range and its map. @param range empty: the whole one
ColorScale used_as(const interaction::Coloring& coloring,
                   const std::optional<std::array<double, 2>>& range, ColorScale scale) {
    scale.range = range.value_or(scale.whole);
    scale.map = coloring.map;
    scale.colors = coloring.colors;
    scale.use = {coloring.reversed, coloring.bands};
    if (coloring.logarithmic && scale.range[1] > 0) {
        // Without a range of its own a map goes by logarithms over six decades at most.
        constexpr double kDecades = 1e-6;
        if (!range && !(scale.range[0] > kDecades * scale.range[1]))
            scale.range[0] = kDecades * scale.range[1];
        scale.logarithmic = scale.range[0] > 0;
    }
    return scale;
}

} // namespace

std::size_t color_array(const ExplorerState& state, const index::IndexFile& file) {
    return index::color_source_called(file, state.coloring.array,
                                      file.array_called(state.array).value_or(0));
}

std::optional<std::array<double, 2>> PercentileRange::of(const ColoredSurfaces& shown,
                                                         const std::array<double, 2>& whole,
                                                         const std::array<double, 2>& percentiles) {
    std::vector<std::weak_ptr<const void>> now{shown.cells};
    now.insert(now.end(), shown.further.begin(), shown.further.end());
    const bool same_set = std::ranges::equal(now, shown_, [](const auto& a, const auto& b) {
        return !a.owner_before(b) && !b.owner_before(a);
    });
    if (same_set && whole == whole_ && percentiles == percentiles_)
        return range_;
    shown_ = std::move(now);
    whole_ = whole;
    percentiles_ = percentiles;
    range_ = range_of_shares(shown, whole, {percentiles[0] / 100, percentiles[1] / 100});
    return range_;
}

std::optional<ColorScale> color_scale(const ExplorerState& state, const index::IndexFile& file,
                                      const ColoredSurfaces& shown, PercentileRange& cached) {
    ColorScale scale;
    switch (state.coloring.by) {
    case interaction::ColorBy::surface: return std::nullopt;
    case interaction::ColorBy::value: {
        if (index::ColorSource::count(file) == 0)
            return std::nullopt;
        const std::size_t number = color_array(state, file);
        const index::ColorArray color = index::ColorSource(file, number).array();
        scale.title = with_brackets(color.array, color.value_unit);
        scale.whole = {color.low, color.high};
        break;
    }
    case interaction::ColorBy::first_crossing:
        if (index::has_dates(file.info().times, file.info().time_unit))
            scale.dates_of = file.info().time_unit;
        scale.title =
            with_brackets("first crossing", scale.dates_of.empty() ? file.info().time_unit : "");
        scale.whole = {file.info().times.front(), file.info().times.back()};
        break;
    }
    std::optional<std::array<double, 2>> range = state.coloring.range;
    if (!range && state.coloring.percentiles)
        range = cached.of(shown, scale.whole, *state.coloring.percentiles);
    return used_as(state.coloring, range, std::move(scale));
}

std::size_t slice_array(const ExplorerState& state, const index::IndexFile& file) {
    const auto named = file.array_called(state.slices.coloring.array);
    return state.slices.coloring.array.empty() || !named
               ? file.array_called(state.array).value_or(0)
               : *named;
}

ColorScale slice_scale(const ExplorerState& state, const index::IndexFile& file,
                       std::size_t number) {
    const index::IndexFile& array = file.array(number);
    const interaction::Coloring& coloring = state.slices.coloring;
    ColorScale scale;
    scale.title = with_brackets(array.info().array, array.info().value_unit);
    scale.whole = {array.stats().low, array.stats().high};
    std::optional<std::array<double, 2>> range = coloring.range;
    if (!range && coloring.percentiles) {
        const auto [low, high] = *coloring.percentiles;
        range = {quantile(array.stats(), low / 100), quantile(array.stats(), high / 100)};
        if (!((*range)[0] < (*range)[1]))
            range.reset();
    }
    return used_as(coloring, range, std::move(scale));
}

std::vector<glm::vec3> colors_of(const ColorScale& scale) {
    std::vector<glm::vec3> given;
    for (const std::uint32_t color : scale.colors)
        given.push_back(render::linear_from_srgb(
            glm::vec3(color >> 16 & 0xffu, color >> 8 & 0xffu, color & 0xffu) / 255.0f));
    const auto known = render::color_map_from_name(scale.map);
    return render::used(given.empty() ? render::color_map(known.value_or(render::ColorMap::viridis))
                                      : render::color_map_between(given),
                        scale.use);
}

double share_on(const ColorScale& scale, double value) {
    const auto [low, high] = scale.range;
    if (scale.logarithmic)
        return std::log(value / low) / std::log(high / low);
    return (value / 2 - low / 2) / (high / 2 - low / 2);
}

std::vector<ScaleTick> ticks_on(const ColorScale& scale, int most) {
    const auto [low, high] = scale.range;
    if (low == high && scale.dates_of.empty())
        return {{0.0, fmt::format("{:.6g}", low)}};
    const Ticks ticks =
        scale.logarithmic ? logarithmic_ticks(low, high, most) : nice_ticks(low, high, most);
    std::vector<ScaleTick> all;
    for (std::size_t i = 0; i < ticks.values.size(); ++i) {
        const double value = ticks.values[i];
        all.push_back(
            {share_on(scale, value), scale.dates_of.empty()
                                         ? tick_text(value, scale.logarithmic ? value : ticks.step)
                                         : index::time_text(ticks.values, i, scale.dates_of)});
    }
    return all;
}

std::optional<std::array<double, 2>> range_of_shares(const ColoredSurfaces& shown,
                                                     const std::array<double, 2>& whole,
                                                     const std::array<double, 2>& shares) {
    // Shares of the whole range, exact for both kinds of coordinates.
    constexpr std::uint32_t kWhole = std::uint32_t{index::kColorSteps} * index::kFineColorSteps;
    std::vector<std::uint32_t> parts;
    const auto add = [&](const std::vector<std::uint16_t>& coordinates, std::uint16_t none,
                         std::uint16_t steps) {
        for (const std::uint16_t one : coordinates)
            if (one != none)
                parts.push_back(one * (kWhole / steps));
    };
    if (shown.cells)
        add(shown.cells->colors, index::kNoColor, index::kColorSteps);
    for (const index::InstantSurfacesPtr& each : shown.further)
        for (const index::CellMeshPtr& mesh : each->meshes)
            if (mesh)
                add(mesh->colors, index::kNoFineColor, index::kFineColorSteps);
    if (parts.empty())
        return std::nullopt;
    std::array<double, 2> range{};
    for (std::size_t end = 0; end < 2; ++end) {
        const auto at =
            parts.begin() + std::lround(shares[end] * static_cast<double>(parts.size() - 1));
        std::ranges::nth_element(parts, at);
        range[end] = std::lerp(whole[0], whole[1], *at / double{kWhole});
    }
    return range[0] < range[1] ? std::optional(range) : std::nullopt;
}

render::ValueColors value_colors(const ColorScale& scale, const render::Texture& map) {
    const auto share = [&](double value) {
        const double half = scale.whole[1] / 2 - scale.whole[0] / 2;
        return half > 0 ? static_cast<float>((value / 2 - scale.whole[0] / 2) / half) : 0.0f;
    };
    render::ValueColors colors{.map = map.name(),
                               .low = share(scale.range[0]),
                               .high = share(scale.range[1]),
                               .bands = scale.use.bands > 0};
    if (scale.logarithmic)
        colors.ratio = static_cast<float>(scale.range[1] / scale.range[0]);
    return colors;
}

} // namespace isochron::app
