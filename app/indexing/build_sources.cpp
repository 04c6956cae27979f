// Opening of sources, and options from arguments.
#include "app/indexing/build_sources.h"

#include "app/indexing/open_index.h"
#include "index/error.h"
#include "index/file/index_series.h"
#include "index/indexing/appended_series.h"
#include "index/name_pattern.h"
#include "index/readers/formats/open_series.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string_view>
#include <utility>

namespace isochron::app {
namespace {

using SeriesPtr = std::unique_ptr<index::VolumeSeries>;

/// What may stand behind a vector's name, or behind a scalar's what is computed of it.
bool is_component(std::string_view word) {
    constexpr std::array<std::string_view, 4> kComputed{"magnitude", "gradient", "vorticity",
                                                        "q-criterion"};
    return std::ranges::find(kComputed, word) != kComputed.end() ||
           (!word.empty() && std::ranges::all_of(word, [](unsigned char digit) {
               return std::isdigit(digit) != 0;
           }));
}

/// @param name of an array, or of an array and a component
ArraySource open_called(const OpenSource& open, index::ReadOptions options,
                        const std::string& name) {
    options.array = name;
    const std::size_t dot = name.rfind('.');
    const bool may_be_two = !options.component && dot != name.npos && dot > 0 &&
                            is_component(std::string_view(name).substr(dot + 1));
    try {
        SeriesPtr series = open(options);
        return {std::move(series), options.array, options.component};
    } catch (const index::Error&) {
        if (!may_be_two)
            throw;
    }
    options.array = name.substr(0, dot);
    options.component = name.substr(dot + 1);
    SeriesPtr series = open(options);
    return {std::move(series), options.array, options.component};
}

constexpr std::string_view kMagnitude = ".magnitude";

/// The name in an entry of `SeriesInfo::arrays`, `u (f32 x 3)`; of a vector, its magnitude.
std::string name_in(const std::string& offered) {
    const std::size_t end = offered.rfind(" (");
    const bool vector = end != offered.npos && offered.find(" x ", end) < offered.find(',', end);
    return offered.substr(0, end) + (vector ? std::string(kMagnitude) : "");
}

std::vector<std::string> offered_by(const OpenSource& open, index::ReadOptions options) {
    options.array.reset();
    options.any_array = true;
    return open(options)->info().arrays;
}

/// Whether names differ in the numbers at their ends alone.
bool are_numbered(std::span<const std::string> names) {
    const auto begin_of = [](const std::string& name) {
        return name.substr(0, name.find_last_not_of("0123456789") + 1); // npos + 1 is 0
    };
    return names.size() > 1 && std::ranges::all_of(names, [&](const std::string& name) {
               const std::string begin = begin_of(name);
               return begin.size() < name.size() && begin == begin_of(names.front());
           });
}

/// Whether the format takes the arrays that match a pattern as the steps of one.
bool takes_as_steps(const OpenSource& open, index::ReadOptions options,
                    const std::string& pattern) {
    options.array = pattern;
    try {
        return open(options)->info().steps() > 1;
    } catch (const index::Error&) {
        return false;
    }
}

/// Names of arrays with patterns such as `u*` replaced by the arrays that match. A pattern that is
/// itself the name of an array, as of groups in HDF5 that are steps, stays, and so does one that no
/// array matches, which the format may know, and one of numbered arrays that are the steps of one.
std::vector<std::string> without_patterns(const OpenSource& open, const BuildArguments& arguments) {
    std::vector<std::string> names, offered;
    for (const std::string& given : arguments.arrays) {
        if (given.find_first_of("*?[") == given.npos) {
            names.push_back(given);
            continue;
        }
        if (offered.empty())
            offered = offered_by(open, read_options(arguments));
        const std::size_t dot = given.rfind('.');
        const bool of_component = dot != given.npos && is_component(given.substr(dot + 1));
        const std::string pattern = of_component ? given.substr(0, dot) : given;
        const std::size_t before = names.size();
        bool is_name = false;
        for (const std::string& each : offered) {
            const std::string name = each.substr(0, each.rfind(" ("));
            is_name = is_name || name == pattern;
            // Paths within a file are named by their ends, too.
            if (index::matches_pattern(pattern, name) ||
                index::matches_pattern("*/" + pattern, name))
                names.push_back(of_component ? name + given.substr(dot) : name_in(each));
        }
        if (is_name || names.size() == before ||
            (are_numbered(std::span(names).subspan(before)) &&
             takes_as_steps(open, read_options(arguments), given))) {
            names.resize(before);
            names.push_back(given);
        }
    }
    return names;
}

/// The names in all entries, each once.
std::vector<std::string> names_among(const index::VolumeSeries& series) {
    std::vector<std::string> names;
    for (const std::string& offered : series.info().arrays)
        if (const std::string name = name_in(offered);
            std::ranges::find(names, name) == names.end())
            names.push_back(name);
    return names;
}

/// Opens every array that goes with the first.
void open_all(const OpenSource& open, const index::ReadOptions& options,
              const std::vector<std::string>& names, BuildSources& sources) {
    for (const std::string& name : names) {
        try {
            ArraySource source = open_called(open, options, name);
            const index::SeriesInfo& info = source.series->info();
            if (!sources.volume) {
                sources.volume = std::move(source.series);
                sources.array = source.array;
                sources.component = source.component;
            } else if (info.grid != sources.volume->info().grid ||
                       info.times != sources.volume->info().times) {
                throw index::Error("its shape or its times differ from {}",
                                   sources.volume->info().array);
            } else {
                sources.further.push_back(std::move(source));
            }
        } catch (const index::Error& error) {
            sources.notes.push_back(fmt::format("array {} is left out: {}", name, error.what()));
        }
    }
    if (!sources.volume)
        throw index::Error(sources.notes.empty() ? "no array can be read" : sources.notes.front());
}

void open_arrays(const OpenSource& open, const BuildArguments& arguments, BuildSources& sources) {
    const index::ReadOptions options = read_options(arguments);
    if (arguments.all_arrays) {
        index::ReadOptions any = options;
        any.any_array = true;
        SeriesPtr first = open(any);
        const std::vector<std::string> names = names_among(*first);
        if (!names.empty())
            return open_all(open, options, names, sources);
        sources.volume = std::move(first); // files with one array that has no name
        return;
    }
    if (!options.array) {
        sources.volume = open(options);
        sources.component = options.component;
        return;
    }
    const std::vector<std::string> names = without_patterns(open, arguments);
    ArraySource first = open_called(open, options, names.empty() ? *options.array : names.front());
    sources.volume = std::move(first.series);
    sources.array = first.array;
    sources.component = first.component;
    for (std::size_t i = 1; i < names.size(); ++i)
        sources.further.push_back(open_called(open, options, names[i]));
}

bool is_among(const BuildSources& sources, const std::optional<std::string>& name) {
    return name && std::ranges::any_of(sources.further, [&](const ArraySource& source) {
               return source.series->info().array == *name;
           });
}

} // namespace

BuildSources open_sources(const OpenSource& open, const BuildArguments& arguments) {
    BuildSources sources;
    open_arrays(open, arguments, sources);
    if (arguments.color && (arguments.color_component || !is_among(sources, arguments.color)))
        sources.colors = open(color_options(arguments));
    return sources;
}

BuildSources open_sources(const std::vector<std::filesystem::path>& files,
                          const BuildArguments& arguments, const index::Progress& progress) {
    // An index is a series too: of an older file version it becomes one of this.
    if (files.size() != 1 || !index::is_index(files.front()))
        return open_sources(
            [&](const index::ReadOptions& options) {
                return index::open_series(files, options, progress);
            },
            arguments);
    BuildSources sources;
    if (arguments.refer)
        throw UsageError("--refer: an index has no files of values to refer to");
    const std::filesystem::path& index = files.front();
    BuildArguments given = arguments;
    given.all_arrays = false; // all are taken unless some are named
    if (const auto all = index::arrays_of_index(index); !given.read.array && all.size() > 1) {
        given.arrays = all;
        given.read.array = all.front();
    }
    open_arrays(
        [&index](const index::ReadOptions& options) {
            return index::open_index_series(index, options);
        },
        given, sources);
    index::ReadOptions of_colors = color_options(arguments);
    if (!of_colors.array)
        of_colors.array = index::color_of_index(index);
    if (of_colors.array && !is_among(sources, of_colors.array))
        sources.colors = index::open_index_series(index, of_colors);
    return sources;
}

std::vector<std::string> arrays_to_choose(const std::vector<std::filesystem::path>& files,
                                          const BuildArguments& arguments) {
    if (arguments.all_arrays || arguments.read.array)
        return {};
    try {
        index::ReadOptions any = read_options(arguments);
        any.any_array = true;
        std::vector<std::string> names = names_among(*index::open_series(files, any));
        if (arguments.read.component) // given apart, so the name has none
            for (std::string& name : names)
                if (name.ends_with(kMagnitude))
                    name.resize(name.size() - kMagnitude.size());
        return names.size() > 1 ? names : std::vector<std::string>();
    } catch (const index::Error&) {
        return {};
    }
}

ArraySource open_array(const std::vector<std::filesystem::path>& files,
                       const BuildArguments& arguments, const std::string& name) {
    return open_called(
        [&](const index::ReadOptions& options) { return index::open_series(files, options); },
        read_options(arguments), name);
}

BuildSources open_one_or_all(const std::vector<std::filesystem::path>& files,
                             BuildArguments& arguments) {
    try {
        return open_sources(files, arguments);
    } catch (const index::Error&) {
        if (arrays_to_choose(files, arguments).empty())
            throw;
    }
    arguments.all_arrays = true;
    return open_sources(files, arguments);
}

void append_sources(BuildSources& sources, const std::shared_ptr<const index::IndexFile>& held,
                    const std::string& name) {
    if (sources.further.size() + 1 != held->arrays()) {
        std::vector<std::string> given{sources.volume->info().array}, has;
        for (const ArraySource& source : sources.further)
            given.push_back(source.series->info().array);
        has = array_names(*held);
        throw index::Error("{}: cannot be appended to: it holds the arrays {}, given are {}", name,
                           fmt::join(has, ", "), fmt::join(given, ", "));
    }
    sources.volume = index::append_to(held, name, std::move(sources.volume));
    sources.colors = index::append_colors_to(held, name, std::move(sources.colors));
    for (std::size_t i = 0; i < sources.further.size(); ++i)
        sources.further[i].series = index::append_to(index::array_of(held, i + 1), name,
                                                     std::move(sources.further[i].series));
}

index::BuildOptions build_options(const BuildArguments& arguments, const BuildSources& sources) {
    index::BuildOptions options = arguments.build;
    if (!arguments.tiers.empty())
        options.tiers = tiers_of(arguments.tiers);
    if (!arguments.codec.empty())
        options.codec = *index::codec_from_name(arguments.codec);
    options.array = sources.array;
    options.component = sources.component;
    index::ReadOptions reading = read_options(arguments);
    reading.array = reading.component = std::nullopt;
    if (reading != index::ReadOptions())
        options.reading = reading;
    options.color_array = arguments.color;
    options.color_component = arguments.color_component;
    options.color = sources.colors.get();
    for (const ArraySource& source : sources.further)
        options.further.push_back({source.series.get(), source.array, source.component});
    return options;
}

} // namespace isochron::app
