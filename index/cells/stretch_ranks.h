// The extremes of a stretch's cells at consecutive steps, as ranks, from which cells and deltas are
// built.
#pragma once

#include "index/volume/level_map.h"
#include "index/volume/step_values.h"
#include "index/volume/stretches.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Reads the vertices of a stretch once for each step. Keeps its work space: one for each thread.
class StretchRanks {
  public:
    StretchRanks(const StepValues& values, const LevelMap& levels);

    /// This many ranks after the last can be read too; they have no meaning.
    static constexpr std::size_t kSlack = 63;

    /// Extremes of each cell of a stretch at one step, in id order; low 1 and high 0 if a vertex is
    /// NaN.
    struct Extremes {
        std::span<const std::uint8_t> low, high;
    };

    /// Computes the extremes of a stretch at the steps `first` to `first + count - 1`.
    void compute(std::uint32_t stretch, std::uint32_t first, std::uint32_t count);

    std::uint32_t steps() const { return steps_; }
    std::uint32_t cells() const { return cells_; }
    /// @param step counted from the first one computed
    Extremes at(std::uint32_t step) const {
        const std::size_t begin = std::size_t{step} * cells_;
        return {{low_.data() + begin, cells_}, {high_.data() + begin, cells_}};
    }

  private:
    struct Vertices;

    const std::uint8_t* ranks_of(std::span<const std::byte> stored);
    bool find_nan(std::span<const std::byte> stored);
    void reduce_columns(const std::uint8_t* ranks, std::size_t count);
    void mark_nan(const Vertices& vertices, std::uint8_t* low, std::uint8_t* high);

    StepValues values_;
    const LevelMap& levels_;
    Stretches stretches_;
    bool identity_; ///< the stored bytes are the ranks
    std::uint32_t steps_ = 0, cells_ = 0;
    std::vector<std::uint8_t> low_, high_;                       ///< [step][cell]
    std::vector<std::uint8_t> ranks_, square_low_, square_high_; ///< [vertex of the vertices]
};

} // namespace isochron::index
