// `isochron-reader-netcdf`: the reader for NetCDF files.
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/reader_program.h"

#include <array>

int main() {
    using namespace isochron::index;
    constexpr std::array kDecoders{Decoder{"netcdf", decode_netcdf}};
    return run_reader(kDecoders);
}
