// The part of a file's volume that a user asked for.
#pragma once

#include "index/readers/formats/volume_file.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace isochron::index {

/// The vertices of a part along each axis, both ends included.
struct VolumePart {
    std::array<std::uint32_t, 3> first{}, last{}, stride{1, 1, 1}, count{};
    bool operator==(const VolumePart&) const = default;
};

/// The part that options name. @throws Error naming the file, as `cropped` does
VolumePart part_in(const Grid& grid, const ReadOptions& options, const std::string& file);

/// Its grid, and a note on it.
Grid grid_of_part(const Grid& whole, const VolumePart& part);
std::string note_on_part(const Grid& whole, const VolumePart& part);

/// Copies a part of values of `size` bytes, all of which are there.
void take_part(std::span<const std::byte> all, const Grid& whole, const VolumePart& part,
               std::size_t size, std::span<std::byte> out);

/// Changes a description to that of the part which `crop` names; `stride` is left to others.
/// @return the part; none: there is no `crop`
std::optional<VolumePart> crop_description(SeriesInfo& info, const ReadOptions& options,
                                           const std::string& file);

/// The file, or the vertices of it that `crop` and `stride` leave, in a grid of their own: it lies where
/// it lay, and a note says which part it is.
/// @throws Error naming the file: a part beyond the volume, or of fewer than 2 vertices along an axis
std::unique_ptr<VolumeFile> cropped(std::unique_ptr<VolumeFile> whole, const ReadOptions& options,
                                    const std::filesystem::path& path);

} // namespace isochron::index
