// `isochron-reader-netcdf`: what NetCDF decodes, with HDF5 behind it.
#include "index/decoders/decoders.h"
#include "index/decoders/reader_program.h"

#include <array>

int main() {
    using namespace isochron::index;
    constexpr std::array kDecoders{Decoder{ForeignFormat::netcdf, decode_netcdf}};
    return run_reader(kDecoders);
}
