// The work of a reader: requests of the program that started it, answered one after another.
#pragma once

#include "index/decoders/decoded_file.h"
#include "index/reader/message_socket.h"

#include <span>
#include <utility>
#include <vector>

namespace isochron::index {

/// One of the formats of a reader.
struct Decoder {
    ForeignFormat format;
    OpenDecodedFile open;
};

using ReadCollectionFile =
    std::vector<std::pair<std::filesystem::path, double>> (*)(const std::filesystem::path&);

/// Returns when nobody is at the other end any more.
/// @param collection what reads .pvd, if anything here does
/// @throws Error when somebody there says what the program never does
void serve(MessageSocket& socket, std::span<const Decoder> decoders, ReadCollectionFile collection);

} // namespace isochron::index
