// Median, 99th percentile and largest of times: exactly for a list of times, and within one percent
// for any number of times that are only counted.
#pragma once

#include <cstdint>
#include <vector>

namespace isochron::app {

/// Median, 99th percentile and largest of some times.
struct TimeSummary {
    double median = 0, p99 = 0, worst = 0; ///< milliseconds
};
TimeSummary summarize(std::vector<double> milliseconds);

/// Counts times in bins that are one percent wide, from a microsecond to a quarter of an hour: any
/// number of times takes 16 KiB.
class TimeTally {
  public:
    void add(double milliseconds);
    /// The largest time is exact, the others are so within one percent.
    TimeSummary summary() const;

  private:
    std::vector<std::uint64_t> counts_; ///< by bin; empty before the first time
    std::uint64_t all_ = 0;
    double worst_ = 0;
};

} // namespace isochron::app
