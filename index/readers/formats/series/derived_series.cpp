// Gradients by finite differences.
#include "index/readers/formats/series/derived_series.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isochron::index {
namespace {

/// Weights of a vertex and its neighbors along an axis in the derivative there.
struct Weights {
    double lower = 0, self = 0, upper = 0;
};

std::vector<Weights> derivative_weights(const Grid& grid, int axis) {
    const std::uint32_t count = grid.vertices[static_cast<std::size_t>(axis)];
    std::vector<Weights> weights(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double at = grid.distance(axis, i);
        const double below = i > 0 ? at - grid.distance(axis, i - 1) : 0;
        const double above = i + 1 < count ? grid.distance(axis, i + 1) - at : 0;
        if (i == 0)
            weights[i] = {0, -1 / above, 1 / above};
        else if (i + 1 == count)
            weights[i] = {-1 / below, 1 / below, 0};
        else
            weights[i] = {-above / (below * (below + above)), (above - below) / (below * above),
                          below / (above * (below + above))};
    }
    return weights;
}

std::string per_length(const std::string& value, const std::string& length) {
    if (length.empty())
        return value;
    if (value.empty())
        return "1/" + length;
    const bool several = value.find_first_of(" /") != value.npos;
    return several ? fmt::format("({})/{}", value, length) : fmt::format("{}/{}", value, length);
}

/// Derivatives of speeds are rates where the speed has the grid's unit of length: `m/s` and m give
/// `1/s`.
std::string unit_of_derived(Derived derived, const SeriesInfo& input) {
    const std::string &value = input.value_unit, &length = input.length_unit;
    if (derived == Derived::magnitude)
        return value;
    if (derived == Derived::gradient)
        return per_length(value, length);
    const bool rate = !length.empty() && value.starts_with(length + "/");
    const bool power = !length.empty() && value == length + " s-1";
    const std::string time = rate ? value.substr(length.size() + 1) : power ? "s" : "";
    if (derived == Derived::vorticity)
        return time.empty() ? per_length(value, length) : "1/" + time;
    if (!time.empty())
        return "1/" + time + "2";
    const std::string once = per_length(value, length);
    return once.empty() ? once : fmt::format("({})^2", once);
}

class DerivedSeries final : public VolumeSeries {
  public:
    DerivedSeries(std::vector<std::unique_ptr<VolumeSeries>> inputs, Derived derived,
                  const std::string& name, const std::optional<std::string>& unit)
        : inputs_(std::move(inputs)), derived_(derived), info_(inputs_.front()->info()) {
        constexpr std::array kNames{"gradient", "vorticity", "q-criterion", "magnitude"};
        constexpr std::array kWhat{"length of the gradient", "length of the curl", "Q criterion",
                                   "length of the vector"};
        const auto number = static_cast<std::size_t>(derived);
        if (inputs_.size() > 1 && info_.array.ends_with(".0"))
            info_.array.resize(info_.array.size() - 2);
        name_ = name.empty() ? info_.array : name;
        info_.array = fmt::format("{}.{}", name_, kNames[number]);
        info_.value_unit = unit.value_or(unit_of_derived(derived, inputs_.front()->info()));
        const bool wide = std::ranges::any_of(inputs_, [](const auto& input) {
            const ValueType type = input->info().type;
            return type == ValueType::f64 || type == ValueType::i32;
        });
        for (const auto& input : inputs_)
            for (const std::string& note : input->info().notes)
                if (std::ranges::find(info_.notes, note) == info_.notes.end())
                    info_.notes.push_back(note);
        info_.type = wide ? ValueType::f64 : ValueType::f32;
        info_.scaling = {};
        info_.notes.push_back(
            fmt::format("values are computed: {}{}{}", kWhat[number],
                        derived == Derived::magnitude ? "" : ", by differences of neighbors",
                        info_.value_unit.empty() ? "" : ", in " + info_.value_unit));
        for (int axis = 0; axis < 3; ++axis)
            weights_[static_cast<std::size_t>(axis)] = derivative_weights(info_.grid, axis);
        to_physical_ = glm::inverse(glm::transpose(info_.grid.direction));
    }

    const SeriesInfo& info() const override { return info_; }
    std::vector<std::filesystem::path> files() const override { return inputs_.front()->files(); }
    std::uint64_t state(std::size_t step) const override { return inputs_.front()->state(step); }

    std::unique_ptr<VolumeSeries> another() const override {
        std::vector<std::unique_ptr<VolumeSeries>> others;
        for (const auto& input : inputs_) {
            others.push_back(input->another());
            if (!others.back())
                return nullptr;
        }
        return std::make_unique<DerivedSeries>(std::move(others), derived_, name_,
                                               info_.value_unit);
    }

    void read(std::size_t step, std::span<std::byte> out) override {
        std::size_t at = 0;
        stream(step, [&](std::span<const std::byte> piece) {
            std::ranges::copy(piece, out.begin() + static_cast<std::ptrdiff_t>(at));
            at += piece.size();
        });
    }

    void stream(std::size_t step, const TakePiece& take) override {
        if (info_.type == ValueType::f32)
            stream_as<float>(step, take);
        else
            stream_as<double>(step, take);
    }

  private:
    template <class T>
    std::vector<T> values_of(VolumeSeries& input, std::size_t step) const {
        std::vector<T> values;
        values.reserve(info_.grid.vertex_count());
        const SeriesInfo& from = input.info();
        input.stream(step, [&](std::span<const std::byte> piece) {
            visit_value_type(from.type, [&]<class From>(std::type_identity<From>) {
                const std::span stored(reinterpret_cast<const From*>(piece.data()),
                                       piece.size() / sizeof(From));
                for (const From value : stored)
                    values.push_back(static_cast<T>(from.scaling(static_cast<double>(value))));
            });
        });
        return values;
    }

    template <class T>
    void stream_as(std::size_t step, const TakePiece& take) {
        std::vector<std::vector<T>> values;
        for (const auto& input : inputs_)
            values.push_back(values_of<T>(*input, step));
        const auto& n = info_.grid.vertices;
        std::vector<T> layer(std::size_t{n[0]} * n[1]);
        for (std::uint32_t z = 0; z < n[2]; ++z) {
            std::size_t at = 0;
            for (std::uint32_t y = 0; y < n[1]; ++y)
                for (std::uint32_t x = 0; x < n[0]; ++x)
                    layer[at++] = static_cast<T>(derived_at(values, {x, y, z}));
            take(std::as_bytes(std::span(layer)));
        }
    }

    template <class T>
    glm::dvec3 gradient_at(const std::vector<T>& values,
                           const std::array<std::uint32_t, 3>& at) const {
        const auto& n = info_.grid.vertices;
        const std::array<std::size_t, 3> stride{1, n[0], std::size_t{n[0]} * n[1]};
        const std::size_t self = at[0] + at[1] * stride[1] + at[2] * stride[2];
        glm::dvec3 along(0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Weights& w = weights_[axis][at[axis]];
            double sum = 0;
            if (w.self != 0)
                sum += w.self * static_cast<double>(values[self]);
            if (at[axis] > 0)
                sum += w.lower * static_cast<double>(values[self - stride[axis]]);
            if (at[axis] + 1 < n[axis])
                sum += w.upper * static_cast<double>(values[self + stride[axis]]);
            along[static_cast<int>(axis)] = sum;
        }
        return to_physical_ * along;
    }

    template <class T>
    double length_at(const std::vector<std::vector<T>>& values,
                     const std::array<std::uint32_t, 3>& at) const {
        const auto& n = info_.grid.vertices;
        double sum = 0;
        for (const std::vector<T>& component : values) {
            const double value = component[at[0] + std::size_t{n[0]} * (at[1] + n[1] * at[2])];
            sum += value * value;
        }
        return std::sqrt(sum);
    }

    template <class T>
    double derived_at(const std::vector<std::vector<T>>& values,
                      const std::array<std::uint32_t, 3>& at) const {
        if (derived_ == Derived::magnitude)
            return length_at(values, at);
        const glm::dvec3 u = gradient_at(values[0], at);
        if (derived_ == Derived::gradient)
            return glm::length(u);
        const glm::dvec3 v = gradient_at(values[1], at), w = gradient_at(values[2], at);
        if (derived_ == Derived::vorticity)
            return glm::length(glm::dvec3(w.y - v.z, u.z - w.x, v.x - u.y));
        return -0.5 * (u.x * u.x + v.y * v.y + w.z * w.z) - (u.y * v.x + u.z * w.x + v.z * w.y);
    }

    std::vector<std::unique_ptr<VolumeSeries>> inputs_;
    std::string name_; ///< name of what it is computed from
    Derived derived_;
    SeriesInfo info_;
    std::array<std::vector<Weights>, 3> weights_; ///< weights of every vertex along each axis
    glm::dmat3 to_physical_{1.0}; ///< turns derivatives along the index axes to physical space
};

} // namespace

std::optional<Derived> derived_from_name(const std::optional<std::string>& component) {
    if (component == "gradient")
        return Derived::gradient;
    if (component == "vorticity")
        return Derived::vorticity;
    return component == "q-criterion" ? std::optional(Derived::q_criterion) : std::nullopt;
}

std::vector<std::optional<std::string>> components_for(Derived derived) {
    if (derived == Derived::gradient)
        return {std::nullopt};
    return {"0", "1", "2"};
}

std::unique_ptr<VolumeSeries> derived_series(std::vector<std::unique_ptr<VolumeSeries>> inputs,
                                             Derived derived, const std::string& name,
                                             const std::optional<std::string>& unit) {
    return std::make_unique<DerivedSeries>(std::move(inputs), derived, name, unit);
}

} // namespace isochron::index
