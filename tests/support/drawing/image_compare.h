// Compares pictures with a maximum and a mean tolerance; a failure writes pictures to look at.
//
//     EXPECT_TRUE(images_match(picture, expected, {.maximum = 8, .mean = 0.2}, "sphere_left"));
//     EXPECT_TRUE(matches_golden(picture, "sphere_left", {.maximum = 8, .mean = 0.2}));
#pragma once

#include "render/gl/image.h"

#include <gtest/gtest.h>

#include <string>

namespace isochron::test_support {

struct ImageTolerance {
    int maximum = 0; ///< largest difference of any channel of any pixel, 0 to 255
    double mean = 0; ///< mean difference over all channels except alpha
    /// Share of the channels that may differ by more than 8; 1: any.
    double strays = 1;
};

/// Compares red, green and blue. On failure writes actual, expected and difference (times 8, black
/// where equal), in this order from left to right, to `BUILD/failed_images/NAME.png`.
testing::AssertionResult images_match(const render::Image& actual, const render::Image& expected,
                                      ImageTolerance tolerance, const std::string& name);

/// Compares with `tests/data/golden/NAME.png`. If there is none, fails and writes the actual
/// picture, to be checked and copied there.
testing::AssertionResult matches_golden(const render::Image& actual, const std::string& name,
                                        ImageTolerance tolerance);

} // namespace isochron::test_support
