// `isochron-reader-dicom`: what GDCM decodes.
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/reader_program.h"

#include <gdcmTrace.h>

#include <array>

int main() {
    using namespace isochron::index;
    gdcm::Trace::DebugOff();
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    constexpr std::array kDecoders{Decoder{"dicom", decode_dicom}};
    return run_reader(kDecoders);
}
