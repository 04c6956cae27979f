// VTK's flying edges, from a module that is loaded when it is measured.
#include "app/bench/flying_edges.h"

#include "index/module.h"

namespace isochron::app::bench {

std::unique_ptr<FlyingEdges> flying_edges(const index::StepValues& values) {
    using Make = FlyingEdges* (*)(const index::StepValues&);
    static const auto make =
        reinterpret_cast<Make>(index::module_symbol("isochron_vtk_peer", "isochron_flying_edges"));
    return std::unique_ptr<FlyingEdges>(make(values));
}

} // namespace isochron::app::bench
