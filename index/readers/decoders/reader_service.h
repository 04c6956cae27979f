// The service of a reader: answers the requests of the program that started it, one by one.
#pragma once

#include "index/readers/decoders/decoded_file.h"
#include "index/readers/process/message_socket.h"
#include "index/volume/triangle_mesh.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
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

/// @throws Error naming the file
using ReadModelFile = TriangleMesh (*)(const std::filesystem::path&);

/// What a reader reads besides volumes; null: it does not.
struct OtherFiles {
    ReadCollectionFile collection = nullptr; ///< .pvd
    ReadPictureFile picture = nullptr;
    ReadModelFile model = nullptr; ///< files of triangles
};

/// The file that the fence has denied since the last call; empty if none, see denied_files.h.
using TakeDenied = std::filesystem::path (*)();

/// The message as one line: control characters, as names inside files may have, become blanks.
std::string in_one_line(std::string message);

/// Answers requests until the other end is closed.
/// @param denied null where nothing is denied; a request that needed a denied file is refused
/// @throws Error when a message is invalid
void serve(MessageSocket& socket, std::span<const Decoder> decoders, const OtherFiles& others,
           TakeDenied denied = nullptr);

} // namespace isochron::index
