// Makes meshes of what files of triangles state.
#include "index/readers/decoders/model/model.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/text_values.h"
#include "index/readers/process/reader_messages.h"
#include "index/system/mapped_file.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace isochron::index {
namespace {

constexpr double kMostCoordinate = 1e30; ///< products of three fit floats' range no more, beyond

/// Finds the points that are equal to earlier ones, by a table of places.
void join_equal_points(StatedModel& model) {
    std::size_t size = 16;
    while (size < 2 * model.points.size())
        size *= 2;
    constexpr std::uint32_t kEmpty = ~0u;
    std::vector<std::uint32_t> table(size, kEmpty), number(model.points.size());
    const auto hash_of = [](const glm::dvec3& point) {
        std::uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) {
            std::uint64_t bits = 0;
            std::memcpy(&bits, &point[axis], sizeof bits);
            hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 29;
        }
        return hash;
    };
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < model.points.size(); ++i) {
        const glm::dvec3 point = model.points[i] + 0.0; // -0 is 0
        std::size_t at = hash_of(point) & (size - 1);
        while (table[at] != kEmpty && model.points[table[at]] != point)
            at = (at + 1) & (size - 1);
        if (table[at] == kEmpty) {
            model.points[kept] = point;
            table[at] = kept++;
        }
        number[i] = table[at];
    }
    model.points.resize(kept);
    for (std::uint32_t& corner : model.corners)
        corner = number[corner];
}

/// Where the corners of each point begin in a list of all corners by points.
struct CornersOfPoints {
    std::vector<std::uint64_t> first;
    std::vector<std::uint32_t> corners;

    CornersOfPoints(std::size_t points, const std::vector<std::uint32_t>& all)
        : first(points + 1), corners(all.size()) {
        for (const std::uint32_t point : all)
            ++first[point];
        std::uint64_t before = 0;
        for (std::uint64_t& each : first)
            before += std::exchange(each, before);
        std::vector<std::uint64_t> next = first;
        for (std::size_t i = 0; i < all.size(); ++i)
            corners[next[all[i]]++] = static_cast<std::uint32_t>(i);
    }
};

/// A point is divided where its triangles meet at an edge. Both sides of a triangle are lit, so it
/// does not matter in which order it has its corners.
void add_normals(TriangleMesh& mesh) {
    constexpr float kSmooth = 0.8660254f; // cosine of 30 degrees
    double span = 0;                      // so that what is multiplied fits floats
    for (const glm::vec3& point : mesh.points)
        span = std::max({span, std::abs(double{point.x}), std::abs(double{point.y}),
                         std::abs(double{point.z})});
    const double scale = span > 0 ? 1 / span : 1.0;
    std::vector<glm::vec3> across(mesh.triangles()); // as long as the triangle is large
    for (std::size_t i = 0; i < across.size(); ++i) {
        const auto at = [&](std::size_t k) {
            return scale * glm::dvec3(mesh.points[mesh.corners[3 * i + k]]);
        };
        across[i] = glm::vec3(glm::cross(at(1) - at(0), at(2) - at(0)));
    }
    const CornersOfPoints of(mesh.points.size(), mesh.corners);
    struct Side {
        glm::vec3 first, sum;
        std::uint32_t point;
    };
    std::vector<Side> sides;
    const std::size_t points = mesh.points.size();
    mesh.normals.resize(points);
    for (std::size_t point = 0; point < points; ++point) {
        sides.clear();
        for (std::uint64_t i = of.first[point]; i < of.first[point + 1]; ++i) {
            const glm::vec3& large = across[of.corners[i] / 3];
            const float length = glm::length(large);
            const glm::vec3 unit = length > 0 ? large / length : glm::vec3(0.0f);
            auto side = std::ranges::find_if(sides, [&](const Side& each) {
                return !(std::abs(glm::dot(each.first, unit)) < kSmooth) || length == 0;
            });
            if (side == sides.end()) {
                const bool is_first = sides.empty();
                sides.push_back(
                    {unit, glm::vec3(0.0f),
                     static_cast<std::uint32_t>(is_first ? point : mesh.points.size())});
                if (!is_first)
                    mesh.points.push_back(glm::vec3(mesh.points[point]));
                side = std::prev(sides.end());
            }
            side->sum += glm::dot(side->first, large) < 0 ? -large : large;
            mesh.corners[of.corners[i]] = side->point;
        }
        mesh.normals.resize(mesh.points.size());
        for (const Side& side : sides) {
            const float length = glm::length(side.sum);
            mesh.normals[side.point] = length > 0 ? side.sum / length : glm::vec3(0.0f);
        }
    }
}

} // namespace

void StatedModel::add_polygon(std::span<const std::int64_t> polygon, const std::string& name,
                              const std::string& what) {
    for (const std::int64_t corner : polygon)
        if (corner < 0 || static_cast<std::uint64_t>(corner) >= points.size())
            throw Error("{}: {} has a corner at point {}: expected 0 to {}", name, what, corner,
                        static_cast<std::int64_t>(points.size()) - 1);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        for (const std::size_t k : {std::size_t{0}, i - 1, i})
            corners.push_back(static_cast<std::uint32_t>(polygon[k]));
}

void take_origin(std::string_view comment, bool in_floats, glm::dvec3& origin) {
    constexpr std::string_view kBefore = "less origin ";
    const std::size_t found = comment.find(kBefore);
    if (found == std::string_view::npos)
        return;
    comment.remove_prefix(found + kBefore.size());
    glm::dvec3 stated(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = comment.substr(0, comment.find_first_of(" \r\n"));
        float single = 0;
        if (in_floats ? !parse_value(word, single) : !parse_value(word, stated[axis]))
            return;
        if (in_floats)
            stated[axis] = double{single};
        if (!(std::abs(stated[axis]) <= kMostCoordinate))
            return;
        comment.remove_prefix(std::min(word.size() + 1, comment.size()));
    }
    origin = stated;
}

TriangleMesh finished(StatedModel model, const std::string& name) {
    if (model.corners.empty())
        throw Error("{}: holds no triangles ({} points): expected faces", name,
                    model.points.size());
    if (model.corners.size() / 3 > kMostModelTriangles ||
        model.points.size() > std::size_t{3} * kMostModelTriangles)
        throw Error("{}: {} triangles, expected at most {}", name, model.corners.size() / 3,
                    kMostModelTriangles);
    glm::dvec3 low(kMostCoordinate), high(-kMostCoordinate);
    for (std::size_t i = 0; i < model.points.size(); ++i) {
        const glm::dvec3& point = model.points[i];
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(point[axis]) <= kMostCoordinate))
                throw Error("{}: point {} has the coordinate {}: expected a number of at most {:g}",
                            name, i, point[axis], kMostCoordinate);
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    join_equal_points(model);
    TriangleMesh mesh;
    const glm::dvec3 middle = 0.5 * low + 0.5 * high;
    mesh.origin = model.origin + middle;
    mesh.points.reserve(model.points.size());
    for (const glm::dvec3& point : model.points)
        mesh.points.emplace_back(point - middle);
    mesh.corners = std::move(model.corners);
    model = {};
    add_normals(mesh);
    return mesh;
}

TriangleMesh decode_model(const std::filesystem::path& path) {
    const MappedFile file(path);
    const std::string name = path.string(), extension = lower_case(path.extension().string());
    const auto parse = extension == ".stl"   ? stl_model
                       : extension == ".ply" ? ply_model
                                             : obj_model;
    return finished(parse(file.bytes(), name), name);
}

} // namespace isochron::index
