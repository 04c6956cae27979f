// The configuration: an installation and the program's settings, read from a TOML file.
#pragma once

#include "app/config/cluster_config.h"
#include "app/config/color_map_file.h"
#include "app/config/device_config.h"
#include "app/config/display_config.h"
#include "app/config/first_placement.h"
#include "app/config/openxr_config.h"
#include "app/config/panel_config.h"
#include "interaction/controls/motion_gate.h"
#include "interaction/navigation/comfort.h"
#include "render/drawing/cell_pass.h"
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
    double quantile; ///< share of all values below it, 0 to 1; used if there is no isovalue
    glm::vec3 color; ///< sRGB
    float opacity = 1.0f;
};

/// How colors blend: `linear` in linear light; `display` in display values, which is faster on
/// software GL; `automatic` means `display` on software GL and `linear` on a GPU.
enum class Blending : std::uint8_t { automatic, linear, display };

/// How good pictures are, and what they may cost: the table `quality`.
struct QualityConfig {
    interaction::QualityMode mode = interaction::QualityMode::automatic; ///< at the start
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
    bool bounding_box = true;    ///< with ticks and numbers
    bool wand_ray = true;
};

/// Written pictures: the keys `picture_...` of the table `rendering`.
struct PictureConfig {
    int samples = 0;      ///< 0: 4, and no fewer than on the displays
    bool ray = false;     ///< they show the wand's ray, too
    bool caption = false; ///< they show isovalue and time
    /// Height of words, see `text_height`; a window at a desk has its own. No key of a file.
    float text = 0;
    /// No window shows the pictures: each is drawn once, directly as the picture to keep. No key
    /// of a file.
    bool only_kept = false;
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

struct Config {
    std::string name; ///< file name for messages; empty for the built-in defaults
    std::string text; ///< the file's whole text, as recordings keep it
    stereo::Installation installation;
    DisplayPlaces places; ///< lines of the file that describe the installation's parts
    interaction::EmulationOptions emulation;
    DeviceConfig devices;
    ClusterConfig cluster;
    OpenXrConfig openxr;
    interaction::ComfortOptions comfort;
    bool grid = false; ///< floor grid shown at the start
    PanelConfig panel;
    PlacementOptions placement;
    QualityConfig quality;
    RenderingConfig rendering;
    PictureConfig pictures;
    MemoryConfig memory;
    std::vector<ConfiguredSurface> surfaces; ///< empty: one surface of rendering.surface_color
    interaction::Coloring coloring;
    std::vector<LoadedColorMap> color_maps; ///< beside those that the program knows
    interaction::Look look;
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
/// from the readers above, so it allows exactly what they accept. Shipped as
/// configs/isochron.schema.json.
std::string config_schema();

/// The emulation's options, with the field of view of the first window's first screen.
interaction::EmulationOptions emulation_for(const Config& config);

/// Names as configuration files and the command line use them.
interaction::QualityMode quality_mode_from_name(const std::string& name); ///< @throws ConfigError
std::vector<std::string> stereo_mode_names();
/// `auto` (empty), `gaussian`, `mesh`, `surface`: the footprint of a settled picture.
/// @throws ConfigError for any other name
std::optional<render::Footprint> settled_footprint_from_name(const std::string& name);
std::vector<std::string> settled_footprint_names();
/// `plane`, `voxel`. @throws ConfigError
render::CellShape cell_shape_from_name(const std::string& name);
std::vector<std::string> cell_shape_names();

} // namespace isochron::app
