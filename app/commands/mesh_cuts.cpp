// What of a surface is exported.
#include "app/commands/mesh_cuts.h"

#include "app/command_line/command_line.h"
#include "app/command_line/step_range.h"
#include "app/commands/simplified.h"
#include "app/output/export_request.h"
#include "app/text.h"
#include "index/error.h"
#include "index/export/mesh_crop.h"
#include "index/volume/instant_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace isochron::app {
namespace {

/// The vertices that `--crop` names. @throws UsageError
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
        throw UsageError(fmt::format(
            "--crop {}: expected X0:X1,Y0:Y1,Z0:Z1, vertices from 0 to {}, {} and {}, the first "
            "below the last",
            text, grid.vertices[0] - 1, grid.vertices[1] - 1, grid.vertices[2] - 1));
    return box;
}

/// The plane that `--clip` names; none without it. @throws UsageError
std::optional<interaction::ClipPlane> plane_of(const std::vector<double>& numbers) {
    if (numbers.empty())
        return std::nullopt;
    const glm::dvec3 point(numbers[0], numbers[1], numbers[2]);
    const glm::dvec3 normal(numbers[3], numbers[4], numbers[5]);
    const double length = glm::length(normal);
    if (!std::ranges::all_of(numbers, [](double each) { return std::isfinite(each); }) ||
        !(length > 0) || !std::isfinite(length))
        throw UsageError(fmt::format("--clip {:g}: expected a point on the plane and its normal, "
                                     "which is not 0: X Y Z NX NY NZ",
                                     fmt::join(numbers, " ")));
    return interaction::ClipPlane{true, point, normal / length};
}

} // namespace

std::function<void(index::CellMesh&, const index::Query&)> reshaping(const MeshCuts& cuts,
                                                                     const index::Grid& grid,
                                                                     const index::ExportPlan& plan,
                                                                     double& moved) {
    std::optional<index::VertexBox> box;
    if (cuts.crop)
        box = box_of(*cuts.crop, grid);
    const auto plane = plane_of(cuts.clip);
    const auto error = cuts.simplify;
    if (!box && !plane && !error)
        return {};
    return [box, plane, error, factor = plan.unit_factor, unit = plan.length_unit, &grid,
            &moved](index::CellMesh& mesh, const index::Query& query) {
        if (box)
            index::crop(mesh, *box);
        if (plane)
            clip(mesh, grid, *plane);
        if (!error)
            return;
        const std::size_t before = mesh.triangles.size() / 3;
        moved = std::max(moved, factor * simplify(mesh, grid, *error / factor));
        if (before > 0 && mesh.triangles.empty())
            throw index::Error(fmt::format("step {}: --simplify {}{} leaves none of the {} "
                                           "triangles at isovalue {}; a smaller "
                                           "distance is needed",
                                           index::number_text(query.instant), human_number(*error),
                                           with_space(unit), grouped(before),
                                           human_number(query.isovalue)));
    };
}

} // namespace isochron::app
