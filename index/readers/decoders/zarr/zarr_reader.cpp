// `isochron-reader-zarr`: Zarr, whose chunks several libraries decompress.
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/reader_program.h"

#include <array>

int main() {
    using namespace isochron::index;
    constexpr std::array kDecoders{Decoder{"zarr", decode_zarr}};
    return run_reader(kDecoders);
}
