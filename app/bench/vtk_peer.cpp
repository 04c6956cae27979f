// The module that knows VTK's contour filter.
#include "app/bench/flying_edges.h"

// Not vtkSMPTools.h, which C++20 compilers reject.
#include <SMP/Common/vtkSMPToolsAPI.h>
#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <type_traits>
#include <vector>

namespace isochron::app::bench {
namespace {

int vtk_type(index::ValueType type) {
    switch (type) {
    case index::ValueType::i8: return VTK_SIGNED_CHAR;
    case index::ValueType::u8: return VTK_UNSIGNED_CHAR;
    case index::ValueType::i16: return VTK_SHORT;
    case index::ValueType::u16: return VTK_UNSIGNED_SHORT;
    case index::ValueType::i32: return VTK_INT;
    case index::ValueType::f32: return VTK_FLOAT;
    case index::ValueType::f64: break;
    }
    return VTK_DOUBLE;
}

class VtkFlyingEdges : public FlyingEdges {
  public:
    explicit VtkFlyingEdges(const index::StepValues& values) : scaling_(values.scaling) {
        vtk::detail::smp::vtkSMPToolsAPI::GetInstance().SetBackend("Sequential");
        const auto& n = values.grid.vertices;
        const auto& spacing = values.grid.spacing;
        for (std::size_t step = 0; step < values.steps; ++step) {
            auto scalars = vtkSmartPointer<vtkDataArray>::Take(
                vtkDataArray::CreateDataArray(vtk_type(values.type)));
            // Without a copy: VTK reads the memory that everything else reads, and never writes it.
            scalars->SetVoidArray(const_cast<std::byte*>(values.first + step * values.stride),
                                  static_cast<vtkIdType>(values.grid.vertex_count()), 1);
            auto image = vtkSmartPointer<vtkImageData>::New();
            image->SetDimensions(static_cast<int>(n[0]), static_cast<int>(n[1]),
                                 static_cast<int>(n[2]));
            image->SetSpacing(spacing.x, spacing.y, spacing.z);
            image->GetPointData()->SetScalars(scalars);
            steps_.push_back(image);
        }
        for (const bool normals : {false, true}) {
            filter(normals).SetComputeNormals(normals);
            filter(normals).SetComputeGradients(false);
            filter(normals).SetComputeScalars(false);
        }
    }

    Surface contour(const index::Query& query, bool normals) override {
        vtkFlyingEdges3D& edges = filter(normals);
        edges.SetInputData(steps_[query.step]);
        edges.SetValue(0, (query.isovalue - scaling_.intercept) / scaling_.slope);
        edges.Modified(); // the same query again is computed again
        edges.Update();
        vtkPolyData& surface = *edges.GetOutput();
        const vtkDataArray* given = surface.GetPointData()->GetNormals();
        return {static_cast<std::uint64_t>(surface.GetNumberOfPolys()),
                static_cast<std::uint64_t>(surface.GetNumberOfPoints()),
                given ? static_cast<std::uint64_t>(given->GetNumberOfTuples()) : 0};
    }

  private:
    vtkFlyingEdges3D& filter(bool normals) { return normals ? *with_normals_ : *plain_; }

    index::Scaling scaling_;
    std::vector<vtkSmartPointer<vtkImageData>> steps_;
    vtkNew<vtkFlyingEdges3D> plain_, with_normals_;
};

} // namespace
} // namespace isochron::app::bench

extern "C" __attribute__((visibility("default"))) isochron::app::bench::FlyingEdges*
isochron_flying_edges(const isochron::index::StepValues& values) {
    return new isochron::app::bench::VtkFlyingEdges(values);
}
