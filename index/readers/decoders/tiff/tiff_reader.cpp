// `isochron-reader-tiff`: what libtiff decodes.
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/reader_program.h"

#include <array>

int main() {
    using namespace isochron::index;
    constexpr std::array kDecoders{Decoder{"tiff", decode_tiff}};
    return run_reader(kDecoders);
}
