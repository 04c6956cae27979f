// What one eye sees: the cells, the volume's box, the wand and what lies on the floor.
#pragma once

#include "app/config.h"
#include "app/guides.h"
#include "index/volume_series.h"
#include "render/cell_buffers.h"
#include "render/cell_pass.h"
#include "render/line_pass.h"
#include "render/view.h"

#include <optional>

namespace isochron::app {

class Scene {
  public:
    Scene(const render::Gl& gl, const index::SeriesInfo& info, const Config& config);

    /// Moves the newest set to the GPU, at most the configured bytes per call.
    void upload(const index::ExtractionPtr& newest);
    const index::ExtractionPtr& shown() const { return cells_.shown(); }

    const render::UploadCount& uploaded() const { return cells_.count(); }

    /// That the shown cells can be drawn with: a very large set has no room for its surface.
    render::Footprint best_footprint() const;

    void set_guides(const Guides& guides) { guides_ = lines_of(guides); }

    /// @param wand drawn as a ray when given
    void draw(const render::View& view, const interaction::Similarity& room_from_physical,
              render::Footprint footprint, const std::optional<interaction::Pose>& wand);

  private:
    const index::Grid grid_;
    const bool bounding_box_;
    const std::size_t upload_bytes_; ///< per frame
    render::CellAppearance appearance_;
    render::CellBuffers cells_;
    render::CellPass cell_pass_;
    render::LinePass line_pass_;
    std::vector<render::Line> guides_;
};

} // namespace isochron::app
