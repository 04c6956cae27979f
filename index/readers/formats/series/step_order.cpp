// Orders steps by their times, each time once.
#include "index/readers/formats/series/step_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace isochron::index {
namespace {

/// What a user is told of steps that are there twice.
std::string note_on_repeated(std::size_t count, const std::string& first, bool keep_first) {
    return fmt::format("{} of the times {} stated again, as after a restart, {}: the {} counts{}",
                       count, count == 1 ? "is" : "are", first, keep_first ? "first" : "later one",
                       keep_first ? "" : " (--keep-first: the first)");
}

} // namespace

OrderedSteps ordered_by_time(std::vector<StepPlace> steps, std::span<const std::string> names,
                             bool keep_first) {
    OrderedSteps ordered;
    std::map<std::size_t, double> begins;
    for (const StepPlace& step : steps) {
        const auto [begin, is_new] = begins.try_emplace(step.file, step.time);
        begin->second = std::min(begin->second, step.time);
    }
    ordered.files.resize(names.size());
    std::iota(ordered.files.begin(), ordered.files.end(), std::size_t{0});
    std::ranges::stable_sort(ordered.files, {}, [&](std::size_t file) { return begins[file]; });
    std::vector<std::size_t> rank(names.size());
    for (std::size_t i = 0; i < ordered.files.size(); ++i)
        rank[ordered.files[i]] = i;
    for (std::size_t i = 1; i < ordered.files.size(); ++i) {
        const std::size_t before = ordered.files[i - 1], file = ordered.files[i];
        if (before < file)
            continue;
        ordered.notes.push_back(fmt::format(
            "the files are in the order of the times that they state, not of their names: {} ({}) "
            "before {} ({})",
            names[before], begins[before], names[file], begins[file]));
        break;
    }
    const auto later = [&](const StepPlace& a, const StepPlace& b) {
        return std::pair(a.time, rank[a.file]) < std::pair(b.time, rank[b.file]);
    };
    const auto across =
        std::adjacent_find(steps.begin(), steps.end(), [](const StepPlace& a, const StepPlace& b) {
            return a.file == b.file && b.time < a.time;
        });
    if (across != steps.end())
        ordered.notes.push_back(fmt::format("{}: its steps are put in the order of their times: {} "
                                            "follows {}",
                                            names[across->file], std::next(across)->time,
                                            across->time));
    std::ranges::stable_sort(steps, later);
    std::size_t repeated = 0;
    std::string first;
    for (const StepPlace& step : steps) {
        if (ordered.steps.empty() || ordered.steps.back().time != step.time) {
            ordered.steps.push_back(step);
            continue;
        }
        StepPlace& same = ordered.steps.back();
        if (repeated++ == 0)
            first = same.file == step.file ? fmt::format("{} in {}", step.time, names[step.file])
                                           : fmt::format("{} in {} and {}", step.time,
                                                         names[same.file], names[step.file]);
        if (!keep_first)
            same = step;
    }
    if (repeated > 0)
        ordered.notes.push_back(note_on_repeated(repeated, first, keep_first));
    return ordered;
}

ListedFiles ordered_entries(ListedFiles files, bool keep_first, std::vector<std::string>& notes) {
    std::ranges::stable_sort(files, {}, &ListedFile::time);
    ListedFiles once;
    std::map<std::pair<double, std::string>, std::size_t> places;
    std::size_t repeated = 0;
    std::string first;
    for (ListedFile& file : files) {
        const auto [place, is_new] = places.try_emplace({file.time, file.part}, once.size());
        if (is_new) {
            once.push_back(std::move(file));
            continue;
        }
        ListedFile& same = once[place->second];
        if (repeated++ == 0)
            first = same.path == file.path
                        ? fmt::format("{} of {}", file.time, file.path.filename().string())
                        : fmt::format("{} of {} and {}", file.time, same.path.filename().string(),
                                      file.path.filename().string());
        if (!keep_first)
            same = std::move(file);
    }
    if (repeated > 0)
        notes.push_back(note_on_repeated(repeated, first, keep_first));
    return once;
}

} // namespace isochron::index
