// Ranges of steps as they are typed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// Whole numbers with one of the characters of `between` between each two of them: `0:63`.
/// @return empty if there is anything else
std::optional<std::vector<std::uint64_t>> whole_numbers(std::string_view text,
                                                        std::string_view between);

/// The steps that `text` names: `7`, `0:63`, which is 0 to 63 with both, or `0:63:4`, every fourth
/// of them.
/// @param option what a message calls it @param steps that there are
/// @throws UsageError: it cannot be read, or names a step that is not there
std::vector<std::uint32_t> steps_of(const std::string& text, const std::string& option,
                                    std::size_t steps);
/// As `steps_of`; all steps without a text.
std::vector<std::uint32_t> steps_or_all(const std::optional<std::string>& text,
                                        const std::string& option, std::size_t steps);

} // namespace isochron::app
