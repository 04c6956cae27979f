// Names with numbers that give files an order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// A name taken apart into its numbers and the texts around them.
struct NumberedName {
    std::vector<std::string> texts; ///< one more than there are numbers
    std::vector<std::uint64_t> numbers;
};

/// A number ends after 18 digits, and the next one begins.
NumberedName taken_apart(const std::string& name);

/// Which numbers differ among names with the same texts; empty if texts differ.
std::vector<std::size_t> varying_numbers(std::span<const NumberedName> names);

/// A note for the user, one sentence, if files without times differ in one number of their names
/// and some numbers are missing: `t_1.vti t_2.vti t_4.vti`. Else empty.
/// @param files in the order of their steps, one each
std::optional<std::string> note_on_missing(std::span<const std::filesystem::path> files);

} // namespace isochron::index
