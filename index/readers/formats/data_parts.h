// Values spread evenly over several files: the lists and patterns of MetaImage and NRRD.
#pragma once

#include "index/readers/formats/data_stream.h"

#include <string>
#include <vector>

namespace isochron::index {

/// One of several files with values.
struct DataPart {
    std::filesystem::path path;
    std::uint64_t offset = 0; ///< where its first (compressed) byte is
    std::uint64_t skip = 0;   ///< decompressed bytes before its first value
};

/// The parts as if they were one file.
/// @param bytes_each decompressed, of every part
/// @throws Error from `read` and `rest`, naming the part
std::unique_ptr<DataStream> open_parts(std::vector<DataPart> parts, std::uint64_t bytes_each,
                                       Compression compression);

/// The files of a pattern such as `slice%03d.raw 1 64 1`: name, first and last number, and step (1
/// if absent). @param file with the pattern, for messages @throws Error: not one, too many files
std::vector<std::string> numbered_names(const std::string& pattern, const std::string& file);

/// Whether a text is a pattern for `numbered_names`.
bool is_numbered(const std::string& text);

} // namespace isochron::index
