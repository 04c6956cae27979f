// The cells of opaque surfaces that can still be seen while a picture is drawn, for software GL.
#pragma once

#include "render/cells/axis_places.h"
#include "render/cells/cell_buffers.h"
#include "render/cells/placement.h"
#include "render/culling/box_projection.h"
#include "render/culling/drawn_depths.h"
#include "render/gl/buffer_texture.h"
#include "render/gl/view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

/// What is to be drawn into one or two views.
struct SightWanted {
    std::span<const View> views;
    const Placement& placement;
    const CellBuffers& cells;
    std::int32_t surfaces;  ///< one bit for each that is drawn
    bool all_cells = false; ///< for comparisons: takes all to be in sight
};

/// Leaves out cells that are outside the views, or behind what is drawn: drawing a cell takes
/// twenty times as long as finding that. Depths are read back every now and then, so that what has
/// been drawn before is known exactly, whatever it was, and the picture stays the same to the bit.
class CellsInSight {
  public:
    explicit CellsInSight(const Gl& gl);

    /// Goes on with the last picture if it stopped just there. Else begins with a new picture; all
    /// that is known about a new picture is what the bound framebuffer holds.
    /// @param first number of cells that came before; 0: nothing of the picture is drawn
    void begin(const SightWanted& wanted, std::size_t first);

    /// Finds the next cells that may be seen, which must be drawn before the next call.
    /// @param back_to_front slots in this order, the same while a picture is drawn
    /// @param most cells to find
    /// @param effort that may be spent: a cell that is found costs 1, any other cell costs `kHidden`;
    /// the search stops when the effort is used up
    /// @return slots, nearest first
    std::span<const std::uint32_t> next(std::span<const std::uint32_t> back_to_front,
                                        std::size_t most, double& effort);
    /// Number of cells that came before, found or not.
    std::size_t passed() const { return passed_; }
    /// What was found last, as a GL_TEXTURE_BUFFER of R32UI texels; and its buffer.
    GLuint texture() const { return texels_.texture(); }
    GLuint buffer() const { return texels_.buffer(); }

    static constexpr double kHidden = 1.0 / 24.0;

  private:
    bool is_in_sight(const CellPlace& place) const;

    const Gl* gl_;
    BufferTexture texels_; ///< what was found
    // The picture:
    std::uint64_t version_ = 0; ///< version of the cells
    GLint framebuffer_ = 0;
    std::vector<View> views_;
    Placement placement_;
    std::int32_t surfaces_ = 0;
    bool all_cells_ = false;
    std::size_t passed_ = 0;
    std::size_t unread_ = 0;                 ///< cells that are drawn since depths were read
    std::vector<BoxProjection> projections_; ///< by view, as are depths
    std::vector<DrawnDepths> depths_;
    std::array<AxisPlaces, 3> axes_; ///< places of a rectilinear grid

    std::span<const CellPlace> places_; ///< during `next`
    std::vector<std::uint32_t> found_;
};

} // namespace isochron::render
