// What the program and a reader say to each other: requests and replies, as bytes.
//
//     const std::vector<std::byte> bytes = encoded(ReaderRequest(ReadSlab{.step = 7, .slices = {0, 64}}));
//     const ReaderRequest same = request_from(bytes);
//
// Decoding is a function of the bytes alone, and takes nothing on trust: what decodes a foreign file
// may have been taken over by it.
#pragma once

#include "index/volume/volume_series.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace isochron::index {

/// The formats that libraries decode.
enum class ForeignFormat : std::uint8_t { vti, vtk, netcdf, hdf5, tiff, vtk_data, zarr };

/// The program in which a format is decoded: one for each library, so that none waits for the
/// loading of another.
std::string program_of(ForeignFormat format);
/// That of collections (.pvd).
extern const std::string kCollectionProgram;

/// Layers of vertices of one z, [first, first + count).
struct Slices {
    std::uint32_t first = 0, count = 0;
    bool operator==(const Slices&) const = default;
};

/// What is in this? Answered by `Described`; the file stays open until the next request of the kind
/// or `CloseFile`.
struct OpenFile {
    ForeignFormat format = ForeignFormat::vti;
    std::filesystem::path path;
    ReadOptions options;
    std::uint64_t most_memory = 0; ///< [bytes] that decoding may take; 0: what is free
};
/// Where values go from now on: memory whose descriptor comes with this; not answered.
struct UseMemory {
    std::uint64_t bytes = 0;
};
/// This step, this slab, into the shared memory from `offset`, as `VolumeSeries::read` has it.
/// Answered by `SlabRead`.
struct ReadSlab {
    std::uint64_t step = 0;
    Slices slices;
    std::uint64_t offset = 0;
};
/// Which files and times are in this .pvd? Answered by `Collected`.
struct ReadCollection {
    std::filesystem::path path;
};
/// Answered by `Closed`: from then on others may write to the file, which libraries lock.
struct CloseFile {};

using ReaderRequest = std::variant<OpenFile, UseMemory, ReadSlab, ReadCollection, CloseFile>;

/// Sent once, before anything is asked. @see kReaderVersion
struct Ready {
    std::string version;
};
struct Described {
    SeriesInfo info;
    std::uint64_t steps = 0;
    std::uint32_t slices_at_once = 0; ///< that are best asked for together; the last may be fewer
};
struct SlabRead {};
struct Collected {
    std::vector<std::pair<std::filesystem::path, double>> files; ///< in their order, with times
};
struct Closed {};
/// Instead of what was asked for.
struct Refused {
    std::string message; ///< one line that names the file
};

using ReaderReply = std::variant<Ready, Described, SlabRead, Collected, Closed, Refused>;

/// What `Ready` must say: program and reader are of one build.
extern const std::string kReaderVersion;

std::vector<std::byte> encoded(const ReaderRequest& request);
std::vector<std::byte> encoded(const ReaderReply& reply);

/// @throws Error when the bytes are no such message: in one line that says what is wrong with it
ReaderRequest request_from(std::span<const std::byte> bytes);
ReaderReply reply_from(std::span<const std::byte> bytes);

} // namespace isochron::index
