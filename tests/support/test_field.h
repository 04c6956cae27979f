// Series made in memory, and the answer to every query on them by brute force.
#pragma once

#include "index/volume/step_values.h"

#include "tests/support/test_seed.h"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace isochron::index {

inline constexpr std::array kAllTypes{ValueType::i8,  ValueType::u8,  ValueType::i16,
                                      ValueType::u16, ValueType::i32, ValueType::f32,
                                      ValueType::f64};
inline constexpr std::array kScalings{Scaling{}, Scaling{-1, 0}, Scaling{0.1, 1e6},
                                      Scaling{-1e-9, 1.0}, Scaling{1e30, -7}};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A series that owns its values.
class TestField {
  public:
    /// Value at vertex (x, y, z) of step t, converted to the type: rounded and clamped for
    /// integers.
    using Function = std::function<double(double x, double y, double z, double t)>;

    TestField(std::array<std::uint32_t, 3> vertices, std::size_t steps, ValueType type,
              const Function& function, Scaling scaling = {});

    StepValues view() const;

    /// A stored value, for tests that plant special ones.
    template <class T>
    T& at(std::size_t step, std::size_t vertex) {
        return reinterpret_cast<T*>(storage_.data() + step * words_per_step_)[vertex];
    }

  private:
    Grid grid_;
    ValueType type_;
    Scaling scaling_;
    std::size_t steps_, words_per_step_;
    std::vector<std::uint64_t> storage_;
};

/// The sphere of the paper: 255 exp(-d^2 / 242), its center (22, 19, 22) + 0.25 t (.8, .36, .48).
double moving_sphere(double x, double y, double z, double t);

/// A smooth random field: a sum of moving Fourier modes, within [-1, 1].
TestField::Function turbulence(std::mt19937& random, int modes = 12);

/// Uncorrelated values, within [-1, 1].
TestField::Function white_noise(std::mt19937& random);

TestField::Function scaled(const TestField::Function& function, double factor, double offset);

/// Extremes of every cell at one step, computed vertex by vertex in double after scaling.
class BruteForce {
  public:
    BruteForce(const StepValues& values, std::size_t step);
    std::vector<CellId> active(double isovalue) const;

  private:
    std::vector<double> low_, high_; ///< low > high where a vertex is NaN
};

/// Scaled values of all vertices and steps, sorted, without NaN.
std::vector<double> sorted_values(const StepValues& values);

/// The quantiles k / (n + 1), k = 1 to n.
std::vector<double> quantiles(const std::vector<double>& sorted, int n);

/// Isovalues that are equal or close to values: some of the values, at most about `most`, with
/// their neighbors, and isovalues beyond both ends.
std::vector<double> ties(const StepValues& values, std::size_t most = SIZE_MAX - 1);

/// Scaled value of a vertex.
double scaled_value(const StepValues& values, std::size_t step, std::size_t vertex);

} // namespace isochron::index
