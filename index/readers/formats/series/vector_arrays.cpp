// Vectors whose components are arrays of their own, on staggered grids too.
#include "index/readers/formats/series/vector_arrays.h"

#include "index/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::size_t kMostComponents = 3;

/// The places between neighbors along an axis.
Grid between_neighbors(Grid grid, int axis) {
    const auto a = static_cast<std::size_t>(axis);
    std::vector<double> middles;
    for (std::uint32_t i = 0; i + 1 < grid.vertices[a]; ++i)
        middles.push_back((grid.distance(axis, i) + grid.distance(axis, i + 1)) / 2);
    const double first = middles.front();
    for (double& at : middles)
        at -= first;
    grid.origin += grid.direction[axis] * first;
    grid.vertices[a] = static_cast<std::uint32_t>(middles.size());
    if (!grid.positions[a].even()) {
        grid.spacing[axis] = middles.back() / static_cast<double>(middles.size() - 1);
        grid.positions[a] = AxisPositions(std::move(middles));
    }
    return grid;
}

/// The means of neighbors along an axis.
class CenteredSeries final : public VolumeSeries {
  public:
    CenteredSeries(std::unique_ptr<VolumeSeries> series, int axis)
        : series_(std::move(series)), info_(series_->info()), axis_(axis) {
        info_.grid = between_neighbors(info_.grid, axis);
        const bool wide = info_.type == ValueType::f64 || info_.type == ValueType::i32;
        info_.type = wide ? ValueType::f64 : ValueType::f32;
        info_.scaling = {};
        info_.notes.push_back(fmt::format("array {} is staggered along axis {}: the means of "
                                          "neighbors are taken",
                                          info_.array, "xyz"[axis]));
    }

    const SeriesInfo& info() const override { return info_; }
    std::vector<std::filesystem::path> files() const override { return series_->files(); }
    std::uint64_t state(std::size_t step) const override { return series_->state(step); }
    std::unique_ptr<VolumeSeries> another() const override {
        auto other = series_->another();
        return other ? std::make_unique<CenteredSeries>(std::move(other), axis_) : nullptr;
    }

    void read(std::size_t step, std::span<std::byte> out) override {
        const SeriesInfo& from = series_->info();
        std::vector<std::byte> stored(from.step_bytes());
        series_->read(step, stored);
        visit_value_type(from.type, [&]<class From>(std::type_identity<From>) {
            const std::span values(reinterpret_cast<const From*>(stored.data()),
                                   from.grid.vertex_count());
            if (info_.type == ValueType::f32)
                take_means<From, float>(values, out);
            else
                take_means<From, double>(values, out);
        });
    }

  private:
    template <class From, class To>
    void take_means(std::span<const From> values, std::span<std::byte> out) const {
        const SeriesInfo& from = series_->info();
        const auto &n = info_.grid.vertices, &held = from.grid.vertices;
        const std::array<std::size_t, 3> stride{1, held[0], std::size_t{held[0]} * held[1]};
        std::size_t at = 0;
        for (std::uint32_t z = 0; z < n[2]; ++z)
            for (std::uint32_t y = 0; y < n[1]; ++y)
                for (std::uint32_t x = 0; x < n[0]; ++x, at += sizeof(To)) {
                    const std::size_t lower = x + y * stride[1] + z * stride[2];
                    const std::size_t upper = lower + stride[static_cast<std::size_t>(axis_)];
                    const auto mean =
                        static_cast<To>((from.scaling(static_cast<double>(values[lower])) +
                                         from.scaling(static_cast<double>(values[upper]))) /
                                        2);
                    std::memcpy(&out[at], &mean, sizeof mean);
                }
    }

    std::unique_ptr<VolumeSeries> series_;
    SeriesInfo info_;
    int axis_;
};

std::string shape_of(const VolumeSeries& series) {
    const auto& n = series.info().grid.vertices;
    return fmt::format("{} ({} x {} x {} vertices, {} steps)", series.info().array, n[0], n[1],
                       n[2], series.info().steps());
}

} // namespace

std::vector<std::string> names_in_list(const std::string& array) {
    std::vector<std::string> names;
    for (std::size_t at = 0; at <= array.size();) {
        const std::size_t end = std::min(array.find(',', at), array.size());
        names.push_back(array.substr(at, end - at));
        at = end + 1;
    }
    if (names.size() < 2 || names.size() > kMostComponents || std::ranges::count(names, "") > 0)
        return {};
    return names;
}

std::vector<std::unique_ptr<VolumeSeries>>
open_components(const std::vector<std::string>& names,
                const std::function<std::unique_ptr<VolumeSeries>(const std::string&)>& open) {
    std::vector<std::unique_ptr<VolumeSeries>> all;
    for (const std::string& name : names)
        all.push_back(open(name));
    for (int axis = 0; axis < 3; ++axis) {
        const auto vertices = [a = static_cast<std::size_t>(axis)](const auto& series) {
            return series->info().grid.vertices[a];
        };
        const std::uint32_t least = vertices(*std::ranges::min_element(all, {}, vertices));
        for (auto& series : all)
            if (vertices(series) == least + 1)
                series = std::make_unique<CenteredSeries>(std::move(series), axis);
    }
    for (const auto& series : all)
        if (series->info().grid.vertices != all.front()->info().grid.vertices ||
            series->info().times != all.front()->info().times)
            throw Error("{}: not the shape or times of {}, expected arrays of one vector",
                        shape_of(*series), shape_of(*all.front()));
    return all;
}

} // namespace isochron::index
