// `isochron-reader-vtk`: the reader for what VTK reads: all its formats but image data in XML.
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/reader_program.h"

#include <array>

int main() {
    using namespace isochron::index;
    constexpr std::array kDecoders{Decoder{"vtk", decode_vtk},
                                   Decoder{"vtk data", decode_vtk_data}};
    return run_reader(kDecoders);
}
