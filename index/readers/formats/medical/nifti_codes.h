// The codes of NIfTI-1's nifti1.h for types, units and intents.
#pragma once

#include "index/readers/formats/stored_scalar.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace isochron::index {

/// @throws Error naming the file: a type that no volume can have, and what it is
StoredType nifti_type(std::int32_t datatype, const std::string& file);

/// The unit that `xyzt_units` names; empty where it names none.
std::string nifti_length_unit(std::int32_t units);
std::string nifti_time_unit(std::int32_t units);

/// What an intent says of the values at a place.
struct NiftiIntent {
    std::string_view name;   ///< empty: unknown
    bool components = false; ///< they are components of one value
};
NiftiIntent nifti_intent(std::int32_t code);

} // namespace isochron::index
