// An installation and its habits, as a TOML file describes them.
#pragma once

#include "app/config/cluster_config.h"
#include "app/config/color_map_file.h"
#include "app/config/device_config.h"
#include "app/config/display_config.h"
#include "app/config/first_placement.h"
#include "app/config/openxr_config.h"
#include "app/config/panel_config.h"
#include "interaction/comfort.h"
#include "interaction/motion_gate.h"
#include "render/cells/cell_pass.h"
#include "stereo/context/gl_context.h"
#include "stereo/installation.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Where surfaces of interest tend to enclose a small part of the volume: a share of all values.
constexpr double kFirstQuantile = 0.95;

/// An isosurface to start with. Where its value does not come from the data, it is a quantile.
struct ConfiguredSurface {
    std::optional<double> isovalue;
    double quantile; ///< of all values, 0 to 1
    glm::vec3 color; ///< sRGB
    float opacity = 1.0f;
};

/// How colors blend: `linear` as light does, `display` in display values, which is faster on
/// software GL; `automatic` takes that there, and linear light elsewhere.
enum class Blending : std::uint8_t { automatic, linear, display };

struct Config {
    std::string name; ///< file name for messages; empty for the built-in defaults
    std::string text; ///< the file's whole text, as recordings keep it
    stereo::ContextKind context = stereo::ContextKind::glfw;
    bool vsync = true;
    float frame_rate_limit = 120.0f; ///< [1/s] where no display paces the frames
    stereo::Installation installation;
    DisplayPlaces places; ///< where the file describes the installation's parts
    interaction::EmulationOptions emulation;
    DeviceConfig devices;
    ClusterConfig cluster;
    OpenXrConfig openxr;
    interaction::StillnessLimits stillness;
    interaction::ComfortOptions comfort;
    PanelConfig panel;
    bool grid = false; ///< floor grid shown at the start
    interaction::QualityMode quality = interaction::QualityMode::automatic;
    /// What a settled picture is drawn with, whatever it costs; empty: the best that fits the
    /// budget (in a fixed-step replay, which measures nothing, the best there is).
    std::optional<render::Footprint> settled_footprint;
    /// What quads and splats stand for.
    render::CellShape cell_shape = render::CellShape::plane;
    double frame_budget_ms = 0;   ///< that drawing may take; 0: one period of the display
    double still_budget_ms = 500; ///< likewise, once, of a picture that has come to rest
    PlacementOptions placement;
    int upload_kilobytes_per_frame = 4096;        ///< cells sent to the GPU per frame at most
    glm::vec3 background{0.055f, 0.063f, 0.078f}; ///< sRGB
    glm::vec3 surface_color{0.94f, 0.86f, 0.70f}; ///< sRGB
    std::vector<ConfiguredSurface> surfaces;      ///< none: one of surface_color
    interaction::Coloring coloring;
    std::vector<LoadedColorMap> color_maps; ///< beside those that the program knows
    interaction::Look look;
    render::CellAppearance appearance; ///< light and material
    Blending blending = Blending::automatic;
    render::DrawnBy drawn_by = render::DrawnBy::automatic; ///< whose ways cells are drawn in
    int samples = 0; ///< of each pixel; 0: 4 where the GPU draws, 1 where the processor does
    int picture_samples = 0;  ///< likewise of pictures that are written; 0: 4, or more on displays
    int cache_megabytes = 0;  ///< what is kept of the index; 0: a quarter of what there may be
    int mesh_megabytes = 96;  ///< that the triangles of a set may take; 0: none are made
    bool bounding_box = true; ///< with ticks and numbers
    bool wand_ray = true;
    bool picture_ray = false;     ///< pictures that are written show it, too
    bool picture_caption = false; ///< and say isovalue and time
    /// Nobody looks on: what is drawn is written, so that each picture is drawn once, as it is kept.
    bool only_kept = false;

    /// As IndexFile::open takes it.
    std::uint64_t cache_bytes() const { return std::uint64_t(cache_megabytes) << 20; }
    /// Likewise SurfacesQuery.
    std::uint64_t mesh_room() const { return std::uint64_t(mesh_megabytes) << 20; }
};

/// @param name stands before the line number in messages
/// @throws ConfigError naming file, line, key and, for an unknown one, the nearest known key
Config parse_config(const std::string& text, const std::string& name);

/// @param path a file, or the name of a shipped configuration (`desktop`, `cave4`, ...)
/// @throws ConfigError as above, or when the file cannot be read
Config read_config(const std::filesystem::path& path);

/// What a configuration may hold, as editors and other programs check it (JSON Schema, draft 7): the
/// readers above tell it, so that it says what they accept. Shipped as
/// configs/isochron.schema.json.
std::string config_schema();

/// The emulation's options with the field of view of the first window's first screen.
interaction::EmulationOptions emulation_for(const Config& config);

/// Names as configuration files and the command line use them.
interaction::QualityMode quality_mode_from_name(const std::string& name); ///< @throws ConfigError
std::vector<std::string> stereo_mode_names();
/// `auto` (empty), `gaussian`, `surface`: what a settled picture is drawn with.
std::optional<render::Footprint> settled_footprint_from_name(const std::string& name);
std::vector<std::string> settled_footprint_names();
/// `plane`, `voxel`. @throws ConfigError
render::CellShape cell_shape_from_name(const std::string& name);
std::vector<std::string> cell_shape_names();

} // namespace isochron::app
