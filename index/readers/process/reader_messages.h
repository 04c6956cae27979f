// The messages between the program and a reader: requests and replies, as bytes.
//
//     const std::vector<std::byte> bytes = encoded(ReaderRequest(ReadSlab{.step = 7, .slices = {0, 64}}));
//     const ReaderRequest same = request_from(bytes);
//
// Decoding depends on the bytes only and trusts nothing in them: a hostile file may have taken over
// the reader that sent them.
#pragma once

#include "index/volume/listed_file.h"
#include "index/volume/volume_series.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace isochron::index {

/// Planes of vertices with the same z: [first, first + count).
struct Slices {
    std::uint32_t first = 0, count = 0;
    bool operator==(const Slices&) const = default;
};

/// Opens a file and asks for its description. Answered by `Described`; the file stays open until
/// it is closed, or another gets its number. Several open files of one reader are arrays of the
/// same file.
struct OpenFile {
    std::string format; ///< its name, see `Format`
    std::filesystem::path path;
    ReadOptions options;
    std::uint64_t number = 0; ///< number by which later requests name it
};
/// Sets the shared memory into which values go from now on; its descriptor is attached. Not
/// answered.
struct UseMemory {
    std::uint64_t bytes = 0;
};
/// Reads slices of a step into the shared memory at `offset`, in the format of
/// `VolumeSeries::read`. Answered by `SlabRead`.
struct ReadSlab {
    std::uint64_t step = 0;
    Slices slices;
    std::uint64_t offset = 0;
    std::uint64_t file = 0; ///< its number
};
/// Asks for the files and times in a .pvd. Answered by `Collected`.
struct ReadCollection {
    std::filesystem::path path;
};
/// Closes a file. Answered by `Closed`; libraries lock files, so others can write to it only then.
struct CloseFile {
    std::uint64_t file = 0; ///< its number
};

/// Asks for the note in a picture, and with `pixels` for its size. Answered by `PictureRead`; the
/// pixels stay until the next request of this kind.
struct ReadPicture {
    std::filesystem::path path;
    bool pixels = false;
};
/// Asks for the pixels of that picture in the shared memory: red, green, blue, alpha. Answered by
/// `SlabRead`.
struct TakePicture {};

/// Asks for the triangles of a file. Answered by `ModelRead`.
struct ReadModel {
    std::filesystem::path path;
};
/// Asks for that model in the shared memory, once: its points, their normals, and the corners, as
/// TriangleMesh has them. Answered by `SlabRead`.
struct TakeModel {};

/// Triangles that a model may have: 3 GB in memory at most.
inline constexpr std::size_t kMostModelTriangles = std::size_t{1} << 26;

using ReaderRequest = std::variant<OpenFile, UseMemory, ReadSlab, ReadCollection, CloseFile,
                                   ReadPicture, TakePicture, ReadModel, TakeModel>;

/// Sent once to the reader, before any request: what its fence leaves readable. Not answered.
struct LeftReadable {
    std::vector<std::filesystem::path> places; ///< folders with all that is in them, and files
};

/// Sent once by the reader, before any request; in its place `Refused` where the reader cannot be
/// fenced in. @see kReaderVersion
struct Ready {
    std::string version;
};
struct Described {
    SeriesInfo info;
    std::uint64_t steps = 0;
    std::uint32_t slices_at_once = 0; ///< best number for one request; the last may have fewer
    std::uint64_t decoded_bytes = 0;  ///< bytes of a step in the library's memory
};
struct SlabRead {};
struct Collected {
    ListedFiles files;
};
struct Closed {};
struct PictureRead {
    std::string note;
    std::uint32_t width = 0, height = 0; ///< without pixels 0
};
struct ModelRead {
    glm::dvec3 origin{0.0};
    std::uint64_t points = 0, corners = 0;
};
/// The reply to any request that failed.
struct Refused {
    std::string message; ///< one line that names the file, if one was asked for
};

using ReaderReply =
    std::variant<Ready, Described, SlabRead, Collected, Closed, Refused, PictureRead, ModelRead>;

/// The version that `Ready` must have, so that program and reader are of one build.
extern const std::string kReaderVersion;

std::vector<std::byte> encoded(const LeftReadable& readable);
std::vector<std::byte> encoded(const ReaderRequest& request);
std::vector<std::byte> encoded(const ReaderReply& reply);

/// @throws Error saying in one line what is wrong, when the bytes are no such message
LeftReadable readable_from(std::span<const std::byte> bytes);
ReaderRequest request_from(std::span<const std::byte> bytes);
ReaderReply reply_from(std::span<const std::byte> bytes);

} // namespace isochron::index
