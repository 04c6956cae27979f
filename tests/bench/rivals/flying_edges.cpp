// VTK's flying edges, from a module that is loaded when needed.
#include "tests/bench/rivals/flying_edges.h"

#include "index/system/module.h"

namespace isochron::bench {

std::unique_ptr<FlyingEdges> flying_edges(const index::StepValues& values) {
    using Make = FlyingEdges* (*)(const index::StepValues&);
    static const auto make =
        reinterpret_cast<Make>(index::module_symbol("isochron_vtk_peer", "isochron_flying_edges"));
    return std::unique_ptr<FlyingEdges>(make(values));
}

} // namespace isochron::bench
