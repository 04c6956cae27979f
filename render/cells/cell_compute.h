// Compute passes for a new set: cell positions, planes, and values and gradients at the vertices.
#pragma once

#include "index/extraction/extraction.h"
#include "render/cells/axis_table.h"
#include "render/cells/block_pool.h"
#include "render/cells/draw_part.h"
#include "render/cells/slot_assignment.h"
#include "render/gl/shader.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace isochron::render {

/// The compute passes of one volume; each covers slots 0 to n - 1.
class CellCompute {
  public:
    /// @param held type of the values in blocks
    /// @throws Error when a shader does not compile, or the driver's limits are too small
    CellCompute(const Gl& gl, const index::Grid& grid, const AxisTable& axes,
                index::ValueType held);

    /// Applies the changes of the new set to the pool's page table.
    void enter_pages(const BlockPool& blocks) const;

    /// Writes the cells of a slot assignment's message into `points` (three words per slot, see
    /// index::CellPoint), without their planes.
    void place_cells(const SlotAssignment& assignment, const index::Extraction& set,
                     const DeviceArray& message, const DeviceArray& points) const;

    /// Gives every point of the set its style, see index::CellPoint.
    /// @param styles by slot, two per word. If the set has no colors, `styles` is not read and all
    /// color coordinates become 0.
    void set_styles(const index::Extraction& set, const DeviceArray& styles,
                    const DeviceArray& points) const;

    /// Writes the planes of all points. @param set its blocks are in the pool
    void fill_planes(const index::Extraction& set, const BlockPool& blocks,
                     const DeviceArray& points) const;

    /// Values and gradients at the vertices of cells, by slot or by number.
    struct Corners {
        const DeviceArray& values;
        const DeviceArray& gradients;
        std::size_t first = 0; ///< slot or number at the beginning of both
        GLuint list = 0;       ///< buffer of slots by number; 0: by slot
    };
    /// Writes these of some cells.
    void fill_corners(const index::Extraction& set, const BlockPool& blocks,
                      const DeviceArray& points, DrawPart cells, const Corners& to) const;

  private:
    void use_volume(const index::Extraction& set, const BlockPool& blocks) const;
    void bind(GLuint binding, const DeviceArray& array) const;
    void bind(GLuint binding, const DeviceArray& array, std::size_t first, std::size_t count) const;
    /// The uniform block of work.glsl, in std140 layout.
    struct Work {
        std::uint32_t begin = 0, end = 0;
        std::uint32_t whole = 0, colored = 0;
        std::array<std::uint32_t, 2> cells{};
        std::array<std::uint32_t, 2> padding{};
        std::array<std::uint32_t, index::kMostSurfaces> surface_ends{};
    };
    /// Runs a program for some items, in ranges that one dispatch can do;
    /// `prepare(begin, end)` binds the data of each range. @param work its range is filled in here
    template <class Prepare>
    void run(const LazyProgram& program, DrawPart items, Work work, Prepare&& prepare) const;
    template <class Prepare>
    void run(const LazyProgram& program, std::size_t count, Work work, Prepare&& prepare) const {
        run(program, DrawPart{0, count}, work, std::forward<Prepare>(prepare));
    }

    const Gl* gl_;
    index::Grid grid_;
    const AxisTable* axes_;
    std::size_t at_once_; ///< most items in one dispatch
    LazyProgram pages_, places_, styles_, planes_, corners_;
    Buffer volume_, work_;
};

} // namespace isochron::render
