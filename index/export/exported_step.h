// What is exported of a step: its surfaces as meshes, and what a file says of them.
#pragma once

#include "index/export/exported_mesh.h"
#include "index/surface/cell_mesh.h"
#include "index/surface/cell_set.h"
#include "index/volume/grid.h"
#include "index/volume/instant_text.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// Functions that pack a mesh for EXT_meshopt_compression (Khronos, "glTF 2.0 Extension Registry").
/// Whoever has the library meshoptimizer passes them in: this floor does without it.
struct MeshPacking {
    /// @param stride bytes of each vertex, a multiple of 4
    std::vector<std::byte> (*vertices)(std::span<const std::byte> bytes, std::size_t stride);
    /// @param corners three of each triangle, which may begin with another corner afterwards
    /// @param vertices number of the vertices
    std::vector<std::byte> (*triangles)(std::span<const std::uint32_t> corners,
                                        std::size_t vertices);
};

/// What all steps of an export have in common.
struct ExportPlan {
    std::string note;              ///< one line: who wrote the file, of which data
    std::string length_unit;       ///< unit of the coordinates in the file; empty: not known
    std::string values_name;       ///< name of the values at the vertices; empty: there are none
    std::string time_unit;         ///< unit of `ExportedStep::time`; empty: not known
    double unit_factor = 1;        ///< from the data's unit of length to that of the file
    double meters = 1;             ///< in a unit of length of the file; 1 where it is not known
    bool double_precision = false; ///< coordinates have 64 bits
    bool normals = true;
    const MeshPacking* packing = nullptr; ///< in glTF; null: nothing is packed
    bool quantized = false;               ///< in glTF, places have 16 bits and normals 8
    double rate = 10;                     ///< steps a second in files that hold all steps
    std::vector<std::uint32_t> steps;     ///< ascending
    /// Each step is blended with the next one: so many 65536ths of it (index/volume/instant.h).
    std::uint32_t fraction = 0;
};

/// sRGB to linear light (IEC 61966-2-1), which colors of glTF and USD are in. Those of PLY, OBJ and
/// VTP are sRGB, as their readers take them.
float linear_light(std::uint8_t srgb);

/// A surface of a step.
struct ExportedSurface {
    std::string name;                    ///< `9.5 1/s`
    std::array<std::uint8_t, 3> color{}; ///< sRGB
    float opacity = 1;
    const ExportedMesh* mesh = nullptr; ///< with values, if the plan names them
    const CellSet* cells = nullptr;     ///< with points, if the format asks for cells
    double isovalue = 0;
    /// sRGB of a vertex with this value; null: `color` everywhere.
    const std::function<std::array<std::uint8_t, 3>(float value)>* color_of = nullptr;

    std::array<std::uint8_t, 3> color_at(float value) const {
        return color_of ? (*color_of)(value) : color;
    }
};

struct ExportedStep {
    Instant instant;
    double time = 0;
    const Grid* grid = nullptr;
    std::vector<ExportedSurface> surfaces;
};

/// The coordinates of a grid's vertices as they stand in a file.
class ExportedPlaces {
  public:
    static constexpr double kMostOfSide = 1e-3; ///< share of a cell's shortest side

    /// Places are those of physical space. Where single precision would move them by more than
    /// `kMostOfSide`, they count from the grid's first vertex, rounded to a float.
    ExportedPlaces(const Grid& grid, const ExportPlan& plan);

    /// Subtracted from all coordinates, in the unit of the file.
    const glm::dvec3& origin() const { return origin_; }
    /// In the unit of the file, less `origin`.
    glm::dvec3 of(const MeshVertex& vertex) const {
        return grid_.physical(position_of(vertex)) * factor_ - origin_;
    }
    /// Distance by which the file may move a vertex by rounding its coordinates, in its unit.
    /// @param longest_side of what the vertices fill, in the file's unit
    double rounding(double longest_side) const;
    /// Whether triangles must be turned, so that they are counter-clockwise as seen from the side
    /// of lower values.
    bool turned() const { return turned_; }
    template <class Corner>
    std::array<Corner, 3> triangle(const std::array<Corner, 3>& at) const {
        return turned_ ? std::array{at[0], at[2], at[1]} : at;
    }

  private:
    void find_farthest();

    const Grid& grid_;
    double factor_;
    glm::dvec3 origin_{0.0};
    double farthest_ = 0; ///< no coordinate in the file is larger
    bool double_, quantized_;
    bool turned_;
};

/// `coordinates in m, less origin 0 0 0`, in one line, for files that have a place for it.
std::string words_of(const ExportPlan& plan, const ExportedPlaces& places);
/// `step 3, time 0.5 s`.
std::string words_of(const ExportPlan& plan, const ExportedStep& step);

} // namespace isochron::index
