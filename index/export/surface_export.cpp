// Makes the meshes of a step, colors their vertices, and hands them to the writer of a format.
#include "index/export/surface_export.h"

#include "index/search/surface_mesh.h"

#include <fmt/format.h>

namespace isochron::index {

ExportCount export_surfaces(const std::shared_ptr<const IndexFile>& file,
                            const SurfaceFormat& format, const std::filesystem::path& name,
                            const ExportRequest& request, const Progress& progress) {
    const SeriesInfo& info = file->info();
    MeshWishes wishes{.normals = request.plan.normals};
    if (request.values)
        wishes.values = request.values->array;
    SurfaceMeshes meshes(file);
    const auto writer = format.make(request.plan, name);
    ExportCount count;
    std::size_t done = 0;
    std::vector<CellMesh> kept(request.surfaces.size());
    std::vector<CellSet> cells(format.of_cells ? request.surfaces.size() : 0);
    for (const std::uint32_t step : request.plan.steps) {
        if (progress)
            progress("exporting",
                     static_cast<double>(done) / static_cast<double>(request.plan.steps.size()));
        ExportedStep exported{
            .step = step, .time = info.times.at(step), .grid = &info.grid, .surfaces = {}};
        std::uint64_t found = 0;
        for (std::size_t i = 0; i < request.surfaces.size(); ++i) {
            const SurfaceWish& wish = request.surfaces[i];
            CellMesh& mesh = kept[i];
            CellSet* const wanted = format.of_cells ? &cells[i] : nullptr;
            mesh = *meshes.make_packed({step, wish.isovalue}, wishes, {}, wanted);
            ExportedSurface surface{.name = wish.name,
                                    .color = wish.color,
                                    .opacity = wish.opacity,
                                    .mesh = &mesh,
                                    .cells = wanted,
                                    .isovalue = wish.isovalue};
            if (request.values && request.values->color_of) {
                surface.colors.reserve(mesh.values.size());
                for (const float value : mesh.values)
                    surface.colors.push_back(request.values->color_of(value));
            }
            found += mesh.cases.size();
            count.vertices += mesh.vertices.size();
            count.triangles += mesh.triangles.size() / 3;
            exported.surfaces.push_back(std::move(surface));
        }
        writer->add(exported);
        count.cells += found;
        if (found == 0)
            count.empty_steps.push_back(step);
        ++done;
    }
    writer->finish();
    if (progress)
        progress("exporting", 1);
    return count;
}

} // namespace isochron::index
