// Takes names with numbers apart.
#include "index/formats/series/numbered_name.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::index {

NumberedName taken_apart(const std::string& name) {
    constexpr std::size_t kMostDigits = 18;
    NumberedName parts;
    std::string text;
    for (std::size_t i = 0; i < name.size();) {
        std::size_t end = i;
        while (end < name.size() && end - i < kMostDigits && name[end] >= '0' && name[end] <= '9')
            ++end;
        if (end == i) {
            text += name[i++];
            continue;
        }
        parts.texts.push_back(std::move(text));
        text.clear();
        parts.numbers.push_back(std::stoull(name.substr(i, end - i)));
        i = end;
    }
    parts.texts.push_back(std::move(text));
    return parts;
}

std::vector<std::size_t> varying_numbers(std::span<const NumberedName> names) {
    std::vector<std::size_t> varying;
    if (std::ranges::any_of(
            names, [&](const NumberedName& name) { return name.texts != names.front().texts; }))
        return varying;
    for (std::size_t i = 0; i < names.front().numbers.size(); ++i)
        if (std::ranges::any_of(names, [&](const NumberedName& name) {
                return name.numbers[i] != names.front().numbers[i];
            }))
            varying.push_back(i);
    return varying;
}

std::optional<std::string> note_on_missing(std::span<const std::filesystem::path> files) {
    if (files.size() < 3)
        return std::nullopt;
    std::vector<NumberedName> names;
    for (const std::filesystem::path& file : files)
        names.push_back(taken_apart(file.string()));
    const auto varying = varying_numbers(names);
    if (varying.size() != 1)
        return std::nullopt;
    const auto number = [&](std::size_t file) { return names[file].numbers[varying.front()]; };
    // The smallest distance is the distance of two steps with no missing step between them.
    std::uint64_t least = UINT64_MAX;
    for (std::size_t i = 1; i < files.size(); ++i)
        if (number(i) < number(i - 1)) // in an order of their own
            return std::nullopt;
    for (std::size_t i = 1; i < files.size(); ++i)
        least = std::min(least, number(i) - number(i - 1)); // equal ones differ in zeros alone
    for (std::size_t i = 1; i < files.size(); ++i)
        if (number(i) - number(i - 1) != least)
            return fmt::format("the files' numbers are not evenly spaced ({} follows {}); the "
                               "steps are; --times-from-names takes the numbers as times",
                               number(i), number(i - 1));
    return std::nullopt;
}

} // namespace isochron::index
