// Keys of the keyboard add, visit and remove the key frames of a film.
#include "tests/interaction/controls/control_desk.h"

#include "interaction/navigation/key_frames.h"

#include <gmock/gmock.h>

namespace isochron::interaction {
namespace {

TEST(KeyFrameControls, KeysAreAddedVisitedAndRemoved) {
    Desk desk;
    for (const double isovalue : {1.0, 2.0, 3.0}) {
        desk.settings.set_isovalue(isovalue);
        desk.settings.instant = Instant(static_cast<std::uint32_t>(isovalue));
        desk.tap(Action::add_key);
    }
    ASSERT_EQ(desk.settings.keys.size(), 3u);
    EXPECT_EQ(desk.settings.keys[2].time, 4);
    EXPECT_EQ(desk.settings.keys[2].step, 3u);
    const auto visited = [&](Action action) {
        desk.tap(action);
        return desk.settings.isovalue();
    };
    EXPECT_EQ(visited(Action::next_key), 1);
    EXPECT_EQ(visited(Action::next_key), 2);
    EXPECT_EQ(desk.settings.instant, Instant(2));
    EXPECT_EQ(visited(Action::previous_key), 1);
    EXPECT_EQ(visited(Action::previous_key), 3);
    desk.settings.room_from_physical.translation.x += 1; // no key is seen
    EXPECT_EQ(visited(Action::next_key), 1);
    desk.settings.playback.playing = true;
    EXPECT_EQ(visited(Action::next_key), 2);
    EXPECT_FALSE(desk.settings.playback.playing);

    desk.tap(Action::remove_key); // that is seen
    ASSERT_EQ(desk.settings.keys.size(), 2u);
    EXPECT_EQ(desk.settings.keys[0].step, 1u);
    EXPECT_EQ(desk.settings.keys[1].step, 3u);
    EXPECT_EQ(visited(Action::next_key), 1);
    desk.tap(Action::remove_key); // the first one: the film begins with the next one
    ASSERT_EQ(desk.settings.keys.size(), 1u);
    EXPECT_EQ(desk.settings.keys[0].time, 0);
    desk.tap(Action::remove_key); // none is seen: the last one
    EXPECT_TRUE(desk.settings.keys.empty());
    EXPECT_TRUE(desk.tap(Action::next_key).empty());
    EXPECT_TRUE(desk.tap(Action::remove_key).empty());
}

TEST(KeyFrameControls, AKeyIsMovedBetweenItsNeighborsAndItsRestMovesThoseBehind) {
    const auto times = [](const std::vector<KeyFrame>& keys) {
        std::vector<double> all;
        for (const KeyFrame& key : keys)
            all.insert(all.end(), {key.time, key.hold});
        return all;
    };
    using Times = std::vector<double>;
    std::vector<KeyFrame> keys(3);
    keys[1].time = 2;
    keys[1].hold = 0.5;
    keys[2].time = 6;
    EXPECT_EQ(times(with_moved_key(keys, 0, 3)), (Times{0, 0, 2, 0.5, 6, 0})) << "stays at 0";
    EXPECT_EQ(times(with_moved_key(keys, 1, 3)), (Times{0, 0, 3, 0.5, 6, 0}));
    EXPECT_EQ(with_moved_key(keys, 1, 9)[1].time, 6 - 0.5 - kShortestMove);
    EXPECT_EQ(with_moved_key(keys, 1, -1)[1].time, kShortestMove);
    EXPECT_EQ(with_moved_key(keys, 2, 1)[2].time, 2.5 + kShortestMove);
    EXPECT_EQ(with_moved_key(keys, 2, 1e9)[2].time, kLongestFilm);
    EXPECT_EQ(times(with_held_key(keys, 1, 2)), (Times{0, 0, 2, 2, 7.5, 0}));
    EXPECT_EQ(times(with_held_key(keys, 1, -3)), (Times{0, 0, 2, 0, 5.5, 0}));
    EXPECT_EQ(seconds_of(with_held_key(keys, 2, 1e9)), kLongestFilm);
}

TEST(KeyFrameControls, AFilmHasAtMostSoManyKeys) {
    Desk desk;
    for (std::size_t i = 0; i < kMostKeyFrames; ++i)
        desk.tap(Action::add_key);
    EXPECT_EQ(desk.settings.keys.size(), kMostKeyFrames);
    EXPECT_TRUE(desk.tap(Action::add_key).empty());
}

} // namespace
} // namespace isochron::interaction
