// The metadata section of an .isochron file, as JSON.
#include "index/file/sections/metadata.h"

#include "index/json_mistake.h"

#include "index/error.h"
#include "index/file/sections/metadata_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace isochron::index {
namespace {

constexpr std::size_t kMaxDepth = 8;
constexpr std::array kAnatomies{"none", "ras", "lps", "enu"};

/// Limits the depth of JSON, since the parser accepts any depth.
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
                throw Error("nested more than {} deep", kMaxDepth);
        } else if (!quoted && (c == ']' || c == '}') && depth > 0)
            --depth;
    }
}

SeriesInfo info_of(const json& j) {
    SeriesInfo info;
    info.array = exact_text(j.at("array"));
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
    if (const auto found = j.find("positions"); found != j.end())
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (!found->at(axis).empty())
                info.grid.positions[axis] =
                    AxisPositions(found->at(axis).get<std::vector<double>>());
    if (const auto found = j.find("axis_names"); found != j.end())
        found->get_to(info.axis_names);
    const auto type = value_type_from_name(j.at("type").get<std::string>());
    if (!type)
        throw Error("unknown value type");
    info.type = *type;
    j.at("slope").get_to(info.scaling.slope);
    j.at("intercept").get_to(info.scaling.intercept);
    j.at("times").get_to(info.times);
    if (const auto found = j.find("missing_after"); found != j.end()) {
        info.missing_after.resize(std::min(found->size(), info.steps()));
        get_whole(*found, info.missing_after);
    }
    for (const json& source : j.at("sources"))
        info.sources.push_back(exact_text(source));
    j.at("notes").get_to(info.notes);
    check_limits(info);
    return info;
}

json json_of(const ValueCounts& counts) {
    return {{"low", counts.low},           {"high", counts.high},   {"nan", counts.nan_values},
            {"exponent", counts.exponent}, {"first", counts.first}, {"bins", counts.bins}};
}

ValueCounts counts_of(const json& j, ValueType type) {
    ValueCounts counts;
    j.at("low").get_to(counts.low);
    j.at("high").get_to(counts.high);
    counts.nan_values = whole<std::uint64_t>(j.at("nan"));
    const json &exponent = j.at("exponent"), &first = j.at("first"), &bins = j.at("bins");
    if (!exponent.is_number_integer() || !first.is_number_integer() || !bins.is_array() ||
        bins.size() > static_cast<std::size_t>(ValueCounts::kMostBins))
        throw Error("counts of values that cannot be");
    exponent.get_to(counts.exponent);
    first.get_to(counts.first);
    counts.bins.resize(bins.size());
    get_whole(bins, counts.bins);
    if (!counts.sound(type))
        throw Error("counts of values that do not fit their range");
    return counts;
}

json json_of(const ChosenTiers& plan) {
    json tiers = json::array();
    for (std::size_t i = 0; i < kTierNames.size(); ++i)
        if (plan.tiers.has(static_cast<Tier>(i)))
            tiers.push_back(kTierNames[i]);
    return {
        {"tiers", tiers}, {"reasons", plan.reasons}, {"asked", plan.asked}, {"steps", plan.steps}};
}

ChosenTiers plan_of(const json& j) {
    ChosenTiers plan;
    for (const json& name : j.at("tiers")) {
        const auto tier = tier_from_name(name.get<std::string>());
        if (tier)
            plan.tiers = plan.tiers.with(*tier);
        else if (!is_former_tier(name.get<std::string>()))
            throw Error("unknown tier {}", name.dump());
    }
    j.at("reasons").get_to(plan.reasons);
    std::erase_if(plan.reasons,
                  [](const std::string& reason) { // why there were former tiers, or not
                      const std::string_view tier =
                          std::string_view(reason).substr(reason.starts_with("no ") ? 3 : 0);
                      return tier.starts_with("cells") || tier.starts_with("deltas");
                  });
    plan.asked = j.value("asked", false); // version 2 did not say
    if (j.contains("steps"))
        plan.steps = whole<std::uint32_t>(j.at("steps"));
    return plan;
}

} // namespace

void set_counts(Metadata& metadata, ValueCounts counts) {
    IndexStats& stats = metadata.stats;
    SeriesInfo& info = metadata.info;
    stats.low = counts.scaled_low(info.scaling);
    stats.high = counts.scaled_high(info.scaling);
    info.digits = telling_digits(stats.low, stats.high);
    stats.nan_values = counts.nan_values;
    stats.histogram = counts.histogram(info.type, info.scaling);
    stats.counts = std::move(counts);
}

std::string to_json(const Metadata& metadata) {
    const SeriesInfo& info = metadata.info;
    const Grid& grid = info.grid;
    const IndexStats& stats = metadata.stats;
    json j{
        {"array", exact(info.array)},
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
        {"sources", exact(info.sources)},
        {"notes", info.notes},
        {"stats", {{"counts", json_of(stats.counts)}, {"staying", stats.staying}}},
        {"plan", json_of(metadata.plan)},
        {"reading_number", metadata.reading_number},
        {"codec", kCodecNames[static_cast<std::size_t>(metadata.codec)]},
        {"tree",
         {{"lattice", metadata.tree.lattice}, {"max_variation", metadata.tree.max_variation}}},
    };
    if (grid.rectilinear())
        j["positions"] = {grid.positions[0].distances(), grid.positions[1].distances(),
                          grid.positions[2].distances()};
    if (info.axis_names != decltype(info.axis_names){})
        j["axis_names"] = info.axis_names;
    if (!info.missing_after.empty())
        j["missing_after"] = info.missing_after;
    if (!metadata.earlier.empty())
        j["earlier"] = metadata.earlier;
    put_optional(j, "chosen_array", metadata.chosen_array);
    put_optional(j, "chosen_component", metadata.chosen_component);
    if (metadata.reading)
        j["reading"] = json_of(*metadata.reading);
    if (metadata.referral)
        j["referral"] = json_of(*metadata.referral);
    if (metadata.color)
        j["color"] = json_of(*metadata.color);
    if (metadata.blends)
        j["between"] = json_of(*metadata.blends);
    if (!metadata.further.empty())
        j["arrays"] = json_of(metadata.further);
    // Texts from files may have any bytes; JSON may not.
    return j.dump(-1, ' ', false, json::error_handler_t::replace);
}

Metadata metadata_from_json(std::string_view text) try {
    check_depth(text);
    const json j = json::parse(text);
    Metadata metadata;
    metadata.info = info_of(j);
    if (j.at("stats").contains("counts")) // version 2 had others, which are counted anew
        set_counts(metadata, counts_of(j.at("stats").at("counts"), metadata.info.type));
    if (const auto staying = j.at("stats").find("staying"); staying != j.at("stats").end())
        metadata.stats.staying = whole<std::uint64_t>(*staying);
    if (j.contains("earlier")) {
        metadata.earlier.resize(std::min(j.at("earlier").size(), metadata.info.steps()));
        get_whole(j.at("earlier"), metadata.earlier);
    }
    get_optional(j, "chosen_array", metadata.chosen_array);
    get_optional(j, "chosen_component", metadata.chosen_component);
    metadata.plan = plan_of(j.at("plan"));
    if (j.contains("codec")) { // version 2 had none
        const auto codec = codec_from_name(j.at("codec").get<std::string>());
        if (!codec)
            throw Error("unknown codec");
        metadata.codec = *codec;
    }
    const json& tree = j.at("tree");
    metadata.tree.lattice = whole<std::uint32_t>(tree.at("lattice"));
    metadata.tree.max_variation = whole<std::uint32_t>(tree.at("max_variation"));
    if (j.contains("reading"))
        metadata.reading = read_options_of(j.at("reading"));
    metadata.reading_number = j.contains("reading_number")
                                  ? whole<std::uint32_t>(j.at("reading_number"))
                                  : 2; // what programs before the number were
    if (j.contains("referral"))
        metadata.referral = referral_of(j.at("referral"));
    if (j.contains("color"))
        metadata.color = color_of(j.at("color"));
    if (j.contains("between"))
        metadata.blends = blends_of(j.at("between"));
    if (j.contains("arrays"))
        metadata.further = further_of(j.at("arrays"));
    return metadata;
} catch (const json::exception& error) {
    throw Error(json_mistake(error));
}

} // namespace isochron::index
