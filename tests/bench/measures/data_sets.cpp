// The series that the benchmark generates.
#include "tests/bench/measures/data_sets.h"

#include "index/indexing/index_build.h"
#include <cassert>
#include <cstring>

namespace isochron::bench {

namespace {

/// A generated series, in the form in which the builder reads series.
class MadeSeries : public index::VolumeSeries {
  public:
    template <class Series>
    MadeSeries(const Series& series, const index::Progress& progress) : info_(describe(series)) {
        make_steps(
            series,
            [this](std::span<const std::byte> values, double time) {
                steps_.emplace_back(values.begin(), values.end());
                info_.times.push_back(time);
                info_.sources.emplace_back(info_.array);
            },
            progress);
    }
    const index::SeriesInfo& info() const override { return info_; }
    void read(std::size_t step, std::span<std::byte> out) override {
        std::memcpy(out.data(), steps_[step].data(), out.size());
    }

  private:
    index::SeriesInfo info_;
    std::vector<std::vector<std::byte>> steps_;
};

} // namespace

const std::vector<std::string>& data_names() {
    static const std::vector<std::string> names{"sphere-25", "sphere-55", "vorticity",
                                                "fourier-128", "fourier-256"};
    return names;
}

DataSet data_set(const std::string& name, index::ValueType type, std::optional<std::size_t> steps) {
    if (name.starts_with("sphere"))
        return {.name = "sphere",
                .series = app::SphereSeries{type, steps.value_or(name == "sphere-25" ? 25 : 55)},
                .isovalue = 112.5};
    if (name == "vorticity")
        return {.name = "vorticity64",
                .series = app::VorticitySeries{.type = type, .steps = steps.value_or(64)},
                .isovalue = {},
                .active_cells = 3940}; // the paper's average
    // About 0.5 % of all cells; for the large series enough that copying takes noticeable time.
    const bool large = name == "fourier-256";
    assert(large || name == "fourier-128");
    return {.name = large ? "fourier256" : "fourier128",
            .series = app::FourierSeries{.type = type,
                                         .size = large ? 256u : 128u,
                                         .steps = steps.value_or(large ? 10 : 16)},
            .isovalue = {},
            .active_cells = large ? 96'000.0 : 10'240.0};
}

std::unique_ptr<index::VolumeSeries> made_series(const DataSet& data,
                                                 const index::Progress& progress) {
    return std::visit(
        [&](const auto& of_kind) { return std::make_unique<MadeSeries>(of_kind, progress); },
        data.series);
}

std::shared_ptr<const index::IndexFile> build_file(const DataSet& data,
                                                   const std::filesystem::path& file,
                                                   const index::Progress& progress) {
    const auto series = made_series(data, progress);
    index::build_index(*series, file, {}, progress);
    return index::IndexFile::open(file);
}

} // namespace isochron::bench
