// Switching between the arrays of an index: the pictures, the isovalues, and what replays do.
#include "app/loop/replay.h"
#include "index/error.h"
#include "interaction/input/actions.h"
#include "tests/support/eventually.h"
#include "tests/support/nearness_series.h"
#include "tests/support/session_fixture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Action;
using interaction::Commands;
using testing::HasSubstr;

class SessionArrays : public SessionTest {
  protected:
    SessionArrays() {
        MovingSphere sphere(kSteps);
        NearnessSeries nearness(sphere.info());
        build_index(sphere, folder_.path() / "both.isochron",
                    {.further = {{.series = &nearness, .array = "nearness"}}});
        both_ = index::IndexFile::open(folder_.path() / "both.isochron");
        build_index(nearness, folder_.path() / "near.isochron", {.color = &sphere});
        near_ = index::IndexFile::open(folder_.path() / "near.isochron");
    }

    static render::Image picture(Session& session, const Commands& commands, double time) {
        session.frame(head_at_rest(time), commands, Waiting::for_cells);
        return session.outputs().display().read_eye(stereo::Eye::left);
    }
    static Config without_titles() {
        Config config = small_config();
        config.start.bounding_box = false;
        return config;
    }
    static bool same(const render::Image& a, const render::Image& b) { return a.rgba == b.rgba; }

    /// The frame in which keys are pressed for these actions.
    static interaction::InputState pressing(double time, const interaction::ActionSet& actions) {
        interaction::InputState input = head_at_rest(time);
        interaction::DeviceState keys;
        keys.name = "keys";
        keys.actions = actions;
        input.devices.push_back(keys);
        return input;
    }
    static Commands press(Session& session, double time, Action action) {
        session.commands_from(pressing(time, 0));
        return session.commands_from(pressing(time + 0.01, interaction::bit(action)));
    }

    static constexpr std::size_t kSteps = 4;
    std::shared_ptr<const index::IndexFile> both_, near_;
};

INSTANTIATE_TEST_SUITE_P(Contexts, SessionArrays,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(SessionArrays, APictureIsThatOfAnIndexWithThatArrayAlone) {
    Session session(without_titles(), both_, *context_);
    const render::Image sphere = picture(session, {}, 0);
    Commands to_near = session.way_to_array(1);
    to_near.instant = index::Instant(2);
    const render::Image near_here = picture(session, to_near, 1);
    EXPECT_FALSE(same(near_here, sphere));
    Commands colored;
    colored.coloring = interaction::Coloring{.by = interaction::ColorBy::value};
    const render::Image colors_here = picture(session, colored, 2);
    EXPECT_FALSE(same(colors_here, near_here));
    Commands plain;
    plain.coloring = interaction::Coloring{};
    plain.instant = index::Instant(0);
    plain = [&, way = session.way_to_array(0)]() mutable {
        interaction::merge(way, plain);
        return way;
    }();
    EXPECT_TRUE(same(picture(session, plain, 3), sphere)) << "and back again";

    Session alone(without_titles(), near_, *context_);
    Commands step;
    step.instant = index::Instant(2);
    EXPECT_TRUE(same(picture(alone, step, 1), near_here));
    EXPECT_TRUE(same(picture(alone, colored, 2), colors_here));
}

TEST_P(SessionArrays, WordsInAPictureAreOfTheArrayThatIsShown) {
    Commands mark, legend;
    mark.mark.emplace();
    mark.mark->point.emplace();
    mark.mark->point->position = {12, 15, 15};
    mark.mark->point->value = 12.25;
    legend.isosurfaces = {{.isovalue = 60}, {.isovalue = 80}};
    for (const auto& [words, commands] : {std::pair("mark", mark), std::pair("legend", legend)}) {
        SCOPED_TRACE(words);
        Session alone(without_titles(), near_, *context_), both(without_titles(), both_, *context_);
        EXPECT_EQ(near_->info().array, "nearness");
        picture(both, {}, 0);
        picture(both, both.way_to_array(1), 1);
        // At rest, so that how long a picture has stood makes no difference.
        const auto at_rest = [](Session& session, const Commands& change, double time) {
            picture(session, change, time);
            for (int frame = 1; frame < 20; ++frame)
                picture(session, {}, time + 0.1 * frame);
            return picture(session, {}, time + 2);
        };
        const render::Image before = at_rest(alone, {}, 2), expected = at_rest(alone, commands, 5);
        EXPECT_FALSE(same(before, expected));
        EXPECT_TRUE(same(at_rest(both, {}, 2), before));
        EXPECT_TRUE(same(at_rest(both, commands, 5), expected));
    }
}

TEST_P(SessionArrays, AResumedSessionKnowsHowEachWasLeft) {
    Session session(small_config(), both_, *context_);
    Commands moved;
    moved.isovalue = 5.25;
    picture(session, moved, 0);
    picture(session, session.way_to_array(1), 1);
    const auto left = session.left_arrays();
    ASSERT_EQ(left.size(), 1u) << "the one that is shown is in the state";
    EXPECT_EQ(left.front().array, "distance");

    Session resumed(small_config(), both_, *context_);
    resumed.set_state(session.state());
    resumed.recall_arrays(left);
    EXPECT_EQ(resumed.left_arrays(), left);
    picture(resumed, resumed.way_to_array(0), 2);
    EXPECT_EQ(resumed.state().isovalue(), 5.25);
}

TEST_P(SessionArrays, EachKeepsItsIsovalueAndAFirstVisitHasTheDefault) {
    Session session(small_config(), both_, *context_);
    EXPECT_EQ(session.state().array, "distance");
    const double first = session.state().isovalue();
    Commands moved;
    moved.isovalue = 5.25;
    session.frame(head_at_rest(0), moved, Waiting::for_cells);
    Commands there = press(session, 0.1, Action::next_array);
    EXPECT_EQ(there.array, "nearness");
    EXPECT_FALSE(there.isovalue);
    const FrameReport& shown = session.frame(head_at_rest(0.2), there, Waiting::for_cells);
    EXPECT_EQ(shown.shown->array, 1u);
    EXPECT_GT(shown.cells, 50u);
    {
        Session alone(small_config(), near_, *context_);
        EXPECT_EQ(session.state().isovalue(), alone.state().isovalue());
    }
    Commands lower;
    lower.isovalue = 61;
    session.frame(head_at_rest(0.3), lower, Waiting::for_cells);
    const Commands back = press(session, 0.4, Action::next_array);
    session.frame(head_at_rest(0.5), back, Waiting::for_cells);
    EXPECT_EQ(session.state().array, "distance");
    EXPECT_EQ(session.state().isovalue(), 5.25);
    EXPECT_NE(first, 5.25);
    session.frame(head_at_rest(0.6), press(session, 0.55, Action::next_array), Waiting::for_cells);
    EXPECT_EQ(session.state().isovalue(), 61);
    // One step of undo takes array and isovalue back.
    ASSERT_TRUE(session.history().undo());
    const Commands undone = *session.history().undo();
    session.frame(head_at_rest(0.7), undone, Waiting::for_cells);
    EXPECT_EQ(session.state().array, "distance");
    EXPECT_EQ(session.state().isovalue(), 5.25);
}

TEST_P(SessionArrays, FramesGoOnWhileTheCellsOfTheNewArrayAreSearched) {
    Session session(small_config(), both_, *context_);
    session.frame(head_at_rest(0), {}, Waiting::for_cells);
    Commands there = session.way_to_array(1);
    int frame = 0;
    // The last good picture stays until the new one is there.
    EXPECT_TRUE(test_support::eventually([&] {
        const FrameReport& report =
            session.frame(head_at_rest(++frame / 60.0), std::exchange(there, {}), Waiting::never);
        EXPECT_TRUE(report.shown);
        EXPECT_GT(report.cells, 0u);
        EXPECT_EQ(report.asked.array, 1u);
        if (!report.shown || report.shown->array == 1)
            return true;
        EXPECT_NE(report.shown->isovalues, report.asked.isovalues);
        return false;
    }));
    EXPECT_EQ(session.failure(), "");
}

TEST_P(SessionArrays, ARecordingSwitchesThem) {
    interaction::Recording recording;
    std::vector<render::Image> live;
    {
        Session session(small_config(), both_, *context_);
        recording.header.start = session.state().as_commands();
        const std::vector<Action> keys{Action::next_array, Action::next_coloring,
                                       Action::next_color_array, Action::next_array};
        for (std::size_t i = 0; i < 3 * keys.size(); ++i) {
            interaction::RecordedFrame frame;
            frame.input = pressing(0.1 * double(i), i % 3 == 1 ? bit(keys[i / 3]) : 0);
            frame.commands = session.commands_from(frame.input);
            session.frame(frame.input, frame.commands, Waiting::for_cells);
            live.push_back(session.outputs().display().read_eye(stereo::Eye::right));
            recording.frames.push_back(std::move(frame));
        }
        EXPECT_EQ(session.state().array, "distance");
        EXPECT_EQ(session.state().coloring.by, interaction::ColorBy::surface)
            << "as the array was left";
    }
    Session again(small_config(), both_, *context_);
    again.set_state(start_of(recording.header, again.state(), kSteps, {}));
    std::size_t compared = 0;
    const auto different = replay_fixed_step(
        again, recording, {.from_devices = true, .stereo = {}, .quality = {}},
        [&](std::size_t number, const interaction::RecordedFrame&) {
            EXPECT_TRUE(same(again.outputs().display().read_eye(stereo::Eye::right), live[number]))
                << number;
            ++compared;
        });
    EXPECT_THAT(different, testing::IsEmpty());
    EXPECT_EQ(compared, live.size());

    Session other(small_config(), near_, *context_);
    try {
        replay_fixed_step(other, recording, {},
                          [](std::size_t, const auto&) { FAIL() << "a picture before the error"; });
        FAIL() << "no error";
    } catch (const index::Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("no array distance, expected nearness"));
    }
}

} // namespace
} // namespace isochron::app
