// What reading, schema and writing of configurations know of types, and the words of their values.
#pragma once

#include "app/config/config_fields.h"
#include "render/passes/color_map.h"

#include <algorithm>
#include <concepts>
#include <string>
#include <vector>

namespace isochron::app {

/// A table: its keys are listed above, or in the lists of settings.
template <class T>
concept Table = requires(T& table) {
    each_field([](const Field&, auto&&) {}, table);
};

template <class T>
inline constexpr bool kIsVector = false;
template <class T>
inline constexpr bool kIsVector<std::vector<T>> = true;
template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsDuration = std::same_as<T, interaction::Seconds>;
template <class T>
inline constexpr glm::length_t kComponents = 0; ///< components of a vector of glm
template <glm::length_t n, class T>
inline constexpr glm::length_t kComponents<glm::vec<n, T>> = n;

/// Vectors without a range of their own are meters or pixels.
inline Field within_reach(Field field) {
    field.low = std::max(field.low, -kFar);
    field.high = std::min(field.high, kFar);
    return field;
}

/// A list of tables.
template <class T>
concept Tables = kIsVector<T> && Table<typename T::value_type>;

/// `unknown value 'x', expected one of a, b; did you mean 'b'?`
std::string unknown_word(const char* what, const std::string& word,
                         const std::vector<std::string>& known);

/// A value that has words in files; none of an optional one is `auto`.
template <class T>
concept Word = interaction::Named<T> || std::same_as<T, stereo::StereoMode>;
template <class T>
concept Worded = Word<T> ||(kIsOptional<T>&& requires { requires Word<typename T::value_type>; });

/// The words that a field may have, in the order of its values; those before `field.low` are not for
/// files.
template <Worded T>
std::vector<std::string> words_of(const Field& field = {}) {
    if constexpr (kIsOptional<T>) {
        std::vector<std::string> words = words_of<typename T::value_type>(field);
        words.insert(words.begin(), "auto");
        return words;
    } else if constexpr (std::same_as<T, stereo::StereoMode>) {
        const std::vector<std::string_view> words = stereo::stereo_mode_words();
        return {words.begin(), words.end()};
    } else {
        const auto& names = interaction::kNames<T>;
        return {names.begin() + static_cast<int>(std::max(field.low, 0.0)), names.end()};
    }
}
/// @param what the word is, for messages @throws ConfigError for any other word
template <Worded T>
T value_of(const std::string& word, const char* what = "value", const Field& field = {}) {
    const std::vector<std::string> words = words_of<T>(field);
    if (std::ranges::find(words, word) == words.end())
        throw ConfigError(unknown_word(what, word, words));
    if constexpr (kIsOptional<T>)
        return word == words.front() ? T() : T(value_of<typename T::value_type>(word));
    else if constexpr (std::same_as<T, stereo::StereoMode>)
        return *stereo::stereo_mode_from_name(word);
    else
        return *interaction::value_named<T>(word);
}

/// The words that a text may be; empty: any text.
inline std::vector<std::string> words_of_text(std::string_view key) {
    if (key != "map")
        return {};
    return {render::kColorMapNames.begin(), render::kColorMapNames.end()};
}

} // namespace isochron::app
