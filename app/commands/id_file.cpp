// Files of cell ids: little-endian, no header.
#include "app/commands/id_file.h"

#include "index/system/new_file.h"

#include <bit>
#include <cstdint>
#include <span>

namespace isochron::app {

void write_ids(const std::filesystem::path& path, const std::vector<index::CellId>& ids) {
    static_assert(std::endian::native == std::endian::little && sizeof(index::CellId) == 4);
    index::write_file(path, std::as_bytes(std::span(ids)));
}

void write_ids(const std::filesystem::path& path, const index::CellSet& set,
               const index::Grid& grid) {
    if (!index::has_wide_ids(grid))
        return write_ids(path, set.ids);
    std::vector<std::uint64_t> ids;
    ids.reserve(set.points.size());
    for (const index::CellPoint& point : set.points)
        ids.push_back(index::wide_id(grid, point.x, point.y, point.z));
    index::write_file(path, std::as_bytes(std::span(ids)));
}

} // namespace isochron::app
