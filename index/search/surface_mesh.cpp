// Searches for the cells of a surface, makes their mesh, and unpacks it.
#include "index/search/surface_mesh.h"

#include "index/error.h"
#include "index/search/index_search.h"
#include "index/search/layer_search.h"

#include <glm/vec3.hpp>

namespace isochron::index {
namespace {

std::array<float, 3> as_floats(const glm::dvec3& at) {
    return {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
}

SurfaceMesh unpacked(const CellMesh& mesh, const Grid& grid, const MeshWishes& wishes) {
    SurfaceMesh surface;
    surface.points.reserve(mesh.vertices.size());
    for (const MeshVertex& vertex : mesh.vertices)
        surface.points.push_back(as_floats(grid.physical(position_of(vertex))));
    surface.triangles.reserve(mesh.triangles.size() / 3);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        surface.triangles.push_back(
            {mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
    if (wishes.normals) {
        surface.normals.reserve(mesh.vertices.size());
        for (const MeshVertex& vertex : mesh.vertices)
            surface.normals.push_back(as_floats(normal_of(vertex)));
    }
    surface.values = mesh.values;
    return surface;
}

} // namespace

struct SurfaceMeshes::WorkSpace {
    explicit WorkSpace(const std::shared_ptr<const IndexFile>& of)
        : file(of), wide(has_wide_ids(of->info().grid)),
          // Where ids are wide, a mesh is made of cells with their places.
          search(search_into(of, std::nullopt, wide ? Shading::cells : Shading::none)), layers(of) {
    }

    using Make =
        std::function<bool(const StepView& step, const CellSet& cells, const ColorSource* values)>;
    /// @param wanted null, or gets the cells, with points @return false when stopped
    bool search_and_make(const Query& query, const MeshWishes& wishes, const std::stop_token& stop,
                         CellSet* wanted, const Make& make) {
        const StepView step = step_of_query(*file, query.instant, {&query.isovalue, 1});
        std::optional<ColorSource> source;
        if (wishes.values) {
            if (const std::size_t count = ColorSource::count(*file); *wishes.values >= count)
                throw Error("array {} to color by: {} has {}", *wishes.values, file->name(), count);
            source.emplace(*file, *wishes.values);
        }
        CellSet found;
        CellSet& cells = wanted ? *wanted : found;
        try {
            return search(step, query.isovalue, stop, cells) &&
                   make(step, cells, source ? &*source : nullptr) &&
                   (!wanted || wide || layers.shade_cells(step, cells, stop));
        } catch (const Stopped&) {
            return false;
        }
    }

    std::shared_ptr<const IndexFile> file;
    bool wide;
    SearchInto search;
    LayerSearch layers;
};

SurfaceMeshes::SurfaceMeshes(std::shared_ptr<const IndexFile> file)
    : work_(std::make_unique<WorkSpace>(file)) {}
SurfaceMeshes::~SurfaceMeshes() = default;

std::optional<CellMesh> SurfaceMeshes::make_packed(const Query& query, const MeshWishes& wishes,
                                                   const std::stop_token& stop, CellSet* cells) {
    CellMesh mesh;
    const auto make = [&](const StepView& step, const CellSet& found, const ColorSource* source) {
        return work_->layers.make_mesh(step, found, mesh, stop, {source, true});
    };
    if (!work_->search_and_make(query, wishes, stop, cells, make))
        return std::nullopt;
    return mesh;
}

bool SurfaceMeshes::make_pieces(const Query& query, const MeshWishes& wishes,
                                const std::function<void(CellMesh piece)>& take,
                                const std::stop_token& stop) {
    const auto make = [&](const StepView& step, const CellSet& found, const ColorSource* source) {
        return work_->layers.make_mesh_pieces(step, found, take, stop, {source, true});
    };
    return work_->search_and_make(query, wishes, stop, nullptr, make);
}

bool SurfaceMeshes::find_cells(const Query& query, CellSet& cells, const std::stop_token& stop) {
    const auto make_nothing = [](const StepView&, const CellSet&, const ColorSource*) {
        return true;
    };
    return work_->search_and_make(query, {}, stop, &cells, make_nothing);
}

std::optional<SurfaceMesh> SurfaceMeshes::make(const Query& query, const MeshWishes& wishes,
                                               const std::stop_token& stop) {
    const std::optional<CellMesh> mesh = make_packed(query, wishes, stop);
    if (!mesh)
        return std::nullopt;
    return unpacked(*mesh, work_->file->info().grid, wishes);
}

SurfaceMesh mesh_of(const std::shared_ptr<const IndexFile>& file, const Query& query,
                    const MeshWishes& wishes) {
    return *SurfaceMeshes(file).make(query, wishes); // which nobody stops
}

} // namespace isochron::index
