// The first steps of a series, as a series of its own.
#pragma once

#include "index/volume/volume_series.h"

#include <memory>
#include <utility>

namespace isochron::index {

/// For an index that is shown while the later steps are still to be read.
class FirstSteps final : public VolumeSeries {
  public:
    /// @param whole outlives this @param steps of it, at least 1 and no more than it has
    FirstSteps(VolumeSeries& whole, std::size_t steps);

    const SeriesInfo& info() const override { return info_; }
    void read(std::size_t step, std::span<std::byte> out) override { whole_->read(step, out); }
    void stream(std::size_t step, const TakePiece& take) override { whole_->stream(step, take); }
    std::unique_ptr<VolumeSeries> another() const override;
    std::uint64_t state(std::size_t step) const override { return whole_->state(step); }

  private:
    FirstSteps(std::unique_ptr<VolumeSeries> whole, SeriesInfo info)
        : owned_(std::move(whole)), whole_(owned_.get()), info_(std::move(info)) {}

    std::unique_ptr<VolumeSeries> owned_; ///< null: somebody else's
    VolumeSeries* whole_;
    SeriesInfo info_;
};

} // namespace isochron::index
