// One processor for each thread that software GL draws with.
#pragma once

#include <cstddef>
#include <vector>

namespace isochron::stereo {

/// What llvmpipe draws with in this process.
struct RasterThreads {
    std::vector<int> processors; ///< that the process may use
    std::size_t threads = 0;     ///< beside the one that gives the commands; 0: that one draws
};
RasterThreads raster_threads();

/// Binds the threads of Mesa's llvmpipe to the processors that this process may use, one after the
/// other, in a job of Open MPI those of the second process on a machine after those of the first;
/// called when a context of it has been made. They are woken all at once for every frame,
/// and Linux now and then wakes two on one processor and leaves them there for the frame, which
/// then takes twice as long: on two processors the 99th percentile of a frame over their median was
/// 1.9, bound it is 1.25. Threads that have not started after 20 ms are left alone: without this,
/// too, all is right, only less even.
void spread_raster_threads();

} // namespace isochron::stereo
