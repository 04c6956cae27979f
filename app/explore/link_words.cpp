// Words and numbers of the settings in links.
#include "app/explore/link_words.h"

#include "render/passes/color_map.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace isochron::app {

std::optional<double> number_of(std::string_view text) {
    double value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    return !text.empty() && read.ec == std::errc() && read.ptr == text.data() + text.size() &&
                   std::isfinite(value)
               ? std::optional(value)
               : std::nullopt;
}

std::vector<std::string_view> split(std::string_view text, char at) {
    std::vector<std::string_view> words;
    for (;;) {
        const std::size_t end = std::min(text.find(at), text.size());
        words.push_back(text.substr(0, end));
        if (end == text.size())
            return words;
        text.remove_prefix(end + 1);
    }
}

std::vector<double> numbers_of(std::string_view text, char at) {
    std::vector<double> numbers;
    for (const std::string_view word : split(text, at))
        if (const auto number = number_of(word))
            numbers.push_back(*number);
        else
            return {};
    return numbers;
}

const std::string& word_of(const LinkWords& words, const std::string& name) {
    static const std::string none;
    const auto found = words.find(name);
    return found == words.end() ? none : found->second;
}
std::optional<double> number_in(const LinkWords& words, const std::string& name) {
    return number_of(word_of(words, name));
}

void color_as_linked(interaction::Coloring& coloring, const LinkWords& settings,
                     const std::string& map, const std::string& range) {
    if (const auto known = render::color_map_from_name(word_of(settings, map)))
        coloring.map = render::name_of(*known);
    if (const auto ends = numbers_of(word_of(settings, range));
        ends.size() == 2 && ends[0] < ends[1])
        coloring.range = {ends[0], ends[1]};
}

} // namespace isochron::app
