// The surface between two steps: its cells beside those of VTK's blend, and its costs.
#include "tests/bench/measures/between_steps.h"

#include "index/extraction/extraction.h"
#include "index/file/step_view.h"
#include "index/indexing/index_build.h"
#include "index/scan/scan.h"
#include "index/search/index_search.h"
#include "tests/bench/measures/stopwatch.h"
#include "tests/bench/measures/timing.h"
#include "tests/bench/rivals/temporal_blend.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

namespace isochron::bench {
namespace {

using index::Instant;

Instant some_moment(std::mt19937& random) {
    return {0, 1 + static_cast<std::uint32_t>(random() % (Instant::kFractions - 1))};
}

/// Active cells of stored values of one step, ascending.
std::vector<index::CellId> cells_of(const index::StepValues& like,
                                    const std::vector<std::byte>& values, double isovalue) {
    std::vector<std::uint64_t> memory((values.size() + 7) / 8);
    std::memcpy(memory.data(), values.data(), values.size());
    index::StepValues one = like;
    one.first = reinterpret_cast<const std::byte*>(memory.data());
    one.steps = 1;
    one.stride = memory.size() * 8;
    one.first_step = 0;
    std::vector<index::CellId> cells;
    index::scan(one, {index::Instant(0), isovalue}, cells);
    std::ranges::sort(cells);
    return cells;
}

/// Values that are missing in VTK's blend at a step that lacks none, between two that lack some.
std::uint64_t spoiled_by_neighbors() {
    index::StepValues values;
    values.type = index::ValueType::f32;
    values.steps = 3;
    values.grid.vertices = {16, 16, 16};
    const auto count = static_cast<std::size_t>(values.grid.vertex_count());
    std::vector<float> all(3 * count, 1.0f);
    for (std::size_t i = 0; i < count; i += 10)
        all[i] = all[2 * count + i] = std::numeric_limits<float>::quiet_NaN();
    values.first = reinterpret_cast<const std::byte*>(all.data());
    values.stride = count * sizeof(float);
    const auto vtk = temporal_blend(values);
    vtk->values(Instant(0, 32768)); // time plays on to the step
    const auto at_step = vtk->values(Instant(1));
    std::uint64_t missing = 0;
    for (std::size_t i = 0; i < count; ++i) {
        float value = 0;
        std::memcpy(&value, at_step.data() + i * sizeof value, sizeof value);
        missing += std::isnan(value) ? 1 : 0;
    }
    return missing;
}

} // namespace

Difference difference_from_vtk(const std::shared_ptr<const index::IndexFile>& file,
                               double isovalue) {
    const index::StepValues& values = file->values();
    const auto vtk = temporal_blend(values);
    const auto search = index::search_in(file);
    std::mt19937 random(1);
    constexpr int kMoments = 12;
    Difference difference;
    for (int i = 0; i < kMoments; ++i) {
        const Instant at = some_moment(random);
        std::vector<index::CellId> exact = search({at, isovalue}, {})->ids;
        std::ranges::sort(exact);
        const auto theirs = cells_of(values, vtk->values(at), isovalue);
        std::vector<index::CellId> differ;
        std::ranges::set_symmetric_difference(exact, theirs, std::back_inserter(differ));
        const double percent =
            100 * static_cast<double>(differ.size()) / static_cast<double>(exact.size());
        difference.mean_percent += percent / kMoments;
        difference.most_percent = std::max(difference.most_percent, percent);
    }
    difference.spoiled_values = spoiled_by_neighbors();
    return difference;
}

double time_of_measuring(index::VolumeSeries& series, const std::filesystem::path& file,
                         unsigned repeats, const std::function<void()>& check) {
    const auto build = [&](bool measures) {
        check();
        const Stopwatch watch(Stopwatch::Of::all_threads);
        index::build_index(series, file, {.measures_blends = measures});
        return watch.seconds();
    };
    build(true);
    std::vector<double> ratios;
    for (unsigned i = 0; i < repeats; ++i) {
        const bool first = i % 2 == 0;
        const double one = build(first), other = build(!first);
        ratios.push_back(first ? one / other : other / one);
    }
    std::filesystem::remove(file);
    return median(ratios);
}

BetweenTimes time_between(const std::shared_ptr<const index::IndexFile>& file, double isovalue,
                          unsigned repeats) {
    const index::Extract extract = index::extract_from(file, std::nullopt, index::Shading::cells);
    const auto vtk = temporal_blend(file->values());
    const auto timed = [](const auto& work) {
        const Stopwatch watch(Stopwatch::Of::all_threads);
        work();
        return watch.seconds();
    };
    BetweenTimes times;
    const auto draw = [&](Instant at) { extract({.instant = at, .isovalues = {isovalue}}, {}); };
    const index::SearchInto search = index::search_into(file, std::nullopt, index::Shading::cells);
    index::CellSet set;
    const auto find = [&](const index::StepView& step) {
        search(step, isovalue, {}, set);
        times.cells = set.ids.size();
    };
    for (int look = 0; look < 3; ++look) // what is decoded, and as a whole, is so from now on
        for (const std::uint32_t step : {0u, 1u}) {
            draw(Instant(step));
            draw(Instant(0, 20'000 + step));
            find(index::step_in_chunks(*file, index::Instant(step)));
        }
    std::mt19937 random(1);
    std::vector<double> moment, step, chunks, rival, drawn_moment, drawn_step, elapsed,
        rival_elapsed;
    for (unsigned i = 0; i < repeats; ++i) {
        const Instant at = some_moment(random), other = some_moment(random);
        step.push_back(timed([&] { find(index::step_of_query(*file, index::Instant(i % 2))); }));
        const auto begun = std::chrono::steady_clock::now();
        moment.push_back(timed([&] { find(index::step_of_query(*file, at, {&isovalue, 1})); }));
        const auto ended = std::chrono::steady_clock::now();
        elapsed.push_back(std::chrono::duration<double>(ended - begun).count());
        chunks.push_back(timed([&] { find(index::step_in_chunks(*file, index::Instant(i % 2))); }));
        drawn_step.push_back(timed([&] { draw(Instant(i % 2)); }));
        drawn_moment.push_back(timed([&] { draw(other); }));
        if (i >= 7)
            continue;
        const auto asked = std::chrono::steady_clock::now();
        rival.push_back(timed([&] { vtk->contour(at, isovalue); }));
        rival_elapsed.push_back(
            std::chrono::duration<double>(std::chrono::steady_clock::now() - asked).count());
    }
    times.moment = median(moment);
    times.step = median(step);
    times.step_by_chunks = median(chunks);
    times.drawn_moment = median(drawn_moment);
    times.drawn_step = median(drawn_step);
    times.vtk = median(rival);
    times.vtk_elapsed = median(rival_elapsed) / median(elapsed);
    const auto cold = [&](Instant at) {
        const auto anew = index::IndexFile::open(file->name());
        const std::uint64_t before = anew->reading().bytes;
        index::search_in(anew, index::SearchMethod::bricks)({at, isovalue}, {});
        return static_cast<double>(anew->reading().bytes - before);
    };
    times.cold_bytes = cold(Instant(0, 32768)) / cold(Instant(0));
    return times;
}

} // namespace isochron::bench
