// The module with VTK's renderer.
#include "tests/bench/rivals/vtk_images.h"
#include "tests/bench/rivals/vtk_scene.h"

#include "index/error.h"

// Not vtkSMPTools.h, which C++20 compilers reject.
#include <SMP/Common/vtkSMPToolsAPI.h>
#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkFlyingEdges3D.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <dlfcn.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

namespace isochron::bench {
namespace {

/// Answers VTK's questions to its window: the context is the benchmark's, and always current.
void answer(vtkObject*, unsigned long event, void*, void* data) {
    if (event == vtkCommand::WindowIsCurrentEvent)
        *static_cast<bool*>(data) = true;
    else if (event == vtkCommand::WindowSupportsOpenGLEvent)
        *static_cast<int*>(data) = 1;
}

class VtkSceneInContext : public VtkScene {
  public:
    VtkSceneInContext(const index::StepValues& values, std::span<const CameraPose> cameras,
                      int size, unsigned threads)
        : scaling_(values.scaling), steps_(vtk_images(values)) {
        auto& smp = vtk::detail::smp::vtkSMPToolsAPI::GetInstance();
        smp.SetBackend(threads > 1 ? "STDThread" : "Sequential");
        smp.Initialize(static_cast<int>(threads));
        edges_->SetComputeNormals(true);
        edges_->SetComputeGradients(false);
        edges_->SetComputeScalars(false);
        mapper_->SetInputConnection(edges_->GetOutputPort());
        actor_->SetMapper(mapper_);
        vtkNew<vtkCallbackCommand> callback;
        callback->SetCallback(answer);
        window_->AddObserver(vtkCommand::WindowIsCurrentEvent, callback);
        window_->AddObserver(vtkCommand::WindowSupportsOpenGLEvent, callback);
        window_->SetSize(size * static_cast<int>(cameras.size()), size);
        window_->SetMultiSamples(0);
        window_->SetFrameBlitModeToNoBlit();
        const double width = 1.0 / static_cast<double>(cameras.size());
        for (std::size_t i = 0; i < cameras.size(); ++i) {
            vtkNew<vtkRenderer> renderer;
            renderer->SetViewport(width * static_cast<double>(i), 0.0,
                                  width * static_cast<double>(i + 1), 1.0);
            renderer->AddActor(actor_);
            vtkCamera& camera = *renderer->GetActiveCamera();
            camera.SetPosition(cameras[i].eye.x, cameras[i].eye.y, cameras[i].eye.z);
            camera.SetFocalPoint(cameras[i].center.x, cameras[i].center.y, cameras[i].center.z);
            camera.SetViewUp(cameras[i].up.x, cameras[i].up.y, cameras[i].up.z);
            camera.SetViewAngle(BenchCamera::kAngle);
            const double distance = camera.GetDistance();
            camera.SetClippingRange(0.4 * distance, 2.0 * distance);
            window_->AddRenderer(renderer);
        }
    }

    void draw(const index::Query& query) override {
        edges_->SetInputData(steps_[query.instant.step]);
        edges_->SetValue(0, (query.isovalue - scaling_.intercept) / scaling_.slope);
        edges_->Modified(); // so that a repeated query is computed again
        window_->Render();
    }

    double covered() override {
        vtkNew<vtkUnsignedCharArray> pixels;
        const int* size = window_->GetSize();
        window_->GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
        vtkIdType lit = 0;
        const vtkIdType count = pixels->GetNumberOfTuples();
        for (vtkIdType i = 0; i < count; ++i)
            lit += pixels->GetValue(4 * i) > 0;
        return static_cast<double>(lit) / static_cast<double>(count);
    }

  private:
    index::Scaling scaling_;
    std::vector<vtkSmartPointer<vtkImageData>> steps_;
    vtkNew<vtkFlyingEdges3D> edges_;
    vtkNew<vtkPolyDataMapper> mapper_;
    vtkNew<vtkActor> actor_;
    vtkNew<vtkGenericOpenGLRenderWindow> window_;
};

} // namespace
} // namespace isochron::bench

/// Found before GLEW's own function. Debian's GLEW loads the entry points of the current context
/// through libGL's dispatch, which also serves EGL, and only then reports that GLX has no display
/// (4). VTK would fail on that, so this function ignores it.
extern "C" __attribute__((visibility("default"))) unsigned glewInit() {
    constexpr unsigned kOk = 0, kNoVersion = 1, kNoGlxDisplay = 4;
    const auto real = reinterpret_cast<unsigned (*)()>(dlsym(RTLD_NEXT, "glewInit"));
    const unsigned result = real ? real() : kNoVersion;
    return result == kNoGlxDisplay ? kOk : result;
}

extern "C" __attribute__((visibility("default"))) isochron::bench::VtkScene*
isochron_vtk_scene(const isochron::index::StepValues& values,
                   std::span<const isochron::bench::CameraPose> cameras, int size,
                   unsigned threads) {
    return new isochron::bench::VtkSceneInContext(values, cameras, size, threads);
}
