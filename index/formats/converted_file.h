// A file whose values are converted to another type, so that files of several types make a series.
#pragma once

#include "index/formats/volume_file.h"

#include <memory>

namespace isochron::index {

/// A file as it is, if it has the type already. To f32 and f64 values are converted after scaling,
/// and rounded where they have more digits: a note says so. To an integer type stored values are
/// converted, which must be exact.
/// @throws Error from `read` and `stream`, naming the file: a value that the integer type does not
///         have
std::unique_ptr<VolumeFile> converted(std::unique_ptr<VolumeFile> file, ValueType type,
                                      const std::filesystem::path& path);

} // namespace isochron::index
