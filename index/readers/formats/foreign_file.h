// Opens a file as its format says: here, or in a reader process, whose library decodes it.
#pragma once

#include "index/readers/formats/format.h"
#include "index/readers/process/reader_pool.h"

#include <memory>
#include <span>

namespace isochron::index {

/// @throws Error in one line that names the file
std::unique_ptr<VolumeFile> open_in_format(const Format& format, const std::filesystem::path& path,
                                           const ReadOptions& options);
/// `open_in_format` as a function of the file.
OpenVolumeFile opener_of(const Format& format);

/// Lets the readers of this process read files, so that they are started once for all of them, also
/// where each is a symbolic link to another folder.
void let_readers_read(std::span<const KnownFile> files);

/// Opens a file of a format that a reader decodes.
/// @param readers gives the reader that is used as long as the file is open
/// @throws Error in one line that names the file, also when the reader crashes or makes no progress
std::unique_ptr<VolumeFile> open_foreign(ReaderPool& readers, const Format& format,
                                         const std::filesystem::path& path,
                                         const ReadOptions& options);

/// The files and times of a ParaView collection (.pvd), in its order; in a reader.
/// @see Format::list
ListedFiles read_pvd(const std::filesystem::path& path);

} // namespace isochron::index
