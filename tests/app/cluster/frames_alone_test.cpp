// A process alone shows cells as soon as it has them, and never waits.
#include "app/cluster/frames_alone.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace isochron::app {
namespace {

index::SurfacesQuery query_of_step(std::uint32_t step) {
    index::SurfacesQuery query;
    query.step = step;
    return query;
}

index::ExtractionPtr found_unless_last(const index::SurfacesQuery& query, const std::stop_token&) {
    if (query.step == 9)
        throw std::runtime_error("step 9 cannot be read");
    auto extraction = std::make_shared<index::Extraction>();
    extraction->query = query;
    return extraction;
}

TEST(FramesAlone, CellsAreShownInTheFirstFrameThatHasThem) {
    FramesAlone frames;
    index::Extractor extractor(found_unless_last);
    for (std::uint32_t step = 0; step < 5; ++step) {
        const index::SurfacesQuery asked = frames.ask(query_of_step(step), Waiting::never);
        EXPECT_EQ(asked, query_of_step(step));
        extractor.request({asked, std::nullopt});
        extractor.wait();
        const CellsInFrame cells = frames.cells(extractor, nullptr, Waiting::never);
        ASSERT_TRUE(cells.show && *cells.show);
        EXPECT_EQ((*cells.show)->query, query_of_step(step));
        EXPECT_EQ(cells.stage, nullptr) << "what is on its way is shown when it is there";
    }
}

TEST(FramesAlone, AFailureIsToldInItsOwnWords) {
    FramesAlone frames;
    index::Extractor extractor(found_unless_last);
    EXPECT_FALSE(frames.has_no_answer(extractor));
    extractor.request({query_of_step(9), std::nullopt});
    extractor.wait();
    EXPECT_EQ(frames.failure(extractor), "step 9 cannot be read");
    EXPECT_TRUE(frames.has_no_answer(extractor));
}

TEST(FramesAlone, NobodyIsAskedOrWaitedFor) {
    FramesAlone frames;
    EXPECT_TRUE(frames.leads());
    frames.swap_barrier([]() -> FrameAnswer { throw std::runtime_error("asked"); });
    const std::vector<DrawSample> samples{{.frame = 3, .load = {}, .gpu = {}},
                                          {.frame = 4, .load = {}, .gpu = {}}};
    EXPECT_EQ(frames.samples(samples), samples);
    EXPECT_EQ(frames.largest({2, 640}), (DrawLoad{2, 640}));
    const FramePlan mine{render::Footprint::surface, QualityReason::moving,
                         PictureState::drawn(true, false)};
    EXPECT_EQ(frames.agree(mine), mine);
    EXPECT_FALSE(frames.close_wanted());
    EXPECT_EQ(frames.next(), std::nullopt);
}

TEST(FramesAlone, HeadsAreAskedForOnlyWhenViewsAreMade) {
    FramesAlone frames;
    int asked = 0;
    const Latch heads = frames.begin({}, {}, Waiting::never,
                                     [&] {
                                         ++asked;
                                         return interaction::InputState();
                                     },
                                     {});
    EXPECT_EQ(asked, 0);
    heads();
    EXPECT_EQ(asked, 1);
    EXPECT_FALSE(frames.begin({}, {}, Waiting::never, {}, {}));
}

} // namespace
} // namespace isochron::app
