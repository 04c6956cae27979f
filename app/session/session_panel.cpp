// A session's panels: their places, their commands, and what they tell.
#include "app/session/session_panel.h"

#include "interaction/controls/room_panel.h"
#include "interaction/navigation/navigation.h"

#include <fmt/format.h>

#include <ctime>
#include <utility>

namespace isochron::app {
namespace {

/// The time of the clock on the wall.
std::string time_of_day() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    localtime_r(&now, &parts);
    return fmt::format("{:02}:{:02}:{:02}", parts.tm_hour, parts.tm_min, parts.tm_sec);
}

} // namespace

std::vector<interaction::DeviceKind> kinds_at_hand(bool hands,
                                                   const interaction::InputState& input) {
    using interaction::DeviceKind;
    std::vector<DeviceKind> kinds{DeviceKind::mouse, DeviceKind::keyboard};
    if (hands)
        kinds.push_back(DeviceKind::hands);
    if (input.find("gamepad"))
        kinds.push_back(DeviceKind::gamepad);
    return kinds;
}

SessionPanel::SessionPanel(const Config& config, const Outputs& outputs)
    : config_(config), outputs_(outputs),
      over_(outputs.gl(), outputs.windows(), config_.panel.font_scale),
      in_room_(outputs.gl(), config_.panel) {}

void SessionPanel::show_messages(std::vector<std::string> messages) {
    messages_ += messages.size();
    for (std::string& words : messages)
        past_.push_back({time_of_day(), std::move(words)});
    if (past_.size() > kMessagesKept)
        past_.erase(past_.begin(), past_.end() - kMessagesKept);
}

interaction::Commands SessionPanel::take_commands() {
    return std::exchange(commands_, {});
}

std::vector<interaction::WindowEvent>
SessionPanel::feed(std::span<const interaction::WindowEvent> events, const ExplorerState& state) {
    return over_.feed(events, is_flat(state) || state.leaving);
}

PanelModel SessionPanel::told(PanelModel model, PanelPlace place) const {
    model.recording = recording_;
    model.movies = movies_;
    if (place != PanelPlace::in_room)
        model.sessions = sessions_;
    model.notes.past = past_;
    model.notes.messages = messages_;
    if (outputs_.headset() && outputs_.shows_windows())
        model.notes.standing = "No picture in the headset: the window shows the data instead. " +
                               outputs_.headset()->description();
    else if (model.notes.standing.empty())
        model.notes.standing = standing_;
    model.place = place;
    return model;
}

OperatorPanel::Model SessionPanel::models(const Facts& facts) const {
    return [this, &facts](PanelPlace place) { return told(facts(), place); };
}

void SessionPanel::lay_out_room(const ExplorerState& state, const Facts& facts,
                                interaction::Seconds time) {
    if (state.room_panel.shown)
        in_room_.lay_out(told(facts(), PanelPlace::in_room), time);
    else
        in_room_.leave_out();
}

void SessionPanel::draw_over(glm::ivec2 size, const ExplorerState& state, const Facts& facts,
                             interaction::Seconds time) {
    if (outputs_.windows().first().has_window())
        add(over_.draw_over(size, places(state), models(facts), time));
}

void SessionPanel::lay_out_over(const ExplorerState& state, const Facts& facts,
                                interaction::Seconds time) {
    const glm::ivec2 size = outputs_.windows().first().framebuffer_size();
    if (size.x > 0 && size.y > 0) // a minimized window has none
        add(over_.lay_out_over(size, places(state), models(facts), time));
}

PictureOverlay SessionPanel::overlay(const Aids& aids) const {
    return {aids, over_.looks(), outputs_.windows().first().framebuffer_size()};
}

FrameOutlook SessionPanel::outlook() const {
    FrameOutlook next = both(over_.outlook(), in_room_.outlook());
    next.changed |= commands_ != interaction::Commands{}; // which the next frame obeys
    return next;
}

void SessionPanel::draw_alone(const Facts& facts, interaction::Seconds time) {
    add(over_.draw_alone(models(facts), time));
}

stereo::Margins SessionPanel::covered(const ExplorerState& state) const {
    const glm::ivec2 size = outputs_.windows().first().framebuffer_size();
    return is_flat(state) ? over_.covered(size / places(state), rows_of(state)) : stereo::Margins{};
}

std::array<glm::vec2, 2> SessionPanel::corners(const ExplorerState& state) const {
    if (covered(state) == stereo::Margins{})
        return {};
    return {kChipEnd / PanelLayer::kFontPixels, kCubeEnd / PanelLayer::kFontPixels};
}

float SessionPanel::text_share(const ExplorerState& state) const {
    const stereo::Margins margins = covered(state);
    return over_.text_share(outputs_.windows()[0].framebuffer_size() / places(state) -
                            glm::ivec2(0, margins.top + margins.bottom));
}

bool SessionPanel::head_is_emulated() const {
    const stereo::Screen& screen = config_.installation.windows.front().viewports.front().screen;
    return config_.devices.empty() && !config_.openxr.enabled && screen.carried_by_head &&
           screen.fit_aspect;
}

std::optional<interaction::Pose> SessionPanel::place() const {
    constexpr float kFilled = 0.92f; // how much of that share the panel fills
    if (!head_is_emulated())
        return std::nullopt;
    const stereo::Screen& screen = config_.installation.windows.front().viewports.front().screen;
    const glm::vec3 across = screen.upper_right - screen.upper_left;
    const glm::vec3 right = glm::normalize(across);
    const glm::vec3 up = glm::normalize(screen.upper_left - screen.lower_left);
    const float aside = kShare / (1 - kShare) * glm::length(across);
    const glm::vec3 middle = 0.5f * (screen.lower_left + screen.upper_left) - 0.5f * aside * right;
    const float nearer = in_room_.size().width / (kFilled * aside);
    return interaction::Pose{nearer * middle,
                             glm::quat_cast(glm::mat3(right, up, glm::cross(right, up)))};
}

bool SessionPanel::stands_beside(const interaction::Pose& head, const ExplorerState& state) const {
    const auto beside = place();
    return beside && state.room_panel.shown &&
           !interaction::called(state.room_panel, head, in_room_.distance(), beside).shown;
}

/// How many times the panel appears in the window (x, y): once in each eye's part.
glm::ivec2 SessionPanel::places(const ExplorerState& state) const {
    const stereo::StereoMode mode = stereo::upright(state.stereo_mode());
    if (outputs_.room() || !outputs_.shows_windows())
        return glm::ivec2(1);
    return {mode == stereo::StereoMode::side_by_side ? 2 : 1,
            mode == stereo::StereoMode::top_bottom ? 2 : 1};
}

} // namespace isochron::app
