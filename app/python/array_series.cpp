// Arrays of Python as a series.
#include "app/python/array_series.h"

#include "index/error.h"
#include "index/readers/formats/cropped_file.h"
#include "index/readers/formats/foreign_file.h"
#include "index/readers/formats/open_series.h"
#include "index/readers/formats/series/file_series.h"
#include "index/readers/process/reader_pool.h"

#include <cmath>
#include <cstring>
#include <utility>

namespace isochron::app {
namespace {

/// The file that describes arrays, with the values of Python.
class ArrayFile final : public index::VolumeFile {
  public:
    ArrayFile(const PythonArrays& arrays, std::unique_ptr<index::VolumeFile> described)
        : arrays_(arrays), info_(described->info()), steps_(described->steps()) {}

    const index::SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override { return steps_; }

    void read(std::size_t step, std::span<std::byte> out) override {
        std::size_t at = 0;
        stream(step, [&](std::span<const std::byte> piece) {
            std::memcpy(&out[at], piece.data(), piece.size());
            at += piece.size();
        });
    }
    void stream(std::size_t step, const index::TakePiece& take) override {
        arrays_.read(info_.array, step, info_.type, take);
    }

  private:
    PythonArrays arrays_;
    index::SeriesInfo info_;
    std::size_t steps_;
};

/// A series of which something else is said than its files say.
class RestatedSeries final : public index::VolumeSeries {
  public:
    /// @param in_files whether the series is one of files
    RestatedSeries(std::unique_ptr<index::VolumeSeries> series, index::SeriesInfo info,
                   bool in_files)
        : series_(std::move(series)), info_(std::move(info)), in_files_(in_files) {}

    const index::SeriesInfo& info() const override { return info_; }
    void read(std::size_t step, std::span<std::byte> out) override { series_->read(step, out); }
    void stream(std::size_t step, const index::TakePiece& take) override {
        series_->stream(step, take);
    }
    std::unique_ptr<VolumeSeries> another() const override {
        auto other = in_files_ ? series_->another() : nullptr;
        return other ? std::make_unique<RestatedSeries>(std::move(other), info_, true) : nullptr;
    }
    std::uint64_t state(std::size_t step) const override {
        return in_files_ ? series_->state(step) : 0;
    }
    std::vector<std::filesystem::path> files() const override {
        return in_files_ ? series_->files() : std::vector<std::filesystem::path>();
    }

  private:
    std::unique_ptr<index::VolumeSeries> series_;
    index::SeriesInfo info_;
    bool in_files_;
};

std::unique_ptr<index::VolumeSeries> open_stored(const PythonArrays& arrays,
                                                 const index::ReadOptions& options) {
    index::readers_of_this_process().let_read(arrays.description);
    const index::OpenVolumeFile open = [arrays](const std::filesystem::path& path,
                                                const index::ReadOptions& asked) {
        index::ReadOptions whole = asked;
        whole.crop.reset();
        whole.stride.reset();
        auto described = index::open_in_format(index::format_named("netcdf"), path, whole);
        return index::cropped(std::make_unique<ArrayFile>(arrays, std::move(described)), asked,
                              path);
    };
    return index::open_file_series({{arrays.description, open, {}}}, options);
}

} // namespace

std::unique_ptr<index::VolumeSeries> open_arrays(const PythonArrays& arrays,
                                                 const index::ReadOptions& options) {
    const auto open = [&](const index::ReadOptions& one) {
        auto series = open_stored(arrays, one);
        index::SeriesInfo info = series->info();
        info.sources = {arrays.name};
        return std::make_unique<RestatedSeries>(std::move(series), std::move(info), false);
    };
    return index::open_stored_series(open, arrays.description.string(), options);
}

std::unique_ptr<index::VolumeSeries> with_times(std::unique_ptr<index::VolumeSeries> series,
                                                const std::vector<double>& times) {
    index::SeriesInfo info = series->info();
    if (times.size() != info.steps())
        throw index::Error("times: " + std::to_string(times.size()) + " given, expected " +
                           std::to_string(info.steps()) + ", one for each step");
    for (std::size_t i = 0; i < times.size(); ++i)
        if (!std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1]))
            throw index::Error("times: expected numbers that increase, not so at step " +
                               std::to_string(i));
    info.times = times;
    return std::make_unique<RestatedSeries>(std::move(series), std::move(info), true);
}

} // namespace isochron::app
