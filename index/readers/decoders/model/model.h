// Models: files of triangles. STL, PLY and OBJ are parsed here; VTK reads others.
#pragma once

#include "index/volume/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// What a file states.
struct StatedModel {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> corners; ///< three points a triangle
    glm::dvec3 origin{0.0}; ///< what `isochron export` has subtracted from the places, as it wrote

    /// Adds a polygon as a fan around its first corner. @throws Error naming the file when a corner is
    /// beyond the points, counted from 0
    /// @param what it is, for messages: `face 7`
    void add_polygon(std::span<const std::int64_t> polygon, const std::string& name,
                     const std::string& what);
};

// Each throws an Error that names the file, in one line: damaged, cut off, or with a corner that
// is no point.
StatedModel stl_model(std::span<const std::byte> bytes, const std::string& name);
StatedModel ply_model(std::span<const std::byte> bytes, const std::string& name);
StatedModel obj_model(std::span<const std::byte> bytes, const std::string& name);

/// Reads `less origin X Y Z` of a comment that `isochron export` writes; where there is none, `origin` stays.
/// @param in_floats it was written so
void take_origin(std::string_view comment, bool in_floats, glm::dvec3& origin);

/// Makes a mesh of it: places from the middle of the box, equal points once, and normals, which are
/// smooth where triangles meet at less than 30 degrees.
/// @throws Error naming the file: no triangles, more than kMostModelTriangles, or a coordinate that
/// is no finite number or more than 1e30
TriangleMesh finished(StatedModel model, const std::string& name);

/// Reads a file by its extension. @throws Error naming it
TriangleMesh decode_model(const std::filesystem::path& path);

} // namespace isochron::index
