// Compares the headers of VTK image files (.vti) by a hash, without VTK: files of equal headers
// differ in their values alone, so that only the first of them has to be opened.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace isochron::index {

/// A hash of all that describes a VTK image file: grid, array and type, not the values. Empty for
/// other files, for headers that may say more of a step, such as its time, and for headers that are
/// longer than 64 KiB. Never throws: whoever opens the file says what is wrong with it.
std::optional<std::uint64_t> header_hash_of_file(const std::filesystem::path& file,
                                                 std::uint64_t size);

/// The hash for a file that begins with these bytes. @param size of the whole file
std::optional<std::uint64_t> vti_header_hash(std::string_view start, std::uint64_t size);

} // namespace isochron::index
