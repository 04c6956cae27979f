// Files of cell ids: u32, little-endian, no header.
#include "app/commands/id_file.h"

#include "index/system/new_file.h"

#include <bit>
#include <span>

namespace isochron::app {

void write_ids(const std::filesystem::path& path, const std::vector<index::CellId>& ids) {
    static_assert(std::endian::native == std::endian::little && sizeof(index::CellId) == 4);
    index::NewFile file(path);
    file.write_at(0, std::as_bytes(std::span(ids)));
    file.commit();
}

} // namespace isochron::app
