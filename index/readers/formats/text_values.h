// Reads numbers that a file has as text, separated by blanks or commas.
#pragma once

#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/stored_scalar.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace isochron::index {

/// Infinities and NaN are numbers of f32 and f64, too; one that is too small for them is 0.
/// @param word without blanks @return whether it is a number of this type
template <class T>
bool parse_value(std::string_view word, T& value) {
    if (word.starts_with('+'))
        word.remove_prefix(1);
    using Parsed = std::conditional_t<sizeof(T) == 1, int, T>; // not letters
    Parsed parsed{};
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), parsed);
    if (end != word.data() + word.size())
        return false;
    if constexpr (std::is_floating_point_v<T>) {
        if (failure == std::errc::result_out_of_range) {
            value = static_cast<T>(std::strtold(std::string(word).c_str(), nullptr));
            return std::isfinite(value);
        }
    } else if (parsed < std::numeric_limits<T>::min() || parsed > std::numeric_limits<T>::max()) {
        return false;
    }
    value = static_cast<T>(parsed);
    return failure == std::errc{};
}

/// Reading forward parses each number once; going back starts from the beginning again.
class TextValues {
  public:
    /// @param offset of the first number in the file
    TextValues(const std::filesystem::path& path, std::uint64_t offset, StoredType type);

    /// Fills `out` with the values from number `first` on, in native byte order.
    /// @throws Error naming the file: too few numbers, or one that does not fit the type
    void read(std::uint64_t first, std::span<std::byte> out);
    /// Number of bytes after the last number that was read, without blanks at the end of the file.
    std::uint64_t rest();

  private:
    void rewind();
    /// The next number; empty at the end of the file. Valid until the next call.
    std::string_view next_word();
    /// Reads on, keeping what starts at `begin`. @return false at the end of the file
    bool refill(std::size_t begin);

    std::string name_;
    std::uint64_t bytes_; ///< length of the text
    StoredType type_;
    std::unique_ptr<DataStream> stream_;
    std::string text_;           ///< a part of the file
    std::size_t at_ = 0;         ///< in `text_`
    std::uint64_t taken_ = 0;    ///< bytes that have been read
    std::uint64_t position_ = 0; ///< number of the next value
};

} // namespace isochron::index
