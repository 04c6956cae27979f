// Discrete Fourier transforms of real fields in a periodic cube, by FFTW.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace isochron::app {

/// Allocates memory aligned for wide vector instructions, which halves the time of a transform.
template <class T>
struct AlignedAllocator {
    using value_type = T;
    static constexpr std::align_val_t kAlignment{64};

    AlignedAllocator() = default;
    template <class U>
    AlignedAllocator(const AlignedAllocator<U>&) {}
    T* allocate(std::size_t count) {
        return static_cast<T*>(::operator new(count * sizeof(T), kAlignment));
    }
    void deallocate(T* place, std::size_t) { ::operator delete(place, kAlignment); }
    bool operator==(const AlignedAllocator&) const = default;
};

/// A real field at the n^3 points of the cube, [z][y][x], x fastest.
using Field = std::vector<double, AlignedAllocator<double>>;

/// Its Fourier coefficients, [z][y][x] with x only in [0, n/2] (the rest are their conjugates).
using Spectrum = std::vector<std::complex<double>, AlignedAllocator<std::complex<double>>>;

/// Calls `visit(place, k, weight)` for every coefficient of a Spectrum: its index, its wave vector
/// (k[0] along x), and its weight in a sum over all wave vectors: 2 if it stands for its conjugate
/// as well, else 1.
template <class Visit>
void for_each_wave_vector(std::size_t n, Visit visit) {
    const auto wave_number = [n](std::size_t i) {
        return static_cast<double>(i) - (i <= n / 2 ? 0.0 : static_cast<double>(n));
    };
    std::size_t place = 0;
    for (std::size_t z = 0; z < n; ++z)
        for (std::size_t y = 0; y < n; ++y)
            for (std::size_t x = 0; x <= n / 2; ++x, ++place)
                visit(place, std::array{wave_number(x), wave_number(y), wave_number(z)},
                      x == 0 || 2 * x == n ? 1.0 : 2.0);
}

/// Transforms fields to spectra and back; several threads may use it at once. On one machine the
/// same input always gives the same bits.
class Fourier {
  public:
    /// @param n points along each axis, at least 2
    explicit Fourier(std::size_t n);
    ~Fourier();

    std::size_t points() const { return n_; }
    std::size_t field_size() const { return n_ * n_ * n_; }
    std::size_t spectrum_size() const { return n_ * n_ * (n_ / 2 + 1); }

    /// The coefficients (divided by n^3) whose sum of coefficient * exp(i k x) is the field.
    Spectrum spectrum_of(const Field& field) const;

    /// @param spectrum passed by value, as the transform overwrites it
    Field field_of(Spectrum spectrum) const;

  private:
    struct Plans;

    std::size_t n_;
    std::unique_ptr<Plans> plans_;
};

} // namespace isochron::app
