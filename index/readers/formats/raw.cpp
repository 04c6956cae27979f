// Raw files: values without a header.
#include "index/error.h"
#include "index/readers/formats/own_formats.h"
#include "index/readers/formats/stored_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::index {

std::unique_ptr<VolumeFile> open_raw(const std::filesystem::path& path,
                                     const ReadOptions& options) {
    const std::string name = path.string();
    if (!options.dims || !options.type)
        throw Error("{}: raw values need --dims NX NY NZ and --type", name);
    const auto& dims = *options.dims;
    SeriesInfo info;
    info.grid.vertices = checked_vertices({dims[0], dims[1], dims[2]}, name);
    StoredLayout layout;
    layout.data = path;
    layout.offset = options.header_bytes;
    layout.big_endian = options.big_endian;
    layout.array = {"values", stored_type_of(*options.type)};

    const std::uint64_t size = file_bytes(path);
    const std::uint64_t step = info.grid.vertex_count() * size_of(*options.type);
    const std::uint64_t values = size - std::min(size, options.header_bytes);
    if (values == 0 || (values % step != 0 && (!options.allow_surplus || values < step)))
        throw Error(
            "{}: {} bytes{}, expected a multiple of {} = {} x {} x {} values of {}{}", name, size,
            options.header_bytes ? fmt::format(" with a header of {}", options.header_bytes) : "",
            step, dims[0], dims[1], dims[2], name_of(*options.type),
            values > step ? " (--allow-surplus leaves the last bytes out)" : "");
    layout.steps = values / step;
    return open_stored(path, std::move(info), layout, options);
}

} // namespace isochron::index
