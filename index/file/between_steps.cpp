// Blends chunks, the tables of layers, and whole steps.
#include "index/file/between_steps.h"

#include "index/file/chunks/spare_memory.h"
#include "index/system/huge_pages.h"

#include <utility>

namespace isochron::index {
namespace {

constexpr std::uint64_t kKeptBytes = 128 << 20; ///< most kept of blended chunks

struct BlendedChunk : Chunk {
    explicit BlendedChunk(std::shared_ptr<SpareMemory> spare_memory)
        : spare(std::move(spare_memory)), memory(spare->take()) {}
    ~BlendedChunk() { spare->give_back(std::move(memory)); }
    BlendedChunk(const BlendedChunk&) = delete;
    BlendedChunk& operator=(const BlendedChunk&) = delete;

    std::shared_ptr<SpareMemory> spare;
    SpareMemory::Doubles memory; ///< memory in doubles, for their alignment
};

/// The ranks of a moment of a store, which keeps the last ones for any isovalues. @throws as
/// ChunkStore does
std::shared_ptr<const BlendedRanks> ranks_of(const ChunkStore& store, Instant at,
                                             const Blend& blend) {
    const auto make = [&] {
        return std::make_shared<const BlendedRanks>(
            *store.levels(at.step), *store.levels(at.step + 1), store.info().scaling, blend,
            at.fraction, blend.isovalues());
    };
    if (!blend.isovalues().empty()) // which is sooner done than said
        return make();
    ByteCache& kept = store.for_blends().ranks;
    const ByteCache::Key key{0, at.number()};
    if (auto found = kept.find<BlendedRanks>(key))
        return found;
    auto made = make();
    kept.add(key, made, made->bytes());
    return made;
}

} // namespace

BetweenSteps::BetweenSteps(const ChunkStore& store, Instant at, const Blend& blend)
    : store_(store), at_(at), blend_(blend), kept_(kKeptBytes) {}

const BlendedRanks& BetweenSteps::ranks() const {
    std::call_once(made_ranks_, [&] { ranks_ = ranks_of(store_, at_, blend_); });
    return *ranks_;
}

ChunkLayerPtr BetweenSteps::layer(std::uint32_t layer) const {
    const ByteCache::Key key{1, layer};
    if (auto kept = kept_.find<ChunkLayer>(key))
        return kept;
    const auto made = std::make_shared<ChunkLayer>(*store_.layer(at_.step, layer));
    if (store_.has_bricks()) {
        const ChunkLayerPtr next = store_.layer(at_.step + 1, layer);
        ranks().blend(made->low, made->high, next->low, next->high);
    }
    kept_.add(key, made, made->low.size() * (sizeof(std::uint64_t) + sizeof(std::uint32_t) + 2));
    return made;
}

void BetweenSteps::blend_bricks(const Chunk& now, const Chunk& next, Chunk& out) const {
    out.bricks = now.bricks;
    if (store_.has_bricks())
        ranks().blend(std::span(out.bricks).first(kBricksOfChunk),
                      std::span(out.bricks).last(kBricksOfChunk),
                      std::span(next.bricks).first(kBricksOfChunk),
                      std::span(next.bricks).last(kBricksOfChunk));
}

ChunkPtr BetweenSteps::blended(const Chunk& now, const Chunk& next) const {
    const auto made = std::make_shared<BlendedChunk>(store_.for_blends().spare);
    made->size = now.size;
    blend_bricks(now, next, *made);
    const std::size_t count = now.values.size() / size_of(store_.info().type);
    const std::size_t bytes = count * size_of(blend_.type());
    auto* const values = reinterpret_cast<std::byte*>(made->memory.get());
    blend_(now.values, next.values, values);
    made->values = {values, bytes};
    return made;
}

std::vector<ChunkPtr> BetweenSteps::pairs(std::uint32_t layer,
                                          std::span<const std::uint32_t> places,
                                          const std::stop_token& stop) const {
    const std::vector<std::uint32_t> later(places.begin(), places.end());
    store_.expect(at_.step + 1, layer, {&later, 1}); // before the first step is waited for
    std::vector<ChunkPtr> now = store_.chunks(at_.step, layer, places, stop);
    std::vector<ChunkPtr> next = store_.chunks(at_.step + 1, layer, places, stop);
    std::vector<ChunkPtr> pairs;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto pair = std::make_shared<ChunkPair>();
        pair->size = now[i]->size;
        pair->values = now[i]->values;
        blend_bricks(*now[i], *next[i], *pair);
        pair->now = std::move(now[i]);
        pair->next = std::move(next[i]);
        pairs.push_back(pair);
    }
    return pairs;
}

std::vector<ChunkPtr> BetweenSteps::chunks(std::uint32_t layer,
                                           std::span<const std::uint32_t> places,
                                           const std::stop_token& stop) const {
    std::vector<ByteCache::Key> keys;
    for (const std::uint32_t place : places)
        keys.push_back({2, std::uint64_t{layer} << 32 | place});
    std::vector<ChunkPtr> found = kept_.find_all<Chunk>(keys);
    std::vector<std::uint32_t> missing;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!found[i])
            missing.push_back(places[i]);
    if (missing.empty())
        return found;
    store_.expect(at_.step + 1, layer, {&missing, 1}); // before the first step is waited for
    const std::vector<ChunkPtr> now = store_.chunks(at_.step, layer, missing, stop);
    const std::vector<ChunkPtr> next = store_.chunks(at_.step + 1, layer, missing, stop);
    std::vector<ByteCache::Entry> entries;
    for (std::size_t i = 0, at = 0; i < places.size(); ++i) {
        if (found[i])
            continue;
        stop_if_asked(stop);
        found[i] = blended(*now[at], *next[at]);
        entries.push_back({keys[i], found[i], found[i]->values.size() + sizeof(BlendedChunk)});
        ++at;
    }
    kept_.add_all(std::move(entries));
    return found;
}

std::uint64_t BetweenSteps::expect(std::uint32_t first,
                                   std::span<const std::vector<std::uint32_t>> places) const {
    return store_.expect(at_.step, first, places) + store_.expect(at_.step + 1, first, places);
}

std::uint64_t BetweenSteps::fetch(std::uint32_t layer, std::span<const std::uint32_t> places,
                                  const std::stop_token& stop) const {
    return store_.fetch(at_.step, layer, places, stop) +
           store_.fetch(at_.step + 1, layer, places, stop);
}

LoadedStep BetweenSteps::whole(const LoadedStep& now, const LoadedStep& next, Instant at,
                               const ChunkStore* store, const Blend& blend) {
    struct Owner {
        LargeMemory values;
        std::vector<std::uint8_t> bricks;
    };
    const auto owner = std::make_shared<Owner>();
    LoadedStep made{.values = now.values};
    made.values.type = blend.type();
    made.values.scaling = blend.scaling();
    const std::size_t bytes = now.values.grid.vertex_count() * size_of(blend.type());
    owner->values = large_memory(bytes);
    blend(now.values.step_bytes(at.step), next.values.step_bytes(at.step + 1), owner->values.get());
    made.values.first = owner->values.get();
    made.values.first_step = at.step;
    made.values.stride = (bytes + 7) / 8 * 8;
    if (!now.bricks.empty() && store) {
        owner->bricks.assign(now.bricks.begin(), now.bricks.end());
        const std::size_t count = now.bricks.size() / 2;
        const std::span<std::uint8_t> bricks = owner->bricks;
        ranks_of(*store, at, blend)
            ->blend(bricks.first(count), bricks.subspan(count, count), next.bricks.first(count),
                    next.bricks.subspan(count, count));
        made.bricks = bricks;
    }
    made.owner = owner;
    return made;
}

} // namespace isochron::index
