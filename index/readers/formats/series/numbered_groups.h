// Arrays in groups with numbers in their names, one group for each step: which number counts the steps,
// and what time it is. One reading for all formats that have groups.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// An array in groups: `/t0/channel1/data`.
struct GroupedPath {
    std::string path;
    std::string kind; ///< equal for arrays that may be steps of one: type and shape
};

/// An array with a step in each group, or one alone.
struct GroupedArray {
    std::string name;               ///< its path; with `*` for the number where there are several
    std::vector<std::size_t> steps; ///< the arrays, in the order of their numbers
    /// Names of the other ways to count its steps, where names do not tell which number does.
    std::vector<std::string> or_else = {};
};

/// Puts arrays together whose paths differ in one number of a group. Which of several numbers counts the
/// steps is told by an attribute of the groups, else by a word of time (`t`, `step`) or a unit of time at
/// the number; numbers at other words (`channel`, `level`) count no steps.
/// @param has_time whether a group states a time
std::vector<GroupedArray>
grouped_arrays(std::span<const GroupedPath> paths,
               const std::function<bool(const std::string& group)>& has_time);

/// The arrays whose paths match a pattern, as the steps of one.
/// @param file by which messages call it @throws Error: none matches, or they are not alike
GroupedArray matching_arrays(std::span<const GroupedPath> paths, const std::string& pattern,
                             const std::string& file);

/// Says that the names leave open which numbers count the steps: both ways as options of commands.
std::string which_steps(const GroupedArray& array);

/// Times in the names of groups.
struct GroupTimes {
    std::vector<double> times;
    std::string unit; ///< `y` in `Time:  1.0E+01 y`; may be empty
};

/// The one number in which paths differ, if it is a time: with a unit of time behind it, with a point,
/// or with the word `time` before it.
/// @param paths in the order of their steps
std::optional<GroupTimes> times_of_groups(std::span<const std::string> paths);

} // namespace isochron::index
