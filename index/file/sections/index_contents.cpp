// The contents of an .isochron file besides the volume.
#include "index/file/sections/index_contents.h"

namespace isochron::index {

std::uint64_t IndexStats::bytes_of(Tier tier) const {
    switch (tier) {
    case Tier::bricks: return bricks_bytes;
    case Tier::cells: return cells_bytes;
    case Tier::deltas: return deltas_bytes;
    case Tier::tree: break;
    }
    return tree_bytes;
}

} // namespace isochron::index
