// `isochron-reader-vtk`: the reader for VTK's formats.
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/reader_program.h"

#include <array>

int main() {
    using namespace isochron::index;
    constexpr std::array kDecoders{Decoder{"vti", decode_vti}, Decoder{"vtk", decode_vtk},
                                   Decoder{"vtk data", decode_vtk_data}};
    return run_reader(kDecoders, decode_pvd);
}
