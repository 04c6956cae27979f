// What the checks of a configuration look at: its viewports, and the walls that they show.
#pragma once

#include "app/config/config.h"

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// A viewport, with its screen, in its window.
struct PlacedViewport {
    const stereo::Window& window;
    const stereo::Viewport& viewport;
    std::size_t number; ///< number of the viewport in its window, from 1
    int line = viewport.screen.line.number;
};

std::string name_of(const PlacedViewport& place);
glm::vec2 pixels_of(const PlacedViewport& place);
/// Size of a pixel on the screen [m]. An eye with half of the window is either stretched over the
/// whole screen or has its own projector: takes the one with squarer pixels.
glm::vec2 pixel_size(const PlacedViewport& place);

/// A screen that stands in the room, with corners from the file.
struct Wall {
    const PlacedViewport* place;
    glm::vec3 middle, across, up, normal; ///< [m], unit vectors; the normal points to the viewer
    glm::vec2 size;                       ///< [m]
    std::array<glm::vec3, 4> corners;     ///< lower left, upper left, upper right, lower right

    const stereo::Screen& screen() const { return place->viewport.screen; }
    const stereo::Window& window() const { return place->window; }
    int line() const { return place->line; }
    bool is_level() const; ///< a floor, a ceiling or a table
    bool is_floor() const; ///< level, seen from above, and large enough to stand on
    /// Whether a ray from a place meets it, from either side.
    bool is_met(const glm::vec3& from, const glm::vec3& direction) const;
};

struct Box {
    glm::vec3 low, high;
    glm::vec3 middle() const { return 0.5f * (low + high); }
};

/// Refers to the configuration, which outlives it.
class CheckedRoom {
  public:
    explicit CheckedRoom(const Config& config);
    CheckedRoom(const CheckedRoom&) = delete;
    CheckedRoom& operator=(const CheckedRoom&) = delete;

    const Config& config() const { return config_; }
    const stereo::Installation& installation() const { return config_.installation; }
    const std::vector<PlacedViewport>& viewports() const { return viewports_; }
    const std::vector<Wall>& walls() const { return walls_; }
    const stereo::Viewer& viewer_of(const PlacedViewport& place) const;
    const stereo::Viewer& viewer_of(const Wall& wall) const { return viewer_of(*wall.place); }
    /// The walls that a viewer sees, and the box around them.
    std::vector<const Wall*> walls_of(std::size_t viewer) const;
    static Box box_of(const std::vector<const Wall*>& walls);
    /// The line of `table.key = ` in the file, in the first table of a list that has it; 0: none.
    int line_of(std::string_view key) const;
    bool has(std::string_view key) const { return line_of(key) > 0; }

  private:
    const Config& config_;
    std::vector<PlacedViewport> viewports_;
    std::vector<Wall> walls_;
    std::map<std::string, int, std::less<>> lines_;
};

/// Where the floor is [m]: the lowest floor that is a wall; or else the origin, if walls begin about
/// there or above; or else the foot of the walls.
float floor_level(const std::vector<const Wall*>& walls);

bool shows_one_eye(const Wall& wall);
/// Whether two walls have the same corners.
bool same_place(const Wall& a, const Wall& b);
/// Whether two screens lie in one plane and face the same way, as the displays of a tiled wall do.
bool in_one_wall(const Wall& a, const Wall& b);

/// Calls `visit` for each pair of walls, the one that comes later in the file second.
template <class Visit>
void each_pair(const CheckedRoom& room, Visit&& visit) {
    const auto& walls = room.walls();
    for (std::size_t i = 0; i < walls.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            visit(walls[j], walls[i]);
}

/// Whether a screen has the corners that it has where a file gives none.
bool has_usual_corners(const stereo::Screen& screen);

/// A length may be of another unit than meters: `; 9.843 feet would be 3.00 m`. Empty where no unit
/// makes it lie between two plausible lengths [m].
std::string other_unit(float length, float low, float high);

} // namespace isochron::app
