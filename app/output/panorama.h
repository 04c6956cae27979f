// Pictures of all directions around a viewer, for both eyes: equirectangular, the left eye's above
// the right eye's, put together from flat views.
#pragma once

#include "app/output/picture_note.h"
#include "interaction/input/tracked_input.h"
#include "render/gl/image.h"
#include "stereo/installation.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <utility>

namespace isochron::app {

/// How a panorama is divided. Column x of W looks to azimuth (x + 0.5) / W * 360 - 180 degrees,
/// counted to the right from straight ahead; row y of an eye's H = W / 2 rows to elevation
/// 90 - (y + 0.5) / H * 180 degrees. In each column the eyes stand left and right of that column's
/// direction (omnidirectional stereo: Peleg, Ben-Ezra and Pritch 2001, doi 10.1109/34.910880);
/// between the middles of sectors this is approximated, by at most half a pixel for what is 1 m away.
class PanoramaPlan {
  public:
    static constexpr int kNarrowest = 256; ///< [pixel]
    /// @param size of both eyes' pictures: a square @throws std::invalid_argument: it is none
    explicit PanoramaPlan(glm::ivec2 size);

    glm::ivec2 size() const { return size_; }
    std::size_t sectors() const { return sectors_; }
    /// Leaves one window, which shows a sector: its upper view and its lower one, to both eyes.
    void prepare(stereo::Installation& installation) const;
    /// The devices, with the head of the first viewer level and turned to the middle of a sector.
    interaction::InputState turned(interaction::InputState input, const stereo::Viewer& viewer,
                                   std::size_t sector) const;
    /// The columns of a sector: the first, and the one behind the last.
    std::pair<int, int> columns(std::size_t sector) const;
    /// Where a direction lies in a view of a sector: fractions of the view from its lower left.
    glm::dvec2 place_in_view(double azimuth, double elevation, std::size_t sector,
                             bool upper) const;

  private:
    double middle_of(std::size_t sector) const; ///< azimuth [rad]
    glm::ivec2 size_;
    std::size_t sectors_;
    glm::ivec2 view_;   ///< size of a view, pixels
    glm::dvec2 extent_; ///< half of a view's size at a distance of 1
};

/// The picture that is put together.
class PanoramaSheet {
  public:
    explicit PanoramaSheet(const PanoramaPlan& plan);
    /// @param part which eye, and viewport 0 (upper view) or 1
    void add(std::size_t sector, const PicturePart& part, const render::Image& view);
    render::Image take() { return std::move(sheet_); }

  private:
    const PanoramaPlan& plan_;
    render::Image sheet_;
};

} // namespace isochron::app
