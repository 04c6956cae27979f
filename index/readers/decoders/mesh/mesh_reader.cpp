// `isochron-reader-mesh`: the reader for meshes of simulations and models, whose libraries take long to load.
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/mesh/mesh_model.h"
#include "index/readers/decoders/reader_program.h"

#include <array>

int main() {
    using namespace isochron::index;
    constexpr std::array kDecoders{Decoder{"mesh", decode_mesh}};
    return run_reader(kDecoders, {.model = decode_vtk_model});
}
