// Building of indexes that are kept, and their going.
#include "app/commands/kept_index.h"

#include "app/commands/build_sources.h"
#include "app/commands/cancel.h"
#include "app/commands/file_patterns.h"
#include "app/commands/progress_bar.h"
#include "app/version.h"
#include "index/error.h"
#include "index/file/file_layout.h"
#include "index/system/new_file.h"
#include "index/system/team.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// Changes when a file in a folder is written to.
std::string state_of_folder(const fs::path& folder) {
    std::error_code error;
    std::uint64_t files = 0, bytes = 0;
    fs::file_time_type newest = fs::file_time_type::min();
    for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
        if (!entry.is_regular_file(error))
            continue;
        ++files;
        bytes += entry.file_size(error);
        newest = std::max(newest, entry.last_write_time(error));
    }
    return fmt::format("{} {} {}", files, bytes, newest.time_since_epoch().count());
}

/// The same for the same files and options.
std::string name_of_kept(const std::vector<fs::path>& files, const BuildArguments& arguments) {
    std::string key(kProgram);
    const auto add = [&key](const std::string& text) {
        key += fmt::format("{}:{};", text.size(), text);
    };
    for (const fs::path& file : files)
        add(fs::weakly_canonical(file).string() +
            (fs::is_directory(file) ? state_of_folder(file) : ""));
    const index::ReadOptions& read = arguments.read;
    for (const auto& text :
         {read.array, read.component, read.length_unit, read.time_unit, read.value_unit,
          arguments.color, arguments.color_component, arguments.color_unit})
        add(text.value_or("-"));
    add(fmt::format("{} {} {} {} {} {} {}", read.allow_surplus, read.extra_axis_is_time,
                    read.times_from_names, read.big_endian, read.header_bytes,
                    read.time_step.value_or(0), arguments.type));
    add(fmt::format("{} {} {} {}", fmt::join(arguments.dims, ","),
                    fmt::join(arguments.resample, ","), fmt::join(arguments.spacing, ","),
                    fmt::join(arguments.origin, ",")));
    const auto hash = index::checksum_of(std::as_bytes(std::span(key)));
    return fmt::format("{}-{:016x}.isochron", files.front().stem().string().substr(0, 40), hash);
}

/// Whether it is whole, and its files are what they were.
bool still_holds(const fs::path& path, const index::VolumeSeries& series) {
    try {
        const auto file = index::IndexFile::open(path);
        const std::size_t steps = series.info().steps();
        const auto states = file->source_states();
        if (file->info().steps() != steps || states.size() < steps)
            return false;
        for (std::size_t step = 0; step < steps; ++step)
            if (states[step] == 0 || states[step] != series.state(step))
                return false;
        return true;
    } catch (const index::Error&) {
        return false;
    }
}

void make_room(const fs::path& folder, const fs::path& stays, std::uint64_t most_bytes) {
    struct Kept {
        fs::file_time_type used;
        std::uint64_t bytes;
        fs::path path;
    };
    std::error_code error;
    std::vector<Kept> kept;
    std::uint64_t bytes = 0;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().extension() != ".isochron" || !entry.is_regular_file(error))
            continue;
        kept.push_back({entry.last_write_time(error), entry.file_size(error), entry.path()});
        bytes += kept.back().bytes;
    }
    std::ranges::sort(kept, {}, &Kept::used);
    for (const Kept& each : kept) {
        if (bytes <= most_bytes)
            return;
        if (each.path != stays && fs::remove(each.path, error))
            bytes -= each.bytes;
    }
}

} // namespace

fs::path kept_index(const BuildArguments& arguments, const fs::path& folder,
                    std::uint64_t most_bytes) {
    const std::vector<fs::path> files = expand_patterns(arguments.files);
    BuildSources sources = open_sources(files, arguments);
    index::make_folder(folder);
    fs::path path = folder / name_of_kept(files, arguments);
    std::error_code ignored;
    if (still_holds(path, *sources.volume)) {
        fs::last_write_time(path, fs::file_time_type::clock::now(), ignored); // when it was used
        return path;
    }
    const index::SeriesInfo& info = sources.volume->info();
    {
        const CancelOnSignal signals;
        ProgressBar bar(stderr,
                        static_cast<double>(info.step_bytes()) * static_cast<double>(info.steps()),
                        ProgressBar::Of::all);
        const auto team = index::join_team();
        index::build_index(
            *sources.volume, path, build_options(arguments, sources),
            [&](std::string_view phase, double fraction) {
                signals.check();
                bar.show(phase, fraction);
            },
            *team);
    }
    for (const std::string& note : info.notes)
        fmt::print(stderr, "note: {}\n", note);
    make_room(folder, path, most_bytes);
    return path;
}

} // namespace isochron::app
