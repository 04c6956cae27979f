// The service of a reader: answers the requests of the program that started it, one by one.
#pragma once

#include "index/decoders/decoded_file.h"
#include "index/reader/message_socket.h"

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

/// The message as one line: control characters, as names inside files may have, become blanks.
std::string in_one_line(std::string message);

/// Answers requests until the other end is closed.
/// @param collection reads .pvd; null if this reader does not
/// @throws Error when a message is invalid
void serve(MessageSocket& socket, std::span<const Decoder> decoders, ReadCollectionFile collection);

} // namespace isochron::index
