// Finds numbers in names that count the steps of a series.
#include "app/config/series_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fnmatch.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// `text` as it is in a pattern.
std::string literal(const std::string& text) {
    std::string pattern;
    for (const char c : text)
        if (c == '*' || c == '?' || c == '[')
            pattern += std::string("[") + c + "]";
        else if (c == '\\')
            pattern += "\\\\";
        else
            pattern += c;
    return pattern;
}

/// The patterns that a name matches, one for each number in it, from the last to the first.
std::vector<std::string> patterns_of(const std::string& name) {
    std::vector<std::string> patterns;
    for (std::size_t end = name.size(); end > 0;) {
        if (!is_digit(name[end - 1])) {
            --end;
            continue;
        }
        std::size_t begin = end;
        while (begin > 0 && is_digit(name[begin - 1]))
            --begin;
        patterns.push_back(literal(name.substr(0, begin)) + "[0-9]*" + literal(name.substr(end)));
        end = begin;
    }
    return patterns;
}

/// By their numbers, however many digits those have.
bool before(const std::string& a, const std::string& b) {
    return std::pair(a.size(), a) < std::pair(b.size(), b);
}

} // namespace

std::vector<NamedSeries> series_among(std::span<const std::string> names) {
    std::map<std::string, std::vector<std::string>> groups;
    for (const std::string& name : names)
        for (const std::string& pattern : patterns_of(name))
            groups[pattern].push_back(name);
    std::vector<NamedSeries> found;
    std::set<std::string> taken;
    for (const std::string& name : names)
        for (const std::string& pattern : patterns_of(name)) {
            std::vector<std::string>& group = groups[pattern];
            if (group.size() < 2 || taken.contains(pattern))
                continue;
            taken.insert(pattern);
            const auto matching = std::ranges::count_if(names, [&](const std::string& other) {
                return ::fnmatch(pattern.c_str(), other.c_str(), 0) == 0;
            });
            if (static_cast<std::size_t>(matching) != group.size())
                continue;
            std::ranges::sort(group, before);
            found.push_back({pattern, group.front(), group.back(), group.size()});
            break;
        }
    return found;
}

std::optional<fs::path> one_name_of(std::span<const fs::path> files) {
    if (files.size() == 1)
        return files.front();
    if (files.empty())
        return std::nullopt;
    const fs::path folder = files.front().parent_path();
    std::set<std::string> wanted;
    for (const fs::path& file : files) {
        if (file.parent_path() != folder)
            return std::nullopt;
        wanted.insert(file.filename().string());
    }
    std::vector<std::string> patterns = patterns_of(*wanted.begin());
    const std::string extension = files.front().extension().string();
    patterns.push_back("*" + literal(extension));
    patterns.emplace_back("*");
    std::set<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
        names.insert(entry.path().filename().string());
    for (const std::string& pattern : patterns) {
        std::set<std::string> matching;
        for (const std::string& name : names)
            if (::fnmatch(pattern.c_str(), name.c_str(), FNM_PERIOD) == 0)
                matching.insert(name);
        if (matching == wanted)
            return pattern_in(folder, pattern);
    }
    return std::nullopt;
}

fs::path pattern_in(const fs::path& folder, const std::string& pattern) {
    return fs::path(literal(folder.string())) / pattern;
}

bool is_pattern(const std::string& name) {
    return name.find_first_of("*?[") != std::string::npos;
}

std::string said_name(const std::filesystem::path& data) {
    std::string name = data.filename().string();
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kSaid{
        {{"[0-9]*", "*"}, {"[[]", "["}, {"[*]", "*"}, {"[?]", "?"}}};
    for (std::size_t at = 0; at < name.size(); ++at)
        for (const auto& [pattern, words] : kSaid)
            if (name.compare(at, pattern.size(), pattern) == 0) {
                name.replace(at, pattern.size(), words);
                break;
            }
    return name;
}

} // namespace isochron::app
