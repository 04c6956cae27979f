// `isochron-reader-vti`: the reader for VTK's image data and ParaView's collections, which needs no VTK.
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/reader_program.h"

#include <array>

int main() {
    using namespace isochron::index;
    constexpr std::array kDecoders{Decoder{"vti", decode_vti}};
    return run_reader(kDecoders, {.collection = decode_pvd});
}
