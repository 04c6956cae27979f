// Finds the numbers of groups that count steps.
#include "index/readers/formats/series/numbered_groups.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/name_pattern.h"
#include "index/readers/formats/series/numbered_name.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace isochron::index {
namespace {

/// What is known of a number in a group's name, the likeliest last.
enum class Counts : std::uint8_t { others, anything, steps, stated_times };

constexpr std::string_view kWordsOfSteps = "|t|time|times|ts|tp|step|steps|tstep|cycle|cycles|"
                                           "iteration|iterations|iter|it|frame|frames|snapshot|"
                                           "snapshots|snap|dump|date|day|hour|month|year|";
constexpr std::string_view kWordsOfOthers =
    "|c|ch|chan|channel|channels|s|setup|view|angle|illumination|cam|camera|tile|level|levels|lev|"
    "resolution|resolutions|res|resolutionlevel|scale|scales|block|blocks|part|piece|rank|proc|"
    "processor|"
    "slice|z|member|members|realization|ensemble|sample|subject|component|array|stack|";
constexpr std::string_view kUnitsOfTime =
    "|s|sec|secs|second|seconds|ms|us|ns|ps|fs|min|mins|minute|minutes|h|hr|hrs|hour|hours|d|day|"
    "days|"
    "week|weeks|month|months|y|yr|yrs|year|years|kyr|myr|gyr|";

bool is_among(std::string_view words, const std::string& word) {
    return !word.empty() && words.find("|" + word + "|") != words.npos;
}

/// A number in a path, and the texts before and behind it in its group's name.
struct GroupNumber {
    std::string pattern; ///< the path with `*` in its place
    std::string group;   ///< the path up to the group with it
    std::string word;    ///< the letters before it, or, where it stands alone, the group around it
    std::string before;  ///< the text before it, in lower case
    std::string unit;    ///< the unit of time behind it, or empty
    bool at_end = false; ///< the group's name ends with it
};

/// `time` of `Time:  `
std::string word_before(std::string_view text) {
    while (!text.empty() && std::string_view(" :=_-.").find(text.back()) != text.npos)
        text.remove_suffix(1);
    std::size_t begin = text.size();
    while (begin > 0 && ((text[begin - 1] | 32) >= 'a' && (text[begin - 1] | 32) <= 'z'))
        --begin;
    return lower_case(std::string(text.substr(begin)));
}

GroupNumber group_number(const std::string& path, const NameNumber& number) {
    const std::size_t slash = number.begin == 0 ? path.npos : path.rfind('/', number.begin - 1);
    const std::size_t begin = slash == path.npos ? 0 : slash + 1;
    const std::size_t end = path.find('/', number.end());
    GroupNumber found;
    found.pattern = path.substr(0, number.begin) + "*" + path.substr(number.end());
    found.group = path.substr(0, end);
    found.before = lower_case(path.substr(begin, number.begin - begin));
    found.word = word_before(found.before);
    if (found.before.empty() && begin > 0)
        found.word = word_before(path.substr(0, begin - 1));
    const std::string rest = path.substr(number.end(), end - number.end());
    const std::string behind(trimmed(rest));
    found.at_end = behind.empty();
    // In `flow2d` and `3d` the letter is no day.
    const bool apart = behind.size() > 1 || behind == "s" || rest != behind ||
                       is_among(kWordsOfSteps, found.word) || found.word == "time";
    if (apart && is_among(kUnitsOfTime, behind.size() > 1 ? lower_case(behind) : behind))
        found.unit = behind;
    return found;
}

Counts counts_by_name(const GroupNumber& number) {
    constexpr std::string_view kTime = "time";
    if (!number.unit.empty() || number.before.find(kTime) != number.before.npos)
        return Counts::steps;
    if (!number.at_end || is_among(kWordsOfOthers, number.word))
        return Counts::others;
    return is_among(kWordsOfSteps, number.word) || number.word.starts_with(kTime)
               ? Counts::steps
               : Counts::anything;
}

/// The numbers in the names of an array's groups.
std::vector<GroupNumber> numbers_in(const std::string& path) {
    std::vector<GroupNumber> found;
    const std::size_t last = path.rfind('/');
    for (const NameNumber& number : taken_apart(path).numbers)
        if (last != path.npos && number.end() <= last)
            found.push_back(group_number(path, number));
    return found;
}

/// Those of the paths in the order of their numbers.
std::vector<std::size_t> in_order_of_names(std::span<const GroupedPath> paths,
                                           const std::vector<std::size_t>& which) {
    std::vector<std::string> names;
    for (const std::size_t each : which)
        names.push_back(paths[each].path);
    std::vector<std::size_t> ordered;
    for (const std::size_t each : read_names(names).order)
        ordered.push_back(which[each]);
    return ordered;
}

} // namespace

std::vector<GroupedArray>
grouped_arrays(std::span<const GroupedPath> paths,
               const std::function<bool(const std::string& group)>& has_time) {
    std::map<std::string, std::vector<std::size_t>> families;
    std::vector<std::vector<GroupNumber>> numbers;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        numbers.push_back(numbers_in(paths[i].path));
        for (const GroupNumber& number : numbers.back())
            families[number.pattern].push_back(i);
    }
    const auto are_alike = [&](const std::vector<std::size_t>& family) {
        return family.size() > 1 && std::ranges::all_of(family, [&](std::size_t other) {
                   return paths[other].kind == paths[family.front()].kind;
               });
    };
    std::vector<GroupedArray> arrays;
    std::set<std::string> put_together;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        std::erase_if(numbers[i], [&](const GroupNumber& number) {
            return !are_alike(families[number.pattern]);
        });
        std::vector<std::string> likeliest;
        Counts best = Counts::anything;
        for (const GroupNumber& number : numbers[i]) {
            Counts counts = counts_by_name(number);
            if ((counts == Counts::others || numbers[i].size() > 1) && has_time(number.group))
                counts = Counts::stated_times;
            if (counts > best)
                likeliest.clear();
            if (counts >= best) {
                likeliest.push_back(number.pattern);
                best = counts;
            }
        }
        if (likeliest.empty()) {
            arrays.push_back({paths[i].path, {i}});
            continue;
        }
        if (!put_together.insert(likeliest.front()).second)
            continue;
        GroupedArray array{likeliest.front(),
                           in_order_of_names(paths, families[likeliest.front()])};
        array.or_else.assign(likeliest.begin() + 1, likeliest.end());
        arrays.push_back(std::move(array));
    }
    return arrays;
}

GroupedArray matching_arrays(std::span<const GroupedPath> paths, const std::string& pattern,
                             const std::string& file) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < paths.size(); ++i)
        if (matches_pattern(pattern, paths[i].path, FNM_PATHNAME))
            found.push_back(i);
    if (found.empty())
        throw Error("{}: no array matches {}", file, pattern);
    const GroupedPath& first = paths[found.front()];
    for (const std::size_t each : found)
        if (paths[each].kind != first.kind)
            throw Error("{}: {} is {}, {} is {}, expected steps that are alike", file,
                        paths[each].path, paths[each].kind, first.path, first.kind);
    return {pattern, in_order_of_names(paths, found)};
}

std::string which_steps(const GroupedArray& array) {
    return fmt::format(
        "the numbers of several groups may count the steps: --array '{}' or --array '{}'",
        array.name, fmt::join(array.or_else, "' or --array '"));
}

std::optional<GroupTimes> times_of_groups(std::span<const std::string> paths) {
    const ReadNames read = read_names({paths.begin(), paths.end()});
    const auto varying = varying_numbers(read.names);
    if (varying.size() != 1 || paths.size() < 2)
        return std::nullopt;
    GroupTimes found;
    bool are_times = false;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const NameNumber& number = read.names[i].numbers[varying.front()];
        const GroupNumber group = group_number(paths[i], number);
        if (i > 0 && group.unit != found.unit)
            return std::nullopt;
        found.unit = group.unit;
        are_times = are_times || !group.unit.empty() || number.fraction > 0 || group.word == "time";
        found.times.push_back(number.value);
    }
    return are_times ? std::optional(std::move(found)) : std::nullopt;
}

} // namespace isochron::index
