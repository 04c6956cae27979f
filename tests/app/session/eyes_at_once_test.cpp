// Both eyes' cells in one draw if the driver can, else in two; the pictures are the same.
#include "render/gl/driver_trials.h"
#include "tests/support/drawing/context_in_between.h"
#include "tests/support/drawing/golden_fixture.h"

#include <array>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

/// Instances of a draw by how many vertices each has; lines and text draw one instance.
using Draws = std::multimap<GLsizei, GLsizei>;

/// What stands between the program and the driver. GL's functions have no room for state.
struct Driver {
    PFNGLGETSTRINGPROC string = nullptr;
    PFNGLGETSTRINGIPROC strings = nullptr;
    PFNGLDRAWELEMENTSINSTANCEDBASEVERTEXPROC elements = nullptr;
    PFNGLDRAWARRAYSINSTANCEDPROC arrays = nullptr;
    bool chooses_viewports = true;
    bool is_gpu = true; ///< by its own account; software GL draws what is seen, eye by eye
    Draws draws;
    int points = 0; ///< draws of points
} driver;

const GLubyte* APIENTRY name_of_renderer(GLenum name) {
    return name == GL_RENDERER && driver.is_gpu ? reinterpret_cast<const GLubyte*>("a GPU")
                                                : driver.string(name);
}

const GLubyte* APIENTRY extensions(GLenum name, GLuint index) {
    const GLubyte* text = driver.strings(name, index);
    const bool hidden = std::string_view(reinterpret_cast<const char*>(text)) ==
                        "GL_ARB_shader_viewport_layer_array";
    return hidden && !driver.chooses_viewports
               ? reinterpret_cast<const GLubyte*>("GL_of_another_driver")
               : text;
}
void APIENTRY draw_elements(GLenum mode, GLsizei count, GLenum type, const void* indices,
                            GLsizei instances, GLint base) {
    driver.draws.emplace(count, instances);
    driver.elements(mode, count, type, indices, instances, base);
}
void APIENTRY draw_arrays(GLenum mode, GLint first, GLsizei count, GLsizei instances) {
    driver.draws.emplace(count, instances);
    driver.points += mode == GL_POINTS;
    driver.arrays(mode, first, count, instances);
}

/// A context whose draws are counted and that can be one of a lesser driver.
class WatchedContext final : public stereo::ContextInBetween {
  public:
    WatchedContext(stereo::ContextKind kind, bool chooses_viewports, bool is_gpu = true)
        : ContextInBetween(kind, kPicture, [](std::string_view wanted, void* found) {
              if (wanted == "glGetString")
                  return stereo::before(found, driver.string, &name_of_renderer);
              if (wanted == "glGetStringi")
                  return stereo::before(found, driver.strings, &extensions);
              if (wanted == "glDrawElementsInstancedBaseVertex")
                  return stereo::before(found, driver.elements, &draw_elements);
              if (wanted == "glDrawArraysInstanced")
                  return stereo::before(found, driver.arrays, &draw_arrays);
              return found;
          }) {
        driver = {.chooses_viewports = chooses_viewports, .is_gpu = is_gpu, .draws = {}};
    }
};

/// The instances of the draws of all cells, quad by quad or point by point.
std::vector<GLsizei> cell_draws(std::uint64_t cells) {
    std::vector<GLsizei> instances;
    for (const auto& [count, drawn] : driver.draws)
        if (count == static_cast<GLsizei>(cells) || count == static_cast<GLsizei>(6 * cells))
            instances.push_back(drawn);
    return instances;
}

class EyesAtOnce : public GoldenPictures {
  protected:
    Config config_for(Footprint footprint) const {
        Config config = one_window(StereoMode::mono);
        config.rendering.drawn_by = render::DrawnBy::gpu;
        config.quality.settled = footprint;
        return config;
    }
    Commands commands_for(Footprint footprint) const {
        Commands commands = showing(kPlacement);
        if (footprint == Footprint::quad)
            commands.quality = interaction::QualityMode::fast;
        return commands;
    }
    /// Every mode's window, and the right buffer of those that have one.
    std::vector<std::pair<std::string, Image>> windows_of(Footprint footprint,
                                                          bool chooses_viewports) {
        WatchedContext context(GetParam(), chooses_viewports);
        Session session(config_for(footprint), file_, context);
        Commands commands = commands_for(footprint);
        std::vector<std::pair<std::string, Image>> windows;
        for (const StereoMode mode : stereo::all_stereo_modes()) {
            commands.stereo = name_of(mode);
            EXPECT_EQ(settle(session, commands), footprint);
            const std::string name =
                std::string(render::name_of(footprint)) + "_" + std::string(name_of(mode));
            windows.emplace_back(name, session.outputs().display().read_window());
            if (upright(mode) == StereoMode::quadbuffer)
                windows.emplace_back(name + "_right",
                                     session.outputs().display().read_right_buffer());
        }
        return windows;
    }
};

constexpr std::array kFootprints{Footprint::quad, Footprint::gaussian, Footprint::surface};

TEST_P(EyesAtOnce, DrawTheirCellsInOneDrawOrOneAfterTheOtherWhereTheDriverCannot) {
    for (const bool chooses_viewports : {true, false})
        for (const Footprint footprint : kFootprints) {
            SCOPED_TRACE(testing::Message()
                         << render::name_of(footprint) << ", at once " << chooses_viewports);
            WatchedContext context(GetParam(), chooses_viewports);
            Session session(config_for(footprint), file_, context);
            // Not every driver that says so can.
            const bool at_once = render::draws_to_two_viewports(session.outputs().gl());
            EXPECT_TRUE(chooses_viewports || !at_once);
            Commands commands = commands_for(footprint);
            for (const StereoMode mode : stereo::all_stereo_modes()) {
                commands.stereo = name_of(mode);
                settle(session, commands);
                driver.draws.clear();
                Commands aside; // the picture changes, so it is drawn
                aside.room_from_physical =
                    place_at({0.12, 1.75, -2.5 - 0.01 * (1 + static_cast<int>(mode))}, 0.039);
                const FrameReport& frame =
                    session.frame(head_at_rest(frame_++ / 60.0), aside, Waiting::for_cells);
                ASSERT_TRUE(frame.redrawn);
                const bool two = eyes_of(mode).size() == 2;
                const std::vector<GLsizei> expected =
                    two && at_once ? std::vector<GLsizei>{2} : std::vector<GLsizei>(two ? 2 : 1, 1);
                EXPECT_EQ(cell_draws(frame.cells), expected) << name_of(mode);
            }
        }
}

TEST_P(EyesAtOnce, HaveTheirQuadsDrawnApartBySoftware) {
    WatchedContext context(GetParam(), true, false);
    Config config = config_for(Footprint::quad);
    config.rendering.drawn_by = render::DrawnBy::processor;
    Session session(config, file_, context);
    Commands commands = commands_for(Footprint::quad);
    for (const StereoMode mode : {StereoMode::mono, StereoMode::side_by_side}) {
        commands.stereo = name_of(mode);
        settle(session, commands);
        driver.points = 0;
        Commands aside;
        aside.room_from_physical =
            place_at({0.12, 1.75, -2.5 - 0.01 * (1 + static_cast<int>(mode))}, 0.039);
        ASSERT_TRUE(
            session.frame(head_at_rest(frame_++ / 60.0), aside, Waiting::for_cells).redrawn);
        EXPECT_EQ(driver.points, static_cast<int>(eyes_of(mode).size()));
    }
}

/// Another program, another rounding of what is blended, which Dubois' matrices carry a step
/// further.
constexpr ImageTolerance kRounding{.maximum = 2, .mean = 0.001};

TEST_P(EyesAtOnce, LookAsTheyDoOneAfterTheOther) {
    for (const Footprint footprint : kFootprints) {
        const auto at_once = windows_of(footprint, true);
        const auto apart = windows_of(footprint, false);
        ASSERT_EQ(at_once.size(), apart.size());
        for (std::size_t i = 0; i < at_once.size(); ++i)
            EXPECT_TRUE(test_support::images_match(at_once[i].second, apart[i].second, kRounding,
                                                   "at_once_" + at_once[i].first));
    }
}

INSTANTIATE_TEST_SUITE_P(, EyesAtOnce,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

} // namespace
} // namespace isochron::app
