// Streams the values of steps, one layer of chunks after the other.
#include "index/indexing/layer_stream.h"

#include "index/file/chunks/chunk_grid.h"
#include "index/indexing/parallel_steps.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <future>
#include <optional>

namespace isochron::index {
namespace {

constexpr std::size_t kTooSmall = 32 << 10; ///< [bytes] of a step; starting a thread takes longer

} // namespace

LayerCutter::LayerCutter(const Grid& grid, ValueType type)
    : planes_(grid.vertices[2]),
      plane_(std::size_t{grid.vertices[0]} * grid.vertices[1] * size_of(type)) {
    const std::size_t most = std::min(planes_, kChunkEdge + 2) * plane_;
    for (auto& buffer : buffers_)
        buffer.resize((most + 7) / 8);
}

LayerView LayerCutter::view() const {
    const std::uint32_t begin = layer_ * kChunkEdge;
    const std::uint32_t end = std::min(begin + kChunkEdge, planes_);
    return {begin,
            end,
            begin - std::min(begin, 1u),
            std::min(end + 1, planes_),
            plane_,
            reinterpret_cast<const std::byte*>(buffers_[current_].data())};
}

void LayerCutter::advance() {
    const LayerView done = view();
    current_ = 1 - current_;
    ++layer_;
    filled_ = 0;
    if (done.end == planes_) {
        layer_ = 0;
        return;
    }
    const auto both = done.planes(done.end - 1, done.last);
    std::memcpy(buffers_[current_].data(), both.data(), both.size());
    filled_ = both.size();
}

void LayerCutter::add(std::span<const std::byte> piece, const Take& take) {
    while (!piece.empty()) {
        const LayerView now = view();
        const std::size_t room = now.planes(now.first, now.last).size() - filled_;
        const std::size_t count = std::min(room, piece.size());
        std::memcpy(reinterpret_cast<std::byte*>(buffers_[current_].data()) + filled_, piece.data(),
                    count);
        filled_ += count;
        piece = piece.subspan(count);
        bool whole = count == room;
        while (whole) {
            const LayerView full = view();
            take(full);
            advance();
            const LayerView next = view();
            whole = full.end < planes_ && next.planes(next.first, next.last).size() == filled_;
        }
    }
}

void stream_layers(std::span<VolumeSeries* const> arrays, std::size_t begin, std::size_t end,
                   unsigned threads, const TakeLayer& take,
                   const std::function<void(double)>& progress) {
    std::deque<LayerCutter> cutters;
    std::size_t all_bytes = 0; // bytes of a step
    for (const VolumeSeries* array : arrays) {
        cutters.emplace_back(array->info().grid, array->info().type);
        all_bytes += array->info().step_bytes();
    }
    std::optional<ParallelSteps> side_by_side;
    if (const unsigned readers = ParallelSteps::readers_for(arrays, end - begin, threads))
        side_by_side.emplace(arrays, begin, end, readers);
    std::future<void> taking; // its destructor waits for it
    const auto wait = [&] {
        if (taking.valid())
            taking.get();
    };
    for (std::size_t step = begin; step < end; ++step) {
        std::size_t bytes_before = 0; // bytes of the step's arrays before this one
        const auto report = [&](std::size_t bytes) {
            const double done =
                static_cast<double>(bytes_before + bytes) / static_cast<double>(all_bytes);
            if (progress)
                progress((static_cast<double>(step - begin) + done) /
                         static_cast<double>(end - begin));
        };
        const auto values = side_by_side ? side_by_side->next() : std::span<const StepBytes>();
        for (std::size_t array = 0; array < arrays.size(); ++array) {
            report(0);
            const auto add = [&](std::span<const std::byte> piece) {
                cutters[array].add(piece, [&](const LayerView& layer) {
                    wait();
                    report(layer.begin * layer.plane);
                    if (layer.own().size() <= kTooSmall)
                        take(array, step, layer);
                    else
                        taking = std::async(std::launch::async, [&take, array, step, layer] {
                            take(array, step, layer);
                        });
                });
            };
            if (side_by_side)
                add(values[array]);
            else
                arrays[array]->stream(step, add);
            bytes_before += arrays[array]->info().step_bytes();
        }
    }
    wait();
}

} // namespace isochron::index
