// Building of indexes that are kept, and their going.
#include "app/indexing/kept_index.h"

#include "app/indexing/build_sources.h"
#include "app/indexing/file_patterns.h"
#include "app/telling.h"
#include "app/version.h"
#include "index/error.h"
#include "index/file/sections/file_layout.h"
#include "index/indexing/first_steps.h"
#include "index/system/growing_file.h"
#include "index/system/kept_files.h"
#include "index/system/new_file.h"
#include "index/system/team.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <list>
#include <optional>
#include <thread>
#include <vector>

#include <unistd.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// Changes when a file in a folder is written to.
std::string state_of_folder(const fs::path& folder) {
    std::error_code error;
    std::uint64_t files = 0, bytes = 0;
    fs::file_time_type newest = fs::file_time_type::min();
    constexpr auto kOthers = fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator at(folder, kOthers, error), end; !error && at != end;
         at.increment(error)) {
        std::error_code gone; // meanwhile
        if (!at->is_regular_file(gone))
            continue;
        ++files;
        if (const auto size = at->file_size(gone); !gone)
            bytes += size;
        if (const auto time = at->last_write_time(gone); !gone)
            newest = std::max(newest, time);
    }
    return fmt::format("{} {} {}", files, bytes, newest.time_since_epoch().count());
}

/// Up to this many bytes of values, an index is made as a whole in less than a second or two.
constexpr std::uint64_t kSmall = 32 << 20;
/// Most bytes of values that are added to an index at a time, but for a step that is larger.
constexpr std::uint64_t kMostAdded = 256 << 20;

/// All that is said of the reading, as text.
std::string options_text(const BuildArguments& arguments) {
    std::string key;
    const index::ReadOptions& read = arguments.read;
    for (const auto& text :
         {read.array, read.component, read.length_unit, read.time_unit, read.value_unit,
          arguments.color, arguments.color_component, arguments.color_unit}) {
        const std::string said = text.value_or("-");
        key += fmt::format("{}:{};", said.size(), said);
    }
    for (const std::string& array : arguments.arrays)
        key += fmt::format("{}:{};", array.size(), array);
    if (arguments.all_arrays)
        key += "all;";
    key += fmt::format("{} {} {} {} {} {} {} {}", read.allow_surplus, read.extra_axis_is_time,
                       read.times_from_names, read.keep_first, read.big_endian, read.header_bytes,
                       read.time_step.value_or(0), arguments.type);
    key += fmt::format("{} {} {} {}", fmt::join(arguments.dims, ","),
                       fmt::join(arguments.resample, ","), fmt::join(arguments.spacing, ","),
                       fmt::join(arguments.origin, ","));
    if (arguments.resample_by_cell)
        key += "by cell";
    if (read.dates)
        key += fmt::format("dates {};", static_cast<int>(*read.dates));
    if (read.member)
        key += fmt::format("member {};", *read.member);
    key += fmt::format("{};{};{}", arguments.crop.value_or(""), arguments.stride.value_or(""),
                       arguments.steps.value_or(""));
    return key;
}

/// The name is equal for equal files and options.
std::string name_of_kept(const std::vector<fs::path>& files, const BuildArguments& arguments) {
    std::string key = fmt::format("{} {};", kProgram, index::kReading);
    for (const fs::path& file : files) {
        const fs::path whole = fs::weakly_canonical(file);
        const bool case_of_openfoam = whole.extension() == ".foam";
        std::string name = whole.string();
        if (case_of_openfoam || fs::is_directory(whole))
            name += state_of_folder(case_of_openfoam ? whole.parent_path() : whole);
        key += fmt::format("{}:{};", name.size(), name);
    }
    key += options_text(arguments);
    const auto hash = index::checksum_of(std::as_bytes(std::span(key)));
    return fmt::format("{}-{:016x}.isochron", files.front().stem().string().substr(0, 40), hash);
}

/// The index, if it is whole and its files are what they were. It may have the first steps only.
std::shared_ptr<const index::IndexFile> still_good(const fs::path& path,
                                                   const index::VolumeSeries& series) {
    try {
        auto file = index::IndexFile::open(path);
        const std::size_t steps = file->info().steps();
        const auto states = file->source_states();
        if (steps > series.info().steps() || states.size() < steps)
            return nullptr;
        for (std::size_t step = 0; step < steps; ++step)
            if (states[step] == 0 || states[step] != series.state(step))
                return nullptr;
        return file;
    } catch (const index::Error&) {
        return nullptr;
    }
}

/// Makes the index of a series, or goes on with it.
class KeptBuild {
  public:
    KeptBuild(BuildSources& sources, const BuildArguments& arguments, const fs::path& path,
              const KeptIndexReports& reports)
        : sources_(sources), arguments_(arguments), path_(path), reports_(reports),
          steps_(sources.volume->info().steps()), step_bytes_(bytes_of_step()),
          held_(still_good(path, *sources.volume)) {}

    /// @return whether there was anything to do
    bool run() {
        if (held())
            report_held();
        if (held() == steps_)
            return false;
        if (!held())
            begin();
        while (held() < steps_)
            go_on();
        return true;
    }

  private:
    std::size_t held() const { return held_ ? held_->info().steps() : 0; }

    std::uint64_t bytes_of_step() const {
        std::uint64_t bytes = sources_.volume->info().step_bytes() +
                              (sources_.colors ? sources_.colors->info().step_bytes() : 0);
        for (const ArraySource& source : sources_.further)
            bytes += source.series->info().step_bytes();
        return bytes;
    }

    void report_held() const {
        if (reports_.held)
            reports_.held(path_, held());
    }

    /// The series and its colors, up to a step.
    struct Part {
        Part(BuildSources& sources, const BuildArguments& arguments, std::size_t steps)
            : volume(*sources.volume, steps), options(build_options(arguments, sources)) {
            if (sources.colors)
                options.color = &colors.emplace(*sources.colors, steps);
            for (std::size_t i = 0; i < sources.further.size(); ++i)
                options.further[i].series =
                    &further.emplace_back(*sources.further[i].series, steps);
        }
        index::FirstSteps volume;
        std::optional<index::FirstSteps> colors;
        std::list<index::FirstSteps> further;
        index::BuildOptions options;
    };

    /// Progress of the whole series, when a part of it is worked on.
    index::Progress progress_to(std::size_t steps) const {
        return [this, first = held(), steps](std::string_view phase, double fraction) {
            if (!reports_.progress)
                return;
            const double done =
                static_cast<double>(first) + fraction * static_cast<double>(steps - first);
            reports_.progress(phase, done / static_cast<double>(steps_));
        };
    }

    void begin() {
        const bool small = step_bytes_ * steps_ <= kSmall;
        const std::size_t steps = small ? steps_ : 1;
        Part part(sources_, arguments_, steps);
        held_ = index::build_index(part.volume, path_, part.options, progress_to(steps));
        report_held();
    }

    /// Adds about as many steps as there are.
    void go_on() {
        std::optional<index::GrowingFile> file;
        try {
            file.emplace(path_, true);
        } catch (const index::Error&) {
            if (::access(path_.c_str(), W_OK) != 0)
                throw;
            return wait_for_other();
        }
        held_ = index::IndexFile::open(path_); // it may have grown before the file was ours
        const std::uint64_t most = std::max<std::uint64_t>(1, kMostAdded / step_bytes_);
        const std::size_t steps =
            std::min<std::uint64_t>(steps_, held() + std::min<std::uint64_t>(held(), most));
        if (steps > held()) {
            Part part(sources_, arguments_, steps);
            const auto team = index::alone();
            held_ = index::append_index(part.volume, *held_, *file, path_, part.options,
                                        progress_to(steps), *team);
        }
        report_held();
    }

    /// Another program goes on with the same index.
    void wait_for_other() {
        constexpr std::chrono::milliseconds kPeriod{250};
        std::this_thread::sleep_for(kPeriod);
        progress_to(held())("waiting for another program", 0);
        const std::size_t before = held();
        held_ = still_good(path_, *sources_.volume);
        if (!held_)
            throw index::Error("{}: another program has replaced it", path_.string());
        if (held() > before)
            report_held();
    }

    BuildSources& sources_;
    const BuildArguments& arguments_;
    const fs::path& path_;
    const KeptIndexReports& reports_;
    const std::size_t steps_;
    const std::uint64_t step_bytes_;
    std::shared_ptr<const index::IndexFile> held_; ///< null: none yet
};

} // namespace

bool has_no_options(const BuildArguments& arguments) {
    return options_text(arguments) == options_text({});
}

fs::path kept_index(const BuildArguments& given, const fs::path& folder,
                    const KeptIndexReports& reports, std::uint64_t most_bytes) {
    BuildArguments arguments = given;
    const std::vector<fs::path> files = expand_patterns(arguments.files);
    BuildSources sources = open_chosen(files, arguments, reports.choose);
    if (reports.opened)
        reports.opened(sources.volume->info().steps());
    index::make_folder(folder);
    fs::path path = folder / name_of_kept(files, arguments);
    if (!KeptBuild(sources, arguments, path, reports).run()) {
        std::error_code ignored;
        fs::last_write_time(path, fs::file_time_type::clock::now(), ignored); // when it was used
        return path;
    }
    std::vector<std::string> notes = sources.volume->info().notes;
    notes.insert(notes.end(), sources.notes.begin(), sources.notes.end());
    for (const std::string& note : notes)
        print_note("note: {}", note);
    index::make_room(folder, ".isochron", path, {most_bytes});
    return path;
}

} // namespace isochron::app
