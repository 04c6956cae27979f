// `isochron-reader-hdf5`: the reader for HDF5 files, and for XDMF documents that describe them.
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/reader_program.h"

#include <array>

int main() {
    using namespace isochron::index;
    constexpr std::array kDecoders{Decoder{"hdf5", decode_hdf5}, Decoder{"xdmf", decode_xdmf}};
    return run_reader(kDecoders);
}
