// Reads the steps of an index that refers to its sources instead of carrying a copy.
#pragma once

#include "index/file/sections/index_contents.h"

#include <memory>
#include <mutex>
#include <vector>

namespace isochron::index {

/// Decodes steps when they are needed and keeps the last few. Thread-safe: one thread decodes at a
/// time.
class StepSource {
  public:
    /// @param index path of the index; files of the referral are relative to its folder
    /// @param checksums of every step
    StepSource(std::filesystem::path index, const SeriesInfo& info, const Referral& referral,
               std::vector<std::uint64_t> checksums);

    /// @throws Error when a source is missing, cannot be read, or is not what was indexed
    LoadedStep load(std::uint32_t step);

  private:
    struct Decoded {
        std::uint32_t step;
        std::shared_ptr<std::uint64_t[]> words;
    };

    std::filesystem::path beside_index(const std::filesystem::path& file) const;
    void open_sources();
    /// Memory for a step: the memory of the oldest kept step if nobody else holds it, else new.
    std::shared_ptr<std::uint64_t[]> room_for_a_step();

    std::filesystem::path index_;
    const SeriesInfo& info_;
    const Referral& referral_;
    std::vector<std::uint64_t> checksums_;
    std::mutex mutex_;
    std::unique_ptr<VolumeSeries> series_; ///< opened when first needed
    std::vector<Decoded> kept_;            ///< the last used at the end
};

} // namespace isochron::index
