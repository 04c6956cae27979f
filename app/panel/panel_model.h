// What the panel shows in one frame.
#pragma once

#include "app/config/color_map_file.h"
#include "app/frame/explorer_state.h"
#include "app/frame/frame_log.h"
#include "index/file/read_use.h"
#include "interaction/control_context.h"
#include "interaction/input/actions.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// Where a panel is laid out.
enum class PanelPlace : std::uint8_t {
    over,   ///< over a picture
    whole,  ///< in its own window, which it fills
    in_room ///< in the room; it shows only what is the same on every wall and in every replay
};

/// What the user wants: a movie of something, or to give up the one that is being made.
enum class MovieWish : std::uint8_t {
    recording, ///< of this session, so far
    series,    ///< all steps, as they are seen now
    give_up    ///< the one that is being made
};

struct MovieState {
    bool offered = false;            ///< this session can have movies made
    bool recorded = false;           ///< it is being recorded
    std::optional<float> progress{}; ///< of the one that is being made, 0 to 1
};

/// What the panel shows in one frame. The panel changes none of it.
struct PanelModel {
    const index::SeriesInfo& info;
    const index::IndexStats& stats;
    const ExplorerState& asked;
    std::span<const std::string> arrays = {};       ///< names, of those with surfaces
    std::size_t array = 0;                          ///< the one that is asked for
    std::span<const std::string> color_arrays = {}; ///< names, of those to color by
    std::size_t color_array = 0;                    ///< whose values are the colors, or would be
    std::function<interaction::Commands(std::size_t)> way_to_array; ///< shows an array, by number
    std::array<double, 2> scale_range{};                            ///< of the color scale
    std::span<const LoadedColorMap> color_maps = {};                ///< of the configuration
    const FrameReport& frame;
    TimeSummary frame_times; ///< of the last frames
    double frames_per_second = 0;
    index::ReadUse reading{};                   ///< of the index, since it was opened
    std::vector<std::uint32_t> at_hand_steps{}; ///< steps that can be shown without a search
    bool searching = false;                     ///< the worker has not answered yet
    bool recording = false;
    MovieState movies{};
    std::string failure;      ///< of the worker; empty when all is well
    std::string message;      ///< newest note, such as a saved screenshot
    std::size_t messages = 0; ///< number of notes so far
    std::string standing;     ///< note that stays in the picture as long as it is true
    const std::vector<interaction::ControlGroup>& controls;
    std::vector<interaction::DeviceKind> at_hand; ///< connected kinds of devices
    PanelPlace place = PanelPlace::over;
    const interaction::Commands* undo = nullptr; ///< null: there is nothing to undo
    const interaction::Commands* redo = nullptr;
    interaction::DataFrame data;
    interaction::Pose head;     ///< of the first viewer
    bool quad_buffered = false; ///< the windows have a right buffer, which mode quadbuffer needs
};

} // namespace isochron::app
