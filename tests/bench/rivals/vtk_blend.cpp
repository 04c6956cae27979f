// The module with VTK's temporal interpolator.
#include "tests/bench/rivals/temporal_blend.h"
#include "tests/bench/rivals/vtk_images.h"

// Not vtkSMPTools.h, which C++20 compilers reject.
#include <SMP/Common/vtkSMPToolsAPI.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageAlgorithm.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTemporalInterpolator.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

namespace isochron::bench {
namespace {

/// Gives images, one for each time, without copies.
class StepsInMemory : public vtkImageAlgorithm {
  public:
    static StepsInMemory* New();
    vtkTypeMacro(StepsInMemory, vtkImageAlgorithm);
    std::vector<vtkSmartPointer<vtkImageData>> steps;

  protected:
    StepsInMemory() { SetNumberOfInputPorts(0); }
    int RequestInformation(vtkInformation*, vtkInformationVector**,
                           vtkInformationVector* out) override {
        vtkInformation& info = *out->GetInformationObject(0);
        std::vector<double> times(steps.size());
        std::iota(times.begin(), times.end(), 0.0);
        double range[2] = {0.0, times.back()};
        using Pipeline = vtkStreamingDemandDrivenPipeline;
        info.Set(Pipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
        info.Set(Pipeline::TIME_RANGE(), range, 2);
        info.Set(Pipeline::WHOLE_EXTENT(), steps.front()->GetExtent(), 6);
        info.Set(vtkDataObject::SPACING(), steps.front()->GetSpacing(), 3);
        info.Set(vtkDataObject::ORIGIN(), steps.front()->GetOrigin(), 3);
        vtkDataObject::SetPointDataActiveScalarInfo(
            &info, steps.front()->GetPointData()->GetScalars()->GetDataType(), 1);
        return 1;
    }
    int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* out) override {
        vtkInformation* info = out->GetInformationObject(0);
        const double time = info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
                                ? info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
                                : 0.0;
        const auto step = static_cast<std::size_t>(
            std::clamp(std::lround(time), 0L, static_cast<long>(steps.size()) - 1));
        vtkImageData* image = vtkImageData::GetData(info);
        image->ShallowCopy(steps[step]);
        image->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), static_cast<double>(step));
        return 1;
    }
};
vtkStandardNewMacro(StepsInMemory);

class VtkTemporalBlend : public TemporalBlend {
  public:
    explicit VtkTemporalBlend(const index::StepValues& values) {
        vtk::detail::smp::vtkSMPToolsAPI::GetInstance().SetBackend("Sequential");
        source_->steps = vtk_images(values);
        for (std::size_t i = 0; i < source_->steps.size(); ++i)
            source_->steps[i]->GetPointData()->GetScalars()->SetName("values");
        blend_->SetInputConnection(source_->GetOutputPort());
        edges_->SetComputeNormals(true);
        edges_->SetComputeGradients(false);
        edges_->SetComputeScalars(false);
    }
    std::vector<std::byte> values(index::Instant at) override {
        vtkDataArray& scalars = *blended(at)->GetPointData()->GetScalars();
        std::vector<std::byte> all(static_cast<std::size_t>(scalars.GetNumberOfTuples()) *
                                   static_cast<std::size_t>(scalars.GetDataTypeSize()));
        std::memcpy(all.data(), scalars.GetVoidPointer(0), all.size());
        return all;
    }
    std::uint64_t contour(index::Instant at, double isovalue) override {
        edges_->SetInputData(blended(at));
        edges_->SetValue(0, isovalue);
        edges_->Modified(); // so that a repeated query is computed again
        edges_->Update();
        return static_cast<std::uint64_t>(edges_->GetOutput()->GetNumberOfPolys());
    }

  private:
    vtkImageData* blended(index::Instant at) {
        blend_->Modified();
        blend_->UpdateTimeStep(static_cast<double>(at.number()) / index::Instant::kFractions);
        return vtkImageData::SafeDownCast(blend_->GetOutputDataObject(0));
    }
    vtkNew<StepsInMemory> source_;
    vtkNew<vtkTemporalInterpolator> blend_;
    vtkNew<vtkFlyingEdges3D> edges_;
};

} // namespace
} // namespace isochron::bench

extern "C" __attribute__((visibility("default"))) isochron::bench::TemporalBlend*
isochron_temporal_blend(const isochron::index::StepValues& values) {
    return new isochron::bench::VtkTemporalBlend(values);
}
