// Values along a ruler, against the field that they come from.
#include "index/extraction/profile.h"

#include "index/extraction/value_in_index.h"
#include "tests/support/indexed.h"
#include "tests/support/test_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace isochron::index {
namespace {

class ProfileTest : public testing::Test {
  protected:
    /// 70 vertices make several chunks along each axis.
    ProfileTest() {
        const TestField field(
            {70, 70, 70}, 2, ValueType::f64,
            [](double x, double y, double z, double t) { return 2 * x - 3 * y + 5 * z + 100 * t; });
        file_ = indexed(folder_, field.view());
    }
    test_support::TestFolder folder_;
    std::shared_ptr<const IndexFile> file_;
};

TEST_F(ProfileTest, IsTheFieldAlongALineAndGoesOnAroundACorner) {
    const glm::dvec3 a(3, 60, 1), b(66, 5, 40), c(66, 5, 68);
    const Profile profile = profile_of({file_, Instant(1), {a, b, c}});
    ASSERT_EQ(profile.values.size(), kProfileSamples);
    EXPECT_EQ(profile.distances.front(), 0);
    EXPECT_NEAR(profile.distances.back(), glm::distance(a, b) + glm::distance(b, c), 1e-9);
    EXPECT_EQ(profile.at.back(), c);
    for (std::size_t i = 0; i < profile.values.size(); ++i) {
        const glm::dvec3& at = profile.at[i];
        const double way = profile.distances[i], to_corner = glm::distance(a, b);
        const glm::dvec3 expected = way <= to_corner
                                        ? glm::mix(a, b, way / to_corner)
                                        : glm::mix(b, c, (way - to_corner) / glm::distance(b, c));
        EXPECT_LT(glm::distance(at, expected), 1e-9) << i;
        EXPECT_NEAR(profile.values[i], 2 * at.x - 3 * at.y + 5 * at.z + 100, 1e-9) << i;
    }
}

TEST_F(ProfileTest, HasNoValuesOutsideTheData) {
    const Profile profile = profile_of({file_, Instant(0), {{-10, 5, 5}, {79, 5, 5}}});
    for (std::size_t i = 0; i < profile.values.size(); ++i) {
        const bool inside = profile.at[i].x >= 0 && profile.at[i].x <= 69;
        EXPECT_EQ(std::isfinite(profile.values[i]), inside) << profile.at[i].x;
    }
}

TEST_F(ProfileTest, OfOnePlaceIsEmptyAndATableHasARowForEachSample) {
    EXPECT_TRUE(profile_of({file_, Instant(0), {{1, 1, 1}, {1, 1, 1}}}).values.empty());
    std::istringstream table(csv_of(profile_of({file_, Instant(0), {{68, 0, 0}, {70, 0, 0}}})));
    std::string line, last;
    std::getline(table, line);
    EXPECT_EQ(line, "distance,x,y,z,value");
    std::getline(table, line);
    EXPECT_EQ(line, "0,68,0,0,136");
    std::size_t rows = 1;
    while (std::getline(table, line)) {
        ++rows;
        last = line;
    }
    EXPECT_EQ(rows, kProfileSamples);
    EXPECT_EQ(last, "2,70,0,0,") << "a value that is not there is nothing";
}

} // namespace
} // namespace isochron::index
