// Words, numbers and lines of the text headers of BOV, MetaImage and NRRD.
#pragma once

#include "index/trimmed.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

std::vector<std::string> words_of(std::string_view text);

/// The line at a place, without its end; moves the place behind it.
std::string_view take_line(std::string_view text, std::size_t& at);

/// A line `KEY: VALUE`, trimmed.
struct HeaderField {
    std::string key, value;
};
/// Empty if the line has no separator.
std::optional<HeaderField> field_of(std::string_view line, char separator);

/// A text as quoted in a message; of a long text only the beginning.
std::string excerpt(std::string_view text);

/// @throws Error: `FILE: KEY: WORD is not a number`
double number_of(std::string_view word, const std::string& key, const std::string& file);
std::vector<double> numbers_of(std::string_view text, const std::string& key,
                               const std::string& file);
/// Reads whole numbers that fit 64 bits.
std::vector<std::int64_t> integers_of(std::string_view text, const std::string& key,
                                      const std::string& file);

} // namespace isochron::index
