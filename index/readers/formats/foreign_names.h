// Names formats that are not read, so that a refusal says what a file is.
#pragma once

#include "index/readers/formats/format.h"

#include <string>

namespace isochron::index {

/// What a file is by its first bytes, and how its values can be read where options can say that:
/// `FITS, whose values --dims 6 5 4 --type f32 --header-bytes 2880 --big-endian reads`; empty if
/// they do not tell.
std::string foreign_format_of(FileStart& start);

/// What a file of an unknown format is, by its first bytes or by its name; empty: they do not tell.
std::string foreign_format_or_name(FileStart& start);

} // namespace isochron::index
