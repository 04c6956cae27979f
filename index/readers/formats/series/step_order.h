// The order of steps whose times files state, and steps that a restart left twice.
#pragma once

#include "index/volume/listed_file.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// A step of a file, by their numbers.
struct StepPlace {
    std::size_t file = 0, step = 0;
    double time = 0;
};

/// The steps in the order of their times. Among steps of equal time, the step of the file that
/// begins last counts, and within a file the last: programs that were restarted write some steps
/// again.
struct OrderedSteps {
    std::vector<StepPlace> steps;
    std::vector<std::size_t> files; ///< by the first time of each; in the order given where equal
    std::vector<std::string> notes; ///< one sentence each
};

/// @param steps finite times, the steps of each file one behind the other
/// @param names of the files, in the order that their names have
/// @param keep_first of several steps with the same time the first one counts
OrderedSteps ordered_by_time(std::vector<StepPlace> steps, std::span<const std::string> names,
                             bool keep_first);

/// The entries of a list by their times, each part of each time once, as ParaView reads them: the later
/// ones count.
/// @param notes gets how many others there were
ListedFiles ordered_entries(ListedFiles files, bool keep_first, std::vector<std::string>& notes);

} // namespace isochron::index
