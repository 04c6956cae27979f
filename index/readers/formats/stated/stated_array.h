// What a container states of an array, before any of it is understood: NetCDF, Zarr, HDF5 and
// others fill the same record, and one piece of code makes grid, times, units and notes of it.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// One axis of an array. What is empty is not stated.
struct StatedAxis {
    std::string name;         ///< name of the dimension: `lev`
    std::uint64_t length = 0; ///< number of vertices, or of steps, or of components
    std::string kind = {};    ///< `space`, `time` or `channel`, as OME-Zarr's `type`

    /// The variable that has the coordinates, `height`; empty: there is none.
    std::string coordinate = {};
    std::vector<double> at = {};         ///< the coordinates of all vertices, scaled
    std::vector<std::string> dates = {}; ///< or of all steps, where they are texts
    double first = 0, step = 1; ///< or the coordinate of the first vertex, and the distance
    bool regular = false;       ///< whether `first` and `step` are stated
    std::string unit = {};      ///< unit of the coordinates, as it is written

    /// Attributes of the CF conventions that the variable of the coordinates has.
    std::string axis = {}, standard_name = {}, positive = {}, calendar = {};
    std::vector<double> missing = {}; ///< coordinates that stand for missing ones, scaled
};

/// Axes of space that need not run along x, y and z.
struct StatedDirections {
    glm::dmat3 steps{1.0}; ///< from a vertex to the next along each of them, fastest first
    glm::dvec3 origin{0.0};
    std::array<std::string, 3> units = {}; ///< units of x, y and z, as written
};

/// One array with its axes.
struct StatedArray {
    std::string file, name;       ///< for messages
    std::vector<StatedAxis> axes; ///< slowest first
    /// In place of the coordinates of the axes of space.
    std::optional<StatedDirections> directions = {};
};

/// The attributes of one object of a container: of an array, or of a group around it.
struct StatedAttributes {
    std::function<std::string(const char* name)> text;               ///< empty: there is none
    std::function<std::vector<std::string>(const char* name)> texts; ///< a list of texts
    std::function<std::vector<double>(const char* name)> numbers;    ///< empty: there is none
    std::function<bool(const char* name)> is_real;   ///< whether the numbers are f32 or f64
    std::function<std::vector<std::string>()> names; ///< names of all attributes
};

} // namespace isochron::index
