// Hashes of places.
#include "index/detail/cell_thinning.h"

namespace isochron::index {
namespace {

/// The last step of splitmix64 (Steele and others 2014, doi:10.1145/2660193.2660195).
constexpr std::uint64_t stirred(std::uint64_t z) {
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

} // namespace

CellThinning::CellThinning(std::uint64_t all, std::uint64_t most)
    : end_(all <= most ? std::uint64_t{1} << 32
                       : static_cast<std::uint64_t>(static_cast<double>(most) /
                                                    static_cast<double>(all) * 0x1p32)) {}

bool CellThinning::keeps(const std::array<std::uint32_t, 3>& place) const {
    const std::uint64_t of_row = stirred(std::uint64_t{place[2]} << 32 | place[1]);
    return stirred(of_row + place[0]) >> 32 < end_;
}

} // namespace isochron::index
