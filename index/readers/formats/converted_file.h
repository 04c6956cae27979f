// A file whose values are converted to another type, so that files of several types make a series.
#pragma once

#include "index/readers/formats/volume_file.h"

#include <memory>

namespace isochron::index {

/// Returns a file that already has the type unchanged. For f32 and f64, scaled values are converted
/// and, if they have more digits, rounded, which a note says. For integer types, stored values are
/// converted; each must be exact.
/// @throws Error from `read` and `stream`, naming the file: a value that the integer type does not
///         have
std::unique_ptr<VolumeFile> converted(std::unique_ptr<VolumeFile> file, ValueType type,
                                      const std::filesystem::path& path);

} // namespace isochron::index
