// What materials and backgrounds come to.
#include "app/scene/look.h"

#include "app/config/config.h"
#include "app/scene/overlay_colors.h"
#include "render/gl/srgb.h"
#include "render/passes/color_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include <set>
#include <tuple>

namespace isochron::app {
namespace {

TEST(Look, SatinIsAsConfiguredAndEveryOtherMaterialIsOfItsOwn) {
    render::CellAppearance configured;
    configured.reflectance = 0.04f;
    configured.shininess = 40.0f;
    configured.ambient = 0.3f;
    std::set<std::tuple<float, float, float>> all;
    using enum interaction::Material;
    for (const auto material : {satin, matte, glossy, metal}) {
        render::CellAppearance appearance;
        set_look(appearance, configured, {.material = material, .occlusion = 0.25f});
        all.insert({appearance.reflectance, appearance.shininess, appearance.ambient});
        EXPECT_EQ(appearance.occlusion, 0.25f);
        if (material == satin)
            EXPECT_EQ(appearance.reflectance, configured.reflectance);
        if (material == matte)
            EXPECT_EQ(appearance.reflectance, 0);
        if (material == metal)
            EXPECT_LT(appearance.ambient, configured.ambient);
    }
    EXPECT_EQ(all.size(), 4u);
}

TEST(Look, ADarkBackgroundIsThePicturesOwn) {
    using enum interaction::Background;
    EXPECT_FALSE(background_of({.background = dark}));
    const auto one = background_of({.background = light}),
               two = background_of({.background = gradient});
    ASSERT_TRUE(one && two);
    EXPECT_EQ(one->low, one->high);
    EXPECT_NE(two->low, two->high);
}

TEST(Look, TheDarkEndOfEveryMapIsSeenOnTheBackgroundThatAWindowHas) {
    const auto luminance = [](const glm::vec3& linear) {
        return 0.2126f * linear.x + 0.7152f * linear.y + 0.0722f * linear.z;
    };
    const glm::vec3 dark = Config().rendering.background;
    const float of_dark = luminance(render::linear_from_srgb(dark)),
                of_lifted = luminance(render::linear_from_srgb(kLifted));
    int lifted = 0;
    for (std::size_t i = 0; i < render::kColorMapNames.size(); ++i) {
        const auto map = render::color_map(static_cast<render::ColorMap>(i));
        float darkest = 1;
        for (const glm::vec3& color : map)
            darkest = std::min(darkest, luminance(color));
        const bool lifts = wants_lifting(map, dark);
        const float behind = lifts ? of_lifted : of_dark;
        EXPECT_GE((std::max(darkest, behind) + 0.05f) / (std::min(darkest, behind) + 0.05f),
                  kDarkEndContrast)
            << render::kColorMapNames[i];
        lifted += lifts;
        EXPECT_FALSE(wants_lifting(map, glm::vec3(0.95f))) << "on paper all is seen";
    }
    EXPECT_EQ(lifted, 5) << "viridis, inferno, cividis, turbo and grayscale begin nearly black";
    EXPECT_FALSE(wants_lifting({}, dark));
}

} // namespace
} // namespace isochron::app
