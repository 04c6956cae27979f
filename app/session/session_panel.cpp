// A session's panels: their contents, their commands and their places.
#include "app/session/session.h"

#include "interaction/controls/room_panel.h"
#include "interaction/navigation/navigation.h"

#include <utility>

namespace isochron::app {
namespace {

/// Frames over which the panel summarizes frame times.
constexpr std::size_t kShownFrames = 120;

} // namespace

std::string Session::drawing() const {
    std::string text = outputs_.windows().drawing().description();
    for (const std::string& line : scene_.given_up())
        text += "; " + line;
    return text;
}

std::optional<glm::dvec3> Session::parallel_center() const {
    if (!state_.orthographic)
        return std::nullopt;
    return interaction::transform(state_.room_from_physical, physical_center(file_->info().grid));
}

/// By mouse and keyboard, before a screen that it carries along.
bool Session::head_is_emulated() const {
    const stereo::Screen& screen = config_.installation.windows.front().viewports.front().screen;
    return config_.devices.empty() && !config_.openxr.enabled && screen.carried_by_head &&
           screen.fit_aspect;
}

/// Where the panel stands beside such a screen, in the head's frame: as far away as it has to be
/// for the share of the window that it gets.
std::optional<interaction::Pose> Session::panel_place() const {
    constexpr float kFilled = 0.92f; // of that share
    if (!head_is_emulated())
        return std::nullopt;
    const stereo::Screen& screen = config_.installation.windows.front().viewports.front().screen;
    const glm::vec3 across = screen.upper_right - screen.upper_left;
    const glm::vec3 right = glm::normalize(across);
    const glm::vec3 up = glm::normalize(screen.upper_left - screen.lower_left);
    const float aside = kPanelShare / (1 - kPanelShare) * glm::length(across);
    const glm::vec3 middle = 0.5f * (screen.lower_left + screen.upper_left) - 0.5f * aside * right;
    const float nearer = room_panel_.size().width / (kFilled * aside);
    return interaction::Pose{nearer * middle,
                             glm::quat_cast(glm::mat3(right, up, glm::cross(right, up)))};
}

/// Whether the panel in the room is where such a window has room for it. Who turns away from it has
/// the window to themselves.
bool Session::stands_beside(const interaction::Pose& head) const {
    const auto place = panel_place();
    return place && state_.room_panel.shown &&
           !interaction::called(state_.room_panel, head, room_panel_.distance(), place).shown;
}

/// The panel in the room replaces it.
bool Session::flat_panel() const {
    return state_.panel && !state_.room_panel.shown;
}

interaction::Commands Session::take_panel_commands() {
    return std::exchange(panel_commands_, {});
}

std::vector<interaction::WindowEvent>
Session::panel_events(std::span<const interaction::WindowEvent> events) {
    return panel_.feed(events, flat_panel() || state_.leaving);
}

std::optional<interaction::Pose> Session::ray_at(const interaction::MouseMoveEvent& cursor,
                                                 const interaction::Pose& head) const {
    if (panel_.covers(cursor))
        return std::nullopt;
    interaction::InputState emulated;
    emulated.devices.push_back({.name = "head", .pose = head, .valuators = {}});
    return outputs_.ray_at(cursor, viewer_poses(config_.installation, emulated,
                                                state_.eye_separation, parallel_center()));
}

PanelModel Session::panel_model(PanelPlace place, const FrameReport& report) const {
    const auto scale = this->scale();
    return {.info = array().info(),
            .stats = array().stats(),
            .asked = state_,
            .arrays = array_names_,
            .array = array_number(),
            .color_arrays = color_names_,
            .color_array = color_array(state_, *file_),
            .way_to_array = [this](std::size_t number) { return way_to_array(number); },
            .scale_range = scale ? scale->range : std::array{0.0, 0.0},
            .color_maps = config_.color_maps,
            .frame = report,
            .frame_times = log_.stage(&FrameReport::total, kShownFrames),
            .frames_per_second = log_.frames_per_second(kShownFrames),
            .reading = file_->reading(),
            .at_hand_steps = extractor_.at_hand(),
            .searching = extractor_.busy(),
            .recording = recording_,
            .movies = movies_,
            .failure = failure(),
            .message = message_,
            .messages = messages_,
            .standing = outputs_.headset() && outputs_.shows_windows()
                            ? "No picture in the headset: the window shows the data instead. " +
                                  outputs_.headset()->description()
                            : standing_,
            .controls = documentation_,
            .at_hand = devices_at_hand(),
            .place = place,
            .undo = history_.undo(),
            .redo = history_.redo(),
            .data = data_frame(file_->info()),
            .head = outputs_.audience().viewers.empty() ? interaction::Pose{}
                                                        : outputs_.audience().viewers.front().head,
            .quad_buffered = outputs_.windows()[0].has_stereo_buffers()};
}

std::vector<interaction::DeviceKind> Session::devices_at_hand() const {
    using enum interaction::DeviceKind;
    std::vector<interaction::DeviceKind> kinds{mouse, keyboard};
    if (!config_.devices.empty() || outputs_.headset())
        kinds.push_back(hands);
    if (input_.find("gamepad"))
        kinds.push_back(gamepad);
    return kinds;
}

OperatorPanel::Model Session::panel_models(const FrameReport& report) const {
    return [this, &report](PanelPlace place) { return panel_model(place, report); };
}

/// How many times the panel appears in the window (x, y): once in each eye's part.
glm::ivec2 Session::panel_places() const {
    const stereo::StereoMode mode = stereo::upright(state_.stereo);
    if (outputs_.room() || !outputs_.shows_windows())
        return glm::ivec2(1);
    return {mode == stereo::StereoMode::side_by_side ? 2 : 1,
            mode == stereo::StereoMode::top_bottom ? 2 : 1};
}

void Session::draw_panel_overlay(glm::ivec2 size, const FrameReport& report) {
    if (outputs_.windows().first().has_window())
        interaction::merge(panel_commands_, panel_.draw_over(size, panel_places(),
                                                             panel_models(report), report.time));
}

} // namespace isochron::app
