// Models in a session: what they hide and what hides them, which files are opened, and replays.
#include "app/loop/replay.h"
#include "interaction/navigation/navigation.h"
#include "tests/interaction/input_builders.h"
#include "tests/support/session_fixture.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <filesystem>
#include <map>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Model;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A plate in the plane x = 12, through the middle of the sphere of radius 7 around (12, 15.5, 15.5).
constexpr double kPlateX = 12, kPlateLow = 6, kPlateHigh = 30;
const char* const kPlate = "v 12 6 6\nv 12 30 6\nv 12 30 30\nv 12 6 30\nf 1 2 3 4\n";

class SessionModels : public SessionTest {
  protected:
    SessionModels() { folder_.write("plate.obj", kPlate); }

    static Config plain() {
        Config config = small_config(stereo::StereoMode::mono);
        config.start.bounding_box = false;
        return config;
    }
    /// A blue surface, a red model.
    static Commands shown(const std::string& path, interaction::QualityMode quality) {
        Commands commands;
        commands.isosurfaces = {{9.0, {0.0f, 0.0f, 1.0f}, 1.0f}};
        commands.models = {{.path = path, .color = {1.0f, 0.0f, 0.0f}}};
        commands.quality = quality;
        return commands;
    }
    /// Frames until the head is at rest for long.
    render::Image settled(Session& session, const Commands& commands) {
        for (int i = 0; i < 4; ++i) {
            session.frame(head_at_rest(time_), i == 0 ? commands : Commands(), Waiting::for_cells);
            time_ += 0.5;
        }
        return session.outputs().display().read_eye(stereo::Eye::center);
    }
    std::vector<std::string> faults(const std::string& path) {
        Session session(plain(), file_, *context_);
        session.frame(head_at_rest(0), shown(path, interaction::QualityMode::fast),
                      Waiting::for_cells);
        return session.models().faults();
    }
    double time_ = 0;
};

/// What is seen first on the way through a pixel: by arithmetic, with the matrices of the view.
enum class Seen { nothing, surface, model, surface_before_model, model_before_surface, unsure };
Seen seen_at(const render::View& view, const interaction::Similarity& place, glm::dvec2 pixel) {
    const glm::dmat4 room_from_clip =
        glm::inverse(glm::dmat4(view.clip_from_eye) * glm::dmat4(view.eye_from_room));
    const glm::dvec2 at = 2.0 * (pixel + 0.5) / glm::dvec2(view.size) - 1.0;
    const glm::dvec4 far = room_from_clip * glm::dvec4(at.x, -at.y, 1, 1);
    const glm::dvec3 from = interaction::in_physical(place, glm::dvec3(view.eye_in_room()));
    const glm::dvec3 way =
        glm::normalize(interaction::in_physical(place, glm::dvec3(far) / far.w) - from);
    constexpr double kUnsure = 1.2; // [voxel] for quads, which are flat
    double sphere = 1e9, plate = 1e9;
    bool unsure = false;
    const glm::dvec3 to = glm::dvec3(12, 15.5, 15.5) - from;
    const double along = glm::dot(to, way), beside = glm::length(to - along * way);
    if (beside < 7)
        sphere = along - std::sqrt(49 - beside * beside);
    unsure |= std::abs(beside - 7) < kUnsure;
    const double reach = (kPlateX - from.x) / way.x;
    const glm::dvec3 hit = from + reach * way;
    const double inside =
        std::min(std::min(hit.y, hit.z) - kPlateLow, kPlateHigh - std::max(hit.y, hit.z));
    if (reach > 0 && inside > 0)
        plate = reach;
    unsure |= reach > 0 && std::abs(inside) < kUnsure;
    unsure |= std::abs(sphere - plate) < kUnsure && sphere < 1e9;
    if (unsure)
        return Seen::unsure;
    const bool both = std::max(sphere, plate) < 1e9;
    if (std::min(sphere, plate) >= 1e9)
        return Seen::nothing;
    return sphere < plate ? (both ? Seen::surface_before_model : Seen::surface)
                          : (both ? Seen::model_before_surface : Seen::model);
}

TEST_P(SessionModels, HideTheSurfaceAndAreHiddenByItAtTheRightPixels) {
    using interaction::QualityMode;
    for (const QualityMode quality : {QualityMode::fast, QualityMode::quality}) {
        Session session(plain(), file_, *context_);
        Commands commands = shown("plate.obj", quality);
        interaction::Similarity place = session.state().room_from_physical;
        const glm::dvec3 middle = interaction::transform(place, glm::dvec3(15.5));
        commands.room_from_physical =
            interaction::turned(place, middle, {0, 1, 0}, 0.4); // sides of the plate
        const render::Image image = settled(session, commands);
        EXPECT_THAT(session.models().faults(), IsEmpty());
        const auto views =
            session.outputs().display().views_in_window(session.outputs().audience().viewers);
        ASSERT_EQ(views.size(), 1u);
        std::map<Seen, int> count, wrong;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const Seen expected =
                    seen_at(views[0], session.state().room_from_physical, glm::dvec2(x, y));
                const auto* pixel = image.at(x, y);
                const int excess = pixel[0] - pixel[2];
                const bool red = excess > 25, blue = excess < -25;
                ++count[expected];
                wrong[expected] +=
                    red != (expected == Seen::model || expected == Seen::model_before_surface) ||
                    blue != (expected == Seen::surface || expected == Seen::surface_before_model);
            }
        for (const Seen each : {Seen::nothing, Seen::surface, Seen::model,
                                Seen::surface_before_model, Seen::model_before_surface}) {
            EXPECT_GT(count[each], 20) << static_cast<int>(each);
            EXPECT_EQ(wrong[each], 0) << static_cast<int>(each) << name_of(quality);
        }
    }
}

TEST_P(SessionModels, OfOthersAreOpenedInTheirFoldersAlone) {
    const TestFolder elsewhere;
    const std::string outside = elsewhere.write("hull.obj", kPlate).string();
    std::filesystem::create_directory(folder_.path() / "deep");
    folder_.write("deep/hull.obj", kPlate);
    std::filesystem::create_symlink(outside, folder_.path() / "link.obj");
    const std::string around =
        std::filesystem::path(outside).lexically_relative(folder_.path()).string();
    for (const std::string& good :
         {std::string("plate.obj"), std::string("deep/hull.obj"), std::string("deep/../plate.obj"),
          (folder_.path() / "plate.obj").string()})
        EXPECT_THAT(faults(good), IsEmpty()) << good;
    for (const std::string& bad :
         {outside, around, std::string("link.obj"), std::string("/etc/passwd")})
        EXPECT_THAT(faults(bad), ElementsAre(HasSubstr("not opened: it lies outside"))) << bad;
    EXPECT_THAT(faults("https://a.b/hull.obj"), ElementsAre(HasSubstr("expected a file")));
    EXPECT_THAT(faults("gone.obj"), ElementsAre(HasSubstr("there is no such file")));
    EXPECT_THAT(faults("sphere.isochron"), ElementsAre(HasSubstr("expected .stl")));

    Session session(plain(), file_, *context_);
    const auto opened = [&] {
        session.frame(head_at_rest(time_ += 0.1), {}, Waiting::for_cells);
        return session.models().shown(session.state()).size();
    };
    session.frame(head_at_rest(0), shown(outside, interaction::QualityMode::fast),
                  Waiting::for_cells);
    EXPECT_EQ(opened(), 0u);
    EXPECT_TRUE(session.models().listed(session.state())[0].refused);
    EXPECT_EQ(session.models().allow(outside), outside); // as its eye in the panel does
    ASSERT_EQ(opened(), 1u);
    const auto seen = session.models().shown(session.state());
    EXPECT_EQ(session.models().listed(session.state())[0].box, index::bounds(*seen[0].mesh));
    session.models().add_folder(elsewhere.path());
    EXPECT_EQ(session.models().allow(folder_.path() / "deep/hull.obj"), "deep/hull.obj");
}

TEST_P(SessionModels, OfASeriesAreThoseOfTheStep) {
    for (int i = 0; i < 6; ++i) // in natural order: hull_8 to hull_13
        folder_.write(fmt::format("hull_{}.obj", i + 8),
                      fmt::format("v {0} 0 0\nv {0} 9 0\nv {0} 0 9\nf 1 2 3\n", 3 * i));
    for (const char* name : {"hull_*.obj", "hull_%02d.obj"}) {
        Session session(plain(), file_, *context_);
        session.frame(head_at_rest(0), shown(name, interaction::QualityMode::fast),
                      Waiting::for_cells);
        for (const std::uint32_t step : {0u, 5u, 2u}) {
            Commands commands;
            commands.instant = index::Instant(step);
            session.frame(head_at_rest(1 + step), commands, Waiting::for_cells);
            const auto models = session.models().shown(session.state());
            ASSERT_EQ(models.size(), 1u) << name;
            EXPECT_EQ(index::bounds(*models[0].mesh)[0].x, 3.0 * step);
        }
    }
    folder_.write("hull_14.obj", kPlate);
    EXPECT_THAT(faults("hull_*.obj"), ElementsAre(HasSubstr("7 files, expected 6")));
    std::filesystem::remove(folder_.path() / "hull_14.obj");
    std::filesystem::remove(folder_.path() / "hull_8.obj");
    std::filesystem::create_symlink("/etc/passwd", folder_.path() / "hull_8.obj");
    EXPECT_THAT(faults("hull_*.obj"), ElementsAre(HasSubstr("is a link")));
}

TEST_P(SessionModels, ReplayAlikeAndComeBackByUndo) {
    interaction::Recording recording;
    for (int i = 0; i < 8; ++i) {
        interaction::RecordedFrame frame;
        frame.input = head_at_rest(0.5 * i);
        if (i == 0)
            frame.commands = shown("plate.obj", interaction::QualityMode::quality);
        if (i == 4)
            frame.commands.models = std::vector<Model>();
        if (i == 6)
            frame.commands.models = shown("plate.obj", interaction::QualityMode::quality).models;
        recording.frames.push_back(frame);
    }
    std::vector<std::vector<std::uint8_t>> pictures[2];
    for (auto& run : pictures) {
        Session session(plain(), file_, *context_);
        replay_fixed_step(session, recording, {}, [&](std::size_t, const auto&) {
            run.push_back(session.outputs().display().read_eye(stereo::Eye::center).rgba);
        });
    }
    EXPECT_EQ(pictures[0], pictures[1]);
    EXPECT_NE(pictures[0][3], pictures[0][5]);
    EXPECT_EQ(pictures[0][3], pictures[0][7]);

    Session session(plain(), file_, *context_);
    session.frame(head_at_rest(0), shown("plate.obj", interaction::QualityMode::fast),
                  Waiting::for_cells);
    const auto before = session.state().models;
    Commands gone;
    gone.models = std::vector<Model>();
    session.frame(head_at_rest(1), gone, Waiting::for_cells);
    ASSERT_NE(session.history().undo(), nullptr);
    session.frame(head_at_rest(2), *session.history().undo(), Waiting::for_cells);
    EXPECT_EQ(session.state().models, before);
    EXPECT_EQ(session.models().shown(session.state()).size(), 1u);
}

TEST_P(SessionModels, AreTakenIntoTheFirstViewUnlessTheyLieFarAway) {
    folder_.write("wide.obj", "v -64 0 0\nv 95 0 0\nv 0 31 31\nf 1 2 3\n");
    folder_.write("far.obj", "v 1e6 0 0\nv 1000001 0 0\nv 1e6 1 0\nf 1 2 3\n");
    for (const bool far : {false, true}) {
        Session session(plain(), file_, *context_);
        session.frame(head_at_rest(0),
                      shown(far ? "far.obj" : "wide.obj", interaction::QualityMode::fast),
                      Waiting::for_cells);
        const auto home = session.state().room_from_physical;
        session.commands_from(head_at_rest(0.5));
        interaction::InputState keys = head_at_rest(1);
        keys.devices.push_back(interaction::keys_down(bit(interaction::Action::reset)));
        const Commands reset = session.commands_from(keys);
        if (far) {
            EXPECT_FALSE(reset.room_from_physical && reset.room_from_physical->scale < home.scale);
            continue;
        }
        ASSERT_TRUE(reset.room_from_physical);
        const double data = 31 * std::sqrt(3.0), all = std::sqrt(159.0 * 159 + 2 * 31 * 31);
        EXPECT_NEAR(reset.room_from_physical->scale, home.scale * data / all, 1e-9);
        EXPECT_FALSE(reset.models); // they stay
    }
}

INSTANTIATE_TEST_SUITE_P(Contexts, SessionModels, testing::Values(stereo::ContextKind::egl),
                         context_name);

} // namespace
} // namespace isochron::app
