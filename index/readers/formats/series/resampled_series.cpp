// Linear interpolation along three axes, a layer at a time.
#include "index/readers/formats/series/resampled_series.h"

#include "index/error.h"
#include "index/readers/formats/series/misfit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

namespace isochron::index {
namespace {

/// Where a vertex lies between two others.
struct Between {
    std::uint32_t lower = 0;
    double share = 0; ///< share of the upper one
};

/// A value whose share is 0 may be missing: it is not looked at.
double mix(double lower, double upper, double share) {
    return share == 0 ? lower : share == 1 ? upper : lower + share * (upper - lower);
}

/// Where each vertex of `to` lies between two vertices of `from`, along an axis on which both grids
/// span the same distance.
std::vector<Between> between(const Grid& to, const Grid& from, int axis) {
    const auto a = static_cast<std::size_t>(axis);
    std::vector<Between> places;
    const std::uint32_t last = from.vertices[a] - 1;
    for (std::uint32_t i = 0; i < to.vertices[a]; ++i) {
        const double at =
            i + 1 == to.vertices[a]
                ? last
                : std::clamp<double>(from.index_at(axis, to.distance(axis, i)), 0, last);
        const auto lower = std::min(static_cast<std::uint32_t>(at), last - 1);
        constexpr double kRounding = 1e-9; // a vertex in the place of another is that one
        double share = at - lower;
        share = share < kRounding ? 0 : share > 1 - kRounding ? 1 : share;
        places.push_back({lower, share});
    }
    return places;
}

using Layer = std::vector<double>;

/// Along x, then along y.
Layer resampled_layer(const Layer& from, std::uint32_t width, const std::vector<Between>& x,
                      const std::vector<Between>& y) {
    const std::size_t height = from.size() / width;
    Layer rows(x.size() * height), out(x.size() * y.size());
    for (std::size_t j = 0; j < height; ++j)
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double* row = &from[j * width + x[i].lower];
            rows[j * x.size() + i] = mix(row[0], row[1], x[i].share);
        }
    for (std::size_t j = 0; j < y.size(); ++j)
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double* column = &rows[y[j].lower * x.size() + i];
            out[j * x.size() + i] = mix(column[0], column[x.size()], y[j].share);
        }
    return out;
}

/// Puts pieces of stored values together to layers.
class Layers {
  public:
    using Take = std::function<void(std::uint32_t z, const Layer&)>;

    Layers(const SeriesInfo& info, Take take)
        : type_(info.type), take_(std::move(take)),
          layer_(std::size_t{info.grid.vertices[0]} * info.grid.vertices[1]) {}

    void add(std::span<const std::byte> piece) {
        visit_value_type(type_, [&]<class T>(std::type_identity<T>) {
            for (std::size_t i = 0; i + sizeof(T) <= piece.size(); i += sizeof(T)) {
                T value;
                std::memcpy(&value, &piece[i], sizeof(T));
                layer_[filled_++] = static_cast<double>(value);
                if (filled_ < layer_.size())
                    continue;
                take_(z_++, layer_);
                filled_ = 0;
            }
        });
    }

  private:
    ValueType type_;
    Take take_;
    Layer layer_;
    std::size_t filled_ = 0;
    std::uint32_t z_ = 0;
};

class ResampledSeries final : public VolumeSeries {
  public:
    ResampledSeries(std::unique_ptr<VolumeSeries> series,
                    const std::array<std::uint32_t, 3>& vertices)
        : series_(std::move(series)), info_(series_->info()) {
        const Grid& from = series_->info().grid;
        info_.grid.vertices = vertices;
        info_.grid.positions = {};
        for (int axis = 0; axis < 3; ++axis)
            info_.grid.spacing[axis] =
                from.distance(axis, from.cells()[static_cast<std::size_t>(axis)]) /
                (vertices[static_cast<std::size_t>(axis)] - 1);
        const bool wide = info_.type == ValueType::f64 || info_.type == ValueType::i32;
        info_.type = wide ? ValueType::f64 : ValueType::f32;
        for (int axis = 0; axis < 3; ++axis)
            places_[static_cast<std::size_t>(axis)] = between(info_.grid, from, axis);
        std::erase_if(info_.notes, [](const std::string& note) {
            return note.find(" is not uniform: ") != std::string::npos;
        });
        info_.notes.push_back(note(misfit()));
    }

    const SeriesInfo& info() const override { return info_; }
    std::vector<std::filesystem::path> files() const override { return series_->files(); }
    std::uint64_t state(std::size_t step) const override { return series_->state(step); }

    void read(std::size_t step, std::span<std::byte> out) override {
        stream(step, [to = out.data()](std::span<const std::byte> piece) mutable {
            std::memcpy(to, piece.data(), piece.size());
            to += piece.size();
        });
    }

    void stream(std::size_t step, const TakePiece& take) override {
        visit_value_type(info_.type, [&]<class T>(std::type_identity<T>) {
            std::vector<T> values;
            each_layer(step, [&](const Layer& layer) {
                values.assign(layer.size(), T{});
                std::ranges::transform(layer, values.begin(),
                                       [](double value) { return static_cast<T>(value); });
                take(std::as_bytes(std::span(values)));
            });
        });
    }

  private:
    /// Two layers of the old grid, spread along x and y, are kept.
    template <class Take>
    void each_layer(std::size_t step, const Take& take) {
        const Grid& from = series_->info().grid;
        Layer before;
        std::size_t next = 0;
        Layers layers(series_->info(), [&](std::uint32_t z, const Layer& layer) {
            Layer now = resampled_layer(layer, from.vertices[0], places_[0], places_[1]);
            Layer mixed(now.size());
            for (; z > 0 && next < places_[2].size() && places_[2][next].lower < z; ++next) {
                for (std::size_t i = 0; i < now.size(); ++i)
                    mixed[i] = mix(before[i], now[i], places_[2][next].share);
                take(mixed);
            }
            before = std::move(now);
        });
        series_->stream(step, [&](std::span<const std::byte> piece) { layers.add(piece); });
    }

    /// How far the new grid, interpolated back to the old vertices, is off in the first step.
    Misfit misfit() {
        const Grid& from = series_->info().grid;
        std::array<std::vector<Between>, 3> back;
        for (int axis = 0; axis < 3; ++axis)
            back[static_cast<std::size_t>(axis)] = between(from, info_.grid, axis);
        // Only every so manieth row is compared of what would not fit into memory.
        constexpr std::uint64_t kMostValues = 1 << 26;
        const std::uint64_t all =
            std::uint64_t{from.vertices[0]} * from.vertices[1] * info_.grid.vertices[2];
        const std::size_t stride = static_cast<std::size_t>(all / kMostValues + 1);
        std::vector<Between> rows;
        for (std::size_t j = 0; j < back[1].size(); j += stride)
            rows.push_back(back[1][j]);
        std::vector<Layer> there; // the new grid's layers at the old vertices of their planes
        each_layer(0, [&](const Layer& layer) {
            there.push_back(resampled_layer(layer, info_.grid.vertices[0], back[0], rows));
        });
        Misfit misfit;
        const std::size_t width = from.vertices[0];
        Layers layers(series_->info(), [&](std::uint32_t z, const Layer& layer) {
            const auto [lower, share] = back[2][z];
            for (std::size_t i = 0; i < rows.size() * width; ++i)
                misfit.add(layer[i / width * stride * width + i % width],
                           mix(there[lower][i], there[lower + 1][i], share));
        });
        series_->stream(0, [&](std::span<const std::byte> piece) { layers.add(piece); });
        return misfit;
    }

    std::string note(const Misfit& misfit) const {
        return fmt::format("resampled from {} vertices; at these, in the first step, the new grid "
                           "is {}",
                           fmt::join(series_->info().grid.vertices, " x "), misfit.text());
    }

    std::unique_ptr<VolumeSeries> series_;
    SeriesInfo info_;
    /// Places of the new vertices between the old ones.
    std::array<std::vector<Between>, 3> places_;
};

/// Vertices along each axis: so many that they are as close as the closest two of the old grid.
std::array<std::uint32_t, 3> vertices_by_gaps(const Grid& grid) {
    constexpr double kMostVertices = 1 << 30, kRounding = 1e-6;
    std::array<std::uint32_t, 3> vertices = grid.vertices;
    double all = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        double least = HUGE_VAL;
        for (std::uint32_t i = 1; i < grid.vertices[a]; ++i)
            least = std::min(least, grid.distance(axis, i) - grid.distance(axis, i - 1));
        const double whole = grid.distance(axis, grid.cells()[a]);
        const double count = std::ceil(whole / least - kRounding) + 1;
        all *= count;
        if (!(all <= kMostVertices))
            throw Error("the least distance along axis {} asks for {:.0f} vertices, expected "
                        "fewer; --resample NX NY NZ says how many",
                        "xyz"[axis], count);
        vertices[a] = std::max(static_cast<std::uint32_t>(count), 2u);
    }
    return vertices;
}

} // namespace

std::unique_ptr<VolumeSeries> resampled(std::unique_ptr<VolumeSeries> series,
                                        const std::array<std::uint32_t, 3>& vertices) {
    const Grid& grid = series->info().grid;
    const bool by_gaps = vertices == kBySmallestCell;
    if (!grid.rectilinear() && (by_gaps || grid.vertices == vertices))
        return series;
    return std::make_unique<ResampledSeries>(std::move(series),
                                             by_gaps ? vertices_by_gaps(grid) : vertices);
}

} // namespace isochron::index
