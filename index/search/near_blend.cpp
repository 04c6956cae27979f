// Marks bricks, and blends runs of rows around them.
#include "index/search/near_blend.h"

#include "index/file/chunks/spare_memory.h"
#include "index/scan/bricks.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace isochron::index {
namespace {

constexpr auto kEdge = BrickGrid::kCells;
static_assert(kEdge[1] == 4 && kEdge[2] == 4, "rows below take every fourth one");
constexpr std::uint32_t kBricksAlongLayer = kChunkEdge / kEdge[2];
constexpr std::size_t kMarksOfWord = 64;
/// Blends that have room for all vertices of a step up to this size.
constexpr std::uint64_t kMostBytes = 64 << 20;
/// Runs are rounded up to whole vectors.
constexpr std::size_t kVector = 16;

std::uint64_t blend_bytes(const StepView& step) {
    return (step.grid().vertex_count() * size_of(step.type()) + 7) / 8 * 8;
}

} // namespace

bool NearBlend::worth(const StepView& step) {
    const ChunkStore& store = step.store();
    return step.between_steps() && store.carries_values() && store.has_bricks() &&
           blend_bytes(step) <= kMostBytes && store.better_whole(step.at().step) &&
           store.better_whole(step.at().step + 1);
}

NearBlend::NearBlend(const StepView& step, const LevelMap::Cut& cut, const std::stop_token& stop)
    : step_(step), now_(step.store().whole(step.at().step, stop)),
      next_(step.store().whole(step.at().step + 1, stop)), counts_(BrickGrid(grid()).bricks()),
      words_((counts_[0] + kMarksOfWord - 1) / kMarksOfWord),
      marks_(words_ * counts_[1] * counts_[2]), bricks_(layers()), bytes_(blend_bytes(step)) {
    mark(step.between_steps()->ranks().candidates(now_.bricks, next_.bricks, cut, candidates_));
    if (!candidates_.empty())
        blends_ = step.store().for_blends().take_step(bytes_);
}

NearBlend::~NearBlend() {
    if (blends_)
        step_.store().for_blends().give_back_step(std::move(blends_), bytes_);
}

/// @param all bricks of the step, of which the candidates alone have ranks
void NearBlend::mark(std::span<const std::uint8_t> all) {
    const std::size_t count = all.size() / 2, plane = std::size_t{counts_[0]} * counts_[1];
    for (const std::uint32_t brick : candidates_) {
        const std::uint32_t x = brick % counts_[0], row = brick / counts_[0];
        marks_[row * words_ + x / kMarksOfWord] |= Word{1} << x % kMarksOfWord;
        const std::uint32_t layer = row / counts_[1] / kBricksAlongLayer;
        if (!bricks_[layer].empty())
            continue;
        const std::uint32_t first = layer * kBricksAlongLayer,
                            end = std::min(first + kBricksAlongLayer, counts_[2]);
        for (const auto ranks : {all.first(count), all.last(count)}) {
            const auto of_layer = ranks.subspan(first * plane, (end - first) * plane);
            bricks_[layer].insert(bricks_[layer].end(), of_layer.begin(), of_layer.end());
        }
    }
}

/// Whether no brick that a row of vertices, or one of the three behind it, may belong to is marked.
bool NearBlend::is_empty(std::span<const Word> plane, std::uint32_t y) const {
    const std::uint32_t own = y / kEdge[1], first = own - std::min(own, 1u);
    const std::size_t end = std::min(own + 2, counts_[1]);
    return std::ranges::none_of(plane.subspan(first * words_, (end - first) * words_),
                                [](Word word) { return word != 0; });
}

/// Adds the vertices of a row that marked bricks need.
/// @param row number of its first vertex @param end of the vertices that may be blended
void NearBlend::add_runs(std::span<const Word> marks, std::size_t row, std::size_t end,
                         std::vector<Blend::Run>& runs) const {
    for (std::size_t i = 0; i < marks.size(); ++i)
        for (Word left = marks[i]; left;) {
            const auto from = static_cast<unsigned>(std::countr_zero(left));
            const auto bricks = static_cast<unsigned>(std::countr_one(left >> from));
            left &= from + bricks < kMarksOfWord ? ~Word{0} << (from + bricks) : 0;
            const std::size_t brick = i * kMarksOfWord + from, first = brick * kEdge[0];
            const std::size_t x = first - std::min<std::size_t>(first, 1);
            const std::size_t x_end =
                std::min<std::size_t>(first + bricks * kEdge[0] + 2, grid().vertices[0]);
            const std::size_t whole = (x_end - x + kVector - 1) / kVector * kVector;
            runs.push_back({row + x, std::min(whole, end - (row + x))});
        }
}

void NearBlend::blend(std::uint32_t layer) const {
    const auto [nx, ny, nz] = grid().vertices;
    const auto [bricks_x, bricks_y, bricks_z] = counts_;
    const std::uint32_t first_plane = layer * kChunkEdge,
                        end_plane = layer + 1 == layers() ? nz : first_plane + kChunkEdge;
    const std::size_t row_marks = words_, plane_marks = bricks_y * words_;
    std::vector<Word> plane(plane_marks), row(row_marks);
    std::vector<Blend::Run> runs;
    const auto is_marked = [](Word word) { return word != 0; };
    // A vertex belongs to the bricks that hold it, and to those one vertex away: the brick of its own
    // number, and for some also the one before or behind.
    const auto for_each_around = [](std::uint32_t vertex, std::uint32_t edge, std::uint32_t count,
                                    const auto& f) {
        const std::uint32_t own = vertex / edge, within = vertex % edge;
        if (within <= 1 && own > 0)
            f(own - 1);
        if (own < count)
            f(own);
        if (within + 1 == edge && own + 1 < count)
            f(own + 1);
    };
    const auto add = [](std::span<Word> to, const Word* marks) {
        for (std::size_t i = 0; i < to.size(); ++i)
            to[i] |= marks[i];
    };
    for (std::uint32_t z = first_plane; z < end_plane; ++z) {
        std::ranges::fill(plane, 0);
        for_each_around(z, kEdge[2], bricks_z,
                        [&](std::uint32_t bz) { add(plane, marks_.data() + bz * plane_marks); });
        if (std::ranges::none_of(plane, is_marked))
            continue;
        for (std::uint32_t y = 0; y < ny; ++y) {
            if (y % kEdge[1] == 0 && is_empty(plane, y)) {
                y += kEdge[1] - 1;
                continue;
            }
            std::ranges::fill(row, 0);
            for_each_around(y, kEdge[1], bricks_y,
                            [&](std::uint32_t by) { add(row, plane.data() + by * row_marks); });
            if (std::ranges::any_of(row, is_marked))
                add_runs(row, (std::size_t{z} * ny + y) * nx, (std::size_t{z} + 1) * ny * nx, runs);
        }
    }
    const Blend& of = step_.between_steps()->kind();
    of(now_.values.first, next_.values.first, runs, blends_.get());
}

StepPart NearBlend::part(std::uint32_t layer) const {
    StepValues values{.grid = grid(), .type = step_.type(), .scaling = step_.scaling()};
    values.steps = step_.steps();
    values.first = blends_.get();
    values.stride = bytes_;
    values.first_step = step_.at().step;
    const StepPart all{.cells = values, .around = values, .sparse = true};
    const std::uint32_t first = layer * kChunkEdge;
    StepPart part = all.planes(first, std::min(first + kChunkEdge, grid().cells()[2]));
    part.bricks = bricks_[layer];
    return part;
}

} // namespace isochron::index
