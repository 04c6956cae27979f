// What the values of one step are like: their range, their histogram, and how many cells are active
// at each isovalue.
#pragma once

#include "index/volume/step_values.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace isochron::app {

struct StepSurvey {
    static constexpr std::size_t kBins = 256;

    /// All values of the step were surveyed; false: those of a coarser level of detail, whose range is
    /// a little narrower.
    bool whole = false;
    /// Range of the finite scaled values; `low` is above `high` if there are none.
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::vector<std::uint64_t> histogram; ///< counts in kBins equal bins over the range
    std::vector<std::uint64_t> cells;     ///< active cells at the middle of each bin
    /// The nearest other step that has different values; looked for only where this step has none.
    std::optional<std::uint32_t> other_step = {};

    bool has_values() const { return low <= high; }
    bool is_constant() const { return low == high; }
    double middle_of(std::size_t bin) const;
    std::size_t bin_of(double value) const; ///< value within the range
    /// Active cells at an isovalue, to within a bin; 0 outside the range.
    std::uint64_t cells_at(double isovalue) const;
};

/// Surveys one step. @param whole see `StepSurvey::whole`
StepSurvey survey_of(const index::StepValues& values, std::size_t step, bool whole);

/// An isovalue with a surface in this step, written with few digits: at a share of the values if
/// there are active cells, else where most cells are active. Empty: no isovalue has a surface.
std::optional<double> surface_in(const StepSurvey& step, double share);

/// The active cells of a further surface, as shares of those of the first one.
inline constexpr double kFewestOfFirst = 0.1, kMostOfFirst = 0.6;

/// The isovalue of a further surface: one whose active cells in this step are kFewestOfFirst to
/// kMostOfFirst of the first one's, if there is any, and that no other surface is near. Empty: no
/// other isovalue has a surface.
/// @param there isovalues of all surfaces, the first one included
std::optional<double> further_isovalue(const StepSurvey& step, double first,
                                       std::span<const double> there);

} // namespace isochron::app
