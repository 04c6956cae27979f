// Numbers and dates that are missing in the names of a series' files.
#include "index/readers/formats/series/missing_numbers.h"

#include "index/readers/formats/series/dated_name.h"
#include "index/readers/formats/series/numbered_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

std::vector<NumberedName> names_of(std::span<const fs::path> files) {
    std::vector<std::string> given;
    for (const fs::path& file : files)
        given.push_back(file.string());
    return read_names(given).names;
}

std::optional<std::string> note_on_numbers(std::span<const fs::path> files) {
    if (files.size() < 3)
        return std::nullopt;
    const std::vector<NumberedName> names = names_of(files);
    const auto varying = varying_numbers(names);
    if (varying.size() != 1)
        return std::nullopt;
    const auto number = [&](std::size_t file) -> const NameNumber& {
        return names[file].numbers[varying.front()];
    };
    // The smallest distance is what steps are apart where none is missing.
    double least = std::numeric_limits<double>::infinity(), rounding = 0;
    for (std::size_t i = 1; i < files.size(); ++i) {
        if (number(i) < number(i - 1)) // in an order of their own
            return std::nullopt;
        least = std::min(least, number(i).value - number(i - 1).value); // 0: other zeros alone
        rounding = std::max(rounding, number(i).rounding());
    }
    for (std::size_t i = 1; i < files.size(); ++i)
        if (const double gap = number(i).value - number(i - 1).value;
            gap - least > std::max(1.5 * rounding, 1e-9 * std::abs(least)))
            return fmt::format("the files' numbers are not evenly spaced ({} follows {}); the "
                               "steps are; --times-from-names takes the numbers as times",
                               number(i).value, number(i - 1).value);
    return std::nullopt;
}

/// What orders the names: their dates, or the last number that differs. May be empty.
std::vector<double> order_of_names(std::span<const fs::path> files, std::optional<DayMonth> said) {
    if (const auto dates = dates_in_names(files, said))
        return dates->times;
    const std::vector<NumberedName> names = names_of(files);
    const auto varying = varying_numbers(names);
    std::vector<double> numbers;
    for (const NumberedName& name : names)
        if (!varying.empty())
            numbers.push_back(name.numbers[varying.back()].value);
    return numbers;
}

} // namespace

std::optional<std::string> note_on_names(std::span<const fs::path> files,
                                         std::optional<DayMonth> dates) {
    auto note = note_on_dates(files, dates);
    return note ? note : note_on_numbers(files);
}

std::vector<std::uint32_t> missing_after(std::span<const fs::path> files,
                                         std::optional<DayMonth> dates) {
    std::vector<std::uint32_t> steps;
    if (files.size() < 3)
        return steps;
    const std::vector<double> numbers = order_of_names(files, dates);
    std::vector<double> apart;
    for (std::size_t i = 1; i < numbers.size(); ++i)
        apart.push_back(numbers[i] - numbers[i - 1]);
    if (apart.empty() || !std::ranges::all_of(apart, [](double each) { return each > 0; }))
        return steps;
    std::vector<double> sorted = apart;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
    std::ranges::nth_element(sorted, middle);
    constexpr double kMost = 1.5; // months and years differ by less, and so do rounded decimals
    for (std::size_t i = 0; i < apart.size(); ++i)
        if (apart[i] > kMost * *middle)
            steps.push_back(static_cast<std::uint32_t>(i));
    return steps;
}

} // namespace isochron::index
