// Series made in memory, and the answer to every query on them by brute force.
#include "tests/support/test_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace isochron::index {

TestField::TestField(std::array<std::uint32_t, 3> vertices, std::size_t steps, ValueType type,
                     const Function& function, Scaling scaling)
    : type_(type), scaling_(scaling), steps_(steps) {
    grid_.vertices = vertices;
    words_per_step_ = (grid_.vertex_count() * size_of(type) + 7) / 8;
    storage_.resize(words_per_step_ * steps);
    visit_value_type(type, [&]<class T>(std::type_identity<T>) {
        for (std::size_t t = 0; t < steps; ++t) {
            T* out = &at<T>(t, 0);
            for (std::uint32_t z = 0; z < vertices[2]; ++z)
                for (std::uint32_t y = 0; y < vertices[1]; ++y)
                    for (std::uint32_t x = 0; x < vertices[0]; ++x) {
                        double value = function(x, y, z, static_cast<double>(t));
                        if constexpr (std::is_integral_v<T>)
                            value = std::clamp(std::round(value),
                                               double{std::numeric_limits<T>::lowest()},
                                               double{std::numeric_limits<T>::max()});
                        *out++ = static_cast<T>(value);
                    }
        }
    });
}

StepValues TestField::view() const {
    StepValues values;
    values.grid = grid_;
    values.type = type_;
    values.scaling = scaling_;
    values.steps = steps_;
    values.first = reinterpret_cast<const std::byte*>(storage_.data());
    values.stride = words_per_step_ * 8;
    return values;
}

double moving_sphere(double x, double y, double z, double t) {
    const double dx = x - 22 - 0.25 * t * 0.8;
    const double dy = y - 19 - 0.25 * t * 0.36;
    const double dz = z - 22 - 0.25 * t * 0.48;
    return 255 * std::exp(-(dx * dx + dy * dy + dz * dz) / 242);
}

TestField::Function turbulence(std::mt19937& random, int modes) {
    struct Mode {
        double kx, ky, kz, frequency, phase;
    };
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    std::vector<Mode> all(static_cast<std::size_t>(modes));
    for (Mode& mode : all)
        mode = {0.4 * normal(random), 0.4 * normal(random), 0.4 * normal(random),
                0.2 * normal(random), angle(random)};
    return [all](double x, double y, double z, double t) {
        double sum = 0;
        for (const Mode& mode : all)
            sum +=
                std::sin(mode.kx * x + mode.ky * y + mode.kz * z + mode.frequency * t + mode.phase);
        return sum / static_cast<double>(all.size());
    };
}

TestField::Function white_noise(std::mt19937& random) {
    return [&random](double, double, double, double) {
        return std::uniform_real_distribution<double>(-1, 1)(random);
    };
}

TestField::Function scaled(const TestField::Function& function, double factor, double offset) {
    return [=](double x, double y, double z, double t) {
        return factor * function(x, y, z, t) + offset;
    };
}

std::vector<double> ties(const StepValues& values, std::size_t most) {
    std::vector<double> distinct = sorted_values(values);
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    std::vector<double> isovalues{-1e300, 0, 1e300};
    const std::size_t stride = distinct.size() / most + 1;
    for (std::size_t i = 0; i < distinct.size(); i += stride)
        if (std::isfinite(distinct[i]))
            isovalues.insert(isovalues.end(), {std::nextafter(distinct[i], -kInfinity), distinct[i],
                                               std::nextafter(distinct[i], kInfinity)});
    return isovalues;
}

double scaled_value(const StepValues& values, std::size_t step, std::size_t vertex) {
    return visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        return values.scaling(static_cast<double>(values.step<T>(step)[vertex]));
    });
}

BruteForce::BruteForce(const StepValues& values, std::size_t step) {
    const auto [nx, ny, nz] = values.grid.vertices;
    std::vector<double> vertices(values.grid.vertex_count());
    for (std::size_t vertex = 0; vertex < vertices.size(); ++vertex)
        vertices[vertex] = scaled_value(values, step, vertex);
    for (std::uint32_t z = 0; z + 1 < nz; ++z)
        for (std::uint32_t y = 0; y + 1 < ny; ++y)
            for (std::uint32_t x = 0; x + 1 < nx; ++x) {
                double low = std::numeric_limits<double>::infinity(), high = -low;
                bool nan = false;
                for (std::size_t dz : {0, 1})
                    for (std::size_t dy : {0, 1})
                        for (std::size_t dx : {0, 1}) {
                            const double value = vertices[x + dx + nx * (y + dy + ny * (z + dz))];
                            nan |= std::isnan(value);
                            low = std::min(low, value);
                            high = std::max(high, value);
                        }
                low_.push_back(nan ? 1 : low);
                high_.push_back(nan ? 0 : high);
            }
}

std::vector<CellId> BruteForce::active(double isovalue) const {
    std::vector<CellId> found;
    for (std::size_t id = 0; id < low_.size(); ++id)
        if (low_[id] <= high_[id] && low_[id] < isovalue && isovalue <= high_[id])
            found.push_back(static_cast<CellId>(id));
    return found;
}

std::vector<double> sorted_values(const StepValues& values) {
    std::vector<double> all;
    for (std::size_t t = 0; t < values.steps; ++t)
        for (std::size_t vertex = 0; vertex < values.grid.vertex_count(); ++vertex)
            if (const double value = scaled_value(values, t, vertex); !std::isnan(value))
                all.push_back(value);
    std::sort(all.begin(), all.end());
    return all;
}

std::vector<double> quantiles(const std::vector<double>& sorted, int n) {
    std::vector<double> found;
    for (int k = 1; k <= n; ++k)
        found.push_back(
            sorted[sorted.size() * static_cast<std::size_t>(k) / static_cast<std::size_t>(n + 1)]);
    return found;
}

} // namespace isochron::index
