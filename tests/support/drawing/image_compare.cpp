// Computes differences of pictures, as numbers and as a picture.
#include "tests/support/drawing/image_compare.h"

#include "index/system/module.h"
#include "stereo/image_file.h"
#include "tests/support/drawing/image_differences.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace isochron::test_support {
namespace {

namespace fs = std::filesystem;
using render::Image;

fs::path written(const Image& image, const std::string& name) {
    const fs::path folder = fs::path(test_support::binary_root()) / "failed_images";
    fs::create_directories(folder);
    fs::path path = folder / (name + ".png");
    stereo::write_image(image, path);
    return path;
}

Image difference_of(const Image& a, const Image& b) {
    Image difference = a;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        difference.rgba[i] = static_cast<std::uint8_t>(
            i % 4 == 3 ? 255 : std::min(255, 8 * std::abs(a.rgba[i] - b.rgba[i])));
    return difference;
}

Image side_by_side(const std::vector<Image>& images) {
    Image all;
    for (const Image& image : images) {
        all.width += image.width;
        all.height = std::max(all.height, image.height);
    }
    all.rgba.assign(std::size_t{4} * all.width * all.height, 255);
    int left = 0;
    for (const Image& image : images) {
        for (int y = 0; y < image.height; ++y)
            std::copy_n(image.at(0, y), std::size_t{4} * image.width,
                        all.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * all.width + left));
        left += image.width;
    }
    return all;
}

} // namespace

testing::AssertionResult images_match(const Image& actual, const Image& expected,
                                      ImageTolerance tolerance, const std::string& name) {
    if (actual.width != expected.width || actual.height != expected.height)
        return testing::AssertionFailure()
               << name << ": " << actual.width << "x" << actual.height << " pixels, expected "
               << expected.width << "x" << expected.height << "; see "
               << written(side_by_side({actual, expected}), name);
    constexpr int kSeen = 8;
    static const auto differences = reinterpret_cast<Differences*>(
        index::module_symbol("isochron_image_compare", kDifferences));
    const ImageDifferences found = differences(actual, expected, kSeen);
    if (found.maximum <= tolerance.maximum && found.mean <= tolerance.mean &&
        found.strays <= tolerance.strays)
        return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << name << ": differs by " << found.maximum << " at most and " << found.mean
           << " on average, " << 100 * found.strays << " % of it by more than " << kSeen
           << ", allowed " << tolerance.maximum << ", " << tolerance.mean << " and "
           << 100 * tolerance.strays << " %; see "
           << written(side_by_side({actual, expected, difference_of(actual, expected)}), name);
}

testing::AssertionResult matches_golden(const Image& actual, const std::string& name,
                                        ImageTolerance tolerance) {
    const fs::path golden = fs::path(test_support::test_data()) / "golden" / (name + ".png");
    if (!fs::exists(golden))
        return testing::AssertionFailure()
               << golden << " does not exist; the actual picture is " << written(actual, name);
    return images_match(actual, stereo::read_image(golden), tolerance, name);
}

} // namespace isochron::test_support
