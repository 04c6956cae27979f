// VTK's temporal interpolator, from a module that is loaded when needed.
#include "tests/bench/rivals/temporal_blend.h"

#include "index/system/module.h"

namespace isochron::bench {

std::unique_ptr<TemporalBlend> temporal_blend(const index::StepValues& values) {
    using Make = TemporalBlend* (*)(const index::StepValues&);
    static const auto make = reinterpret_cast<Make>(
        index::module_symbol("isochron_vtk_blend", "isochron_temporal_blend"));
    return std::unique_ptr<TemporalBlend>(make(values));
}

} // namespace isochron::bench
