// What materials and backgrounds come to.
#include "app/scene/look.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace isochron::app
