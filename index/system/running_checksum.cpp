// XXH3 of bytes that arrive piece by piece.
#include "index/system/running_checksum.h"

#include <xxhash.h>

#include <new>

namespace isochron::index {

RunningChecksum::RunningChecksum() : state_(XXH3_createState()) {
    if (!state_)
        throw std::bad_alloc();
    XXH3_64bits_reset(state_);
}

RunningChecksum::~RunningChecksum() {
    XXH3_freeState(state_);
}

void RunningChecksum::add(std::span<const std::byte> bytes) {
    XXH3_64bits_update(state_, bytes.data(), bytes.size());
}

std::uint64_t RunningChecksum::take() {
    const std::uint64_t sum = XXH3_64bits_digest(state_);
    XXH3_64bits_reset(state_);
    return sum;
}

} // namespace isochron::index
