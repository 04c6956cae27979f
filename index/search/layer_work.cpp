// Prepares, reads ahead, and works on layers in parallel.
#include "index/search/layer_work.h"

#include "index/system/read_ahead.h"

#include <algorithm>

namespace isochron::index {

/// The slabs of all threads together take at most a quarter of the cache's budget.
unsigned LayerWork::threads(const StepView& step) {
    const std::uint64_t room =
        file_->cache().budget / 4 / StepSlab::bytes(step.grid(), step.type()) + 1;
    const auto threads = static_cast<unsigned>(std::min<std::uint64_t>(thread_count(0), room));
    slabs_.resize(std::max<std::size_t>(slabs_.size(), threads));
    return threads;
}

StepSlab& LayerWork::slab(unsigned worker) {
    if (!slabs_[worker])
        slabs_[worker] = std::make_unique<StepSlab>();
    return *slabs_[worker];
}

bool LayerWork::for_each_layer(const StepView& step, const PlacesOf& places, const Prepare& prepare,
                               const Work& work, unsigned threads, const std::stop_token& stop) {
    const std::uint32_t layers = StepSlab::layers(step.grid());
    ReadAhead ahead(layers, [&](std::uint32_t layer) {
        stop_if_asked(stop);
        return step.fetch(layer, places(layer), stop);
    });
    // Each item prepares a layer, and works on one that has been prepared a while ago.
    const unsigned before = prepare ? threads : 0;
    try {
        parallel_for(std::size_t{layers} + before, threads,
                     [&](std::size_t item, unsigned worker) {
                         stop_if_asked(stop);
                         if (item < layers) {
                             ahead.reach(static_cast<std::uint32_t>(item));
                             if (prepare)
                                 prepare(static_cast<std::uint32_t>(item));
                         }
                         if (item < before)
                             return;
                         work(worker, static_cast<std::uint32_t>(item - before));
                     },
                     {});
    } catch (const Stopped&) {
        return false;
    }
    return !stop.stop_requested();
}

CubeSearch& LayerWork::cubes(unsigned worker) {
    if (!cubes_[worker])
        cubes_[worker] = std::make_unique<CubeSearch>();
    return *cubes_[worker];
}

} // namespace isochron::index
