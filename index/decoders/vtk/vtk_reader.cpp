// `isochron-reader-vtk`: the reader for VTK's formats.
#include "index/decoders/decoders.h"
#include "index/decoders/reader_program.h"

#include <array>

int main() {
    using namespace isochron::index;
    constexpr std::array kDecoders{Decoder{ForeignFormat::vti, decode_vti},
                                   Decoder{ForeignFormat::vtk, decode_vtk},
                                   Decoder{ForeignFormat::vtk_data, decode_vtk_data}};
    return run_reader(kDecoders, decode_pvd);
}
