// The configuration: an installation and the program's settings, read from a TOML file.
#pragma once

#include "app/config/color_map_file.h"
#include "app/config/config_problem.h"
#include "app/config/first_placement.h"
#include "app/config/openxr_config.h"
#include "interaction/controls/desktop_emulation.h"
#include "interaction/controls/motion_gate.h"
#include "interaction/navigation/comfort.h"
#include "interaction/settings.h"
#include "interaction/trackers/dtrack_input.h"
#include "interaction/trackers/osc_input.h"
#include "interaction/trackers/vrpn_input.h"
#include "render/drawing/cell_pass.h"
#include "stereo/cluster.h"
#include "stereo/context/gl_context.h"
#include "stereo/installation.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Quantile at which the first surface starts by default: interesting surfaces tend to enclose a
/// small part of the volume.
constexpr double kFirstQuantile = 0.95;

/// An isosurface to start with, given as an isovalue or else as a quantile of the data's values.
struct ConfiguredSurface {
    std::optional<double> isovalue;
    double quantile = kFirstQuantile; ///< share of all values, 0 to 1; used if there is no isovalue
    glm::vec3 color{};                ///< sRGB
    float opacity = 1.0f;
};

/// How colors blend: `linear` in linear light; `display` in display values, which is faster on
/// software GL; `automatic` means `display` on software GL and `linear` on a GPU.
enum class Blending : std::uint8_t { automatic, linear, display };

/// How good pictures are, and what they may cost: the table `quality`.
struct QualityConfig {
    /// Footprint of a settled picture, whatever it costs; empty: the best one within the budget
    /// (the best one of all in a fixed-step replay, which measures nothing).
    std::optional<render::Footprint> settled;
    double frame_budget_ms = 0; ///< [ms] for drawing a frame; 0: one period of the display
    /// [ms] that a moving picture may take, at most, where it could not be recognized otherwise;
    /// 0: the budget.
    double longest_ms = 100;
    /// Share of a view's width and height in which cells of moving pictures are drawn at least;
    /// 1: in all pixels.
    double least_resolution = 0.35;
    /// [ms] for drawing a picture at rest, at once or in parts; 0: the same as for other frames.
    double still_budget_ms = 500;
    interaction::StillnessLimits stillness;
};

/// How pictures are drawn: the tables `rendering` and `lighting`.
struct RenderingConfig {
    stereo::ContextKind context = stereo::ContextKind::glfw;
    bool vsync = true;
    float frame_rate_limit = 120.0f; ///< [1/s] where no display paces the frames
    /// The part of a cell that a quad or splat stands for.
    render::CellShape cell_shape = render::CellShape::plane;
    int upload_kilobytes_per_frame = 4096;        ///< most data of cells sent to the GPU per frame
    glm::vec3 background{0.055f, 0.063f, 0.078f}; ///< sRGB
    glm::vec3 surface_color{0.94f, 0.86f, 0.70f}; ///< sRGB, of the surface if none is configured
    render::CellAppearance appearance;            ///< light and material
    Blending blending = Blending::automatic;
    render::DrawnBy drawn_by = render::DrawnBy::automatic; ///< as suits a GPU or a processor
    /// Samples of each pixel; 0: 4 where the GPU draws, 1 where the processor does.
    int samples = 0;
    bool level_of_detail = true; ///< coarser levels while too many cells move
    bool wand_ray = true;
};

/// Written pictures: the keys `picture_...` of the table `rendering`.
struct PictureConfig {
    int samples = 0;      ///< 0: 4, and no fewer than on the displays
    bool ray = false;     ///< they show the wand's ray, too
    bool caption = false; ///< they show isovalue and time
    /// Background and pixels an inch in the place of the session's. No keys of a file.
    interaction::WrittenBackground background = interaction::WrittenBackground::shown;
    double dpi = 0;
    /// Height of words, see `text_height`; a window at a desk has its own. No key of a file.
    float text = 0;
    /// Pictures, each of other samples, whose mean a picture to keep is; 0: as many as a settled
    /// window takes (`Outputs::passes`). No key of a file.
    int passes = 1;
    /// No window shows the pictures: each is drawn once, directly as the picture to keep. No key
    /// of a file.
    bool only_kept = false;
};

/// The trackers, any number of each kind.
struct DeviceConfig {
    interaction::DeviceOptions common; ///< what all devices start from: the table `tracking`
    std::vector<interaction::DTrackOptions> dtrack;
    std::vector<interaction::OscOptions> osc;
    std::vector<interaction::VrpnOptions> vrpn;
    bool empty() const { return dtrack.empty() && osc.empty() && vrpn.empty(); }
};

/// Calls `visit(key, tracker)` for every tracker, with the key of its table.
template <class Visit>
void each_tracker(const DeviceConfig& devices, Visit&& visit) {
    const auto all = [&](const char* key, const auto& trackers) {
        for (const auto& tracker : trackers)
            visit(key, tracker);
    };
    all("dtrack", devices.dtrack);
    all("osc", devices.osc);
    all("vrpn", devices.vrpn);
}

struct ClusterConfig {
    stereo::ClusterLimits limits;
    bool swap_group = false; ///< let the graphics driver swap all windows at once
};

/// A window that shows only the panel.
struct ConsoleConfig {
    glm::ivec2 size{480, 900};
    glm::ivec2 position = stereo::Window{}.position;
    stereo::Window window() const { return {"console", size, position}; }
};

struct PanelConfig {
    float width = 0.46f;    ///< [m] of the panel in the room
    float distance = 0.65f; ///< [m] from the eyes, at which it appears
    float font_scale = 1;   ///< size of the other panels, times the desktop's scale
    std::optional<ConsoleConfig> console;
};

/// The table `memory`.
struct MemoryConfig {
    int cache_megabytes = 0; ///< most kept of the index; 0: a quarter of the usable memory
    int mesh_megabytes = 96; ///< most for the triangles of a set; 0: no triangles are made
    /// Cells of a set; where there are more, coarser levels take their place.
    int most_cells = 8'000'000;

    /// As IndexFile::open takes it.
    std::uint64_t cache_bytes() const { return std::uint64_t(cache_megabytes) << 20; }
    /// As SurfacesQuery takes it.
    std::uint64_t mesh_room() const { return std::uint64_t(mesh_megabytes) << 20; }
};

/// Its keys are listed in config_fields.h.
struct Config {
    std::string name;            ///< file name for messages; empty for the built-in defaults
    std::string text;            ///< the file's whole text, as recordings keep it
    int version = 1;             ///< version of its keys
    interaction::Settings start; ///< what the file says of settings, which can change later
    stereo::Installation installation;
    interaction::EmulationOptions emulation;
    DeviceConfig devices;
    ClusterConfig cluster;
    OpenXrConfig openxr;
    interaction::ComfortOptions comfort;
    PanelConfig panel;
    PlacementOptions placement;
    QualityConfig quality;
    RenderingConfig rendering;
    PictureConfig pictures;
    MemoryConfig memory;
    std::vector<ConfiguredSurface> surfaces; ///< empty: one surface of rendering.surface_color
    /// A file of color maps, which may be relative to the folder of the configuration, and the name
    /// of the one to start with; empty: none.
    std::string color_map_file, color_map_of_file;
    std::vector<LoadedColorMap> color_maps; ///< beside those that the program knows
    /// The table `time`: what is shown between two steps at first; empty: what the data's own steps
    /// advise, in `explore`, else `hold`.
    std::optional<interaction::BetweenSteps> between;
};

/// @param name stands before the line number in messages
/// @throws ConfigError naming file, line and key, and for an unknown key the nearest known one
Config parse_config(const std::string& text, const std::string& name);

/// @param path a file, or the name of a shipped configuration (`desktop`, `cave4`, ...)
/// @throws ConfigError as above, or when the file cannot be read
Config read_config(const std::filesystem::path& path);

/// The JSON schema (draft 7) of configuration files, for editors and other programs. It is made
/// from the list of keys that reading uses, too. Shipped as configs/isochron.schema.json.
std::string config_schema();

/// The emulation's options, with the field of view of the first window's first screen.
interaction::EmulationOptions emulation_for(const Config& config);

} // namespace isochron::app
