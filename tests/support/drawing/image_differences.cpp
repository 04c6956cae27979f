// Compares pictures by OpenImageIO.
#include "tests/support/drawing/image_differences.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cmath>

namespace isochron::test_support {
namespace {

/// The picture's own bytes as one of OpenImageIO's.
OIIO::ImageBuf viewed(const render::Image& image) {
    return OIIO::ImageBuf(OIIO::ImageSpec(image.width, image.height, 4, OIIO::TypeDesc::UINT8),
                          const_cast<std::uint8_t*>(image.rgba.data())); // nothing writes to it
}

} // namespace

extern "C" __attribute__((visibility("default"))) ImageDifferences
isochron_image_differences(const render::Image& a, const render::Image& b, int seen) {
    const OIIO::ImageBuf first = viewed(a), second = viewed(b);
    const float threshold = (static_cast<float>(seen) + 0.5f) / 255.0f;
    ImageDifferences all;
    // It counts pixels: one channel at a time, it counts values.
    for (int channel = 0; channel < 3; ++channel) {
        OIIO::ROI roi(0, a.width, 0, a.height, 0, 1, channel, channel + 1);
        const OIIO::ImageBufAlgo::CompareResults one =
            OIIO::ImageBufAlgo::compare(first, second, threshold, threshold, roi);
        all.maximum = std::max(all.maximum, static_cast<int>(std::lround(255 * one.maxerror)));
        all.mean += 255 * one.meanerror / 3;
        all.strays += static_cast<double>(one.nfail) / (3.0 * a.width * a.height);
    }
    return all;
}

} // namespace isochron::test_support
