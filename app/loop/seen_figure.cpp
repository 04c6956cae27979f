// The description of a figure of what is seen.
#include "app/loop/seen_figure.h"

#include "interaction/recording/commands_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace isochron::app {
namespace {

using nlohmann::json;

/// A value in TOML, on one line; its words are those of JSON except for tables. What is null is left
/// out.
std::string toml_of(const json& value) {
    std::string items;
    if (!value.is_structured())
        return value.dump();
    for (const auto& [key, item] : value.items())
        if (!item.is_null())
            items += fmt::format("{}{}{}", items.empty() ? "" : ", ",
                                 value.is_object() ? key + " = " : "", toml_of(item));
    return value.is_object() ? "{ " + items + " }" : "[" + items + "]";
}

} // namespace

std::string figure_text(const std::string& index, const interaction::KeyFrame& key, double aspect) {
    constexpr std::array<std::string_view, 6> kOfFilms{"time", "hold", "pace",
                                                       "name", "text", "place"};
    interaction::Commands commands;
    commands.keys = {key};
    const json all = interaction::commands_json(commands).at("keys").at(0);
    std::string text = fmt::format("[[panels]]\nindex = {}\naspect = {:.3f}\n",
                                   json(index).dump(-1, ' ', false, json::error_handler_t::replace),
                                   std::clamp(aspect, 0.1, 10.0));
    for (const auto& [name, value] : all.items())
        if (!value.is_null() && std::ranges::find(kOfFilms, name) == kOfFilms.end())
            text += fmt::format("{} = {}\n", name, toml_of(value));
    return text;
}

} // namespace isochron::app
