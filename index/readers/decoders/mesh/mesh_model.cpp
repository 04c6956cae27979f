// Models that VTK reads: VTP, and glTF in both forms.
#include "index/readers/decoders/mesh/mesh_model.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/decoders/vtk/vtk_session.h"

#include <fmt/format.h>

#include <vtkCellArray.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkGLTFReader.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <array>

namespace isochron::index {
namespace {

/// @param turned y is up, as in glTF: it becomes z
void add_triangles(vtkPolyData& surface, bool turned, StatedModel& model, const std::string& name) {
    const vtkNew<vtkTriangleFilter> filter;
    filter->SetInputData(&surface);
    filter->PassVertsOff();
    filter->PassLinesOff();
    filter->Update();
    vtkPolyData& triangles = *filter->GetOutput();
    const auto first = static_cast<std::int64_t>(model.points.size());
    for (vtkIdType i = 0; i < triangles.GetNumberOfPoints(); ++i) {
        std::array<double, 3> at{};
        triangles.GetPoint(i, at.data());
        model.points.push_back(turned ? glm::dvec3(at[0], -at[2], at[1])
                                      : glm::dvec3(at[0], at[1], at[2]));
    }
    vtkCellArray& polygons = *triangles.GetPolys();
    polygons.InitTraversal();
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    for (std::uint64_t face = 0; polygons.GetNextCell(count, points) != 0; ++face) {
        std::vector<std::int64_t> corners;
        for (vtkIdType k = 0; k < count; ++k)
            corners.push_back(points[k] < 0 ? -1 : first + points[k]);
        model.add_polygon(corners, name, fmt::format("face {}", face));
    }
}

/// VTK triangulates polygons without looking whether their points are there.
void expect_points(vtkPolyData& surface, const std::string& name) {
    for (vtkCellArray* const cells : {surface.GetPolys(), surface.GetStrips()}) {
        vtkIdType count = 0;
        const vtkIdType* points = nullptr;
        cells->InitTraversal();
        for (std::uint64_t face = 0; cells->GetNextCell(count, points) != 0; ++face)
            for (vtkIdType k = 0; k < count; ++k)
                if (points[k] < 0 || points[k] >= surface.GetNumberOfPoints())
                    throw Error(
                        fmt::format("{}: face {} has a corner at point {}: expected 0 to {}", name,
                                    face, points[k], surface.GetNumberOfPoints() - 1));
    }
}

} // namespace

TriangleMesh decode_vtk_model(const std::filesystem::path& path) {
    const std::string name = path.string();
    StatedModel model;
    with_vtk(path, [&] {
        const auto add = [&](vtkPolyData& surface, bool turned) {
            expect_points(surface, name);
            add_triangles(surface, turned, model, name);
        };
        if (lower_case(path.extension().string()) == ".vtp") {
            const vtkNew<vtkXMLPolyDataReader> reader;
            reader->SetFileName(path.c_str());
            reader->Update();
            return add(*reader->GetOutput(), false);
        }
        const vtkNew<vtkGLTFReader> reader;
        reader->SetFileName(path.c_str());
        reader->ApplyDeformationsToGeometryOn();
        reader->Update();
        const auto parts = vtkSmartPointer<vtkCompositeDataIterator>::Take(
            static_cast<vtkCompositeDataSet*>(reader->GetOutputDataObject(0))->NewIterator());
        for (parts->InitTraversal(); !parts->IsDoneWithTraversal(); parts->GoToNextItem())
            if (auto* const surface = vtkPolyData::SafeDownCast(parts->GetCurrentDataObject()))
                add(*surface, true);
    });
    return finished(std::move(model), name);
}

} // namespace isochron::index
