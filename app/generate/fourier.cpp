// Discrete Fourier transforms through FFTW.
#include "app/generate/fourier.h"

#include <fftw3.h>

#include <cassert>

namespace isochron::app {

namespace {

fftw_complex* as_fftw(Spectrum& spectrum) {
    return reinterpret_cast<fftw_complex*>(spectrum.data()); // same layout, says FFTW's manual
}

} // namespace

struct Fourier::Plans {
    fftw_plan forward;
    fftw_plan backward;
};

Fourier::Fourier(std::size_t n) : n_(n), plans_(std::make_unique<Plans>()) {
    assert(n >= 2);
    Field field(field_size());
    Spectrum spectrum(spectrum_size());
    const int points = static_cast<int>(n);
    // Measured plans would differ from run to run, and so would the last bits of the results.
    const unsigned flags = FFTW_ESTIMATE;
    plans_->forward = fftw_plan_dft_r2c_3d(points, points, points, field.data(), as_fftw(spectrum),
                                           flags | FFTW_PRESERVE_INPUT);
    plans_->backward = fftw_plan_dft_c2r_3d(points, points, points, as_fftw(spectrum), field.data(),
                                            flags | FFTW_DESTROY_INPUT);
}

Fourier::~Fourier() {
    fftw_destroy_plan(plans_->forward);
    fftw_destroy_plan(plans_->backward);
}

Spectrum Fourier::spectrum_of(const Field& field) const {
    assert(field.size() == field_size());
    Spectrum spectrum(spectrum_size());
    // FFTW_PRESERVE_INPUT: the field is only read.
    fftw_execute_dft_r2c(plans_->forward, const_cast<double*>(field.data()), as_fftw(spectrum));
    const double scale = 1.0 / static_cast<double>(field_size());
    for (std::complex<double>& coefficient : spectrum)
        coefficient *= scale;
    return spectrum;
}

Field Fourier::field_of(Spectrum spectrum) const {
    assert(spectrum.size() == spectrum_size());
    Field field(field_size());
    fftw_execute_dft_c2r(plans_->backward, as_fftw(spectrum), field.data());
    return field;
}

} // namespace isochron::app
