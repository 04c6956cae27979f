// Every text of the panel can be read: none is cut, lies on another one, or fades into what is
// behind it, in any size of the window and in both themes.
#include "tests/app/panel/drawn_text.h"

#include "app/panel/imgui/panel_layer.h"
#include "interaction/controls/controls.h"
#include "stereo/context/gl_context.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Background;
using interaction::Key;
using interaction::KeyEvent;
using interaction::MouseButton;
using interaction::MouseButtonEvent;
using interaction::MouseMoveEvent;
using interaction::WindowEvent;

struct Shape {
    glm::ivec2 size;
    float scale;
    PanelPlace place = PanelPlace::over;
};
void PrintTo(const Shape& shape, std::ostream* out) {
    *out << shape.size.x << " x " << shape.size.y << " at " << shape.scale << ", place "
         << static_cast<int>(shape.place);
}

class LegiblePanel : public testing::TestWithParam<Shape> {
  protected:
    LegiblePanel() {
        for (int step = 0; step < 64; ++step)
            info_.times.push_back(0.2 * step);
        info_.grid.vertices = {64, 64, 64};
        info_.array = "vorticity";
        info_.value_unit = "1/s";
        info_.time_unit = "s";
        info_.length_unit = "m";
        stats_.low = 0.017;
        stats_.high = 40.25;
        for (std::uint64_t bin = 0; bin < 256; ++bin)
            stats_.histogram.push_back(1 + 7 * bin * (256 - bin));
        asked_.panel = true;
        asked_.set_isovalue(9.21);
        report_.shown = index::SurfacesQuery{index::Instant(0), {9.21}};
        report_.footprint = render::Footprint::surface;
        report_.final = true;
    }

    PanelModel model() {
        return {.place = GetParam().place,
                .info = info_,
                .stats = stats_,
                .asked = asked_,
                .frame = report_,
                .gaps = gaps_,
                .arrays = {.names = arrays_, .lines = lines_, .color_names = arrays_},
                .colors = {.range = {0.0, 40.0}},
                .work = {.at_hand_steps = {3, 4, 5, 6, 20}},
                .notes = notes_,
                .recording = recording_,
                .movies = {.offered = true, .recorded = true},
                .sessions = sessions_,
                .controls = controls_,
                .at_hand = {interaction::DeviceKind::mouse, interaction::DeviceKind::keyboard}};
    }
    void frame(const std::vector<WindowEvent>& events = {}) {
        layer_.feed(events, true);
        time_ += interaction::Seconds(0.1);
        layer_.lay_out(GetParam().size, model(), time_);
    }
    void click(glm::vec2 at) {
        const glm::vec2 part = at / (glm::vec2(GetParam().size) / GetParam().scale);
        frame({MouseMoveEvent{part.x, part.y, 100, 100}});
        frame({MouseButtonEvent{MouseButton::left, true}});
        frame({MouseButtonEvent{MouseButton::left, false}});
        frame({MouseMoveEvent{-1, -1, 100, 100}});
        frame();
    }
    /// Lays out a few frames in each theme, and reads them.
    /// @param page a page lies over other parts, which it may hide
    void expect_legible(const std::string& what, bool page = false) {
        for (const Background background : {Background::dark, Background::light}) {
            asked_.look.background = background;
            for (int i = 0; i < 5; ++i) // windows take some to know their size
                frame();
            const ImFont& font = *ImGui::GetIO().Fonts->Fonts.front();
            const ReadText read = read_text(*ImGui::GetDrawData(), font);
            EXPECT_GT(read.runs, 3u) << what;
            for (const TextFault& fault : read.faults)
                if (!page || fault.fault != kHidden)
                    ADD_FAILURE() << what << ", " << interaction::name_of(background) << ": '"
                                  << fault.text << "' " << fault.fault << " (" << fault.window
                                  << ")";
        }
    }
    /// The sections, one after the other where they are folded.
    void expect_legible_sections(const std::string& what) {
        expect_legible(what);
        const PanelLayout layout = layer_.layout();
        if (GetParam().place == PanelPlace::in_room)
            for (int page = 0; page < 4; ++page) {
                click({50.0f + 100.0f * static_cast<float>(page), layout.column.low.y + 20});
                expect_legible(fmt::format("{}, page {}", what, page));
            }
        if (!layout.folded)
            return;
        for (int icon = 0; icon < 4; ++icon) {
            const glm::vec2 at(20, layout.column.low.y + 20 + 33 * static_cast<float>(icon));
            click(at);
            expect_legible(fmt::format("{}, section {}", what, icon));
            click(at);
        }
    }
    std::unique_ptr<stereo::GlContext> context_ =
        stereo::make_context(stereo::ContextKind::egl, {.size = {64, 64}});
    render::Gl gl_{context_->loader()};
    PanelLayer layer_{gl_, GetParam().scale};
    index::SeriesInfo info_;
    index::IndexStats stats_;
    ExplorerState asked_;
    FrameReport report_;
    std::vector<std::uint32_t> gaps_;
    PanelNotes notes_;
    bool recording_ = false;
    std::vector<std::string> arrays_{"vorticity"};
    std::vector<ListedArray> lines_{
        {"vorticity", "64 x 64 x 64, 64 steps", "1/s", "0.017 to 40.25", ""},
        {"a rather long name of an array, as files have them", "64 x 64 x 64, 64 steps",
         "kg m-1 s-2", "-1.234e+05 to 9.876e+05", ""}};
    std::vector<OfferedSession> sessions_;
    std::vector<interaction::ControlGroup> controls_ = interaction::Controls::documentation();
    interaction::Seconds time_{0};
};

class LegiblePanelOverAPicture : public LegiblePanel {};

TEST_P(LegiblePanel, AsItOpens) {
    expect_legible_sections("at first");
    asked_.instant = index::Instant(63);
    info_.time_unit = "hours since 2009-09-09 17:00";
    expect_legible("with dates");
}

TEST_P(LegiblePanel, WhereStepsAreBlendedAndAGapIsHeld) {
    asked_.between = interaction::BetweenSteps::blend;
    gaps_ = {11, 12, 40};
    asked_.instant = index::Instant(11);
    expect_legible_sections("with a gap");
    asked_.instant.fraction = index::Instant::kFractions / 3;
    expect_legible("between steps");
}

TEST_P(LegiblePanel, WithSeveralSurfacesAndAColorMap) {
    arrays_ = {"vorticity", "a rather long name of an array, as files have them", "pressure"};
    info_.value_unit = "kg m-1 s-2";
    asked_.isosurfaces = {{1.25, {0.9f, 0.6f, 0.0f}, 0.45f},
                          {10.123456, {0.34f, 0.7f, 0.9f}, 1.0f},
                          {33.5, {0.0f, 0.62f, 0.45f}, 0.0f}};
    asked_.picked = 1;
    asked_.coloring.by = interaction::ColorBy::value;
    expect_legible_sections("with a map");
    asked_.coloring.range = {0.0, 40.0};
    asked_.coloring.bands = 7;
    expect_legible_sections("with a range of its own");
    asked_.set_isovalue(100);
    asked_.stereo = "side_by_side";
    expect_legible_sections("out of the range");
}

TEST_P(LegiblePanel, WithWhatToolsHaveMade) {
    asked_.tools.mouse = asked_.tools.wand = interaction::ToolKind::clip;
    asked_.clip.shown = true;
    asked_.rulers.list = {{.name = "1", .places = {{1, 2, 3}, {2, 3, 4}}},
                          {.name = "2", .places = {{1, 2, 3}}, .angle = true}};
    asked_.marks = {{"eye of the storm", {.instant = {}, .value = 12.25}}};
    asked_.mark.point = interaction::MarkedPoint{{1.5, 2.5, 3.5}, {}, 12.25};
    expect_legible_sections("with tools");
}

TEST_P(LegiblePanel, WithMessages) {
    notes_.failure = "/data/flow.isochron: block 17 cannot be read: Input/output error";
    const std::array<PastMessage, 2> past{
        {{"14:05:09", "stereo: side_by_side"},
         {"14:06:10", "saved /home/somebody/a rather long name of a folder, as disks have "
                      "them/isochron_0001.png"}}};
    notes_.past = past;
    notes_.messages = 1;
    expect_legible("with messages");
    if (GetParam().place == PanelPlace::in_room)
        return;
    layer_.pages().open_messages();
    expect_legible("with all messages", true);
    notes_.past = {};
}

TEST_P(LegiblePanelOverAPicture, WithStatistics) {
    report_.footprint = render::Footprint::gaussian;
    report_.final = false;
    report_.candidates = 123456;
    frame();
    click(layer_.layout().picture.low + glm::vec2(30, 22));
    expect_legible("with statistics");
}

TEST_P(LegiblePanel, WithItsPages) {
    if (GetParam().place == PanelPlace::in_room) {
        frame();
        layer_.pages().open_search();
        expect_legible("with the search", true);
        layer_.pages().close_search();
        layer_.pages().open_arrays();
        return expect_legible("with the arrays", true);
    }
    layer_.pages().offer_arrays({{"velocity.magnitude", "128 x 128 x 64, 20 steps", "m/s", "", ""},
                                 {"phase", "", "", "", "complex values cannot be shown"}});
    frame();
    layer_.pages().open_arrays();
    expect_legible("with the arrays", true);
    frame({KeyEvent{Key::escape, true}, KeyEvent{Key::escape, false}});
    constexpr auto kControl = static_cast<std::uint8_t>(interaction::Modifier::control);
    frame({KeyEvent{Key{'K'}, true, kControl}, KeyEvent{Key{'K'}, false, kControl}});
    expect_legible("with the search", true);
    frame({KeyEvent{Key::escape, true}, KeyEvent{Key::escape, false}});
    frame({KeyEvent{Key::f1, true}, KeyEvent{Key::f1, false}});
    expect_legible("with help", true);
    frame({KeyEvent{Key::f1, true}, KeyEvent{Key::f1, false}});
    layer_.pages().introduce();
    expect_legible("with the introduction");
}

/// Whatever button opens a menu, in the bars above and below.
TEST_P(LegiblePanel, WithTheMenusOfItsBars) {
    asked_.bookmarks = {{"first maximum", index::Instant(3)}, {"later", index::Instant(40)}};
    asked_.pictures.width = 1920;
    asked_.pictures.height = 1080;
    asked_.play_range = {3, 50};
    frame();
    const PanelLayout layout = layer_.layout();
    int menus = 0;
    const auto press_along = [&](float y) {
        for (float x = 20; x < layout.time.high.x - 10; x += 14) {
            click({x, y});
            if (ImGui::GetCurrentContext()->OpenPopupStack.Size > 0) {
                ++menus;
                expect_legible(fmt::format("with the menu at {}, {}", x, y), true);
            }
            frame({KeyEvent{Key::escape, true}, KeyEvent{Key::escape, false}});
            frame();
            frame({KeyEvent{Key::escape, true}, KeyEvent{Key::escape, false}});
            frame();
        }
    };
    press_along((layout.top.low.y + layout.top.high.y) / 2);
    press_along(layout.two_rows ? layout.time.low.y + 17
                                : (layout.time.low.y + layout.time.high.y) / 2);
    EXPECT_GE(menus, 3);
}

TEST_P(LegiblePanelOverAPicture, WithTheTourAndTheOfferOfTheSessionBefore) {
    sessions_ = {{.words = "draft, 2026-11-28 10:00:00"}, {.words = "2026-11-27 09:00:00"}};
    layer_.pages().offer_earlier();
    layer_.pages().introduce();
    expect_legible("with the offers");
    layer_.pages().ask_session_name();
    expect_legible("with the question for a name");
}

const auto kOver =
    testing::Values(Shape{{640, 480}, 1}, Shape{{1280, 800}, 1}, Shape{{2560, 1440}, 2});
INSTANTIATE_TEST_SUITE_P(Shapes, LegiblePanelOverAPicture, kOver);
INSTANTIATE_TEST_SUITE_P(Shapes, LegiblePanel, kOver);
INSTANTIATE_TEST_SUITE_P(OtherShapes, LegiblePanel,
                         testing::Values(Shape{{480, 900}, 1, PanelPlace::whole},
                                         Shape{{1000, 1350}, 2.5f, PanelPlace::in_room}));

} // namespace
} // namespace isochron::app
