// What of a surface is exported.
#include "app/commands/mesh_cuts.h"

#include "app/command_line/command_line.h"
#include "app/command_line/step_range.h"
#include "app/output/export_request.h"
#include "app/text.h"
#include "index/error.h"
#include "index/export/simplified_mesh.h"
#include "index/measure/kept_pieces.h"
#include "index/volume/instant_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

namespace isochron::app {
namespace {

/// The distance that `--simplify` names. @param cell shortest side of one, and result, in the file's
/// unit @throws UsageError
double distance_of(const std::string& text, double cell) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, problem] = std::from_chars(text.data(), end, number);
    std::string_view unit(rest, end);
    unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
    const bool in_cells = unit == "cells" || unit == "cell";
    if (problem != std::errc{} || !(number > 0) || !std::isfinite(number) ||
        !(unit.empty() || in_cells))
        throw UsageError("--simplify {}: expected a distance above 0 in the unit of the file (0.1) "
                         "or in cells (0.5cells)",
                         text);
    return in_cells ? number * cell : number;
}

/// Whether what is left of a surface tells little of it.
bool is_nearly_nothing(std::size_t triangles, std::size_t before, double moved, double side) {
    return triangles * 10 < before && (triangles < 20 || triangles * 50 < before) &&
           moved > side / 20;
}

/// The longest side of the box around a mesh [unit of the data].
double longest_side(const index::CellMesh& mesh, const index::Grid& grid) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const index::MeshVertex& vertex : mesh.vertices) {
        const glm::dvec3 at = grid.physical(position_of(vertex));
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::dvec3 size = high - low;
    return mesh.vertices.empty() ? 0 : std::max({size.x, size.y, size.z});
}

/// Simplifies the surfaces of an export.
struct Simplifying {
    std::string asked;
    double error; ///< [unit of the file]
    const index::Grid& grid;
    const index::ExportPlan& plan;
    SimplifiedBy& moved;

    void operator()(index::CellMesh& mesh, const index::Query& query,
                    const std::function<void()>& look) const {
        const std::size_t before = mesh.triangles.size() / 3;
        if (before == 0)
            return;
        const double side = plan.unit_factor * longest_side(mesh, grid);
        // Both surfaces are rounded: the one that is exported, and the one that it is compared with.
        const double rounding = 2 * index::ExportedPlaces(grid, plan).rounding(side);
        const auto refused = [&](const std::string& why) {
            throw index::Error("step {}: --simplify {}: {}", index::number_text(query.instant),
                               asked, why);
        };
        if (error <= rounding)
            refused(fmt::format("a file of this precision moves vertices by up to {} already",
                                upper_text(rounding / 2, plan.length_unit)));
        const double distance =
            rounding + plan.unit_factor *
                           index::simplify(mesh, grid, (error - rounding) / plan.unit_factor, look);
        if (is_nearly_nothing(mesh.triangles.size() / 3, before, distance, side))
            refused(fmt::format("leaves {} of {} triangles at isovalue {}, which is {} long; a "
                                "smaller distance is needed",
                                mesh.triangles.size() / 3, grouped(before),
                                human_number(query.isovalue), with_unit(side, plan.length_unit)));
        moved.moved = std::max(moved.moved, distance);
        moved.cells = moved.moved / (plan.unit_factor * index::shortest_side(grid));
    }
};

} // namespace

std::optional<interaction::ClipPlane> plane_of(const std::vector<double>& numbers) {
    if (numbers.empty())
        return std::nullopt;
    const glm::dvec3 point(numbers[0], numbers[1], numbers[2]);
    const glm::dvec3 normal(numbers[3], numbers[4], numbers[5]);
    const double length = glm::length(normal);
    if (!(length > 0) || !std::isfinite(length))
        throw UsageError("--clip {:g}: expected a point on the plane and its normal, which is not "
                         "0: X Y Z NX NY NZ",
                         fmt::join(numbers, " "));
    return interaction::ClipPlane{true, point, normal / length};
}

index::VertexBox box_of(const std::string& text, const index::Grid& grid) {
    const auto numbers = whole_numbers(text, ":,");
    std::string form;
    std::ranges::copy_if(text, std::back_inserter(form),
                         [](char c) { return c == ':' || c == ','; });
    index::VertexBox box;
    bool fits = numbers && numbers->size() == 6 && form == ":,:,:";
    for (std::size_t axis = 0; fits && axis < 3; ++axis) {
        const std::uint64_t first = (*numbers)[2 * axis], last = (*numbers)[2 * axis + 1];
        fits = first < last && last < grid.vertices[axis];
        box.first[axis] = static_cast<std::uint32_t>(first);
        box.last[axis] = static_cast<std::uint32_t>(last);
    }
    if (!fits)
        throw UsageError("--crop {}: expected X0:X1,Y0:Y1,Z0:Z1, vertices from 0 to {}, {} and {}, "
                         "the first below the last",
                         text, grid.vertices[0] - 1, grid.vertices[1] - 1, grid.vertices[2] - 1);
    return box;
}

decltype(index::ExportRequest::reshape) reshaping(const MeshCuts& cuts, const index::Grid& grid,
                                                  bool complete, const index::ExportPlan& plan,
                                                  SimplifiedBy& moved) {
    std::optional<index::VertexBox> box;
    if (cuts.crop)
        box = box_of(*cuts.crop, grid);
    const auto plane = plane_of(cuts.clip);
    std::optional<Simplifying> simplifying;
    if (cuts.simplify)
        simplifying.emplace(
            *cuts.simplify,
            distance_of(*cuts.simplify, plan.unit_factor * index::shortest_side(grid)), grid, plan,
            moved);
    if (!box && !plane && !simplifying && cuts.dust == 0)
        return {};
    const index::PieceFilter pieces{.only = {}, .hidden = {}, .dust = cuts.dust};
    return [box, plane, simplifying, pieces, complete, &grid](index::CellMesh& mesh,
                                                              const index::Query& query,
                                                              const std::function<void()>& look) {
        index::keep(mesh, index::kept_pieces(mesh, grid, complete, pieces, 0));
        if (box || plane)
            index::keep_triangles(mesh, [&](const index::MeshVertex& vertex) {
                return (!box || is_within(vertex, *box)) &&
                       (!plane || is_left(vertex, grid, *plane));
            });
        if (simplifying)
            (*simplifying)(mesh, query, look);
    };
}

} // namespace isochron::app
