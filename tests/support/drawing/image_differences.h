// The interface between tests and the module that compares pictures.
#pragma once

#include "render/gl/image.h"

namespace isochron::test_support {

struct ImageDifferences {
    int maximum = 0;   ///< largest difference of any channel of any pixel, 0 to 255
    double mean = 0;   ///< over all channels except alpha
    double strays = 0; ///< share of these channels that differ by more than asked for
};

/// Compares red, green and blue of two pictures of the same size.
using Differences = ImageDifferences(const render::Image& a, const render::Image& b, int seen);
constexpr const char* kDifferences = "isochron_image_differences";

} // namespace isochron::test_support
