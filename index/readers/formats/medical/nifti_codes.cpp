// Names the codes.
#include "index/readers/formats/medical/nifti_codes.h"

#include "index/error.h"

#include <utility>

namespace isochron::index {

StoredType nifti_type(std::int32_t datatype, const std::string& file) {
    switch (datatype) {
    case 2: return StoredType::u8;
    case 4: return StoredType::i16;
    case 8: return StoredType::i32;
    case 16: return StoredType::f32;
    case 64: return StoredType::f64;
    case 256: return StoredType::i8;
    case 512: return StoredType::u16;
    case 768: return StoredType::u32;
    case 1024: return StoredType::i64;
    case 1280: return StoredType::u64;
    default: break;
    }
    const char* what = "";
    for (const auto& [code, named] : {std::pair(1, " (bits)"),
                                      {32, " (complex numbers)"},
                                      {128, " (colors, RGB)"},
                                      {1536, " (f128)"},
                                      {1792, " (complex numbers)"},
                                      {2048, " (complex numbers)"},
                                      {2304, " (colors, RGBA)"}})
        if (code == datatype)
            what = named;
    throw Error("{}: NIfTI datatype {}{}, expected integers of up to 64 bits, f32 or f64", file,
                datatype, what);
}

NiftiIntent nifti_intent(std::int32_t code) {
    switch (code) {
    case 1002: return {"labels"};
    case 1003: return {"names of neurons"};
    case 1004: return {"matrices", true};
    case 1005: return {"symmetric matrices", true};
    case 1006: return {"displacement vectors", true};
    case 1007: return {"vectors", true};
    case 1008: return {"points", true};
    case 1009: return {"triangles", true};
    case 1010: return {"quaternions", true};
    case 2001: return {"series in time"};
    case 2003: return {"vectors of colors, RGB", true};
    case 2004: return {"vectors of colors, RGBA", true};
    case 2006: return {"displacement vectors of FSL", true};
    case 2007:
    case 2008:
    case 2009:
    case 2016:
    case 2017: return {"coefficients of FSL", true};
    default: return {code >= 2 && code <= 24 ? "statistics" : ""};
    }
}

std::string nifti_length_unit(std::int32_t units) {
    switch (units & 7) {
    case 1: return "m";
    case 2: return "mm";
    case 3: return "um";
    default: return {};
    }
}

std::string nifti_time_unit(std::int32_t units) {
    switch (units & 56) {
    case 8: return "s";
    case 16: return "ms";
    case 24: return "us";
    case 32: return "Hz";
    case 40: return "ppm";
    case 48: return "rad/s";
    default: return {};
    }
}

} // namespace isochron::index
