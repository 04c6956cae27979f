// Every tool of the table, by every means: put, moved, removed, undone, recorded and replayed.
//
// The suite goes over the table of tools and over the lines of the search, so that a further tool is
// tested without a line here.
#include "app/loop/replay.h"
#include "app/panel/imgui/panel_layer.h"
#include "app/panel/search_table.h"
#include "interaction/controls/action_table.h"
#include "interaction/controls/desktop_emulation.h"
#include "interaction/navigation/navigation.h"
#include "interaction/tools/tool_table.h"
#include "stereo/screen.h"
#include "stereo/windows.h"
#include "tests/support/played_fixture.h"
#include "tests/support/session_fixture.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace isochron::app {
namespace {

using interaction::Action;
using interaction::Commands;
using interaction::InputState;
using interaction::Key;
using interaction::KeyEvent;
using interaction::Pose;
using interaction::Settings;
using interaction::ToolKind;
using interaction::ToolRow;
using interaction::WindowEvent;

enum class Means : std::uint8_t {
    mouse,   ///< in a window
    wand,    ///< tracked, in an emulated CAVE
    headset, ///< a controller, through an OpenXR runtime
    search   ///< Ctrl+K, and where nothing is found there, Enter
};
constexpr std::array<const char*, 4> kMeans{"mouse", "wand", "headset", "search"};

constexpr double kIsovalue = 8;             ///< a sphere of 8 mm
const glm::dvec3 kMiddle(12.0, 15.5, 15.5); ///< its middle at the first step
const glm::dvec3 kPlaceA = kMiddle + glm::dvec3(-2, 1, 0), kPlaceB = kMiddle + glm::dvec3(3, -3, 0);
const Pose kHand{{0.25f, 1.2f, -0.3f}, {1, 0, 0, 0}};

/// A session that records itself, as the explorer does it, but for the clock.
class Rig {
  public:
    virtual ~Rig() = default;
    virtual Session& session() = 0;
    /// Such an installation without a user, for a replay.
    virtual std::unique_ptr<Session> another() = 0;
    virtual void aim(const glm::dvec3& physical) = 0;
    virtual void press(bool down) = 0;
    virtual void tap(Action action) = 0;
    virtual render::Image picture(Session& of) = 0;

    PanelModel panel_model() {
        return {.info = file_->info(),
                .stats = file_->stats(),
                .data = data_,
                .asked = session().state(),
                .frame = report_,
                .controls = controls_};
    }
    /// What the key of an action leads to at once.
    Commands effect_of(Action action) {
        Commands commands;
        std::vector<std::string> notes;
        const interaction::ControlContext context{.settings = state(), .data = data_};
        for (const interaction::KeyLine& line : interaction::key_lines())
            for (const interaction::ActionRow& row : line.actions)
                if (row.action == action && row.effect)
                    row.effect({context, commands, notes});
        return commands;
    }

    /// @param asked by a panel, or by a page of it
    void frame(const Commands& asked = {}) {
        now_ += interaction::Seconds(1.0 / 30);
        interaction::RecordedFrame frame;
        frame.input = poll(now_);
        frame.commands = session().commands_from(frame.input);
        frame.from_panel = session().take_panel_commands();
        merge(frame.from_panel, asked);
        merge(frame.from_panel, from_page());
        merge(frame.commands, frame.from_panel);
        session().frame(frame.input, frame.commands, Waiting::for_cells);
        recording.frames.push_back(std::move(frame));
    }
    void click(const glm::dvec3& physical) {
        aim(physical);
        frame();
        press(true);
        frame();
        press(false);
        frame();
    }
    void drag(const glm::dvec3& from, const glm::dvec3& to) {
        aim(from);
        frame();
        press(true);
        frame();
        for (const double part : {0.25, 0.5, 0.75, 1.0}) {
            aim(glm::mix(from, to, part));
            frame();
        }
        press(false);
        frame();
    }
    void rest() { now_ += interaction::Seconds(2); }
    /// As the bar of a panel lets a hand hold a tool.
    void choose(ToolKind kind) {
        Commands commands;
        commands.tools = interaction::Tools{.wand = kind, .mouse = kind};
        frame(commands);
    }
    const Settings& state() { return session().state(); }

    interaction::Recording recording;

  protected:
    virtual InputState poll(interaction::Seconds now) = 0;
    virtual Commands from_page() { return {}; }
    glm::vec3 in_room(const glm::dvec3& physical) {
        return glm::vec3(transform(state().room_from_physical, physical));
    }
    Pose hand_at(const glm::dvec3& physical) {
        return {kHand.position, glm::quatLookAt(glm::normalize(in_room(physical) - kHand.position),
                                                glm::vec3(0, 1, 0))};
    }
    void begin() {
        ExplorerState start = session().state();
        start.set_isovalue(kIsovalue);
        session().set_state(start);
        recording.header.start = session().state().as_commands();
        for (int i = 0; i < 3; ++i)
            frame();
    }

    TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_ = build_sphere(folder_.path());
    interaction::Seconds now_{0};
    const interaction::DataFrame data_{glm::scale(glm::dmat4(1.0), glm::dvec3(31)), "mm",
                                       glm::dvec3(31)};
    const FrameReport report_;
    const std::vector<interaction::ControlGroup> controls_;
};

/// Mouse and keyboard in a window, with the panel over the picture.
class WindowRig final : public Rig {
  public:
    WindowRig() {
        config_.installation.windows.front().size = kSize;
        config_.installation.windows.front().viewports.front().screen = {
            .lower_left = {-0.9f, -0.5f, -1.2f},
            .upper_left = {-0.9f, 0.5f, -1.2f},
            .upper_right = {0.9f, 0.5f, -1.2f},
            .carried_by_head = true,
            .fit_aspect = true};
        config_.rendering.samples = 1;
        session_.emplace(config_, file_, *context_);
        emulation_.set_eye([this](const Pose& head, const interaction::MouseMoveEvent& cursor) {
            return session_->ray_at(cursor, head);
        });
        begin();
    }
    Session& session() override { return *session_; }
    std::unique_ptr<Session> another() override {
        return std::make_unique<Session>(config_, file_, *context_);
    }
    void aim(const glm::dvec3& physical) override {
        const stereo::Display& display = session_->outputs().display();
        const render::View view = stereo::view_of(
            display.window().viewports.front().screen, *emulation_.poll(now_).find("head")->pose,
            stereo::Eye::center, state().eye_separation, 0.05f, 50.0f, kSize);
        const glm::vec4 clip =
            view.clip_from_eye * view.eye_from_room * glm::vec4(in_room(physical), 1);
        const glm::vec2 at = glm::vec2(clip) / clip.w * 0.5f + 0.5f;
        events_.emplace_back(interaction::MouseMoveEvent{at.x, 1 - at.y, kSize.x, kSize.y});
    }
    void press(bool down) override {
        events_.emplace_back(interaction::MouseButtonEvent{interaction::MouseButton::left, down});
    }
    void tap(Action action) override {
        const auto& all = key_commands();
        const auto found = std::ranges::find(all, std::optional(action), &KeyCommand::action);
        ASSERT_NE(found, all.end());
        strike(presses_of(*found));
    }
    void strike(const std::vector<WindowEvent>& events) {
        events_.insert(events_.end(), events.begin(), events.end());
        for (int i = 0; i < 3; ++i) // the key goes down, up, and what it does is seen
            frame();
    }
    /// Types into the search of commands and chooses its first line.
    void find(const std::string& words) {
        const auto control = static_cast<std::uint8_t>(interaction::Modifier::control);
        strike({KeyEvent{Key{'K'}, true, control}, KeyEvent{Key{'K'}, false, control}});
        std::vector<WindowEvent> typed;
        for (const char character : words)
            typed.emplace_back(interaction::TextEvent{static_cast<char32_t>(character)});
        strike(typed);
        strike({KeyEvent{Key::enter, true}, KeyEvent{Key::enter, false}});
        frame();
    }
    render::Image picture(Session& of) override { return of.outputs().display().read_window(); }

  private:
    InputState poll(interaction::Seconds now) override {
        emulation_.feed(layer_.feed(std::exchange(events_, {}), true));
        return emulation_.poll(now);
    }
    Commands from_page() override { return layer_.lay_out(kSize, panel_model(), now_); }

    static constexpr glm::ivec2 kSize{640, 400};
    Config config_ = small_config(stereo::StereoMode::mono);
    std::unique_ptr<stereo::GlContext> context_ =
        stereo::make_context(stereo::ContextKind::egl, {.size = kSize});
    render::Gl gl_{context_->loader()};
    PanelLayer layer_{gl_}; ///< a session without a window of the desktop has none
    std::optional<Session> session_;
    interaction::DesktopEmulation emulation_{{}};
    std::vector<WindowEvent> events_;
};

/// A tracked wand, and a keyboard, in an emulated CAVE of four small walls.
class CaveRig final : public Rig {
  public:
    CaveRig() {
        for (stereo::Window& window : config_.installation.windows) {
            window.size = {48, 48};
            window.viewports.front().position = {0, 0};
            window.viewports.front().size = {1, 1};
        }
        session_ = another();
        begin();
    }
    Session& session() override { return *session_; }
    std::unique_ptr<Session> another() override {
        return std::make_unique<Session>(
            config_, file_,
            stereo::open_room(stereo::ContextKind::egl, config_.installation, {.size = {96, 64}}));
    }
    void aim(const glm::dvec3& physical) override { wand_.pose = hand_at(physical); }
    void press(bool down) override {
        wand_.buttons = down ? bit(interaction::WandButton::grab) : 0;
    }
    void tap(Action action) override {
        keys_ = bit(action);
        frame();
        keys_ = {};
        frame();
    }
    render::Image picture(Session& of) override { return of.outputs().room()->read(); }

  private:
    InputState poll(interaction::Seconds now) override {
        return {now,
                {{.name = "head", .pose = Pose{{0, 1.6f, 0}, {1, 0, 0, 0}}, .valuators = {}},
                 wand_,
                 {.name = "keys", .pose = {}, .valuators = {}, .actions = keys_}}};
    }

    Config config_ = read_config("cave4");
    std::unique_ptr<Session> session_;
    interaction::DeviceState wand_{.name = "wand", .pose = kHand, .valuators = {}};
    interaction::ActionSet keys_;
};

/// The right controller of a headset. What its wearer has no button for comes from the panel in the
/// room.
class HeadsetRig final : public Rig {
  public:
    HeadsetRig() {
        stereo::use_played_runtime();
        headset().reset();
        headset().right.present = true;
        headset().right.aim = headset().right.grip = kHand;
        for (played::Eye& eye : headset().eyes)
            eye.size = {48, 48};
        config_.openxr.options.windowless = true;
        Config worn = config_;
        worn.openxr.enabled = true;
        session_.emplace(worn, file_, *context_, index::Extract(), open_headset(worn.openxr));
        begin();
    }
    ~HeadsetRig() override {
        context_->make_current();
        session_->outputs().headset()->leave();
        session_.reset();
        EXPECT_EQ(stereo::codes(), std::vector<std::string>());
    }
    Session& session() override { return *session_; }
    std::unique_ptr<Session> another() override {
        beside_ = stereo::make_context(stereo::ContextKind::egl, {.size = {48, 48}});
        return std::make_unique<Session>(config_, file_, *beside_);
    }
    void aim(const glm::dvec3& physical) override {
        headset().right.aim = headset().right.grip = hand_at(physical);
    }
    void press(bool down) override { headset().right.inputs["squeeze/value"] = down ? 1 : 0; }
    void tap(Action action) override {
        if (action == Action::undo || action == Action::redo) {
            const History& all = session_->history();
            const auto way = action == Action::undo ? all.undo() : all.redo();
            ASSERT_TRUE(way);
            return frame(*way);
        }
        frame(effect_of(action));
    }
    render::Image picture(Session&) override { return {}; } // a replay has no headset

  private:
    static played::PlayedHeadset& headset() { return played::played_headset(); }
    InputState poll(interaction::Seconds now) override {
        stereo::Headset& client = *session_->outputs().headset();
        client.update(now);
        client.begin_frame(now);
        return client.poll(now);
    }

    Config config_ = small_config(stereo::StereoMode::mono);
    std::unique_ptr<stereo::GlContext> beside_, ///< that of a replay
        context_ = stereo::make_context(stereo::ContextKind::egl, {.size = {48, 48}});
    std::optional<Session> session_;
};

std::unique_ptr<Rig> rig_of(Means means) {
    switch (means) {
    case Means::wand: return std::make_unique<CaveRig>();
    case Means::headset: return std::make_unique<HeadsetRig>();
    default: return std::make_unique<WindowRig>();
    }
}

/// Whether settings are the same but for the place of the data; for a tool that makes nothing, that place
/// alone counts.
bool same_made(const ToolRow& tool, const Settings& a, const Settings& b) {
    if (tool.makes.empty())
        return a.room_from_physical == b.room_from_physical;
    Settings moved = a;
    moved.room_from_physical = b.room_from_physical;
    return moved == b;
}

using Cell = std::tuple<ToolKind, Means>;
class EachTool : public testing::TestWithParam<Cell> {
  protected:
    const ToolRow& tool_ = tool_row(std::get<ToolKind>(GetParam()));
    const Means means_ = std::get<Means>(GetParam());
    const bool makes_ = !tool_.makes.empty();
    std::unique_ptr<Rig> rig_ = rig_of(means_);

    bool made() { return makes_ && tool_.made(rig_->state()); }

    /// The words of the first line of the search that leads where it is wanted.
    std::optional<std::string> line_to(const std::function<bool(const Settings&)>& wanted) {
        const ExplorerState now = rig_->session().state();
        const PanelModel model = rig_->panel_model();
        for (const SearchLine& line : search_lines(model)) {
            ExplorerState after = now;
            Commands commands = line.commands;
            if (line.press && line.press->action)
                commands = rig_->effect_of(*line.press->action);
            if (!commands.empty() && after.apply(commands, model.info.steps()) && wanted(after))
                return line.words;
        }
        return std::nullopt;
    }
    /// By a line of the search if there is one that leads there. Else by Enter, with the cursor at a
    /// place, and then such a line, if there is one for the mark that Enter makes.
    void by_words(const glm::dvec3& at, const std::function<bool(const Settings&)>& wanted) {
        WindowRig& window = dynamic_cast<WindowRig&>(*rig_);
        auto words = line_to(wanted);
        if (!words) {
            window.aim(at);
            window.frame();
            window.strike({KeyEvent{Key::enter, true}, KeyEvent{Key::enter, false}});
            if (wanted(window.state()))
                return;
            before_ = window.session().state(); // the mark is a step of its own
            words = line_to(wanted);
        }
        window.rest();
        if (words)
            window.find(*words);
    }

    void put() {
        if (means_ == Means::search)
            by_words(kPlaceA, [&](const Settings& after) { return tool_.made(after); });
        else
            rig_->click(kPlaceA);
    }
    void move() {
        const ExplorerState before = rig_->session().state();
        if (means_ == Means::search)
            return by_words(kPlaceB, [&](const Settings& after) {
                return !same_made(tool_, before, after) && (!makes_ || tool_.made(after));
            });
        rig_->drag(kPlaceA, kPlaceB);
        if (same_made(tool_, before, rig_->state())) // it is put elsewhere
            rig_->click(kPlaceB);
    }
    void remove() {
        if (means_ == Means::search)
            by_words(kPlaceA, [&](const Settings& after) { return !tool_.made(after); });
        else
            rig_->tap(Action::remove_made);
    }
    /// Back and again: undo gives what was before, redo what is now.
    void expect_undone() {
        const ExplorerState after = rig_->session().state();
        rig_->rest();
        rig_->tap(Action::undo);
        EXPECT_TRUE(same_made(tool_, before_, rig_->state())) << "undone";
        rig_->rest();
        rig_->tap(Action::redo);
        EXPECT_TRUE(same_made(tool_, after, rig_->state())) << "redone";
        rig_->rest();
        before_ = rig_->session().state();
    }

    ExplorerState before_; ///< state before the act that is tested
};

TEST_P(EachTool, IsPutMovedRemovedUndoneRecordedAndReplayed) {
    rig_->choose(tool_.kind);
    rig_->rest();
    before_ = rig_->session().state();
    if (makes_) {
        ASSERT_FALSE(made());
        put();
        ASSERT_TRUE(made()) << "put";
        expect_undone();
        ASSERT_TRUE(made());
    }
    move();
    EXPECT_FALSE(same_made(tool_, before_, rig_->state())) << "moved";
    expect_undone();
    EXPECT_EQ(made(), makes_);
    if (makes_) {
        remove();
        EXPECT_FALSE(made()) << "removed";
        expect_undone();
        rig_->tap(Action::undo); // so that it is seen at the end
        EXPECT_TRUE(made());
    }
    for (int i = 0; i < 4; ++i)
        rig_->frame();

    const ExplorerState& end = rig_->session().state();
    const auto picture = rig_->picture(rig_->session()).rgba;
    const std::unique_ptr<Session> again = rig_->another();
    again->set_state(start_of(rig_->recording.header, again->state(), 6, {}));
    EXPECT_THAT(replay_fixed_step(*again, rig_->recording,
                                  {.from_devices = true, .stereo = {}, .quality = {}},
                                  [](std::size_t, const auto&) {}),
                testing::IsEmpty());
    EXPECT_TRUE(again->state() == end) << "replayed";
    EXPECT_TRUE(rig_->picture(*again).rgba == picture);
}

std::vector<ToolKind> all_tools() {
    std::vector<ToolKind> kinds;
    for (const ToolRow& tool : interaction::tool_table())
        kinds.push_back(tool.kind);
    return kinds;
}

INSTANTIATE_TEST_SUITE_P(, EachTool,
                         testing::Combine(testing::ValuesIn(all_tools()),
                                          testing::Values(Means::mouse, Means::wand, Means::headset,
                                                          Means::search)),
                         [](const testing::TestParamInfo<Cell>& cell) {
                             return std::string(name_of(std::get<ToolKind>(cell.param))) + "_" +
                                    kMeans[static_cast<std::size_t>(std::get<Means>(cell.param))];
                         });

} // namespace
} // namespace isochron::app
