// Gaps of a series: distances of more than three times the median, and steps that are missing.
#include "index/volume/step_gaps.h"

#include <gmock/gmock.h>

#include <utility>

namespace isochron::index {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

SeriesInfo series(std::vector<double> times, std::vector<std::uint32_t> missing_after = {}) {
    SeriesInfo info;
    info.times = std::move(times);
    info.missing_after = std::move(missing_after);
    return info;
}

TEST(StepGaps, AreLongerThanThreeTimesTheMedian) {
    EXPECT_THAT(gaps_of(series({0, 1, 2, 3, 13, 14, 15})), ElementsAre(3));
    EXPECT_THAT(gaps_of(series({0, 1, 2, 5, 6})), IsEmpty()) << "exactly three times";
    EXPECT_THAT(gaps_of(series({0, 4})), IsEmpty()) << "one distance is usual";
    EXPECT_THAT(gaps_of(series({7})), IsEmpty());
}

TEST(StepGaps, AreWhereStepsAreMissingTooHoweverNearTheNextOneIs) {
    const SeriesInfo info = series({0, 1, 2, 12, 13, 14}, {0, 2, 4});
    EXPECT_THAT(gaps_of(info), ElementsAre(0, 2, 4));
    EXPECT_THAT(gaps_of(info, 5), ElementsAre(0, 2)) << "the next step is not known yet";
    EXPECT_THAT(gaps_of(info, 3), ElementsAre(0));
}

} // namespace
} // namespace isochron::index
