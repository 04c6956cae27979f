// Computes distances by tables per axis, and sorts them by radix sort.
#include "render/cells/traversal_order.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace isochron::render {

/// A radix sort in pieces: every pass goes over all cells. The first makes the entries, then two
/// for each digit count and move them, and the last one takes the slots out.
class SortPasses {
  public:
    virtual ~SortPasses() = default;
    virtual std::size_t count() const = 0;
    /// Does a part of a pass, for the cells from `begin` to `end`.
    virtual void run(const Slots& slots, std::size_t pass, std::size_t begin, std::size_t end) = 0;

    std::vector<std::uint32_t> order;
};

namespace {

constexpr int kWeightOne = 1 << kWeightBits;
constexpr float kHeaviest = 1 << 14;  // enough for spacings up to 100 times the smallest (squared)
constexpr double kFarthest = 1 << 20; // [cells]; beyond this only the direction counts
/// References are middles of quarter cells, in eighths of a cell. They are never half way between
/// the middles of two cells, so that the cell of the eye is always the nearer one.
constexpr int kPart = 2, kCell = 8, kMiddle = 4, kPartsOfCell = kCell / kPart;
constexpr double kSnapsPerRadian = 512; // directions of a reference outside the grid

/// Weights as fixed point numbers, relative to the smallest. A weight of at least 1 keeps cells
/// apart that are a whole cell apart, and rounding to its units keeps their order.
glm::ivec3 fixed_point(const glm::vec3& weights) {
    const float smallest =
        std::max({std::min({weights.x, weights.y, weights.z}),
                  std::max({weights.x, weights.y, weights.z}) / kHeaviest, 1e-30f});
    return glm::ivec3(glm::round(glm::clamp(weights / smallest, 1.0f, kHeaviest) *
                                 static_cast<float>(kWeightOne)));
}

/// How far a coordinate is outside [0, cells]; negative below 0.
double beyond(double eye, int cells) {
    return eye < 0.0 ? eye : eye > cells ? eye - cells : 0.0;
}

/// @param snap step of the reference outside the grid, in parts of a cell
int reference_along(double eye, int cells, std::int64_t snap) {
    const double inside = std::clamp(eye, 0.0, std::nextafter(cells, 0.0));
    const auto part = static_cast<std::int64_t>(inside * kPartsOfCell);
    const auto past = static_cast<std::int64_t>(std::abs(beyond(eye, cells)) * kPartsOfCell);
    const std::int64_t snapped = past / snap * snap;
    if (eye < 0.0)
        return static_cast<int>(-kPart * (snapped + 1) + kPart / 2);
    if (eye >= cells)
        return static_cast<int>(kCell * std::int64_t{cells} + kPart * snapped + kPart / 2);
    return static_cast<int>(kPart * part + kPart / 2);
}

using AxisTable = std::vector<std::uint64_t>;

/// Each axis's part of the distance, by coordinate.
struct Distances {
    std::array<AxisTable, 3> along;
    /// Bits of a distance that are dropped. If one cell may hide another, their distances still differ.
    int unit_bits = 0;
    std::uint64_t largest = 0; ///< largest possible distance

    std::uint64_t of(const CellPlace& place) const {
        return (along[0][place.x] + along[1][place.y] + along[2][place.z]) >> unit_bits;
    }
};

Distances distances(const Slots& slots, const TraversalKey& key) {
    glm::ivec3 low(std::numeric_limits<int>::max()), high(0);
    // A place of mixed levels is twice the cell's center.
    const int step = slots.largest > 0 ? kCell / 2 : kCell;
    const int first = slots.largest > 0 ? 0 : kMiddle;
    for (const CellPlace& place : slots.places) {
        const glm::ivec3 at(place.x, place.y, place.z);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    Distances result;
    // Squared distances differ by at least 1/4: (5/8)^2 - (3/8)^2, at the eye's own cell.
    result.unit_bits =
        kWeightBits + (key.reference.w != 0 ? std::countr_zero(kCell * kCell / 4u) : 0);
    for (int axis = 0; axis < 3; ++axis) {
        AxisTable& table = result.along[axis];
        table.resize(high[axis] + 1);
        const std::int64_t reference = key.reference[axis], weight = key.weights[axis];
        std::uint64_t most = 0, least = std::numeric_limits<std::uint64_t>::max();
        for (int at = low[axis]; at <= high[axis]; ++at) {
            const std::int64_t off = key.reference.w != 0 ? std::abs(step * at + first - reference)
                                     : reference < 0      ? at
                                                          : high[axis] - at;
            table[at] = off * (key.reference.w != 0 ? off : 1) * weight;
            most = std::max(most, table[at]);
            least = std::min(least, table[at]);
        }
        // Only differences count, and small numbers are sorted in fewer passes.
        for (int at = low[axis]; at <= high[axis]; ++at)
            table[at] -= least;
        result.largest += most - least;
    }
    result.largest >>= result.unit_bits;
    return result;
}

/// A slot with its cell's nearness, 0 for the farthest. Usually both fit into one word, which moves
/// faster.
struct Narrow {
    std::uint64_t word;
    Narrow() = default;
    Narrow(std::uint64_t nearness, std::uint32_t slot) : word(nearness << 32 | slot) {}
    std::uint64_t nearness() const { return word >> 32; }
    std::uint32_t slot() const { return static_cast<std::uint32_t>(word); }
};
struct Wide {
    std::uint64_t near_;
    std::uint32_t slot_;
    Wide() = default;
    Wide(std::uint64_t nearness, std::uint32_t slot) : near_(nearness), slot_(slot) {}
    std::uint64_t nearness() const { return near_; }
    std::uint32_t slot() const { return slot_; }
};

constexpr int kDigitBits = 11;

template <class Entry>
std::size_t digit(const Entry& entry, int shift) {
    return entry.nearness() >> shift & ((1u << kDigitBits) - 1);
}

template <class Entry>
class PassesOf final : public SortPasses {
  public:
    PassesOf(std::size_t cells, Distances distances)
        : distances_(std::move(distances)), cells_(cells),
          from_(std::make_unique_for_overwrite<Entry[]>(cells)),
          to_(std::make_unique_for_overwrite<Entry[]>(cells)) {
        while (distances_.largest >> (digits_ * kDigitBits) != 0)
            ++digits_;
    }

    std::size_t count() const override { return 2 + 2 * digits_; }

    void run(const Slots& slots, std::size_t pass, std::size_t begin, std::size_t end) override {
        const int shift = (static_cast<int>(pass) - 1) / 2 * kDigitBits;
        if (pass == 0)
            make(slots, begin, end);
        else if (pass == count() - 1)
            take_slots(begin, end);
        else if (pass % 2 == 1)
            count_digits(shift, begin, end);
        else
            move(shift, begin, end);
    }

  private:
    void make(const Slots& slots, std::size_t begin, std::size_t end) {
        for (std::size_t rank = begin; rank < end; ++rank) {
            const std::uint32_t slot = slots.slot_of(rank);
            from_[rank] = {distances_.largest - distances_.of(slots.places[slot]), slot};
        }
    }

    void take_slots(std::size_t begin, std::size_t end) {
        if (begin == 0) {
            to_.reset(); // so that both and the order are never there together
            order.resize(cells_);
        }
        std::ranges::transform(std::span(from_.get(), end).subspan(begin), order.begin() + begin,
                               &Entry::slot);
    }

    void count_digits(int shift, std::size_t begin, std::size_t end) {
        if (begin == 0)
            begin_ = {};
        for (std::size_t i = begin; i < end; ++i)
            ++begin_[digit(from_[i], shift)];
    }

    /// Stable, so that cells stay in the order of the lower digits.
    void move(int shift, std::size_t begin, std::size_t end) {
        if (begin == 0) {
            std::uint32_t sum = 0;
            for (std::uint32_t& count : begin_)
                sum += std::exchange(count, sum);
        }
        for (std::size_t i = begin; i < end; ++i)
            to_[begin_[digit(from_[i], shift)]++] = from_[i];
        if (end == cells_)
            from_.swap(to_);
    }

    const Distances distances_;
    const std::size_t cells_;
    std::size_t digits_ = 0;
    std::unique_ptr<Entry[]> from_, to_;
    std::array<std::uint32_t, 1 << kDigitBits> begin_{}; ///< counts, then places, by digit
};

std::unique_ptr<SortPasses> sort_passes(const Slots& slots, const TraversalKey& key) {
    Distances distance = distances(slots, key);
    const std::size_t cells = slots.places.size();
    if (distance.largest >> 32 == 0)
        return std::make_unique<PassesOf<Narrow>>(cells, std::move(distance));
    return std::make_unique<PassesOf<Wide>>(cells, std::move(distance));
}

} // namespace

TraversalKey traversal_key(const glm::vec4& eye, const glm::ivec3& cells,
                           const glm::vec3& spacing) {
    TraversalKey key;
    if (eye.w == 0.0f) {
        // Any direction in the same octant is right; this one keeps the eye's proportions.
        const glm::vec3 towards = glm::abs(glm::vec3(eye)) * spacing * spacing;
        for (int axis = 0; axis < 3; ++axis)
            key.reference[axis] = eye[axis] < 0.0f ? -1 : 1;
        key.reference.w = 0;
        key.weights = fixed_point(towards);
        return key;
    }
    key.weights = fixed_point(spacing * spacing);
    const glm::dvec3 middle = 0.5 * glm::dvec3(cells);
    glm::dvec3 from_middle = glm::dvec3(eye) - middle;
    const glm::dvec3 size = glm::abs(from_middle);
    const double farthest = std::max({size.x, size.y, size.z});
    glm::dvec3 excess(0.0);
    glm::dvec3 at = glm::dvec3(eye);
    for (int axis = 0; axis < 3; ++axis) {
        excess[axis] = beyond(at[axis], cells[axis]);
        if (excess[axis] != 0.0 && farthest > kFarthest)
            excess[axis] *= kFarthest / farthest;
        if (excess[axis] != 0.0)
            at[axis] = excess[axis] < 0.0 ? excess[axis] : cells[axis] + excess[axis];
    }
    const auto coarse =
        static_cast<std::uint64_t>(glm::length(excess) * kPartsOfCell / kSnapsPerRadian);
    const auto snap = static_cast<std::int64_t>(std::bit_floor(std::max<std::uint64_t>(coarse, 1)));
    for (int axis = 0; axis < 3; ++axis)
        key.reference[axis] = reference_along(at[axis], cells[axis], snap);
    return key;
}

BackToFrontSort::BackToFrontSort(const Slots& slots, const TraversalKey& key)
    : passes_(slots.places.empty() ? nullptr : sort_passes(slots, key)),
      cells_(slots.places.size()) {}

BackToFrontSort::BackToFrontSort(BackToFrontSort&&) noexcept = default;
BackToFrontSort& BackToFrontSort::operator=(BackToFrontSort&&) noexcept = default;
BackToFrontSort::~BackToFrontSort() = default;

std::size_t BackToFrontSort::work() const {
    return passes_ ? passes_->count() * cells_ : 0;
}

void BackToFrontSort::advance(const Slots& slots, std::size_t to) {
    for (to = std::min(to, work()); done_ < to;) {
        const std::size_t pass = done_ / cells_, first = done_ - pass * cells_;
        const std::size_t end = std::min(to - pass * cells_, cells_);
        passes_->run(slots, pass, first, end);
        done_ += end - first;
    }
}

std::vector<std::uint32_t> BackToFrontSort::take() {
    return passes_ ? std::move(passes_->order) : std::vector<std::uint32_t>();
}

void order_back_to_front(const Slots& slots, const TraversalKey& key,
                         std::vector<std::uint32_t>& order) {
    BackToFrontSort sort(slots, key);
    sort.advance(slots, sort.work());
    order = sort.take();
}

} // namespace isochron::render
