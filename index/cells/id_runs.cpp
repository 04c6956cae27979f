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

/// Copies a whole block without a branch, as most runs are shorter; the next run overwrites what is
/// too much.
HWY_INLINE void copy_block(const std::uint16_t* ids, CellId first, CellId* out) {
    const hn::CappedTag<CellId, IdRun::kSlack> d;
    const hn::Rebind<std::uint16_t, decltype(d)> d16;
    const auto base = hn::Set(d, first);
    for (std::size_t i = 0; i < IdRun::kSlack; i += hn::Lanes(d))
        hn::StoreU(hn::Add(hn::PromoteTo(d, hn::LoadU(d16, ids + i)), base), d, out + i);
}

std::size_t copy_ids(const IdRun* runs, std::size_t run_count, CellId* out) {
    CellId* next = out;
    for (const IdRun* run = runs; run != runs + run_count; ++run) {
        const std::uint16_t* ids = run->ids;
        for (std::size_t at = 0; at < run->count; at += IdRun::kSlack)
            copy_block(ids + at, run->first, next + at);
        next += run->count;
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

void append_ids(std::span<const IdRun> runs, std::vector<CellId>& out) {
    const std::size_t begin = out.size();
    out.resize(begin + count_ids(runs) + IdRun::kSlack);
    copy_ids(runs, std::span(out).subspan(begin));
    out.resize(out.size() - IdRun::kSlack);
}

} // namespace isochron::index
#endif
