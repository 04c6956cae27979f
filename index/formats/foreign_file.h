// Opens a file in a reader process, whose library decodes it, like any other file.
#pragma once

#include "index/formats/volume_file.h"
#include "index/reader/reader_pool.h"

#include <memory>

namespace isochron::index {

/// @param readers gives the reader that is used as long as the file is open
/// @throws Error in one line that names the file, also when the reader crashes or makes no progress
std::unique_ptr<VolumeFile> open_foreign(ReaderPool& readers, ForeignFormat format,
                                         const std::filesystem::path& path,
                                         const ReadOptions& options);

} // namespace isochron::index
