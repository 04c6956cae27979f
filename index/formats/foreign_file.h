// A file of a format that a library decodes: in a reader, as if it were here.
#pragma once

#include "index/formats/volume_file.h"
#include "index/reader/reader_pool.h"

#include <memory>

namespace isochron::index {

/// @param readers one of them has the file as long as it is open
/// @throws Error in one line that names the file, also when the reader crashes or gets nowhere
std::unique_ptr<VolumeFile> open_foreign(ReaderPool& readers, ForeignFormat format,
                                         const std::filesystem::path& path,
                                         const ReadOptions& options);

} // namespace isochron::index
