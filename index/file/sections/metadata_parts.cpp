// The parts of the metadata section that say where values come from, and where further arrays lie.
#include "index/file/sections/metadata_json.h"

#include "index/error.h"
#include "index/file/sections/metadata.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <utility>

namespace isochron::index {

namespace {

/// The options that say how files are decoded.
void put_decoding(json& j, const ReadOptions& options) {
    j["big_endian"] = options.big_endian;
    j["header_bytes"] = options.header_bytes;
    if (options.allow_surplus)
        j["allow_surplus"] = true;
    if (options.times_from_names)
        j["times_from_names"] = true;
    if (options.dates)
        j["dates"] = word_of(*options.dates);
    if (options.keep_first)
        j["keep_first"] = true;
    if (options.extra_axis_is_time)
        j["extra_axis_is_time"] = true;
    if (options.member)
        j["member"] = *options.member;
    put_optional(j, "crop", options.crop);
    put_optional(j, "stride", options.stride);
    put_optional(j, "steps", options.steps);
    put_optional(j, "dims", options.dims);
    put_optional(j, "resample", options.resample);
    if (options.type)
        j["type"] = name_of(*options.type);
}

void get_decoding(const json& j, ReadOptions& options) {
    options.allow_surplus = j.value("allow_surplus", false);
    options.times_from_names = j.value("times_from_names", false);
    if (const auto dates = j.find("dates"); dates != j.end())
        options.dates = day_month_of(dates->get<std::string>());
    options.keep_first = j.value("keep_first", false);
    options.extra_axis_is_time = j.value("extra_axis_is_time", false);
    if (j.contains("member"))
        options.member = whole<std::uint32_t>(j.at("member"));
    j.at("big_endian").get_to(options.big_endian);
    options.header_bytes = whole<std::uint64_t>(j.at("header_bytes"));
    if (j.contains("crop")) {
        options.crop.emplace();
        for (std::size_t axis = 0; axis < 3; ++axis)
            get_whole(j.at("crop").at(axis), (*options.crop)[axis]);
    }
    if (j.contains("steps"))
        get_whole(j.at("steps"), options.steps.emplace());
    for (auto [key, to] : {std::pair("dims", &options.dims),
                           {"resample", &options.resample},
                           {"stride", &options.stride}})
        if (j.contains(key))
            get_whole(j.at(key), to->emplace());
    if (j.contains("type"))
        options.type = value_type_from_name(j.at("type").get<std::string>());
}

} // namespace

json json_of(const ReadOptions& options) {
    json j = json::object();
    put_decoding(j, options);
    for (const auto& [key, value] :
         {std::pair("spacing", options.spacing), {"origin", options.origin}})
        if (value)
            j[key] = numbers(*value);
    put_optional(j, "time_step", options.time_step);
    put_optional(j, "length_unit", options.length_unit);
    put_optional(j, "time_unit", options.time_unit);
    put_optional(j, "value_unit", options.value_unit);
    return j;
}

ReadOptions read_options_of(const json& j) {
    ReadOptions options;
    get_decoding(j, options);
    for (auto [key, to] : {std::pair("spacing", &options.spacing), {"origin", &options.origin}})
        if (j.contains(key))
            *to = vector_of(j.at(key));
    get_optional(j, "time_step", options.time_step);
    get_optional(j, "length_unit", options.length_unit);
    get_optional(j, "time_unit", options.time_unit);
    get_optional(j, "value_unit", options.value_unit);
    return options;
}

json json_of(const Referral& referral) {
    json j{{"files", json::array()}};
    for (const std::filesystem::path& file : referral.files)
        j["files"].push_back(exact(file.string()));
    put_decoding(j, referral.options);
    put_optional(j, "array", referral.options.array);
    put_optional(j, "component", referral.options.component);
    return j;
}

Referral referral_of(const json& j) {
    Referral referral;
    for (const json& file : j.at("files"))
        referral.files.emplace_back(exact_text(file));
    get_decoding(j, referral.options);
    get_optional(j, "array", referral.options.array);
    get_optional(j, "component", referral.options.component);
    return referral;
}

json json_of(const ColorArray& color) {
    json j{{"array", exact(color.array)},
           {"value_unit", color.value_unit},
           {"type", name_of(color.type)},
           {"slope", color.scaling.slope},
           {"intercept", color.scaling.intercept},
           {"low", color.low},
           {"high", color.high},
           {"nan_values", color.nan_values}};
    put_optional(j, "chosen_array", color.chosen_array);
    put_optional(j, "chosen_component", color.chosen_component);
    return j;
}

ColorArray color_of(const json& j) {
    ColorArray color;
    color.array = exact_text(j.at("array"));
    j.at("value_unit").get_to(color.value_unit);
    const auto type = value_type_from_name(j.at("type").get<std::string>());
    if (!type)
        throw Error("unknown type of colors");
    color.type = *type;
    j.at("slope").get_to(color.scaling.slope);
    j.at("intercept").get_to(color.scaling.intercept);
    j.at("low").get_to(color.low);
    j.at("high").get_to(color.high);
    if (!(color.low <= color.high) || !std::isfinite(color.low) || !std::isfinite(color.high))
        throw Error("colors from {} to {}", color.low, color.high);
    color.nan_values = whole<std::uint64_t>(j.at("nan_values"));
    get_optional(j, "chosen_array", color.chosen_array);
    get_optional(j, "chosen_component", color.chosen_component);
    return color;
}

json json_of(const BlendQuality& blends) {
    json j{{"every_second", blends.every_second},
           {"cells", blends.cells},
           {"lone_second", blends.lone_second},
           {"lone", blends.lone}};
    put_optional(j, "every_fourth", blends.every_fourth);
    return j;
}

BlendQuality blends_of(const json& j) {
    BlendQuality blends;
    j.at("every_second").get_to(blends.every_second);
    get_optional(j, "every_fourth", blends.every_fourth);
    for (const double voxels : {blends.every_second, blends.every_fourth.value_or(0)})
        if (!(voxels >= 0 && voxels <= BlendQuality::kFarthest))
            throw Error("blends that are off by {} voxels", voxels);
    blends.cells = whole<std::uint64_t>(j.at("cells"));
    blends.lone_second = whole<std::uint64_t>(j.at("lone_second"));
    blends.lone = whole<std::uint64_t>(j.at("lone"));
    return blends;
}

namespace {

/// 16 hexadecimal digits.
std::string hex(std::uint64_t number) {
    return fmt::format("{:016x}", number);
}

std::uint64_t number_from_hex(const json& value) {
    const auto text = value.get<std::string>();
    std::uint64_t number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number, 16);
    if (failure != std::errc{} || end != text.data() + text.size() || text.size() != 16)
        throw Error("expected 16 hexadecimal digits, got {}", value.dump());
    return number;
}

} // namespace

json json_of(const std::vector<ArrayPlace>& further) {
    json all = json::array();
    for (const ArrayPlace& place : further) {
        json sections = json::object();
        for (std::size_t i = 0; i < kSectionNames.size(); ++i) {
            const Section& section = place.sections[i];
            sections[kSectionNames[i]] = {section.offset, section.bytes, hex(section.checksum)};
        }
        all.push_back({{"content_hash", hex(place.content_hash)}, {"sections", sections}});
    }
    return all;
}

std::vector<ArrayPlace> further_of(const json& j) {
    if (!j.is_array() || j.size() >= kMostArrays)
        throw Error("expected a list of fewer than {} further arrays", kMostArrays);
    std::vector<ArrayPlace> further;
    for (const json& item : j) {
        ArrayPlace& place = further.emplace_back();
        place.content_hash = number_from_hex(item.at("content_hash"));
        for (std::size_t i = 0; i < kSectionNames.size(); ++i) {
            const json& section = item.at("sections").at(kSectionNames[i]);
            place.sections[i] = {whole<std::uint64_t>(section.at(0)),
                                 whole<std::uint64_t>(section.at(1)),
                                 number_from_hex(section.at(2))};
        }
    }
    return further;
}

} // namespace isochron::index
