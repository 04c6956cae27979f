// Reads the tables `panel` and `console`.
#include "app/config/panel_config.h"

#include <fmt/format.h>

namespace isochron::app {
namespace {

constexpr int kSmallestPanel = 200, kLargestPanel = 16384; ///< [pixel] sides of the console

stereo::Window read_console(TomlReader& reader) {
    stereo::Window window;
    window.name = "console";
    window.size = {480, 900};
    reader.integers("size", kSmallestPanel, kLargestPanel, window.size);
    reader.integers("position", 0, kLargestPanel, window.position);
    return window;
}

} // namespace

void read_panel(TomlReader& root, PanelConfig& panel) {
    root.table("panel", [&](TomlReader& reader) {
        reader.flag("room", panel.room);
        reader.number("width", 0.2, 2.0, panel.width);
        reader.number("distance", 0.3, 5.0, panel.distance);
        reader.number("font_scale", 0.5, 4.0, panel.font_scale);
    });
    root.table("console", [&](TomlReader& reader) { panel.console = read_console(reader); });
}

} // namespace isochron::app
