// Whether a file says of itself what another one says, told without the library that decodes it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace isochron::index {

/// A hash of all that describes a VTK image file (.vti): two files with the same are described alike,
/// and differ in their values alone. Empty for other files, and where the head may say more of a
/// step, such as its time, or is not whole in the first 64 KiB. Never throws: what cannot be read is
/// somebody else's to say.
std::optional<std::uint64_t> head_of_file(const std::filesystem::path& file, std::uint64_t size);

/// The head of a file that begins with these bytes.
std::optional<std::uint64_t> telling_head(std::string_view start, std::uint64_t size);

} // namespace isochron::index
