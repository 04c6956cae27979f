// Parses words and numbers of text headers.
#include "index/readers/formats/text_header.h"

#include "index/error.h"

#include <algorithm>
#include <charconv>
#include <sstream>

namespace isochron::index {
namespace {

template <class Number>
Number parse(std::string_view word, const std::string& key, const std::string& file) {
    if (word.starts_with('+'))
        word.remove_prefix(1);
    Number number{};
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (failure != std::errc{} || end != word.data() + word.size())
        throw Error("{}: {}: `{}` is not a number", file, key, excerpt(word));
    return number;
}

} // namespace

std::vector<std::string> words_of(std::string_view text) {
    std::istringstream in{std::string(text)};
    std::vector<std::string> words;
    for (std::string word; in >> word;)
        words.push_back(word);
    return words;
}

std::string_view take_line(std::string_view text, std::size_t& at) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    return line;
}

std::optional<HeaderField> field_of(std::string_view line, char separator) {
    const std::size_t found = line.find(separator);
    if (found == line.npos)
        return std::nullopt;
    return HeaderField{std::string(trimmed(line.substr(0, found))),
                       std::string(trimmed(line.substr(found + 1)))};
}

std::string excerpt(std::string_view text) {
    constexpr std::size_t kMost = 60;
    return std::string(text.substr(0, kMost)) + (text.size() > kMost ? "..." : "");
}

double number_of(std::string_view word, const std::string& key, const std::string& file) {
    return parse<double>(word, key, file);
}

std::vector<double> numbers_of(std::string_view text, const std::string& key,
                               const std::string& file) {
    std::vector<double> numbers;
    for (const std::string& word : words_of(text))
        numbers.push_back(parse<double>(word, key, file));
    return numbers;
}

std::vector<std::int64_t> integers_of(std::string_view text, const std::string& key,
                                      const std::string& file) {
    std::vector<std::int64_t> numbers;
    for (const std::string& word : words_of(text))
        numbers.push_back(parse<std::int64_t>(word, key, file));
    return numbers;
}

} // namespace isochron::index
