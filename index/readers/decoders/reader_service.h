// The service of a reader: answers the requests of the program that started it, one by one.
#pragma once

#include "index/readers/decoders/decoded_file.h"
#include "index/readers/process/message_socket.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isochron::index {

/// A format that a reader decodes.
struct Decoder {
    std::string_view format; ///< its name, see `Format`
    OpenDecodedFile open;
};

using ReadCollectionFile = ListedFiles (*)(const std::filesystem::path&);

struct DecodedPicture {
    std::string note;
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};
/// @param pixels whether they are wanted, or the note alone @throws Error naming the file
using ReadPictureFile = DecodedPicture (*)(const std::filesystem::path&, bool pixels);

/// The file that the fence has denied since the last call; empty if none, see denied_files.h.
using TakeDenied = std::filesystem::path (*)();

/// The message as one line: control characters, as names inside files may have, become blanks.
std::string in_one_line(std::string message);

/// Answers requests until the other end is closed.
/// @param collection reads .pvd; null if this reader does not
/// @param picture reads pictures; null if this reader does not
/// @param denied null where nothing is denied; a request that needed a denied file is refused
/// @throws Error when a message is invalid
void serve(MessageSocket& socket, std::span<const Decoder> decoders, ReadCollectionFile collection,
           ReadPictureFile picture = nullptr, TakeDenied denied = nullptr);

} // namespace isochron::index
