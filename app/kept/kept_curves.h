// Curves that are whole, kept as files in the user's cache folder.
#pragma once

#include "app/frame/step_curve.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace isochron::app {

/// A file is named by a hash of what it holds: the content of the index, the surface, and the
/// definitions of the measures. It holds that in words, too, and a checksum: a file that is damaged,
/// or of something else, is as good as none. Files that cannot be read or written are no error.
class KeptCurves {
  public:
    static constexpr std::size_t kMostFiles = 256;
    static constexpr std::uint64_t kMostBytes = 64 << 20; ///< all files together

    /// @param folder made where it is missing; other files in it stay
    explicit KeptCurves(std::filesystem::path folder, std::size_t most_files = kMostFiles,
                        std::uint64_t most_bytes = kMostBytes);

    /// The whole curve, if it is there.
    std::optional<StepCurve> read(const CurveSubject& subject) const;
    /// Those that were not used for the longest time go where there are too many.
    /// @param curve all steps are known
    void write(const StepCurve& curve) const;
    std::filesystem::path path_of(const CurveSubject& subject) const;

  private:
    std::filesystem::path folder_;
    std::size_t most_files_;
    std::uint64_t most_bytes_;
};

} // namespace isochron::app
