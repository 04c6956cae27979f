// Names with numbers, and the volumes that they make.
#include "index/readers/formats/series/slice_files.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/foreign_file.h"
#include "index/readers/formats/series/numbered_name.h"
#include "index/readers/formats/series/tiff_head.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// What the numbers in names count.
enum class Counted : std::uint8_t { slice, step, channel, place };

/// The letters before a number, perhaps with `_`, `-`, `=` or a blank between.
std::string last_word(const std::string& text) {
    std::size_t end = text.size();
    if (end > 0 && std::string_view("_-= ").find(text[end - 1]) != std::string_view::npos)
        --end;
    std::size_t begin = end;
    const auto is_letter = [](unsigned char c) { return (c | 32) >= 'a' && (c | 32) <= 'z'; };
    while (begin > 0 && is_letter(static_cast<unsigned char>(text[begin - 1])))
        --begin;
    return text.substr(begin, end - begin);
}

/// By the letters before a number.
std::optional<Counted> counted_behind(const std::string& text) {
    const std::string word = lower_case(last_word(text));
    for (const char* each : {"z", "slice", "plane", "section", "img"})
        if (word == each)
            return Counted::slice;
    for (const char* each : {"t", "time", "timepoint", "frame", "step"})
        if (word == each)
            return Counted::step;
    for (const char* each : {"c", "ch", "chn", "channel", "w"})
        if (word == each)
            return Counted::channel;
    for (const char* each : {"x", "y", "row", "col", "column", "tile", "fov", "well", "mosaic"})
        if (word == each)
            return Counted::place;
    return std::nullopt;
}

/// Whether a number stands in a folder's name.
bool in_folder(const NumberedName& name, std::size_t number) {
    return std::any_of(name.texts.begin() + static_cast<std::ptrdiff_t>(number) + 1,
                       name.texts.end(),
                       [](const std::string& text) { return text.find('/') != text.npos; });
}

/// The numbers that differ. One that a folder's name and a file's name both have counts once.
std::vector<std::size_t> counting_numbers(const std::vector<NumberedName>& names) {
    std::vector<std::size_t> counting;
    for (const std::size_t i : varying_numbers(names))
        if (std::ranges::none_of(counting, [&](std::size_t earlier) {
                return in_folder(names.front(), earlier) && !in_folder(names.front(), i) &&
                       std::ranges::all_of(names, [&](const NumberedName& name) {
                           return name.numbers[i] == name.numbers[earlier];
                       });
            }))
            counting.push_back(i);
    return counting;
}

/// What each varying number counts. @throws Error when that cannot be told
std::map<std::size_t, Counted> meanings(const std::vector<NumberedName>& names,
                                        const std::vector<fs::path>& files, bool flat) {
    const std::vector<std::size_t> varying = counting_numbers(names);
    std::map<std::size_t, Counted> found;
    std::set<Counted> taken;
    const auto is_place = [&](std::size_t i) {
        return counted_behind(names.front().texts[i]) == Counted::place;
    };
    for (const std::size_t i : varying)
        if (is_place(i) &&
            (last_word(names.front().texts[i]).size() > 1 || // x1.tif alone may be any
             std::ranges::count_if(varying, is_place) > 1))
            throw Error("{}, {}: tiles side by side, by the numbers behind '{}', expected slices "
                        "or steps: give the files of one place",
                        files.front().string(), files.back().string(),
                        last_word(names.front().texts[i]));
    for (const std::size_t i : varying)
        if (const auto counted = counted_behind(names.front().texts[i]);
            counted && taken.insert(*counted).second)
            found[i] = *counted;
    if (varying.size() == 1 && (found.empty() || (flat && found.begin()->second == Counted::step)))
        return {{varying.front(), flat ? Counted::slice : Counted::step}};
    if (varying.size() == 2 && found.empty() && flat && in_folder(names.front(), varying[0]) &&
        !in_folder(names.front(), varying[1])) // 003/0001.tif
        return {{varying[0], Counted::step}, {varying[1], Counted::slice}};
    // One that is left is what is not there yet.
    for (const std::size_t i : varying)
        if (!found.contains(i) && varying.size() == found.size() + 1) {
            const Counted left =
                flat && !taken.contains(Counted::slice) ? Counted::slice : Counted::step;
            if (taken.insert(left).second)
                found[i] = left;
        }
    if (found.size() != varying.size())
        throw Error("{}, {}: {} numbers differ in the names of the files, expected them behind t, "
                    "c and z (t01_c0_z001.tif)",
                    files.front().string(), files.back().string(), varying.size());
    return found;
}

/// Gaps would be shown as if they were none. Decimals in names are rounded.
void expect_even(const std::map<NameNumber, fs::path>& slices) {
    if (slices.size() < 3)
        return;
    const double gap = std::next(slices.begin())->first.value - slices.begin()->first.value;
    for (auto slice = std::next(slices.begin()); slice != slices.end(); ++slice) {
        const auto before = std::prev(slice);
        const double rounding =
            1.5 * std::max(slice->first.rounding(), before->first.rounding()) + 1e-9 * gap;
        if (std::abs(slice->first.value - before->first.value - gap) > rounding)
            throw Error("{}: slice {} follows {} of {}, expected {}", slice->second.string(),
                        slice->first.value, before->first.value, before->second.string(),
                        before->first.value + gap);
    }
}

/// The folder that all files are in, at some depth.
fs::path common_folder(const std::vector<fs::path>& files) {
    fs::path common = files.front().parent_path();
    for (const fs::path& file : files) {
        const fs::path folder = file.parent_path();
        fs::path both;
        for (auto a = common.begin(), b = folder.begin();
             a != common.end() && b != folder.end() && *a == *b; ++a, ++b)
            both /= *a;
        common = both;
    }
    return common;
}

SeriesFile of_slices(const Format& format, std::vector<fs::path> slices) {
    SeriesFile file{.path = slices.front(), .open = {}, .time = {}};
    file.open = [&format, slices = std::move(slices)](const fs::path& path,
                                                      const ReadOptions& options) {
        ReadOptions with = options;
        with.slices = slices;
        return open_in_format(format, path, with);
    };
    return file;
}

} // namespace

std::vector<SeriesFile> tiff_series(const Format& format, const std::vector<fs::path>& files,
                                    const ReadOptions& options) {
    const auto of_stack = [&](const fs::path& path) {
        return SeriesFile{.path = path, .open = opener_of(format), .time = {}};
    };
    if (const std::vector<fs::path> wholes = not_named_by_others(files);
        wholes.size() < files.size())
        return tiff_series(format, wholes, options);
    if (files.size() == 1)
        return {of_stack(files.front())};
    std::vector<std::string> within;
    const std::string::size_type folder = common_folder(files).string().size();
    for (const fs::path& file : files)
        within.push_back(file.string().substr(folder));
    const ReadNames read = read_names(within);
    std::vector<fs::path> sorted;
    std::vector<NumberedName> names;
    for (const std::size_t file : read.order) {
        sorted.push_back(files[file]);
        names.push_back(read.names[file]);
        if (names.back().texts != names.front().texts)
            throw Error("{}, {}: names that differ in more than numbers, expected t01_c0_z001.tif "
                        "and the like",
                        sorted.front().string(), sorted.back().string());
    }
    const bool flat = is_flat_tiff(sorted.front()).value_or(false);
    const auto counts = meanings(names, sorted, flat);
    std::map<NameNumber, std::map<NameNumber, std::map<NameNumber, fs::path>>> found;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        std::map<Counted, NameNumber> at;
        for (const auto& [number, counted] : counts)
            at[counted] = names[i].numbers[number];
        fs::path& place = found[at[Counted::channel]][at[Counted::step]][at[Counted::slice]];
        if (!place.empty())
            throw Error("{}, {}: both are slice {} of step {}", place.string(), sorted[i].string(),
                        at[Counted::slice].value, at[Counted::step].value);
        place = sorted[i];
    }
    auto channel = found.begin();
    if (found.size() > 1) {
        std::vector<std::string> offered;
        for (const auto& [number, steps] : found)
            offered.push_back(fmt::format("channel {}", number.value));
        const auto chosen = std::ranges::find(offered, options.array.value_or(""));
        if (chosen == offered.end())
            throw Error("{}: files of several channels, choose one with --array: {}",
                        sorted.front().string(), fmt::join(offered, ", "));
        std::advance(channel, chosen - offered.begin());
    }
    std::vector<SeriesFile> series;
    const std::size_t slices = channel->second.begin()->second.size();
    for (const auto& [step, of_step] : channel->second) {
        if (of_step.size() != slices)
            throw Error("{}: {} slices in step {}, the first has {}",
                        of_step.begin()->second.string(), of_step.size(), step.value, slices);
        expect_even(of_step);
        std::vector<fs::path> paths;
        for (const auto& [number, path] : of_step)
            paths.push_back(path);
        series.push_back(flat ? of_slices(format, std::move(paths)) : of_stack(paths.front()));
        if (!flat && found.size() > 1)
            series.back().open = [&format](const fs::path& path, const ReadOptions& given) {
                ReadOptions alone = given;
                alone.array.reset(); // it chose the file
                return open_in_format(format, path, alone);
            };
    }
    return series;
}

} // namespace isochron::index
