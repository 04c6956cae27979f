// A series of files: checks them against the first, and sets their times.
#include "index/readers/formats/series/file_series.h"

#include "index/interrupted.h"

#include "index/error.h"
#include "index/readers/formats/converted_file.h"
#include "index/readers/formats/series/missing_numbers.h"
#include "index/readers/formats/series/same_volume.h"
#include "index/readers/formats/series/step_order.h"
#include "index/readers/formats/series/vti_header_hash.h"
#include "index/readers/formats/stored_file.h"
#include "index/utf8.h"
#include "index/volume/time_unit.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <string_view>
#include <utility>

namespace isochron::index {
namespace {

/// The state of a file when the series was opened.
struct Found {
    std::vector<std::filesystem::path> paths; ///< the file, and other files with its values
    std::vector<FileState> states;
    std::size_t steps = 0;
};

void expect_unchanged(const Found& found) {
    for (std::size_t i = 0; i < found.paths.size(); ++i) {
        const FileState &was = found.states[i], is = state_of(found.paths[i]);
        if (is == was)
            continue;
        const std::string name = found.paths[i].string();
        if (is.size != was.size)
            throw Error("{}: changed while it was read: {} bytes, at first {}", name, is.size,
                        was.size);
        throw Error("{}: changed while it was read: {}", name,
                    is.inode != was.inode || is.device != was.device
                        ? "another file has taken its place"
                        : "it was written to");
    }
}

/// Runs `work`; exceptions other than Error and Interrupted become errors that name
/// the file.
template <class Work>
auto named(const std::filesystem::path& file, Work&& work) {
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const Interrupted&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error("{}: there is not enough memory to read it", file.string());
    } catch (const std::exception& other) {
        throw Error("{}: cannot be read: {}", file.string(), other.what());
    }
}

class FileSeries final : public VolumeSeries {
  public:
    FileSeries(std::vector<SeriesFile> files, ReadOptions options, const Progress& progress)
        : files_(std::move(files)), options_(std::move(options)) {
        constexpr std::size_t kMany = 1000;
        for (std::size_t i = 0; i < files_.size(); ++i) {
            if (progress && files_.size() >= kMany && i % 64 == 0)
                progress("opening files",
                         static_cast<double>(i) / static_cast<double>(files_.size()));
            named(files_[i].path, [&] { is_left_out(i) ? leave_out(i) : add(i); });
        }
        note_missing_numbers();
        if (!options_.time_step)
            order_by_time();
        choose_steps();
        find_gaps();
        override_info();
    }

    const SeriesInfo& info() const override { return info_; }
    void add_note(const std::string& note) { info_.notes.push_back(note); }

    /// For files with one step each.
    std::unique_ptr<VolumeSeries> another() const override {
        return places_.size() == files_.size()
                   ? std::unique_ptr<VolumeSeries>(new FileSeries(*this))
                   : nullptr;
    }

    void read(std::size_t step, std::span<std::byte> out) override {
        with_file_of(step, [&](std::size_t number) { open_->read(number, out); });
    }

    void stream(std::size_t step, const TakePiece& take) override {
        // Exceptions of `take` are not about the file, so they are passed on unchanged.
        std::exception_ptr failure;
        struct Stop {};
        try {
            with_file_of(step, [&](std::size_t number) {
                open_->stream(number, [&](std::span<const std::byte> piece) {
                    try {
                        take(piece);
                    } catch (...) {
                        failure = std::current_exception();
                        throw Stop();
                    }
                });
            });
        } catch (const Stop&) {
            std::rethrow_exception(failure);
        }
    }

    std::uint64_t state(std::size_t step) const override {
        return number_of(found_[places_.at(step).file].states);
    }

    std::vector<std::filesystem::path> files() const override {
        std::vector<std::filesystem::path> all;
        for (const Found& found : found_)
            all.insert(all.end(), found.paths.begin(), found.paths.end());
        return all;
    }

  private:
    /// Copies what the other one knows, but has no file open.
    FileSeries(const FileSeries& other)
        : files_(other.files_), options_(other.options_), info_(other.info_), first_(other.first_),
          timed_(other.timed_), places_(other.places_), found_(other.found_) {}

    /// Opens the file of a step and calls `work` with the number of the step in it.
    template <class Work>
    void with_file_of(std::size_t step, const Work& work) {
        const StepPlace place = places_.at(step);
        named(files_[place.file].path, [&] {
            expect_unchanged(found_[place.file]);
            if (!open_ || place.file != open_index_)
                reopen(place.file);
            work(place.step);
            expect_unchanged(found_[place.file]);
        });
    }

    std::string name(std::size_t file) const { return files_[file].path.string(); }

    /// Whether `--steps` leaves the file out without opening it: the first one has one step, this one
    /// as many bytes, and times are known without opening the others.
    bool is_left_out(std::size_t index) const {
        if (!options_.steps || index == 0 || found_.front().steps != 1 ||
            (timed_ && !files_[index].time && !options_.time_step) ||
            state_of(files_[index].path).size != found_.front().states.front().size)
            return false;
        const auto [first, last, stride] = *options_.steps;
        const std::size_t step = places_.size();
        return step < first || step > last || stride == 0 || (step - first) % stride != 0;
    }

    /// Counts a file without opening it.
    void leave_out(std::size_t index) {
        found_.push_back({.paths = {files_[index].path}, .states = {{}}, .steps = 1});
        info_.sources.push_back(files_[index].path.filename().string());
        info_.times.push_back(files_[index].time.value_or(static_cast<double>(places_.size())));
        places_.push_back({index, 0, info_.times.back()});
    }

    void add(std::size_t index) {
        Found found{.paths = {files_[index].path}, .states = {state_of(files_[index].path)}};
        const auto head = files_.size() > 1
                              ? header_hash_of_file(files_[index].path, found.states[0].size)
                              : std::nullopt;
        const bool told = index > 0 && head && head == head_;
        if (index == 0)
            head_ = head;
        // Only the last file stays open: a long series has more files than there are descriptors.
        if (!told)
            open_file(index);
        found.steps = told ? found_.front().steps : open_->steps();
        const std::size_t steps = found.steps;
        if (!told)
            for (std::filesystem::path& path : open_->beside()) {
                found.states.push_back(state_of(path));
                found.paths.push_back(std::move(path));
            }
        found_.push_back(std::move(found));
        expect_few_steps(places_.size() + steps, name(index));
        const SeriesInfo& info = told ? first_ : open_->info(); // a head that tells has no times
        if (index == 0) {
            choose_as_in(info);
            info_ = info;
            info_.times.clear();
            info_.sources.clear();
            check_grid(info_.grid, name(0));
            first_ = info_;
        } else {
            expect_same(info, name(index), first_, name(0));
            for (const std::string& note : info.notes) // what converting this one loses
                if (options_.type && std::ranges::find(info_.notes, note) == info_.notes.end())
                    info_.notes.push_back(note);
        }
        info_.sources.push_back(files_[index].path.filename().string());
        std::vector<double> times = info.times;
        if (files_[index].time) {
            if (steps != 1)
                throw Error("{}: {} steps, expected 1 for time {}", name(index), steps,
                            *files_[index].time);
            times = {*files_[index].time};
        } else if (!times.empty() && !options_.time_step && !info.time_unit.empty() &&
                   !first_.time_unit.empty()) {
            // A file without a unit is assumed to use the first file's.
            const auto same = times_in(first_.time_unit, info.time_unit, std::move(times));
            if (!same)
                throw Error("{}: times in {}, {} has {}; --time-step sets them all", name(index),
                            info.time_unit, name(0), first_.time_unit);
            times = *same;
        }
        if (index == 0)
            timed_ = !times.empty();
        if (timed_ != !times.empty() && !options_.time_step)
            throw Error("{}: gives {} time, {} gives {}; --time-step sets them all", name(index),
                        times.empty() ? "no" : "a", name(0), times.empty() ? "one" : "none");
        for (std::size_t step = 0; step < steps; ++step) {
            const double time = times.empty() ? static_cast<double>(places_.size()) : times[step];
            info_.times.push_back(time);
            places_.push_back({index, step, time});
        }
    }

    /// Reads from all files the array that was chosen in the first one, in whatever order a file
    /// has its arrays.
    void choose_as_in(const SeriesInfo& first) {
        constexpr std::string_view kMagnitude = ".magnitude";
        if (!options_.any_array || options_.array || options_.component || files_.size() == 1)
            return;
        const auto choose = [&](const std::string& name, const std::optional<std::string>& part) {
            for (const std::string& offered : first.arrays)
                if (offered.starts_with(name + " (")) {
                    options_.array = name;
                    options_.component = part;
                }
        };
        if (first.array.ends_with(kMagnitude))
            choose(first.array.substr(0, first.array.size() - kMagnitude.size()), "magnitude");
        choose(first.array, std::nullopt);
    }

    /// The file of each step.
    std::vector<std::filesystem::path> paths() const {
        std::vector<std::filesystem::path> paths;
        for (const StepPlace& place : places_)
            paths.push_back(files_[place.file].path);
        return paths;
    }

    void note_missing_numbers() {
        if (timed_ || options_.time_step || places_.size() != files_.size())
            return;
        if (const auto note = note_on_names(paths(), options_.dates))
            info_.notes.push_back(*note);
    }

    /// Where names alone order the steps.
    void find_gaps() {
        const auto one = [](const Found& found) { return found.steps == 1; };
        if ((!timed_ || options_.time_step) && std::ranges::all_of(found_, one))
            info_.missing_after = missing_after(paths(), options_.dates);
    }

    void open_file(std::size_t index) {
        open_.reset(); // first, so that the next file can use the same reader
        open_ = files_[index].open(files_[index].path, options_);
        if (options_.type)
            open_ = converted(std::move(open_), *options_.type, files_[index].path);
        open_index_ = index;
    }

    void reopen(std::size_t index) {
        open_file(index);
        expect_same(open_->info(), name(index), first_, name(0));
        if (open_->steps() != found_[index].steps)
            throw Error("{}: changed while it was read: {} steps, at first {}", name(index),
                        open_->steps(), found_[index].steps);
    }

    /// What files state orders the steps; names do only where they state nothing.
    void order_by_time() {
        for (std::size_t i = 0; i < info_.times.size(); ++i)
            if (!std::isfinite(info_.times[i]))
                throw Error("{}: time {} is not finite", name(places_[i].file), info_.times[i]);
        const bool given = std::ranges::any_of(
            files_, [](const SeriesFile& file) { return file.time.has_value(); });
        const bool all_same = places_.size() > 1 && std::ranges::all_of(info_.times, [&](double t) {
                                  return t == info_.times.front();
                              });
        if (given || all_same)
            return expect_increasing_times();
        OrderedSteps ordered =
            ordered_by_time(std::move(places_), info_.sources, options_.keep_first);
        places_ = std::move(ordered.steps);
        for (std::string& note : ordered.notes)
            info_.notes.push_back(std::move(note));
        info_.times.clear();
        for (const StepPlace& place : places_)
            info_.times.push_back(place.time);
        std::vector<std::string> sources;
        for (const std::size_t file : ordered.files)
            sources.push_back(info_.sources[file]);
        info_.sources = std::move(sources);
    }

    /// Leaves the steps that `--steps` names.
    void choose_steps() {
        if (!options_.steps)
            return;
        const auto [first, last, stride] = *options_.steps;
        if (first > last || last >= places_.size() || stride == 0)
            throw Error("{}: --steps {}:{}:{}, expected steps of 0:{}", name(0), first, last,
                        stride, places_.size() - 1);
        const std::vector<StepPlace> all = std::exchange(places_, {});
        info_.times.clear();
        info_.sources.clear();
        for (std::uint64_t i = 0; i <= (last - first) / stride; ++i) {
            places_.push_back(all[first + i * stride]);
            info_.times.push_back(places_.back().time);
            const auto source = files_[places_.back().file].path.filename().string();
            if (info_.sources.empty() || info_.sources.back() != source)
                info_.sources.push_back(source);
        }
        info_.notes.push_back(fmt::format("steps {}:{}:{} of {}", first, last, stride, all.size()));
    }

    void expect_increasing_times() const {
        for (std::size_t i = 1; i < info_.times.size(); ++i) {
            if (info_.times[i] > info_.times[i - 1])
                continue;
            const std::string file = name(places_[i].file), before = name(places_[i - 1].file);
            if (places_[i].file == places_[i - 1].file)
                throw Error("{}: time {} of its step {} is that of the step before it; --time-step "
                            "spaces the steps evenly instead",
                            file, said_time(i), places_[i].step);
            throw Error("{}: time {}, {} has the same; {}", file, said_time(i), before,
                        options_.times_from_names
                            ? "without --times-from-names their names order them"
                            : "--time-step spaces the steps evenly, in the order of their names");
        }
    }

    /// A time as the file has it, and its date.
    std::string said_time(std::size_t step) const {
        const std::span one(&info_.times[step], 1);
        return has_dates(one, info_.time_unit)
                   ? fmt::format("{} ({})", info_.times[step], time_text(one, 0, info_.time_unit))
                   : fmt::format("{}", info_.times[step]);
    }

    void override_info() {
        if (options_.spacing) {
            info_.grid.spacing = *options_.spacing;
            info_.grid.positions = {}; // even
        }
        if (options_.origin)
            info_.grid.origin = *options_.origin;
        expect_measurable(info_.grid, options_);
        if (options_.time_step) {
            const double last = *options_.time_step * static_cast<double>(info_.times.size());
            if (!(*options_.time_step > 0) || !std::isfinite(last))
                throw Error("--time-step: {}, expected a positive number", *options_.time_step);
            for (std::size_t i = 0; i < info_.times.size(); ++i)
                info_.times[i] = static_cast<double>(i) * *options_.time_step;
        }
        if (options_.length_unit)
            info_.length_unit = *options_.length_unit;
        if (options_.time_unit)
            info_.time_unit = *options_.time_unit;
        if (options_.value_unit)
            info_.value_unit = *options_.value_unit;
        for (std::string* unit : {&info_.length_unit, &info_.time_unit, &info_.value_unit})
            *unit = as_utf8(*unit);
    }

    std::vector<SeriesFile> files_;
    ReadOptions options_;
    SeriesInfo info_;
    SeriesInfo first_; ///< from the first file, before overrides
    bool timed_ = false;
    std::vector<StepPlace> places_;     ///< place of every step
    std::vector<Found> found_;          ///< what was found in every file
    std::optional<std::uint64_t> head_; ///< head of the first file, see `vti_header_hash`
    std::unique_ptr<VolumeFile> open_;
    std::size_t open_index_ = 0;
};

} // namespace

std::uint64_t number_of(std::span<const FileState> states) {
    std::vector<std::uint64_t> numbers;
    for (const FileState& state : states)
        numbers.insert(numbers.end(), {state.size, static_cast<std::uint64_t>(state.written)});
    return XXH3_64bits(numbers.data(), numbers.size() * sizeof numbers.front());
}

std::unique_ptr<VolumeSeries> open_file_series(std::vector<SeriesFile> files,
                                               const ReadOptions& options,
                                               const std::vector<std::string>& notes,
                                               const Progress& progress) {
    auto series = std::make_unique<FileSeries>(std::move(files), options, progress);
    for (const std::string& note : notes)
        series->add_note(note);
    return series;
}

} // namespace isochron::index
