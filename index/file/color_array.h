// The second array of a series, which surfaces may be colored by, and its section of the file.
#pragma once

#include "index/file/index_contents.h"
#include "index/file/step_source.h"

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace isochron::index {

/// The section: an XXH3-64 checksum for every step, padded to 64 bytes, and then, unless the file
/// refers to its sources, the stored values step after step, as in the volume section. An index
/// without colors has no such section. Thread-safe; the bytes outlive this.
class ColorSection {
  public:
    /// @param index path of the file, for referrals  @param volume whose grid and times these are
    /// @throws Error when the section is not as long as it must be
    ColorSection(std::span<const std::byte> section, const std::filesystem::path& index,
                 const SeriesInfo& volume, const ColorArray& array,
                 const std::optional<Referral>& referral);

    /// One step. @throws Error as `IndexFile::load` does
    LoadedStep load(std::uint32_t step) const;

    /// @return false when a checksum does not match
    bool matches(std::uint32_t step) const;

    /// Offset and length of everything but padding.
    std::vector<std::pair<std::uint64_t, std::uint64_t>> parts() const;

    /// Bytes of the checksums and of all steps' values.
    static std::uint64_t table_bytes(std::size_t steps);
    static std::uint64_t bytes(const SeriesInfo& volume, ValueType type, bool with_values);

  private:
    std::span<const std::uint64_t> checksums() const;

    std::span<const std::byte> section_;
    SeriesInfo info_; ///< of the second array itself
    std::optional<Referral> referral_;
    std::unique_ptr<StepSource> source_;
};

} // namespace isochron::index
