// Sets glibc's limits.
#include "stereo/context/raster_memory.h"

#include <malloc.h>

namespace isochron::stereo {

void keep_raster_memory() {
#ifdef __GLIBC__
    // Setting one of them stops glibc from adapting the other.
    constexpr int kTrimThreshold = 64 << 20, kMapThreshold = 16 << 20; // [byte]
    mallopt(M_TRIM_THRESHOLD, kTrimThreshold);
    mallopt(M_MMAP_THRESHOLD, kMapThreshold);
#endif
}

} // namespace isochron::stereo
