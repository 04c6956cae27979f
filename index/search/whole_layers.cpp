// Decodes layers in the order of the file; works on each once its neighbors are there.
#include "index/search/whole_layers.h"

#include "index/search/layer_candidates.h"
#include "index/system/parallel.h"

#include <algorithm>
#include <array>
#include <utility>

namespace isochron::index {
namespace {

/// Slabs besides one for each thread: of the layer before the one that is worked on, the one behind
/// it, and the next one.
constexpr unsigned kMoreSlabs = 3;

} // namespace

std::optional<WholeLayers::Range> WholeLayers::worth(const StepView& step, const LevelMap::Cut& cut,
                                                     unsigned threads, std::uint64_t room) {
    if ((threads + kMoreSlabs) * StepSlab::bytes(step.grid(), step.type()) > room / 2)
        return {};
    const std::uint32_t layers = StepSlab::layers(step.grid());
    Range range{layers, 0};
    std::uint32_t whole = 0;
    std::size_t staying = 0;
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        const std::size_t places = LayerCandidates::count_of(*step.layer(layer), cut);
        if (places == 0)
            continue;
        range.first = std::min(range.first, layer);
        range.end = layer + 1;
        whole += step.store().fetches_all(places) ? 1 : 0;
        staying += step.store().staying(step.at().step, layer);
    }
    // Values that lie in other steps do not come in the order of the file.
    if (8 * staying > (range.end - range.first) * step.chunk_grid().chunks_of_layer())
        return {};
    if (range.first >= range.end || 4 * whole < 3 * (range.end - range.first))
        return {};
    return range;
}

WholeLayers::WholeLayers(const StepView& step, Range range, const LevelMap::Cut& cut,
                         unsigned threads)
    : step_(step), worked_on_(range), decoded_{range.first - std::min(range.first, 1u),
                                               std::min(range.end + 1, step.chunk_grid().layers())},
      cut_(cut), threads_(threads), layers_(decoded_.end - decoded_.first),
      slabs_(threads + kMoreSlabs) {
    for (std::uint32_t layer = decoded_.first; layer < decoded_.end; ++layer)
        of(layer).pieces = RecordStream::pieces_of(*step.layer(layer));
    for (std::uint32_t layer = worked_on_.first; layer < worked_on_.end; ++layer)
        for (std::uint32_t near = layer - std::min(layer, 1u);
             near < std::min(layer + 2, decoded_.end); ++near)
            ++of(near).uses;
}

bool WholeLayers::for_each(const Work& work, const std::stop_token& stop) {
    RecordStream stream(step_.store(), step_.at().step, decoded_.first, decoded_.end, stop);
    try {
        parallel_for(threads_, threads_,
                     [&](std::size_t, unsigned) {
                         try {
                             run(stream, work, stop);
                         } catch (...) {
                             stream.close();
                             const std::scoped_lock lock(mutex_);
                             failed_ = true;
                             released_.notify_all();
                             throw;
                         }
                     },
                     {});
    } catch (const Stopped&) {
        return false;
    }
    return !stop.stop_requested();
}

void WholeLayers::run(RecordStream& stream, const Work& work, const std::stop_token& stop) {
    RecordPiece piece;
    while (stream.next(piece)) {
        StepSlab* const of_piece = begin(piece, stop);
        if (!of_piece)
            return;
        const auto begun = std::chrono::steady_clock::now();
        decode(piece, *of_piece);
        for (const std::uint32_t layer : finish(piece, std::chrono::steady_clock::now() - begun)) {
            stop_if_asked(stop);
            for (const std::uint32_t near : {layer - 1, layer + 1})
                if (near >= decoded_.first && near < decoded_.end) // false for 0 - 1, too
                    slab(layer).fill_from(slab(near));
            work(slab(layer), layer, of(layer).decoding);
            release(layer);
        }
    }
}

/// Makes the slab of a layer ready, once the layer that had its memory is no longer needed.
/// @return null when another thread has failed
StepSlab* WholeLayers::begin(const RecordPiece& piece, const std::stop_token& stop) {
    const auto count = static_cast<std::uint32_t>(slabs_.size());
    std::unique_lock lock(mutex_);
    released_.wait(lock, [&] {
        return failed_ || piece.layer < decoded_.first + count || of(piece.layer - count).uses == 0;
    });
    if (failed_)
        return nullptr;
    if (!std::exchange(of(piece.layer).begun, true)) {
        auto& memory = slabs_[piece.layer % count];
        if (!memory)
            memory = std::make_unique<StepSlab>();
        memory->begin_whole(step_, piece.layer, stop);
    }
    return &slab(piece.layer);
}

void WholeLayers::decode(const RecordPiece& piece, StepSlab& slab) {
    thread_local std::vector<std::byte> values;
    const ChunkStore& store = step_.store();
    values.resize(store.most_values());
    Chunk chunk;
    for (std::uint32_t place = piece.first; place < piece.end; ++place) {
        chunk.size = store.grid().size(piece.layer, place);
        ChunkPtr staying;
        if (store.decoder().lies_elsewhere(step_.at().step, *piece.table, place)) {
            staying = store.chunks(step_.at().step, piece.layer, std::array{place}).front();
            chunk.bricks = staying->bricks;
            chunk.values = staying->values;
        } else {
            const auto own = std::span(values).first(store.bytes_of(chunk.size));
            store.decoder().chunk(step_.at().step, piece.layer, place, piece.record(place),
                                  chunk.bricks, own);
            chunk.values = own;
        }
        const bool may_hold =
            LayerCandidates::may_hold(piece.table->low[place], piece.table->high[place], cut_);
        slab.put(chunk, place, may_hold ? bricks_of(chunk.bricks, cut_) : 0);
    }
}

/// Notes that a piece has been decoded. @return the layers that can now be worked on, by the caller
std::vector<std::uint32_t> WholeLayers::finish(const RecordPiece& piece,
                                               std::chrono::nanoseconds time) {
    const std::scoped_lock lock(mutex_);
    of(piece.layer).decoding += time;
    std::vector<std::uint32_t> ready;
    if (--of(piece.layer).pieces > 0)
        return ready;
    const auto there = [this](std::uint32_t layer) {
        return layer < decoded_.first || layer >= decoded_.end || of(layer).pieces == 0;
    };
    const std::uint32_t first = piece.layer - std::min(piece.layer, 1u);
    for (std::uint32_t layer = std::max(first, worked_on_.first);
         layer < std::min(piece.layer + 2, worked_on_.end); ++layer)
        if (!of(layer).worked_on && there(layer - std::min(layer, 1u)) && there(layer) &&
            there(layer + 1)) {
            of(layer).worked_on = true;
            ready.push_back(layer);
        }
    return ready;
}

/// Ends the use of a layer and its neighbors by the work on it.
void WholeLayers::release(std::uint32_t layer) {
    const std::scoped_lock lock(mutex_);
    for (std::uint32_t near = layer - std::min(layer, 1u); near < std::min(layer + 2, decoded_.end);
         ++near)
        --of(near).uses;
    released_.notify_all();
}

} // namespace isochron::index
