// Binds each thread of software GL to one processor.
#pragma once

#include <cstddef>
#include <vector>

namespace isochron::stereo {

/// The processors and threads with which llvmpipe draws in this process.
struct RasterThreads {
    std::vector<int> processors; ///< numbers of the processors that this process may use
    std::size_t threads = 0;     ///< apart from the calling thread; 0: the calling thread draws
};
RasterThreads raster_threads();

/// Binds the threads of Mesa's llvmpipe to the processors that this process may use, one after the
/// other; in a job of Open MPI, the second process on a machine begins after the first one's. Call
/// it after making a context. Every frame wakes all threads at once. Sometimes Linux wakes two on
/// one processor and leaves them there, and the frame takes twice as long: on two processors the
/// 99th percentile of frame times was 1.9 times the median, and 1.25 times with bound threads.
/// Threads that have not started after 20 ms stay unbound: frames are correct then, only less even.
void spread_raster_threads();

} // namespace isochron::stereo
