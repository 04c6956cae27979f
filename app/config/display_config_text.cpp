// Writes an installation as TOML.
#include "app/config/display_config_text.h"

#include <fmt/format.h>

namespace isochron::app {
namespace {

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            result += fmt::format("\\{}", c);
        else if (code < 0x20 || code == 0x7f)
            result += fmt::format("\\u{:04x}", code);
        else
            result += c;
    }
    return result + '"';
}

/// With the fewest digits that read back as the same number.
std::string numbers(const glm::vec2& v) {
    return fmt::format("[{}, {}]", v.x, v.y);
}
std::string numbers(const glm::ivec2& v) {
    return fmt::format("[{}, {}]", v.x, v.y);
}
std::string numbers(const glm::vec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

std::string text_of(const stereo::Viewer& viewer) {
    const std::string eyes =
        viewer.left_eye && viewer.right_eye
            ? fmt::format("left_eye = {}\n"
                          "right_eye = {}\n",
                          numbers(*viewer.left_eye), numbers(*viewer.right_eye))
            : fmt::format("eye_separation = {}\n", viewer.eye_separation);
    return fmt::format("\n[[viewers]]\n"
                       "name = {}\n"
                       "head = {}\n"
                       "position = {}\n"
                       "{}",
                       quoted(viewer.name), quoted(viewer.head), numbers(viewer.position), eyes);
}

std::string text_of(const stereo::Viewport& viewport, const stereo::Viewer& viewer) {
    const stereo::Screen& screen = viewport.screen;
    std::string text = "\n[[windows.viewports]]\n";
    if (!viewport.name.empty())
        text += fmt::format("name = {}\n", quoted(viewport.name));
    text += fmt::format("position = {}\n"
                        "size = {}\n"
                        "viewer = {}\n"
                        "{}"
                        "\n[windows.viewports.projection]\n"
                        "carried_by = \"{}\"\n",
                        numbers(viewport.position), numbers(viewport.size), quoted(viewer.name),
                        viewport.upside_down ? "upside_down = true\n" : "",
                        screen.carried_by_head ? "head" : "room");
    if (screen.fit_aspect)
        text += "fit_aspect = true\n";
    if (screen.bezel != 0)
        text += fmt::format("bezel = {}\n", screen.bezel);
    return text + fmt::format("lower_left = {}\n"
                              "upper_left = {}\n"
                              "upper_right = {}\n",
                              numbers(screen.lower_left), numbers(screen.upper_left),
                              numbers(screen.upper_right));
}

std::string text_of(const stereo::Window& window, const stereo::Installation& installation) {
    std::string text = fmt::format("\n[[windows]]\n"
                                   "name = {}\n"
                                   "size = {}\n",
                                   quoted(window.name), numbers(window.size));
    if (window.position != glm::ivec2(-1))
        text += fmt::format("position = {}\n", numbers(window.position));
    if (window.fullscreen)
        text += "fullscreen = true\n";
    if (window.monitor != stereo::kNextMonitor)
        text += fmt::format("monitor = {}\n", window.monitor);
    if (window.node != 0)
        text += fmt::format("node = {}\n", window.node);
    if (!window.border)
        text += "border = false\n";
    text += fmt::format("stereo = \"{}\"\n", stereo::name_of(window.stereo));
    for (const stereo::Viewport& viewport : window.viewports)
        text += text_of(viewport, installation.viewers[viewport.viewer]);
    return text;
}

} // namespace

std::string display_config_text(const stereo::Installation& installation) {
    std::string text = "version = 1\n";
    for (const stereo::Viewer& viewer : installation.viewers)
        text += text_of(viewer);
    for (const stereo::Window& window : installation.windows)
        text += text_of(window, installation);
    const stereo::Installation usual;
    if (installation.near_plane != usual.near_plane || installation.far_plane != usual.far_plane)
        text += fmt::format("\n[rendering]\nnear = {}\nfar = {}\n", installation.near_plane,
                            installation.far_plane);
    return text;
}

} // namespace isochron::app
