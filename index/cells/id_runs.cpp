// Copies ids of runs in whole vectors; compiled once for each SIMD target and chosen at run time.
#include "index/cells/id_runs.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/cells/id_runs.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <cassert>

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Copies a whole block without a branch, as many runs are shorter; the next run overwrites what is
/// too much. A longer block costs more, as most stores touch two cache lines.
constexpr std::size_t kBlock = 16;
static_assert(kBlock <= IdRun::kSlack);

HWY_INLINE void copy_block(const std::uint16_t* ids, CellId first, CellId* out) {
    const hn::CappedTag<CellId, kBlock> d;
    const hn::Rebind<std::uint16_t, decltype(d)> d16;
    const auto base = hn::Set(d, first);
    for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d))
        hn::StoreU(hn::Add(hn::PromoteTo(d, hn::LoadU(d16, ids + i)), base), d, out + i);
}

std::size_t copy_ids(const IdRun* runs, std::size_t run_count, CellId* out) {
    CellId* next = out;
    for (const IdRun* each = runs; each != runs + run_count; ++each) {
        const IdRun run = *each; // the compiler would read it again after every store
        for (std::size_t at = 0; at < run.count; at += kBlock)
            copy_block(run.ids + at, run.first, next + at);
        next += run.count;
    }
    return static_cast<std::size_t>(next - out);
}

} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(copy_ids);

std::size_t count_ids(std::span<const IdRun> runs) {
    std::size_t count = 0;
    for (const IdRun& run : runs)
        count += run.count;
    return count;
}

std::size_t copy_ids(std::span<const IdRun> runs, std::span<CellId> out) {
    assert(count_ids(runs) + IdRun::kSlack <= out.size());
    return HWY_DYNAMIC_DISPATCH(copy_ids)(runs.data(), runs.size(), out.data());
}

void assign_ids(std::span<const IdRun> runs, std::vector<CellId>& out) {
    const std::size_t wanted = count_ids(runs) + IdRun::kSlack;
    if (wanted > out.capacity())
        out.clear(); // else it would be copied
    if (wanted > out.size())
        out.resize(wanted);
    out.resize(copy_ids(runs, out));
}

} // namespace isochron::index
#endif
