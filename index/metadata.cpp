// What an .isochron file knows about its volume, as JSON.
#include "index/metadata.h"

#include "index/error.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::index {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxDepth = 8;
constexpr std::array kAnatomies{"none", "ras", "lps"};

json numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

glm::dvec3 vector_of(const json& value) {
    const auto v = value.get<std::array<double, 3>>();
    return {v[0], v[1], v[2]};
}

/// The library converts numbers of any kind and size without a word.
template <class T>
T whole(const json& value) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<T>::max())
        throw Error(fmt::format("expected a whole number up to {}, got {}",
                                std::numeric_limits<T>::max(), value.dump()));
    return value.get<T>();
}

template <class Numbers>
void get_whole(const json& values, Numbers& out) {
    if (!values.is_array() || values.size() != out.size())
        throw Error(fmt::format("expected {} whole numbers", out.size()));
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = whole<typename Numbers::value_type>(values[i]);
}

/// The parser itself accepts any depth; ours is known.
void check_depth(std::string_view text) {
    std::size_t depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\')
            ++i;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && (c == '[' || c == '{')) {
            if (++depth > kMaxDepth)
                throw Error(fmt::format("nested more than {} deep", kMaxDepth));
        } else if (!quoted && (c == ']' || c == '}') && depth > 0)
            --depth;
    }
}

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

SeriesInfo info_of(const json& j) {
    SeriesInfo info;
    j.at("array").get_to(info.array);
    j.at("value_unit").get_to(info.value_unit);
    j.at("length_unit").get_to(info.length_unit);
    j.at("time_unit").get_to(info.time_unit);
    const auto anatomy = std::ranges::find(kAnatomies, j.at("anatomy").get<std::string>());
    if (anatomy == kAnatomies.end())
        throw Error("unknown anatomy");
    info.anatomy = static_cast<Anatomy>(anatomy - kAnatomies.begin());
    get_whole(j.at("vertices"), info.grid.vertices);
    info.grid.origin = vector_of(j.at("origin"));
    info.grid.spacing = vector_of(j.at("spacing"));
    const json& direction = j.at("direction");
    for (std::size_t axis = 0; axis < 3; ++axis)
        info.grid.direction[static_cast<int>(axis)] = vector_of(direction.at(axis));
    const auto type = value_type_from_name(j.at("type").get<std::string>());
    if (!type)
        throw Error("unknown value type");
    info.type = *type;
    j.at("slope").get_to(info.scaling.slope);
    j.at("intercept").get_to(info.scaling.intercept);
    j.at("times").get_to(info.times);
    j.at("sources").get_to(info.sources);
    j.at("notes").get_to(info.notes);
    check_limits(info);
    return info;
}

} // namespace

void check_limits(const SeriesInfo& info) {
    const Grid& grid = info.grid;
    for (const std::uint32_t n : grid.vertices)
        if (n < 2 || n > 65537)
            throw Error(fmt::format("{}x{}x{} vertices, expected 2 to 65537 along each axis",
                                    grid.vertices[0], grid.vertices[1], grid.vertices[2]));
    if (grid.cell_count() > std::numeric_limits<CellId>::max())
        throw Error(fmt::format("{} cells, expected fewer than 2^32", grid.cell_count()));
    if (!finite(grid.origin) || !finite(grid.spacing) || !finite(grid.direction[0]) ||
        !finite(grid.direction[1]) || !finite(grid.direction[2]))
        throw Error("origin, spacing or direction is not finite");
    if (!(grid.spacing.x > 0 && grid.spacing.y > 0 && grid.spacing.z > 0))
        throw Error(fmt::format("spacing {} {} {}, expected positive numbers", grid.spacing.x,
                                grid.spacing.y, grid.spacing.z));
    if (!(std::abs(glm::determinant(grid.direction)) > 1e-6))
        throw Error("the direction's axes lie in one plane");
    if (!std::isfinite(info.scaling.slope) || info.scaling.slope == 0 ||
        !std::isfinite(info.scaling.intercept))
        throw Error(fmt::format("scaling {} * stored + {}, expected finite numbers and no slope 0",
                                info.scaling.slope, info.scaling.intercept));
    if (info.times.empty() || info.times.size() >= std::numeric_limits<std::uint32_t>::max())
        throw Error(fmt::format("{} steps, expected 1 to 2^32 - 2", info.times.size()));
    for (std::size_t t = 0; t < info.times.size(); ++t)
        if (!std::isfinite(info.times[t]) || (t > 0 && !(info.times[t] > info.times[t - 1])))
            throw Error(fmt::format("step {} has time {}, expected finite and increasing times", t,
                                    info.times[t]));
}

std::string to_json(const Metadata& metadata) {
    const SeriesInfo& info = metadata.info;
    const Grid& grid = info.grid;
    const IndexStats& stats = metadata.stats;
    const json j{
        {"array", info.array},
        {"value_unit", info.value_unit},
        {"length_unit", info.length_unit},
        {"time_unit", info.time_unit},
        {"anatomy", kAnatomies[static_cast<std::size_t>(info.anatomy)]},
        {"vertices", grid.vertices},
        {"origin", numbers(grid.origin)},
        {"spacing", numbers(grid.spacing)},
        {"direction",
         {numbers(grid.direction[0]), numbers(grid.direction[1]), numbers(grid.direction[2])}},
        {"type", name_of(info.type)},
        {"slope", info.scaling.slope},
        {"intercept", info.scaling.intercept},
        {"times", info.times},
        {"sources", info.sources},
        {"notes", info.notes},
        {"stats",
         {{"low", stats.low},
          {"high", stats.high},
          {"nan_values", stats.nan_values},
          {"histogram", stats.histogram}}},
        {"build",
         {{"lattice", metadata.options.tree.lattice},
          {"max_variation", metadata.options.tree.max_variation},
          {"exact_only", metadata.options.exact_only}}},
    };
    // File names may be any bytes; JSON may not.
    return j.dump(-1, ' ', false, json::error_handler_t::replace);
}

Metadata metadata_from_json(std::string_view text) try {
    check_depth(text);
    const json j = json::parse(text);
    Metadata metadata;
    metadata.info = info_of(j);
    const json& stats = j.at("stats");
    stats.at("low").get_to(metadata.stats.low);
    stats.at("high").get_to(metadata.stats.high);
    metadata.stats.nan_values = whole<std::uint64_t>(stats.at("nan_values"));
    metadata.stats.histogram.resize(kHistogramBins);
    get_whole(stats.at("histogram"), metadata.stats.histogram);
    const json& build = j.at("build");
    metadata.options.tree.lattice = whole<std::uint32_t>(build.at("lattice"));
    metadata.options.tree.max_variation = whole<std::uint32_t>(build.at("max_variation"));
    build.at("exact_only").get_to(metadata.options.exact_only);
    return metadata;
} catch (const json::exception& error) {
    throw Error(error.what());
}

} // namespace isochron::index
