// What the panel shows in one frame.
#pragma once

#include "app/config/color_map_file.h"
#include "app/frame/empty_picture.h"
#include "app/frame/explorer_state.h"
#include "app/frame/frame_log.h"
#include "app/frame/piece_list.h"
#include "app/frame/step_curve.h"
#include "index/extraction/extraction.h"
#include "index/extraction/profile.h"
#include "index/file/index_file.h"
#include "index/file/read_use.h"
#include "interaction/control_context.h"
#include "interaction/input/actions.h"
#include "interaction/pointed.h"
#include "render/gl/image.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
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

/// What the user wants with movies and recordings.
enum class MovieWish : std::uint8_t {
    recording, ///< a movie of this session's recording, so far
    series,    ///< a movie of all steps, as they are seen now
    turn,      ///< a movie of one turn of the data, while this moment stands
    both,      ///< a movie of one turn while all steps pass
    keys,      ///< a film of the key frames
    titled,    ///< a film of the key frames with their names and texts as titles
    views,     ///< a film from one saved viewpoint to the next
    figure,    ///< a figure of what is seen
    story,     ///< a file of the story that the keys tell
    give_up,   ///< to cancel the movie that is being made
    record     ///< to begin a recording, or to end the recording that goes on
};

struct MovieState {
    bool offered = false;            ///< this session can have movies made
    bool recorded = false;           ///< it is being recorded
    std::optional<float> progress{}; ///< how much of the movie is made, 0 to 1
    std::string words{}; ///< its name, folder, length, size and time left; else the folder
};

/// An array as it is listed.
struct ListedArray {
    std::string name, grid, unit, values;
    std::string fault; ///< why it cannot be chosen; empty: it can
};

/// The arrays of the data.
struct PanelArrays {
    std::span<const std::string> names = {}; ///< names of the arrays with surfaces
    std::span<const std::string> notes = {}; ///< range and unit of each, in words; may be empty
    std::span<const ListedArray> lines = {}; ///< lines of the list of arrays; may be empty
    std::size_t asked = 0;                   ///< number of the array asked for
    std::function<interaction::Commands(std::size_t)> way_to; ///< shows an array, by number
    std::span<const std::string> color_names = {};            ///< names of the arrays to color by
    std::size_t color = 0; ///< number of the array whose values are the colors, or would be
    /// The array of each surface; null, and of those behind the last: the one that is shown.
    std::vector<const index::IndexFile*> of_surfaces{};

    const index::IndexFile* of(std::size_t surface) const {
        return surface < of_surfaces.size() ? of_surfaces[surface] : nullptr;
    }
};

/// The color scale, and the maps that it may have.
struct PanelColors {
    std::array<double, 2> range{};                 ///< lowest and highest value of the scale
    std::array<double, 2> slices{};                ///< those of the slices' scale
    std::size_t sliced = 0;                        ///< number of the array that is sliced
    std::span<const LoadedColorMap> own_maps = {}; ///< maps of the configuration
};

/// How the search and the frames go.
struct PanelWork {
    FrameSpeed frames{};
    index::ReadUse reading{};                   ///< what was read of the index since it was opened
    std::vector<std::uint32_t> at_hand_steps{}; ///< steps that can be shown without a search
    bool searching = false;                     ///< the worker has not answered yet
    const StepSurvey* survey = nullptr;         ///< survey of the shown step; null: none yet
};

using interaction::kDistanceCurve, interaction::kMarkCurve, interaction::kProfileCurve;

/// Numbers of the surfaces over all steps.
struct PanelCurves {
    std::vector<StepCurvePtr> surfaces{}; ///< one a surface; null: hidden, or not there
    StepCurvePtr mark{};                  ///< the value at the mark; null: none
    index::ProfilePtr profile{};          ///< the values along the ruler; null: none
    std::string failure{};                ///< why steps could not be measured; empty: all could
    std::function<void()> save{};         ///< writes them as a table; empty: that is not offered
};

/// A model as it is listed, beside what its setting says.
struct ListedModel {
    std::string words;    ///< how large it is; empty: nothing is known
    std::string fault;    ///< why it is not shown; empty: it is, or it will be
    bool refused = false; ///< it is not opened unless the user allows it
    /// Its lowest and highest coordinates, physical space; empty: it is not there.
    std::optional<std::array<glm::dvec3, 2>> box{};
};

/// Files of triangles, in the order of their settings.
struct PanelModels {
    std::vector<ListedModel> lines{};
    std::function<void(const std::string& path)> allow{}; ///< opens a refused one
};

/// The surfaces of other steps, in words.
struct PanelGhosts {
    std::string wished{}; ///< which there will be; empty: none
    std::string shown{};  ///< which there are, and whether more are being made
};

/// The connected pieces of the surfaces.
struct PanelPieces {
    index::ToldPieces told{}; ///< those of the cells that are drawn
    bool come = false;        ///< other cells are asked for than are drawn
    PieceListPtr list{};      ///< the last one that was made; null: none yet
    std::string failure{};    ///< why it could not be made
    /// To be called in each frame that shows the list; empty: there is none.
    std::function<void(const PieceOrder&)> want{};
};

/// A session on the same data that the user can go on with.
struct OfferedSession {
    std::string words; ///< its name, when it was saved, and whether it is dropped next
    interaction::Commands commands{}; ///< sets all that it had
    std::string name{};               ///< given by the user; empty: none
    std::filesystem::path file{};
    std::shared_future<render::Image>
        picture{}; ///< what was seen last, once it is read; may be none
};

/// Something that was said.
struct PastMessage {
    std::string time; ///< time of the day: `14:05:09`
    std::string words;
};

/// What the user is told.
struct PanelNotes {
    std::string failure{}; ///< failure of the worker; empty when all is well
    std::span<const PastMessage>
        past{};               ///< the last notes, such as a saved screenshot; newest last
    std::size_t messages = 0; ///< number of notes so far
    std::string message() const { return past.empty() ? std::string() : past.back().words; }
    std::string standing{};              ///< note that stays in the picture as long as it is true
    std::optional<EmptyPicture> empty{}; ///< why the picture shows no surface; empty: it does
};

/// What the panel shows in one frame. The panel changes none of it.
struct PanelModel {
    PanelPlace place = PanelPlace::over;
    const index::SeriesInfo& info;
    const index::IndexStats& stats;
    interaction::DataFrame data{};
    const ExplorerState& asked;
    const FrameReport& frame;
    std::span<const std::uint32_t> gaps{}; ///< steps behind which playing holds, ascending
    PanelArrays arrays{};
    PanelColors colors{};
    PanelWork work{};
    PanelCurves curves{};
    PanelModels models{};
    PanelGhosts ghosts{};
    PanelPieces pieces{};
    PanelNotes notes{};
    bool recording = false;
    MovieState movies{};
    std::span<const OfferedSession> sessions{}; ///< the last one first
    const std::vector<interaction::ControlGroup>& controls;
    std::vector<interaction::DeviceKind> at_hand{}; ///< connected kinds of devices
    interaction::Ways ways{};
    interaction::Pose head{};   ///< head of the first viewer
    bool quad_buffered = false; ///< the windows have a right buffer, which mode quadbuffer needs
    bool room_from_outside = false; ///< the window shows an emulated installation
    /// Where the place of the story's step lies in the window, 0 to 1 from its upper left corner; empty:
    /// there is none, or it is out of sight.
    std::optional<glm::vec2> told_at{};
    /// The place on a surface under the cursor; may be empty.
    std::function<std::optional<interaction::Pointed>()> pointed{};

    /// The array of a surface, and what is known of its values.
    const index::SeriesInfo& info_of(std::size_t surface) const {
        return arrays.of(surface) ? arrays.of(surface)->info() : info;
    }
    const index::IndexStats& stats_of(std::size_t surface) const {
        return arrays.of(surface) ? arrays.of(surface)->stats() : stats;
    }
    const index::SeriesInfo& picked_info() const { return info_of(asked.picked); }
    const index::IndexStats& picked_stats() const { return stats_of(asked.picked); }
};

/// What the user asks for that no command is for.
struct PanelPages {
    bool offers_files = false;  ///< the user can open other data
    bool offers_arrays = false; ///< the files have arrays that cannot be shown with these
    /// Opened in this frame.
    bool files = false, help = false, search = false, arrays = false, messages = false;
    std::string text{};                   ///< for the clipboard
    std::optional<MovieWish> movie{};     ///< movie that the user asked for in this frame
    std::optional<std::size_t> session{}; ///< session that they go on with
};

} // namespace isochron::app
