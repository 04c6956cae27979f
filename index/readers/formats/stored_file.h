// A file whose values are one plain array after a header: raw, MetaImage, NRRD, NIfTI, MRC.
#pragma once

#include "index/readers/formats/data_parts.h"
#include "index/readers/formats/stored_scalar.h"
#include "index/readers/formats/volume_file.h"

namespace isochron::index {

/// The place and the encoding of a file's values.
struct StoredLayout {
    std::filesystem::path data; ///< may be the header's own file
    /// The files with the values, in their order, if there are several: each has the same share.
    std::vector<DataPart> parts = {};
    /// Where the first (compressed) byte is; see `skip` where the whole file is compressed.
    std::uint64_t offset = 0;
    std::uint64_t skip = 0; ///< decompressed bytes before the first value
    Compression compression = Compression::none;
    bool ascii = false; ///< numbers as text, separated by blanks or commas
    bool big_endian = false;
    StoredArray array;
    bool half = false;     ///< stored as float16, of type f32
    std::size_t steps = 1; ///< step after step, each [z][y][x][component]
    double first_time = 0;
    double time_step = 0; ///< between steps; 0 when the file does not say
};

/// Bytes that a value takes in the file.
std::size_t stored_bytes(const StoredLayout& layout);

/// @param info grid, scaling, units and times; array, type and notes are set from the layout
/// @throws Error when the data are too short for the layout
std::unique_ptr<VolumeFile> open_stored(const std::filesystem::path& header, SeriesInfo info,
                                        const StoredLayout& layout, const ReadOptions& options);

/// Sets the times of that many steps, unless they are there, from the layout's first time and time
/// step; if the file does not give them, removes their unit.
void give_times(SeriesInfo& info, const StoredLayout& layout, std::size_t steps);

/// Sets spacing and direction from the vectors between neighboring vertices along the index axes.
/// @throws Error naming the file when one is zero or not finite, or all lie in a plane
void set_axes(Grid& grid, const glm::dmat3& steps, const std::string& file);

/// Checks that there are 1 to a million steps; a header with more must be wrong.
/// @throws Error naming the file
void expect_few_steps(std::size_t steps, const std::string& file);

/// Sizes that are given must be above 0, and such that pictures, which have single precision, can
/// show them.
/// @throws Error naming the option
void expect_measurable(const Grid& grid, const ReadOptions& options);

/// @throws Error naming the file: fewer than 2 vertices along an axis, or more than 65,537
void check_grid(const Grid& grid, const std::string& file);

/// Checks sizes that may not even fit a grid. @return the grid's vertices
std::array<std::uint32_t, 3> checked_vertices(const std::array<std::int64_t, 3>& sizes,
                                              const std::string& file);

} // namespace isochron::index
