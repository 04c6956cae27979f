// Models that VTK reads: VTP, and glTF in both forms.
#include "index/readers/decoders/mesh/mesh_model.h"

#include "index/lower_case.h"
#include "index/readers/decoders/vtk/vtk_session.h"

#include <fmt/format.h>

#include <vtkCellArray.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkGLTFReader.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {
namespace {

/// @param turned y is up, as in glTF: it becomes z
void add_triangles(vtkPolyData& surface, bool turned, StatedModel& model, const std::string& name) {
    const auto first = static_cast<std::int64_t>(model.points.size());
    for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) {
        std::array<double, 3> at{};
        surface.GetPoint(i, at.data());
        model.points.push_back(turned ? glm::dvec3(at[0], -at[2], at[1])
                                      : glm::dvec3(at[0], at[1], at[2]));
    }
    for (vtkCellArray* const cells : {surface.GetPolys(), surface.GetStrips()}) {
        const std::size_t most =
            cells == surface.GetStrips() ? 3 : SIZE_MAX; // corners of each face
        vtkIdType count = 0;
        const vtkIdType* points = nullptr;
        cells->InitTraversal();
        for (std::uint64_t face = 0; cells->GetNextCell(count, points) != 0; ++face) {
            std::vector<std::int64_t> corners;
            for (vtkIdType k = 0; k < count; ++k)
                corners.push_back(points[k] < 0 ? -1 : first + points[k]);
            for (std::size_t k = 0; k + std::min(most, corners.size()) <= corners.size(); ++k)
                model.add_polygon(std::span(corners).subspan(k, std::min(most, corners.size())),
                                  name, fmt::format("face {}", face));
        }
    }
}

} // namespace

TriangleMesh decode_vtk_model(const std::filesystem::path& path) {
    const std::string name = path.string();
    StatedModel model;
    with_vtk(path, [&] {
        if (lower_case(path.extension().string()) == ".vtp") {
            const vtkNew<vtkXMLPolyDataReader> reader;
            reader->SetFileName(path.c_str());
            reader->Update();
            return add_triangles(*reader->GetOutput(), false, model, name);
        }
        const vtkNew<vtkGLTFReader> reader;
        reader->SetFileName(path.c_str());
        reader->ApplyDeformationsToGeometryOn();
        reader->Update();
        const auto parts = vtkSmartPointer<vtkCompositeDataIterator>::Take(
            static_cast<vtkCompositeDataSet*>(reader->GetOutputDataObject(0))->NewIterator());
        for (parts->InitTraversal(); !parts->IsDoneWithTraversal(); parts->GoToNextItem())
            if (auto* const surface = vtkPolyData::SafeDownCast(parts->GetCurrentDataObject()))
                add_triangles(*surface, true, model, name);
    });
    return finished(std::move(model), name);
}

} // namespace isochron::index
