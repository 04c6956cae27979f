// A small motion, played and compared.
#include "tests/bench/motion/cases.h"
#include "tests/bench/tests/bench_commands.h"

#include <gmock/gmock.h>

namespace isochron::bench {
namespace {

using testing::HasSubstr;

class MotionPlay : public app::BenchCommands {
  protected:
    std::vector<ComparedMotion> play(const MotionCase& of) {
        PlayOptions options;
        options.seconds = 0.6;
        options.longest_rest = 600; // however long it takes here
        return play_case(of, folder.path(), options, [] {}, [](std::string_view, double) {});
    }
};

MotionCase small() {
    return {.data = {.name = "small",
                     .kept = "small",
                     .field = MovedField::turbulence,
                     .size = 32,
                     .steps = 2,
                     .longest = 4},
            .size = {160, 120},
            .budgets = {50},
            .motions = {Motion::orbit, Motion::scrub}};
}

TEST_F(MotionPlay, ComparesEachKeptPictureAndEndsExact) {
    const MotionCase of = small();
    const auto motions = play(of);
    ASSERT_EQ(motions.size(), 2u);
    for (const ComparedMotion& motion : motions) {
        SCOPED_TRACE(motion.row.motion);
        EXPECT_EQ(motion.row.pictures, 2u) << "at two moments, however slow it is";
        EXPECT_GT(motion.row.cells, 100u);
        EXPECT_GT(motion.row.overlap, 0.5) << "so small a set is drawn whole";
        EXPECT_GT(motion.row.lit, 0.5);
        EXPECT_LT(motion.row.lit, 2);
        EXPECT_TRUE(motion.row.exact_ms) << "it comes to rest";
        EXPECT_EQ(motion.row.left_off, 0) << "and is then what is settled";
        EXPECT_EQ(motion.moving.width, 160);
    }
    EXPECT_TRUE(motions[0].row.shown_ms) << "from the hand to the picture";
    EXPECT_TRUE(motions[1].row.shown_ms);
    EXPECT_THAT(folder.names(), testing::ElementsAre("small.isochron")) << "kept for the next time";
    const render::Image sheet = sheet_of(motions, 40);
    EXPECT_EQ(sheet.width, 84);
    EXPECT_EQ(sheet.height, 64);
}

TEST_F(MotionPlay, ComparesBothEyes) {
    MotionCase of = small();
    of.size = {240, 120};
    of.eyes = 2;
    of.motions = {Motion::sway};
    const auto motions = play(of);
    ASSERT_EQ(motions.size(), 1u);
    EXPECT_EQ(motions[0].row.pictures, 4u);
    EXPECT_EQ(motions[0].row.width, 120);
    EXPECT_EQ(motions[0].moving.width, 120);
}

TEST_F(MotionPlay, RefusesDataThatItDoesNotKnow) {
    const app::ChildResult result = bench({"motion", "--data", "nothing"});
    EXPECT_NE(result.status, 0);
    EXPECT_THAT(result.err, HasSubstr("nothing"));
    EXPECT_THAT(result.err, HasSubstr("192"));
}

} // namespace
} // namespace isochron::bench
