// Reads ranges of steps.
#include "app/command_line/step_range.h"

#include "app/command_line/command_line.h"

#include <fmt/format.h>

#include <charconv>

namespace isochron::app {

std::optional<std::vector<std::uint64_t>> whole_numbers(std::string_view text,
                                                        std::string_view between) {
    std::vector<std::uint64_t> numbers;
    for (const char *at = text.data(), *const end = at + text.size();; ++at) {
        const auto [behind, error] = std::from_chars(at, end, numbers.emplace_back());
        if (error != std::errc{})
            return std::nullopt;
        if (behind == end)
            return numbers;
        if (between.find(*behind) == between.npos)
            return std::nullopt;
        at = behind;
    }
}

std::vector<std::uint32_t> steps_of(const std::string& text, const std::string& option,
                                    std::size_t steps) {
    const std::vector<std::uint64_t> numbers =
        whole_numbers(text, ":").value_or(std::vector<std::uint64_t>());
    if (numbers.empty() || numbers.size() > 3)
        throw UsageError("{}: expected a step, or FIRST:LAST or FIRST:LAST:STRIDE with both ends "
                         "included, got {}",
                         option, text.empty() ? "nothing" : text);
    const std::uint64_t first = numbers[0], last = numbers.size() > 1 ? numbers[1] : first;
    const std::uint64_t stride = numbers.size() > 2 ? numbers[2] : 1;
    if (first > last || last >= steps || stride == 0)
        throw UsageError("{} {}: expected steps 0 to {}, the first not after the last{}", option,
                         text, steps - 1, stride == 0 ? ", and a stride above 0" : "");
    std::vector<std::uint32_t> named;
    for (std::uint64_t step = first; step <= last; step += stride)
        named.push_back(static_cast<std::uint32_t>(step));
    return named;
}

std::vector<std::uint32_t> steps_or_all(const std::optional<std::string>& text,
                                        const std::string& option, std::size_t steps) {
    return steps_of(text.value_or(fmt::format("0:{}", steps - 1)), option, steps);
}

} // namespace isochron::app
