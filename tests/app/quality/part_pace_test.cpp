// The pieces of a picture that is drawn over several frames, with simulated times.
#include "app/quality/part_pace.h"

#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

namespace isochron::app {
namespace {

/// Frames until so much work is done. @return the time of each [ms]
std::vector<double> frames_of(std::size_t work, Milliseconds each,
                              const std::function<double(std::size_t, std::size_t)>& cost) {
    PartPace pace;
    std::vector<double> frames;
    double whole = 0;
    for (std::size_t done = 0; done < work;) {
        pace.begin_frame(each);
        double spent = 0;
        while (std::size_t piece = pace.next()) {
            piece = std::min(piece, work - done);
            const double time = cost(done, piece);
            pace.took(piece, Milliseconds(time));
            done += piece;
            spent += time;
            if (done == work)
                break;
        }
        whole += spent;
        frames.push_back(spent);
    }
    EXPECT_NEAR(pace.whole().count(), whole, 1e-6 * whole);
    return frames;
}

TEST(PartPace, FramesKeepToTheirTimeAndUseIt) {
    std::mt19937 random(test_seed());
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    for (int trial = 0; trial < 200; ++trial) {
        const double each = uniform(5, 50), of_one = uniform(1e-4, 1e-2), fixed = uniform(0, 0.5);
        const auto frames =
            frames_of(200'000, Milliseconds(each), [&](std::size_t, std::size_t work) {
                return fixed + of_one * static_cast<double>(work) * uniform(0.8, 1.25);
            });
        double whole = 0;
        for (const double frame : frames) {
            // The first piece is drawn without knowing what it costs.
            EXPECT_LE(frame, std::max(1.2 * each, 1.3 * of_one * PartPace::kFirst + 1)) << trial;
            whole += frame;
        }
        EXPECT_LE(static_cast<double>(frames.size()), 2 + 2.0 * whole / each) << trial;
    }
}

TEST(PartPace, EveryFrameHasAPieceHoweverShortItsTime) {
    const auto frames = frames_of(100'000, Milliseconds(1e-6), [](std::size_t, std::size_t work) {
        return 1e-2 * static_cast<double>(work);
    });
    EXPECT_GE(frames.size(), 100'000 / PartPace::kFirst);
    EXPECT_LE(frames.size(), 100'000 / PartPace::kLeast + 2);
}

TEST(PartPace, WorkThatBecomesDearIsNoticedAfterOnePiece) {
    // A hundred times as dear from the middle on.
    const auto frames =
        frames_of(200'000, Milliseconds(20), [](std::size_t done, std::size_t work) {
            return (done < 100'000 ? 1e-4 : 1e-2) * static_cast<double>(work);
        });
    // A quarter of a frame's work at the old price is all that can be too dear, once.
    EXPECT_LE(*std::ranges::max_element(frames), 20 + 0.25 * 20 / 1e-4 * 1e-2);
    EXPECT_EQ(std::ranges::count_if(frames, [](double frame) { return frame > 21; }), 1);
}

TEST(PartPace, OtherWorkCountsForTheFrameOnly) {
    PartPace pace;
    pace.begin_frame(Milliseconds(10));
    pace.took(0, Milliseconds(30));
    EXPECT_EQ(pace.next(), 0u) << "the frame has had its time";
    pace.begin_frame(Milliseconds(10));
    EXPECT_EQ(pace.next(), PartPace::kFirst);
}

} // namespace
} // namespace isochron::app
