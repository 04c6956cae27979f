// A series of files: checks them against the first, and sets their times.
#include "index/formats/series/file_series.h"

#include "index/error.h"
#include "index/formats/converted_file.h"
#include "index/formats/series/numbered_name.h"
#include "index/formats/stored_file.h"
#include "index/system/input_file.h"
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

bool close(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& tolerance) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(a[axis] - b[axis]) <= tolerance[axis]))
            return false;
    return true;
}

/// Of grids with as many vertices; one may be even but for rounding, and the other not.
bool same_positions(const Grid& a, const Grid& b, std::size_t axis) {
    constexpr double kSlack = 1e-4; // of the spacing
    if (a.positions[axis] == b.positions[axis])
        return true;
    const int i = static_cast<int>(axis);
    for (std::uint32_t vertex = 0; vertex < a.vertices[axis]; ++vertex)
        if (!(std::abs(a.distance(i, vertex) - b.distance(i, vertex)) <= kSlack * b.spacing[i]))
            return false;
    return true;
}

std::string text(const glm::dvec3& v) {
    return fmt::format("({} {} {})", v.x, v.y, v.z);
}

std::string text(Anatomy anatomy) {
    switch (anatomy) {
    case Anatomy::ras: return "right-anterior-superior";
    case Anatomy::lps: return "left-posterior-superior";
    case Anatomy::enu: return "east-north-up";
    case Anatomy::none: break;
    }
    return "not anatomical";
}

// Compares with a tolerance: geometry as decimal text or f32 differs in its last digits.
void expect_same(const SeriesInfo& got, const std::string& file, const SeriesInfo& first,
                 const std::string& first_file) {
    const auto fail = [&](const std::string& what, const std::string& is, const std::string& was) {
        throw Error(fmt::format("{}: {} {}, {} has {}", file, what, is, first_file, was));
    };
    const Grid &a = got.grid, &b = first.grid;
    if (a.vertices != b.vertices)
        fail("dimensions", fmt::format("{}x{}x{}", a.vertices[0], a.vertices[1], a.vertices[2]),
             fmt::format("{}x{}x{}", b.vertices[0], b.vertices[1], b.vertices[2]));
    if (got.array != first.array)
        fail("array", got.array, first.array);
    if (got.type != first.type)
        throw Error(fmt::format("{}: type {}, {} has {}; --type f32 reads both as f32", file,
                                name_of(got.type), first_file, name_of(first.type)));
    if (!close(a.spacing, b.spacing, b.spacing * 1e-6))
        fail("spacing", text(a.spacing), text(b.spacing));
    if (!close(a.origin, b.origin,
               glm::dvec3(1e-4 * std::min({b.spacing.x, b.spacing.y, b.spacing.z}))))
        fail("origin", text(a.origin), text(b.origin));
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!same_positions(a, b, axis))
            throw Error(fmt::format("{}: other positions of vertices along axis {} than {}", file,
                                    axis, first_file));
    for (int axis = 0; axis < 3; ++axis)
        if (!close(a.direction[axis], b.direction[axis], glm::dvec3(1e-5)))
            fail(fmt::format("direction of axis {}", axis), text(a.direction[axis]),
                 text(b.direction[axis]));
    if (got.scaling != first.scaling)
        fail("scaling", fmt::format("{} x + {}", got.scaling.slope, got.scaling.intercept),
             fmt::format("{} x + {}", first.scaling.slope, first.scaling.intercept));
    if (got.anatomy != first.anatomy)
        fail("space", text(got.anatomy), text(first.anatomy));
}

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
            throw Error(fmt::format("{}: changed while it was read: {} bytes, at first {}", name,
                                    is.size, was.size));
        throw Error(fmt::format("{}: changed while it was read: {}", name,
                                is.inode != was.inode || is.device != was.device
                                    ? "another file has taken its place"
                                    : "it was written to"));
    }
}

/// Runs `work`; exceptions other than Error become errors that name the file.
template <class Work>
auto named(const std::filesystem::path& file, Work&& work) {
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(fmt::format("{}: there is not enough memory to read it", file.string()));
    } catch (const std::exception& other) {
        throw Error(fmt::format("{}: cannot be read: {}", file.string(), other.what()));
    }
}

class FileSeries final : public VolumeSeries {
  public:
    FileSeries(std::vector<SeriesFile> files, ReadOptions options)
        : files_(std::move(files)), options_(std::move(options)) {
        for (std::size_t i = 0; i < files_.size(); ++i)
            named(files_[i].path, [&] { add(i); });
        note_missing_numbers();
        if (!options_.time_step)
            check_times();
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
    struct Place {
        std::size_t file, step;
    };

    /// Copies what the other one knows, but has no file open.
    FileSeries(const FileSeries& other)
        : files_(other.files_), options_(other.options_), info_(other.info_), first_(other.first_),
          timed_(other.timed_), places_(other.places_), found_(other.found_) {}

    /// Opens the file of a step and calls `work` with the number of the step in it.
    template <class Work>
    void with_file_of(std::size_t step, const Work& work) {
        const Place place = places_.at(step);
        named(files_[place.file].path, [&] {
            expect_unchanged(found_[place.file]);
            if (!open_ || place.file != open_index_)
                reopen(place.file);
            work(place.step);
            expect_unchanged(found_[place.file]);
        });
    }

    std::string name(std::size_t file) const { return files_[file].path.string(); }

    void add(std::size_t index) {
        Found found{.paths = {files_[index].path}, .states = {state_of(files_[index].path)}};
        // Only the last file stays open: a long series has more files than there are descriptors.
        open_file(index);
        found.steps = open_->steps();
        for (std::filesystem::path& path : open_->beside()) {
            found.states.push_back(state_of(path));
            found.paths.push_back(std::move(path));
        }
        found_.push_back(std::move(found));
        expect_few_steps(places_.size() + open_->steps(), name(index));
        const SeriesInfo& info = open_->info();
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
            if (open_->steps() != 1)
                throw Error(fmt::format("{}: {} steps, expected 1 for time {}", name(index),
                                        open_->steps(), *files_[index].time));
            times = {*files_[index].time};
        } else if (!times.empty() && !options_.time_step && !info.time_unit.empty() &&
                   !first_.time_unit.empty()) {
            // A file without a unit is assumed to use the first file's.
            const auto same = times_in(first_.time_unit, info.time_unit, std::move(times));
            if (!same)
                throw Error(fmt::format("{}: times in {}, {} has {}; --time-step sets them all",
                                        name(index), info.time_unit, name(0), first_.time_unit));
            times = *same;
        }
        if (index == 0)
            timed_ = !times.empty();
        if (timed_ != !times.empty() && !options_.time_step)
            throw Error(fmt::format("{}: gives {} time, {} gives {}; --time-step sets them all",
                                    name(index), times.empty() ? "no" : "a", name(0),
                                    times.empty() ? "one" : "none"));
        for (std::size_t step = 0; step < open_->steps(); ++step) {
            info_.times.push_back(times.empty() ? static_cast<double>(places_.size())
                                                : times[step]);
            places_.push_back({index, step});
        }
    }

    /// What was chosen of the first file is read of all, in whatever order they have their arrays.
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

    void note_missing_numbers() {
        if (timed_ || options_.time_step || places_.size() != files_.size())
            return;
        std::vector<std::filesystem::path> paths;
        for (const SeriesFile& file : files_)
            paths.push_back(file.path);
        if (const auto note = note_on_missing(paths))
            info_.notes.push_back(*note);
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
            throw Error(fmt::format("{}: changed while it was read: {} steps, at first {}",
                                    name(index), open_->steps(), found_[index].steps));
    }

    void check_times() const {
        for (std::size_t i = 0; i < info_.times.size(); ++i) {
            if (!std::isfinite(info_.times[i]))
                throw Error(fmt::format("{}: time {} is not finite", name(places_[i].file),
                                        info_.times[i]));
            if (i == 0 || info_.times[i] > info_.times[i - 1])
                continue;
            const std::string file = name(places_[i].file), before = name(places_[i - 1].file);
            const std::string time = said_time(i), time_before = said_time(i - 1);
            constexpr const char* kWayOut = "--time-step spaces the steps evenly instead";
            if (places_[i].file == places_[i - 1].file)
                throw Error(fmt::format("{}: time {} of its step {}, expected more than {} of the "
                                        "step before it; {}",
                                        file, time, places_[i].step, time_before, kWayOut));
            if (info_.times[i] == info_.times[i - 1])
                throw Error(
                    fmt::format("{}: time {}, {} has the same; {}", file, time, before, kWayOut));
            throw Error(fmt::format("{}: time {}, expected more than {} of {} before it; {}", file,
                                    time, time_before, before, kWayOut));
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
            for (int axis = 0; axis < 3; ++axis)
                if (!((*options_.spacing)[axis] > 0) || !std::isfinite((*options_.spacing)[axis]))
                    throw Error(fmt::format("--spacing: {}, expected positive numbers",
                                            text(*options_.spacing)));
            info_.grid.spacing = *options_.spacing;
            info_.grid.positions = {}; // even
        }
        if (options_.origin)
            info_.grid.origin = *options_.origin;
        if (options_.time_step) {
            if (!(*options_.time_step > 0) || !std::isfinite(*options_.time_step))
                throw Error(fmt::format("--time-step: {}, expected a positive number",
                                        *options_.time_step));
            for (std::size_t i = 0; i < info_.times.size(); ++i)
                info_.times[i] = static_cast<double>(i) * *options_.time_step;
        }
        if (options_.length_unit)
            info_.length_unit = *options_.length_unit;
        if (options_.time_unit)
            info_.time_unit = *options_.time_unit;
        if (options_.value_unit)
            info_.value_unit = *options_.value_unit;
    }

    std::vector<SeriesFile> files_;
    ReadOptions options_;
    SeriesInfo info_;
    SeriesInfo first_; ///< from the first file, before overrides
    bool timed_ = false;
    std::vector<Place> places_; ///< of every step
    std::vector<Found> found_;  ///< of every file
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
                                               const std::vector<std::string>& notes) {
    auto series = std::make_unique<FileSeries>(std::move(files), options);
    for (const std::string& note : notes)
        series->add_note(note);
    return series;
}

} // namespace isochron::index
