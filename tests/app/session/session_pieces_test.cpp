// Pieces that are hidden leave nothing in the picture, however cells are drawn.
#include "tests/support/session_fixture.h"

#include "app/panel/parts/piece_lines.h"
#include "app/session/piece_lister.h"
#include "index/extraction/cell_ray.h"
#include "render/gl/driver.h"

#include <algorithm>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::PlacedPiece;
using render::Footprint;

/// A ball of radius 7 at the left, and beside it one of radius 4 at the right if wished.
class Balls final : public index::VolumeSeries {
  public:
    explicit Balls(bool both) : both_(both) {
        info_ = MovingSphere(1).info();
        info_.grid.vertices = {40, 32, 32};
    }
    const index::SeriesInfo& info() const override { return info_; }
    void read(std::size_t, std::span<std::byte> out) override {
        std::size_t at = 0;
        for (int z = 0; z < 32; ++z)
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 40; ++x) {
                    const auto ball = [&](double middle, double radius) {
                        return radius - std::hypot(x - middle, y - 15.5, z - 15.5);
                    };
                    const auto value = static_cast<float>(
                        std::max(ball(10.0, 7.0), both_ ? ball(31.0, 4.0) : -99));
                    std::memcpy(out.data() + at, &value, sizeof value);
                    at += sizeof value;
                }
    }

  private:
    bool both_;
    index::SeriesInfo info_;
};

class SessionPieces : public SessionTest {
  protected:
    std::shared_ptr<const index::IndexFile> balls(bool both) {
        Balls series(both);
        const auto path = folder_.path() / (both ? "both.isochron" : "left.isochron");
        build_index(series, path, {});
        return index::IndexFile::open(path);
    }
    static Config config_of(Footprint footprint) {
        Config config = small_config(stereo::StereoMode::mono);
        config.start.bounding_box = false;
        config.quality.settled = footprint;
        return config;
    }
    static Commands plain(Footprint footprint) {
        Commands commands;
        commands.isovalue = 0.0;
        commands.look = interaction::Look{.occlusion = 0};
        if (footprint == Footprint::quad)
            commands.quality = interaction::QualityMode::fast;
        return commands;
    }
    /// The picture at rest.
    static render::Image picture(Session& session, const Commands& commands) {
        for (int i = 0; i < 30; ++i)
            session.frame(head_at_rest(static_cast<double>(session.log().frames().size()) / 30),
                          i == 0 ? commands : Commands(), Waiting::for_cells);
        return session.outputs().display().read_window();
    }
    /// Pixels that differ by more than the rounding of values on the GPU, which goes by their range.
    static std::size_t apart(const render::Image& a, const render::Image& b) {
        std::size_t count = 0;
        for (int y = 0; y < a.height; ++y)
            for (int x = 0; x < a.width; ++x)
                count += !std::equal(a.at(x, y), a.at(x, y) + 3, b.at(x, y),
                                     [](int one, int other) { return std::abs(one - other) <= 6; });
        return count;
    }
};

INSTANTIATE_TEST_SUITE_P(Contexts, SessionPieces, testing::Values(stereo::ContextKind::egl),
                         context_name);

TEST_P(SessionPieces, LeaveNoPixelWhereTheyAreHidden) {
    const auto both = balls(true), left = balls(false);
    for (const Footprint footprint :
         {Footprint::quad, Footprint::gaussian, Footprint::mesh, Footprint::surface}) {
        if (footprint == Footprint::mesh &&
            !render::is_drawn_for_processor(render::Gl(context_->loader())))
            continue;
        SCOPED_TRACE(render::name_of(footprint));
        Session session(config_of(footprint), both, *context_),
            alone(config_of(footprint), left, *context_);
        const render::Image expected = picture(alone, plain(footprint)),
                            all = picture(session, plain(footprint));
        ASSERT_EQ(session.log().frames().back().footprint, footprint);
        EXPECT_GT(apart(all, expected), 100u);
        Commands commands;
        commands.pieces = interaction::ShownPieces{
            .only = {}, .hidden = {PlacedPiece{0, {31, 15.5, 19.5}}}, .dust = 0};
        EXPECT_EQ(apart(picture(session, commands), expected), 0u);
        EXPECT_EQ(session.log().frames().back().cells, alone.log().frames().back().cells);
        ASSERT_TRUE(session.history().undo());
        EXPECT_EQ(apart(picture(session, *session.history().undo()), all), 0u);
        commands.pieces = interaction::ShownPieces{
            .only = {PlacedPiece{0, {10, 15.5, 22.5}}}, .hidden = {}, .dust = 0};
        EXPECT_EQ(apart(picture(session, commands), expected), 0u);
        commands.pieces = interaction::ShownPieces{.only = {}, .hidden = {}, .dust = 500};
        EXPECT_EQ(apart(picture(session, commands), expected), 0u);
        commands.pieces = interaction::ShownPieces{};
        EXPECT_EQ(apart(picture(session, commands), all), 0u);
    }
}

TEST_P(SessionPieces, HaveAColorOfTheirOwnAsSurfacesOfTheirOwn) {
    const auto both = balls(true), left = balls(false);
    Session session(config_of(Footprint::surface), both, *context_),
        alone(config_of(Footprint::surface), left, *context_);
    const render::Image all = picture(session, plain(Footprint::surface));
    const std::size_t cells = session.log().frames().back().cells;
    const std::size_t right = apart(all, picture(alone, plain(Footprint::surface)));
    auto colored = colored_piece(session.state(), {0, {31, 15.5, 19.5}});
    ASSERT_TRUE(colored);
    EXPECT_NE(colored->isosurfaces->back().color, colored->isosurfaces->front().color);
    colored->isosurfaces->back().color = {0, 0, 1};
    const render::Image image = picture(session, *colored);
    EXPECT_EQ(session.log().frames().back().cells, cells) << "each piece is there once";
    std::size_t blue = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            blue += image.at(x, y)[2] > image.at(x, y)[0] + 30;
    EXPECT_GT(blue, right * 9 / 10);
    ASSERT_TRUE(session.history().undo());
    EXPECT_EQ(apart(picture(session, *session.history().undo()), all), 0u);
    ExplorerState full = session.state();
    full.isosurfaces.resize(interaction::kMostIsosurfaces);
    EXPECT_FALSE(colored_piece(full, {0, {31, 15.5, 19.5}}));
}

TEST_P(SessionPieces, AreNotPickedWhereTheyAreHidden) {
    const auto both = balls(true);
    const index::Extract extract = index::extract_from(both);
    index::SurfacesQuery query{index::Instant(0), {0.0}};
    const index::Ray through{{31, 15.5, 60}, {0, 0, -1}}, beside{{10, 15.5, 60}, {0, 0, -1}};
    const auto hits = [&](const index::Ray& ray) {
        return index::first_hit(*extract(query, {}), both->info().grid, ray).has_value();
    };
    EXPECT_TRUE(hits(through) && hits(beside));
    query.pieces.dust = 500;
    EXPECT_TRUE(!hits(through) && hits(beside));
    query.pieces = {.only = {{0, {31, 15.5, 15.5}}}, .hidden = {}};
    EXPECT_TRUE(hits(through) && !hits(beside));
}

TEST_P(SessionPieces, AreListedWhileAPanelLooks) {
    const auto both = balls(true);
    ExplorerState state;
    state.set_isovalue(0.0);
    const ShownArrays arrays(config_of(Footprint::surface), both, state);
    FramesAlone alone;
    FramePlan plan;
    FrameReport report;
    const std::optional<Picture> none;
    PieceLister lister;
    const auto listed = [&](const std::optional<PieceOrder>& order) {
        report.asked = arrays.surfaces(state);
        const Frame frame{.state = state,
                          .file = *both,
                          .steps = 1,
                          .waiting = Waiting::for_cells,
                          .is_kept = false,
                          .drawn = none,
                          .sharing = alone,
                          .plan = plan,
                          .report = report};
        if (order)
            lister.in_panel(report, nullptr).want(*order);
        lister.update(frame, arrays);
        return lister.in_panel(report, nullptr);
    };
    EXPECT_EQ(listed({}).list, nullptr); // nobody looks
    const PieceListPtr list = listed(PieceOrder{}).list;
    ASSERT_TRUE(list);
    ASSERT_EQ(list->rows.size(), 2u);
    EXPECT_NEAR(list->rows[0].volume, 4.0 / 3 * 3.14159 * 343, 30);
    EXPECT_NEAR(list->rows[1].area, 4 * 3.14159 * 16, 8);
    EXPECT_NEAR(list->rows[1].centroid[0], 31, 0.1);
    EXPECT_GT(listed(PieceOrder{PieceColumn::cells, true}).list->rows[0].centroid[0], 30);
    EXPECT_EQ(csv_of(*list, both->info()).substr(0, 46),
              "piece,cells,area [mm^2],volume [mm^3],closed,x");
    index::SeriesInfo odd = both->info();
    odd.length_unit = "a,b";
    EXPECT_EQ(csv_of(*list, odd).substr(0, 31), "piece,cells,\"area [a,b^2]\",\"vol");
    state.pieces.dust = 500;
    EXPECT_EQ(listed(PieceOrder{}).list->rows.size(), 1u);
    EXPECT_TRUE(listed(PieceOrder{}).come); // as no cells are shown
}

TEST(PieceLists, CountWhatTheyLeaveOut) {
    std::vector<index::MeasuredPiece> pieces;
    for (std::size_t i = 0; i < PieceList::kMostRows + 50; ++i) {
        index::MeasuredPiece piece{.cells = i, .area = 1.0};
        piece.volume = i % 2 == 0 ? static_cast<double>(i) : std::nan("");
        pieces.push_back(piece);
    }
    const PieceList by_cells = piece_list(pieces, {PieceColumn::cells, false});
    EXPECT_EQ(by_cells.rows.size(), PieceList::kMostRows);
    EXPECT_EQ(by_cells.rows.front().cells, PieceList::kMostRows + 49);
    EXPECT_EQ(by_cells.pieces, pieces.size());
    EXPECT_EQ(by_cells.other_cells, 49u * 50 / 2);
    EXPECT_EQ(by_cells.other_area, 50.0);
    const PieceList by_volume = piece_list(pieces, {PieceColumn::volume, true});
    EXPECT_EQ(by_volume.rows.front().cells, 0u);
    EXPECT_TRUE(std::isnan(by_volume.rows.back().volume));
}

} // namespace
} // namespace isochron::app
