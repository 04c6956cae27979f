// Surfaces of another array beside those of the shown one: exact at their instant, drawn, picked, undone,
// kept, and the same in every replay.
#include "app/explore/link_view.h"
#include "app/loop/replay.h"
#include "app/output/export_request.h"
#include "index/extraction/value_in_index.h"
#include "index/system/links/link.h"
#include "interaction/recording/commands_json.h"
#include "tests/app/session/quality_session.h"
#include "tests/support/nearness_series.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using index::Instant;
using interaction::Commands;
using interaction::Isosurface;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::uint32_t kEdge = 32;

class SessionFurther : public SessionQuality {
  protected:
    SessionFurther() {
        MovingSphere sphere(6);
        NearnessSeries nearness(sphere.info());
        build_index(sphere, folder_.path() / "both.isochron",
                    {.further = {{.series = &nearness, .array = "nearness"}}});
        both_ = index::IndexFile::open(folder_.path() / "both.isochron");
    }
    FrameReport frame(Session& session, const Commands& commands = {}) {
        return session.frame(head_at_rest(now().count() + frame_++ / kRate), commands,
                             Waiting::for_cells);
    }
    static Commands asking(std::vector<Isosurface> surfaces) {
        Commands commands;
        commands.isosurfaces = std::move(surfaces);
        return commands;
    }
    /// The sphere and what is near to the middle.
    static Commands of_both(double distance = 6, double nearness = 60, float opacity = 0.5f) {
        return asking(
            {{.isovalue = distance},
             {.isovalue = nearness, .color = {0, 0, 1}, .opacity = opacity, .array = "nearness"}});
    }
    static Commands at_instant(Instant at) {
        Commands commands;
        commands.instant = at;
        if (at.between())
            commands.between = interaction::BetweenSteps::blend;
        return commands;
    }
    /// Active cells by the definition.
    static std::size_t cells_of(index::VolumeSeries& series, Instant at, double isovalue) {
        std::vector<double> values(series.info().grid.vertex_count(), 0.0);
        const auto add = [&](std::uint32_t step, double share) {
            const bool bytes = series.info().type == index::ValueType::u8;
            std::vector<std::byte> raw(values.size() * (bytes ? 1 : 4));
            series.read(step, raw);
            for (std::size_t i = 0; i < values.size(); ++i) {
                float real = 0;
                if (!bytes)
                    std::memcpy(&real, &raw[4 * i], 4);
                values[i] += share * (bytes ? double(std::to_integer<int>(raw[i])) : double(real));
            }
        };
        const double share = double(at.fraction) / Instant::kFractions;
        add(at.step, 1 - share);
        if (at.between())
            add(at.step + 1, share);
        std::size_t cells = 0;
        for (std::size_t z = 0; z + 1 < kEdge; ++z)
            for (std::size_t y = 0; y + 1 < kEdge; ++y)
                for (std::size_t x = 0; x + 1 < kEdge; ++x) {
                    bool below = false, above = false;
                    for (std::size_t i = 0; i < 8; ++i) {
                        const std::size_t at_vertex =
                            x + (i & 1) + kEdge * (y + (i >> 1 & 1) + kEdge * (z + (i >> 2)));
                        (values[at_vertex] < isovalue ? below : above) = true;
                    }
                    cells += below && above;
                }
        return cells;
    }
    std::shared_ptr<const index::IndexFile> both_;
};
INSTANTIATE_TEST_SUITE_P(, SessionFurther, testing::Values(stereo::ContextKind::egl), context_name);

TEST_P(SessionFurther, HaveTheCellsOfTheirOwnArrayAtTheInstantThatIsShown) {
    Session session(small_config(), both_, *context_);
    MovingSphere sphere(6);
    NearnessSeries nearness(sphere.info());
    const std::array<index::VolumeSeries*, 2> series{&sphere, &nearness};
    std::mt19937 random(test_seed());
    for (int round = 0; round < 12; ++round) {
        const std::size_t shown = random() % 2;
        Commands commands = session.way_to_array(shown);
        std::vector<Isosurface> surfaces;
        for (std::size_t i = 0; i < 2 + random() % 3; ++i) {
            const std::size_t array = random() % 2;
            const double isovalue =
                array == 0 ? 1.0 + double(random() % 1000) / 90 : 30.5 + double(random() % 60);
            surfaces.push_back(
                {.isovalue = isovalue, .array = std::string(both_->array(array).info().array)});
        }
        interaction::merge(commands, asking(surfaces));
        commands.picked = 0;
        interaction::merge(commands, at_instant(random() % 2 == 0
                                                    ? Instant(random() % 6)
                                                    : Instant(random() % 5, random() % 65'536)));
        const FrameReport report = frame(session, commands);
        std::size_t further = 0;
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            const std::size_t array = surfaces[i].array == "nearness" ? 1 : 0;
            const std::size_t cells =
                cells_of(*series[array], session.state().shown_instant(), surfaces[i].isovalue);
            if (array == shown) {
                EXPECT_EQ(report.asked.isovalues[i], surfaces[i].isovalue);
                continue;
            }
            ASSERT_LT(further, session.further().shown().size());
            const auto& made = *session.further().shown()[further++];
            EXPECT_EQ(surface_of(made.query), i);
            EXPECT_EQ(made.query.array, array);
            EXPECT_EQ(made.query.instant, session.state().shown_instant());
            EXPECT_TRUE(made.exact());
            EXPECT_EQ(made.cells, cells) << surfaces[i].isovalue;
            EXPECT_EQ(made.meshes.back() == nullptr, cells == 0);
        }
        EXPECT_THAT(session.further().shown(), SizeIs(further));
        EXPECT_FALSE(session.further().come());
    }
}

TEST_P(SessionFurther, AreSeenInTheirColorAndHideWhatIsBehindThem) {
    Config config = small_config(stereo::StereoMode::mono);
    config.start.bounding_box = false;
    Session session(config, both_, *context_);
    const auto picture = [&](Commands commands) {
        commands.quality = interaction::QualityMode::quality; // one footprint for all pictures
        frame(session, commands);
        frame(session);
        return session.outputs().display().read_window();
    };
    struct Light {
        int blue = 0, warm = 0; ///< pixels
    };
    const auto light = [](const render::Image& image) { // the legend is at the right
        Light sum;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width / 2; ++x) {
                sum.blue += image.at(x, y)[2] > image.at(x, y)[0] + 30;
                sum.warm += image.at(x, y)[0] > image.at(x, y)[2] + 5;
            }
        return sum;
    };
    const render::Image image = picture(asking({{.isovalue = 6}}));
    const Light alone = light(image), around = light(picture(of_both(6, 30, 1))),
                through = light(picture(of_both(6, 30, 0.15f))),
                within = light(picture(of_both(3, 90, 1)));
    EXPECT_EQ(alone.blue, 0);
    EXPECT_GT(alone.warm, 300);
    EXPECT_GT(around.blue, 500) << "an opaque one around the sphere";
    EXPECT_EQ(around.warm, 0);
    EXPECT_GT(through.blue, 50);
    EXPECT_GT(through.warm, 150) << "the sphere is seen through a translucent one";
    EXPECT_EQ(within.blue, 0) << "the sphere hides what is in it";
    EXPECT_EQ(picture(of_both(6, 30, 0)).rgba, image.rgba) << "a hidden one";
    EXPECT_EQ(picture(asking({{.isovalue = 6}})).rgba, image.rgba);
    Commands cut = of_both(6, 30, 1);
    cut.clip_box.emplace();
    cut.clip_box->shown = true;
    cut.clip_box->high = {2, 2, 2};
    EXPECT_EQ(light(picture(cut)).blue, 0) << "the box cuts it";
}

TEST_P(SessionFurther, HaveTheColorsOfAnArraysValuesOnThemWhereSurfacesHaveThem) {
    Config config = small_config(stereo::StereoMode::mono);
    Session session(config, both_, *context_);
    const auto picture = [&](Commands commands) {
        commands.quality = interaction::QualityMode::quality; // one footprint for all pictures
        frame(session, commands);
        frame(session);
        return session.outputs().display().read_window();
    };
    interaction::Coloring by_distance{.by = interaction::ColorBy::value};
    by_distance.array = both_->info().array;
    const auto colored = [&](const glm::vec3& color, float opacity, Instant at) {
        Commands commands = of_both(6, 30, opacity);
        commands.isosurfaces->back().color = color;
        commands.coloring = by_distance;
        interaction::merge(commands, at_instant(at));
        return picture(commands);
    };
    const double low = both_->stats().low, high = both_->stats().high;
    for (const Instant at : {Instant(2), Instant(1, 20'000)}) {
        colored({0, 0, 1}, 1, at);
        const auto& made = *session.further().shown().at(0);
        ASSERT_TRUE(made.meshes.back());
        const index::CellMesh& mesh = *made.meshes.back();
        ASSERT_EQ(mesh.colors.size(), mesh.vertices.size());
        std::vector<glm::dvec3> places;
        for (const index::MeshVertex& vertex : mesh.vertices)
            places.push_back(both_->info().grid.physical(index::position_of(vertex)));
        const std::vector<double> values = index::values_in(*both_, at, places);
        int distinct = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            EXPECT_NEAR(mesh.colors[i], (values[i] - low) / (high - low) * 65534, 4);
            distinct += i > 0 && mesh.colors[i] != mesh.colors[0];
        }
        EXPECT_GT(distinct, 100);
    }
    for (const float opacity : {1.0f, 0.4f}) {
        const render::Image blue = colored({0, 0, 1}, opacity, Instant(2)),
                            red = colored({1, 0, 0}, opacity, Instant(2));
        EXPECT_EQ(blue.rgba, red.rgba)
            << "a color of its own counts no longer, in the legend either";
        Commands own = of_both(6, 30, opacity);
        own.coloring.emplace();
        EXPECT_NE(picture(own).rgba, blue.rgba);
    }
    ExplorerState state = session.state();
    state.coloring = by_distance;
    state.isosurfaces = *of_both(6, 30).isosurfaces;
    state.picked = 1;
    EXPECT_EQ(shown_request(state, both_).values->array, color_array(state, *both_));
    state.coloring.by = interaction::ColorBy::first_crossing;
    ASSERT_TRUE(shown_request(state, both_).values);
    EXPECT_FALSE(shown_request(state, both_).values->array) << "times";
}

TEST_P(SessionFurther, CountAmongThePercentilesOfTheScale) {
    Session session(small_config(), both_, *context_);
    const auto range = [&](Commands commands) {
        commands.coloring = interaction::Coloring{.by = interaction::ColorBy::value};
        commands.coloring->array = both_->info().array;
        commands.coloring->percentiles = {2.0, 98.0};
        frame(session, commands);
        frame(session);
        return session.scale()->range;
    };
    const std::array<double, 2> whole{both_->stats().low, both_->stats().high};
    EXPECT_EQ(range(asking({{.isovalue = 6}})), whole) << "all of it lies at 6: that is no range";
    const auto both = range(of_both(6, 30));
    EXPECT_GT(both[0], whole[0] + 1);
    EXPECT_LT(both[0], 3) << "what is near to the middle reaches further out";
    EXPECT_NEAR(both[1], 6, 0.01);
}

TEST_P(SessionFurther, HaveTheTimesOfTheirOwnFirstCrossings) {
    constexpr double kIsovalue = 60;
    Session session(small_config(stereo::StereoMode::mono), both_, *context_);
    MovingSphere sphere(6);
    NearnessSeries nearness(sphere.info());
    std::vector<std::vector<std::byte>> values(6, std::vector<std::byte>(kEdge * kEdge * kEdge));
    for (std::size_t step = 0; step < 6; ++step)
        nearness.read(step, values[step]);
    const auto is_active = [&](const glm::ivec3& cell, std::size_t step) {
        int above = 0;
        for (int i = 0; i < 8; ++i) {
            const glm::ivec3 at = cell + glm::ivec3(i & 1, i >> 1 & 1, i >> 2);
            const int place = at.x + int(kEdge) * (at.y + int(kEdge) * at.z);
            above += std::to_integer<int>(values[step][std::size_t(place)]) >= kIsovalue;
        }
        return above > 0 && above < 8;
    };
    Commands commands = of_both(6, kIsovalue, 1);
    commands.coloring = interaction::Coloring{.by = interaction::ColorBy::first_crossing};
    for (const std::uint32_t step : {4u, 2u}) {
        interaction::merge(commands, at_instant(Instant(step)));
        frame(session, commands);
        frame(session);
        const index::CellMesh& mesh = *session.further().shown().at(0)->meshes.back();
        ASSERT_EQ(mesh.colors.size(), mesh.vertices.size());
        std::array<int, 6> seen{};
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            const index::MeshVertex& vertex = mesh.vertices[i];
            const auto time =
                std::size_t(std::lround(mesh.colors[i] / 65534.0 * 5)); // step of a cell
            bool is_first = false;
            for (int around = 0; around < 4; ++around) {
                glm::ivec3 cell(vertex.x, vertex.y, vertex.z);
                cell[(vertex.axis + 1) % 3] -= around & 1;
                cell[(vertex.axis + 2) % 3] -= around >> 1;
                std::size_t first = 0;
                while (first < 6 && !is_active(cell, first))
                    ++first;
                is_first = is_first || first == time;
            }
            EXPECT_TRUE(is_first) << i;
            ++seen.at(time);
        }
        for (std::uint32_t each = 0; each < 6; ++each)
            EXPECT_EQ(seen[each] > 20, each <= step) << step << ' ' << each;
    }
    const auto timed = session.outputs().display().read_window().rgba;
    commands.isosurfaces->back().color = {1, 0, 0};
    frame(session, commands);
    frame(session);
    EXPECT_TRUE(session.outputs().display().read_window().rgba == timed)
        << "a color of its own counts no longer";
}

TEST_P(SessionFurther, AreMadeWhileLiveFramesGoOnAndArriveExactly) {
    Session session(config_with(kPlenty), both_, *context_);
    start(session);
    rest(session, 1, of_both());
    std::mt19937 random(test_seed());
    for (int i = 0; i < 40; ++i) {
        Commands commands = at_instant(Instant(static_cast<std::uint32_t>(random() % 6)));
        commands.picked = 1;
        commands.isovalue = 40 + static_cast<double>(random() % 40);
        rest(session, 1, commands);
        EXPECT_LE(session.further().shown().size(), 1u);
    }
    rest_until(session, [&](const FrameReport& report) {
        return report.final && !session.further().come();
    });
    ASSERT_THAT(session.further().shown(), SizeIs(1));
    const auto& made = *session.further().shown().front();
    EXPECT_EQ(made.query.instant, session.state().shown_instant());
    EXPECT_EQ(made.query.isovalues.back(), session.state().isovalue());
    EXPECT_TRUE(made.exact());
}

TEST_P(SessionFurther, AreUndoneSavedAndSettledAsOthersAre) {
    Session session(small_config(), both_, *context_);
    frame(session, asking({{.isovalue = 6}}));
    frame(session, of_both());
    EXPECT_THAT(session.further().shown(), SizeIs(1));
    const nlohmann::json saved = interaction::commands_json(session.state().as_commands());
    EXPECT_EQ(saved["isosurfaces"][1]["array"], "nearness");
    EXPECT_FALSE(saved["isosurfaces"][0].contains("array")) << "as earlier versions write it";
    Session resumed(small_config(), both_, *context_);
    ExplorerState state = resumed.state();
    EXPECT_TRUE(state.resume(interaction::commands_from(saved, "saved"), 6));
    resumed.set_state(state);
    frame(resumed);
    EXPECT_EQ(resumed.state(), session.state());
    EXPECT_THAT(resumed.further().shown(), SizeIs(1));
    ASSERT_TRUE(session.history().undo());
    frame(session, [&] {
        Commands back = *session.history().undo();
        back.undo = true;
        return back;
    }());
    EXPECT_THAT(session.state().isosurfaces, SizeIs(1));
    EXPECT_THAT(session.further().shown(), IsEmpty());
    // The shown array's own name says nothing more, and an unknown one shows nothing.
    frame(session,
          asking({{.isovalue = 6, .array = "distance"}, {.isovalue = 1, .array = "none"}}));
    EXPECT_EQ(session.state().isosurfaces[0].array, "");
    EXPECT_EQ(session.state().isosurfaces[1].array, "none");
    EXPECT_THAT(session.further().shown(), IsEmpty());
}

TEST_P(SessionFurther, AreTheSameInEveryReplay) {
    interaction::Recording recording;
    std::vector<std::vector<std::uint8_t>> seen;
    Session first(small_config(), both_, *context_);
    recording.header.start = first.state().as_commands();
    for (const Commands& commands :
         {of_both(), at_instant(Instant(1)), at_instant(Instant(3, 20'000)), of_both(5, 45, 1),
          at_instant(Instant(5)), asking({{.isovalue = 5}})}) {
        interaction::RecordedFrame one;
        one.input = head_at_rest(0.1 * static_cast<double>(recording.frames.size()));
        one.commands = commands;
        recording.frames.push_back(std::move(one));
    }
    for (int round = 0; round < 2; ++round) {
        Session session(small_config(), both_, *context_);
        std::size_t number = 0;
        replay_fixed_step(session, recording, {}, [&](std::size_t, const auto&) {
            EXPECT_FALSE(session.further().come());
            if (round == 0)
                seen.push_back(shown(session));
            else
                EXPECT_EQ(shown(session), seen[number]) << number;
            ++number;
        });
    }
    EXPECT_NE(seen[3], seen[5]);
}

TEST_P(SessionFurther, ArePickedAndExportedWithTheirOwnArray) {
    Session session(small_config(), both_, *context_);
    Commands both = of_both(6, 40, 1); // spheres with a radius of 10 about x 12, of 15 about x 15.5
    both.picked = 1;
    frame(session, both);
    ExplorerState state; // in the room as in the data
    state.isosurfaces = session.state().isosurfaces;
    state.picked = 1;
    Picker picker(both_);
    picker.set_further(shown_further(session.further().shown(), state, *both_));
    const interaction::Pose ray{
        {40.0f, 15.5f, 10.0f},
        glm::angleAxis(0.5f * std::numbers::pi_v<float>, glm::vec3(0, 1, 0))};
    const auto hit = picker.hit_by(ray, state, nullptr);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->surface, 1u);
    EXPECT_EQ(hit->point.array, "nearness");
    EXPECT_EQ(hit->point.unit, "%");
    EXPECT_EQ(hit->point.value, 40);
    EXPECT_NEAR(hit->point.position.x, 30.5, 0.3);
    EXPECT_TRUE(state.is_of_picked(hit->point));
    const index::ExportRequest request = shown_request(state, both_);
    ASSERT_THAT(request.surfaces, SizeIs(1));
    EXPECT_EQ(request.surfaces[0].isovalue, 40);
    EXPECT_EQ(request.surfaces[0].name, "nearness 40 %");
    ExplorerState other = state;
    other.picked = 0;
    EXPECT_EQ(shown_request(other, both_).surfaces.at(0).isovalue, 6);
}

TEST_P(SessionFurther, LoseThePiecesThatAreHiddenOnThem) {
    Session session(small_config(), both_, *context_);
    const auto cells = [&](const interaction::ShownPieces& pieces) {
        Commands commands = of_both(6, 60, 1);
        commands.pieces = pieces;
        frame(session, commands);
        return session.further().shown().at(0)->cells;
    };
    const std::uint64_t all = cells({});
    EXPECT_GT(all, 1000u);
    const std::uint64_t of_sphere = session.log().frames().back().cells;
    const glm::dvec3 on_it{25.5, 15.5, 10};
    EXPECT_EQ(cells({.only = {}, .hidden = {{1, on_it}}}), 0u);
    EXPECT_EQ(session.log().frames().back().cells, of_sphere);
    EXPECT_EQ(cells({.only = {{1, on_it}}, .hidden = {}}), all);
    EXPECT_EQ(cells({.only = {}, .hidden = {{0, {22, 15.5, 15.5}}}}), all);
    EXPECT_EQ(session.log().frames().back().cells, 0u);
    EXPECT_EQ(cells({.only = {}, .hidden = {}, .dust = 100'000}), 0u);
}

TEST_P(SessionFurther, AreInLinksBesideWhatAPageShows) {
    ExplorerState state;
    state.isosurfaces = *of_both(6, 60).isosurfaces;
    state.picked = 1;
    const LinkScreen screen{
        {.lower_left = {-1, 1, -1}, .upper_left = {-1, 2, -1}, .upper_right = {1, 2, -1}},
        {{0, 1.5f, 0}, {1, 0, 0, 0}},
        {800, 400}};
    const std::string link = link_to("http://h/a.isochron", state, *both_, screen);
    EXPECT_THAT(link, testing::HasSubstr("isovalue=6&"));
    const ExplorerState read =
        as_linked({}, index::settings_of_link(index::address_of(link)), *both_, screen);
    ASSERT_THAT(read.isosurfaces, SizeIs(2));
    EXPECT_EQ(read.isosurfaces[0].isovalue, 6);
    EXPECT_EQ(read.isosurfaces[1].isovalue, 60);
    EXPECT_EQ(read.isosurfaces[1].array, "nearness");
    EXPECT_EQ(read.isosurfaces[1].opacity, 0.5f);
}

} // namespace
} // namespace isochron::app
