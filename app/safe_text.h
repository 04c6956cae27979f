// Texts that a terminal may be given: control characters and the like of files, names and
// configurations are spelled out in them, so that they command nothing.
#pragma once

#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>

#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace isochron::app {

/// Text as one line that is safe for a terminal. Line ends and other control characters, those of
/// eight bits too, become `\n`, `\x1b`; what changes the direction of text and the other two line
/// ends of Unicode `\u202e`; bytes that are no UTF-8 `\xff`. Only beginning and end remain of a very long text.
std::string one_line(std::string_view text);

class SafeText;

/// A value of a format: a number as it is, a `SafeText` with its lines, all else as one line.
template <class T>
auto safe_value(const T& value) {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, char>)
        return value;
    else if constexpr (std::is_same_v<T, SafeText>)
        return value.str();
    else if constexpr (std::is_convertible_v<const T&, std::string_view>)
        return one_line(value);
    else
        return one_line(fmt::vformat("{}", fmt::make_format_args(value)));
}
/// A format that stands in the code: the compiler refuses others.
template <class... T>
using SafeWords =
    std::type_identity_t<fmt::format_string<decltype(safe_value(std::declval<const T&>()))...>>;

/// A text of lines that is safe for a terminal. No other type can be printed, and only the
/// functions below make one.
///
///     print_safely("{}: {} steps\n", file_name, steps);
///
/// A text among the values becomes one line, so that a name with a line end in it looks like no
/// line of the program.
class SafeText {
  public:
    SafeText() = default;
    template <class... T>
    explicit SafeText(SafeWords<T...> words, const T&... values)
        : text_([&](const auto&... safe) {
              return fmt::vformat(words, fmt::make_format_args(safe...));
          }(safe_value(values)...)) {}
    /// A text that has lines of its own.
    static SafeText lines(std::string_view text);
    /// TOML, or JSON as text: characters are spelled as both have it between quotes, `\u009b`.
    static SafeText data(std::string_view text);
    /// An object or list in lines, and a line end. Bytes that are no UTF-8 become U+FFFD.
    static SafeText json(const nlohmann::ordered_json& value, int indent = 2);

    const std::string& str() const { return text_; }
    SafeText& operator+=(const SafeText& more) {
        text_ += more.text_;
        return *this;
    }

  private:
    std::string text_;
};

/// Whatever the program says is printed by these functions: `tests/house` finds other ways.
void print_safely(const SafeText& text, std::FILE* out = stdout);
template <class... T>
void print_safely(std::FILE* out, SafeWords<T...> words, const T&... values) {
    print_safely(SafeText(words, values...), out);
}
template <class... T>
void print_safely(SafeWords<T...> words, const T&... values) {
    print_safely(SafeText(words, values...));
}

} // namespace isochron::app
