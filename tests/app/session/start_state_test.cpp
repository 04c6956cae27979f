// The surfaces at the first look: there is something to see in the step that is shown.
#include "app/session/start_state.h"
#include "index/indexing/index_build.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>

#include <random>

namespace isochron::app {
namespace {

using index::BruteForce;
using index::TestField;
using index::ValueType;

class FirstSurfaces : public testing::Test {
  protected:
    /// Isovalues of the first look at a step.
    std::vector<double> isovalues(const TestField& field, std::uint32_t step,
                                  const Config& config = {}) {
        index::MemorySeries series(field.view());
        build_index(series, folder_.path() / "series.isochron", {});
        const auto file = index::IndexFile::open(folder_.path() / "series.isochron");
        of_all_ = quantile(file->stats(), kFirstQuantile);
        std::vector<double> isovalues;
        for (const interaction::Isosurface& surface : first_surfaces(config, file, step))
            isovalues.push_back(surface.isovalue);
        return isovalues;
    }
    static std::size_t cells(const TestField& field, std::size_t step, double isovalue) {
        return BruteForce(field.view(), step).active(isovalue).size();
    }

    test_support::TestFolder folder_;
    double of_all_ = 0; ///< the quantile of the values of all steps
};

TEST_F(FirstSurfaces, OfASeriesWhoseValuesDriftAreInTheStepThatIsShown) {
    std::mt19937 random(test_seed());
    const TestField::Function shape = index::turbulence(random);
    for (const ValueType type : {ValueType::u8, ValueType::i16, ValueType::f32, ValueType::f64})
        for (const double drift : {40.0, -40.0}) {
            const TestField field({40, 33, 21}, 5, type,
                                  [&](double x, double y, double z, double t) {
                                      return 100 + 10 * shape(x, y, z, t) + drift * (t - 2);
                                  });
            for (const std::uint32_t step : {0u, 2u, 4u}) {
                const double isovalue = isovalues(field, step).at(0);
                EXPECT_GT(cells(field, step, isovalue), 50u)
                    << index::name_of(type) << " drift " << drift << " step " << step;
            }
        }
}

TEST_F(FirstSurfaces, AreThoseOfAllStepsWhereTheStepHasThem) {
    std::mt19937 random(test_seed());
    const TestField smooth({40, 33, 21}, 4, ValueType::f32, index::turbulence(random));
    EXPECT_EQ(isovalues(smooth, 0).at(0), of_all_);
    const TestField noise({40, 33, 21}, 4, ValueType::f32, index::white_noise(random));
    EXPECT_EQ(isovalues(noise, 0).at(0), of_all_) << "coarser levels do not have this value";
}

TEST_F(FirstSurfaces, OfAStepWithoutAnySurfaceAreThoseOfAllSteps) {
    const TestField grows({20, 20, 20}, 4, ValueType::f32,
                          [](double x, double, double, double t) { return x * t; });
    EXPECT_EQ(isovalues(grows, 0).at(0), of_all_);
}

TEST_F(FirstSurfaces, ThatTheConfigurationGivesAreKept) {
    const TestField field({20, 20, 20}, 3, ValueType::f32,
                          [](double x, double, double, double t) { return x + 100 * t; });
    Config config;
    config.surfaces = {{.isovalue = 5000.0, .quantile = 0.5, .color = {}, .opacity = 1.0f},
                       {.isovalue = {}, .quantile = 0.5, .color = {}, .opacity = 1.0f}};
    const std::vector<double> got = isovalues(field, 0, config);
    EXPECT_EQ(got.at(0), 5000.0);
    EXPECT_NEAR(got.at(1), 9.5, 1.0) << "the median of the first step";
}

} // namespace
} // namespace isochron::app
