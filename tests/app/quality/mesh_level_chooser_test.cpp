// The finest mesh that fits is drawn, and the choice does not go to and fro.
#include "app/quality/mesh_level_chooser.h"

#include <gtest/gtest.h>

namespace isochron::app {
namespace {

constexpr std::array<std::size_t, index::kMeshLevels> kAllLevels{100'000, 30'000, 12'000, 5'000};
constexpr interaction::Seconds kLater{10};

/// Drawing all triangles takes so long; a frame may take 10 ms.
MeshesAtHand taking(double ms, interaction::Seconds now = kLater) {
    return {.triangles = kAllLevels,
            .quads = 0.1,
            .budget = Milliseconds(10),
            .expected =
                [ms](std::size_t triangles) {
                    return std::optional(Milliseconds(ms * static_cast<double>(triangles) /
                                                      static_cast<double>(kAllLevels[0])));
                },
            .now = now};
}

TEST(MeshLevelChooser, IsTheFinestThatFits) {
    EXPECT_EQ(MeshLevelChooser().choose(taking(5)), 0u);
    EXPECT_EQ(MeshLevelChooser().choose(taking(15)), 1u);
    EXPECT_EQ(MeshLevelChooser().choose(taking(40)), 2u);
    EXPECT_EQ(MeshLevelChooser().choose(taking(100)), 3u);
    EXPECT_EQ(MeshLevelChooser().choose(taking(1000)), std::nullopt);
}

TEST(MeshLevelChooser, IsNoneWhereNothingIsKnownOrThereIsNone) {
    MeshesAtHand meshes = taking(1);
    meshes.expected = [](std::size_t) { return std::optional<Milliseconds>(); };
    EXPECT_EQ(MeshLevelChooser().choose(meshes), std::nullopt);
    meshes = taking(1);
    meshes.triangles = {};
    EXPECT_EQ(MeshLevelChooser().choose(meshes), std::nullopt);
    meshes.triangles = {0, 0, 12'000, 0};
    EXPECT_EQ(MeshLevelChooser().choose(meshes), 2u) << "of those that are there";
}

TEST(MeshLevelChooser, GivesWayToQuadsOfSoManyCellsThatTheyAreMoreLikeTheSurface) {
    const auto beside = [](double quads, double all_ms) {
        MeshesAtHand meshes = taking(all_ms);
        meshes.quads = quads;
        return MeshLevelChooser().choose(meshes);
    };
    EXPECT_EQ(beside(1, 15), 1u) << "thin things are thinner as a mesh";
    EXPECT_EQ(beside(1, 40), std::nullopt);
    EXPECT_EQ(beside(0.25, 40), 2u);
    EXPECT_EQ(beside(0.25, 100), std::nullopt);
    EXPECT_EQ(beside(0.1, 100), 3u);
}

TEST(MeshLevelChooser, OfTranslucentSurfacesIsAnyMeshBeforeQuads) {
    const auto beside = [](double quads, double all_ms) {
        MeshesAtHand meshes = taking(all_ms);
        meshes.translucent = true;
        meshes.quads = quads;
        meshes.longest = Milliseconds(100);
        return MeshLevelChooser().choose(meshes);
    };
    EXPECT_EQ(beside(0.25, 15), 1u);
    EXPECT_EQ(beside(0.9, 40), 2u);
    EXPECT_EQ(beside(0.25, 100), 3u);
    EXPECT_EQ(beside(0.25, 1000), 3u) << "slower than wanted, but no scraps";
    EXPECT_EQ(beside(0.25, 2100), std::nullopt) << "longer than any picture may take";
    EXPECT_EQ(beside(1, 100), 3u) << "also before quads of all cells";
}

TEST(MeshLevelChooser, TheCoarsestMayTakeLongerThanTheBudgetWhereQuadsAreLessLikeTheSurface) {
    const auto beside = [](double quads, double coarsest_ms, double longest_ms = 100) {
        MeshesAtHand meshes = taking(20 * coarsest_ms);
        meshes.quads = quads;
        meshes.longest = Milliseconds(longest_ms);
        return MeshLevelChooser().choose(meshes);
    };
    EXPECT_EQ(beside(0.15, 14), 3u) << "of a budget of 10 ms";
    EXPECT_EQ(beside(0.15, 16), std::nullopt);
    EXPECT_EQ(beside(0.2, 14), std::nullopt) << "quads of a fifth of the cells are more like it";
    EXPECT_EQ(beside(0.15, 14, 12), std::nullopt) << "no picture may take so long";
}

TEST(MeshLevelChooser, TakesHardlyLongerThanQuadsThatDoNotFitEither) {
    const auto beside = [](double quads_ms, double all_ms) {
        MeshesAtHand meshes = taking(all_ms);
        meshes.quads_take = Milliseconds(quads_ms);
        return MeshLevelChooser().choose(meshes);
    };
    const double budget = taking(1).budget.count();
    EXPECT_EQ(beside(1.1 * budget, 1.4 * budget), 0u);
    EXPECT_NE(beside(1.1 * budget, 1.5 * budget), 0u);
    EXPECT_NE(beside(0.99 * budget, 1.2 * budget), 0u) << "quads fit";
}

TEST(MeshLevelChooser, StaysWhereTimesScatterAboutALimitAndFollowsThemTwiceASecondAtMost) {
    MeshLevelChooser choice;
    interaction::Seconds now{0};
    EXPECT_EQ(choice.choose(taking(20, now)), 1u);
    for (int i = 0; i < 400; ++i, now += interaction::Seconds(0.01))
        EXPECT_EQ(choice.choose(taking(i % 2 ? 18 : 29, now)), 1u) << i;
    // It follows where times really change.
    int changes = 0;
    std::optional<std::size_t> last = choice.level();
    for (int i = 0; i < 400; ++i, now += interaction::Seconds(0.01)) {
        const auto level = choice.choose(taking(i % 2 ? 10 : 90, now));
        changes += level != last;
        last = level;
    }
    EXPECT_GT(changes, 0);
    EXPECT_LE(changes, 8) << "in four seconds";
    // What is gone is left at once.
    EXPECT_TRUE(choice.choose(taking(10, now += interaction::Seconds(1))));
    MeshesAtHand none = taking(10, now);
    none.triangles = {};
    EXPECT_EQ(choice.choose(none), std::nullopt);
}

} // namespace
} // namespace isochron::app
