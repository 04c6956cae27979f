// The module with VTK's contour filter.
#include "tests/bench/rivals/flying_edges.h"
#include "tests/bench/rivals/vtk_images.h"

// Not vtkSMPTools.h, which C++20 compilers reject.
#include <SMP/Common/vtkSMPToolsAPI.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <vector>

namespace isochron::bench {
namespace {

class VtkFlyingEdges : public FlyingEdges {
  public:
    explicit VtkFlyingEdges(const index::StepValues& values)
        : scaling_(values.scaling), steps_(vtk_images(values)) {
        vtk::detail::smp::vtkSMPToolsAPI::GetInstance().SetBackend("Sequential");
        for (const bool normals : {false, true}) {
            filter(normals).SetComputeNormals(normals);
            filter(normals).SetComputeGradients(false);
            filter(normals).SetComputeScalars(false);
        }
    }

    Surface contour(const index::Query& query, bool normals) override {
        vtkFlyingEdges3D& edges = filter(normals);
        edges.SetInputData(steps_[query.instant.step]);
        edges.SetValue(0, (query.isovalue - scaling_.intercept) / scaling_.slope);
        edges.Modified(); // so that a repeated query is computed again
        edges.Update();
        vtkPolyData& surface = *edges.GetOutput();
        const vtkDataArray* given = surface.GetPointData()->GetNormals();
        return {static_cast<std::uint64_t>(surface.GetNumberOfPolys()),
                static_cast<std::uint64_t>(surface.GetNumberOfPoints()),
                given ? static_cast<std::uint64_t>(given->GetNumberOfTuples()) : 0};
    }

    Geometry geometry(const index::Query& query) override {
        contour(query, true);
        vtkPolyData& surface = *with_normals_->GetOutput();
        Geometry result;
        const auto vec3 = [](const double* v) { return glm::vec3(v[0], v[1], v[2]); };
        const auto* spacing = steps_[query.instant.step]->GetSpacing();
        for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) {
            result.points.push_back(vec3(surface.GetPoint(i)) / vec3(spacing));
            result.normals.push_back(vec3(surface.GetPointData()->GetNormals()->GetTuple(i)));
        }
        vtkCellArray& polygons = *surface.GetPolys();
        vtkIdType corners = 0;
        const vtkIdType* at = nullptr;
        for (polygons.InitTraversal(); polygons.GetNextCell(corners, at);)
            result.triangles.push_back({static_cast<std::uint32_t>(at[0]),
                                        static_cast<std::uint32_t>(at[1]),
                                        static_cast<std::uint32_t>(at[2])});
        return result;
    }

  private:
    vtkFlyingEdges3D& filter(bool normals) { return normals ? *with_normals_ : *plain_; }

    index::Scaling scaling_;
    std::vector<vtkSmartPointer<vtkImageData>> steps_;
    vtkNew<vtkFlyingEdges3D> plain_, with_normals_;
};

} // namespace
} // namespace isochron::bench

extern "C" __attribute__((visibility("default"))) isochron::bench::FlyingEdges*
isochron_flying_edges(const isochron::index::StepValues& values) {
    return new isochron::bench::VtkFlyingEdges(values);
}
