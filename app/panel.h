// The control panel: shows what is asked for and what is shown, and turns clicks into commands.
#pragma once

#include "app/explorer_state.h"
#include "app/frame_log.h"
#include "index/cell_set.h"
#include "interaction/commands.h"

#include <array>
#include <string>
#include <vector>

namespace isochron::app {

/// Where a panel is laid out.
enum class PanelPlace : std::uint8_t {
    over,   ///< a picture, as a window that can be moved
    whole,  ///< a window of its own, which it fills
    in_room ///< likewise; it says only what is the same on every wall and in every replay
};

/// What the panel shows in one frame; nothing in it is changed by showing it.
struct PanelModel {
    const index::SeriesInfo& info;
    const index::IndexStats& stats;
    const ExplorerState& asked;
    bool second_array = false;           ///< there is one to colour by
    std::array<double, 2> whole_range{}; ///< of what is coloured by
    const FrameReport& frame;
    TimeSummary frame_times; ///< of the last frames
    double frames_per_second = 0;
    bool searching = false; ///< the worker has not answered yet
    bool recording = false;
    std::string failure;                      ///< of the worker; empty when all is well
    std::string message;                      ///< newest note, such as a saved screenshot
    const std::vector<std::string>& controls; ///< one line per key
    PanelPlace place = PanelPlace::over;
    bool quad_buffered = false; ///< the windows have a right buffer, which mode quadbuffer needs
};

/// The rectangle that the panel covers: pixels from the top left.
struct PanelArea {
    float left = 0, top = 0, right = 0, bottom = 0;
    float title = 0; ///< height of its title
    bool contains(float x, float y) const {
        return x >= left && x < right && y >= top && y < bottom;
    }
};

/// Lays the panel out in the current Dear ImGui frame. @return what the user did to it
interaction::Commands draw_panel(const PanelModel& model, PanelArea& area);

/// How the picture is drawn, and why: `settled: surface, 7.2 of 11.1 ms`.
std::string quality_line(const FrameReport& frame);

/// `12.5 ms`, `0.0341`, `1.20e+07`: a number with its unit, short enough for a label.
std::string with_unit(double value, const std::string& unit);

} // namespace isochron::app
