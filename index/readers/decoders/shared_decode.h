// What a library has decoded of a file, shared by the arrays of it that are open.
#pragma once

#include "index/system/input_file.h"
#include "index/volume/volume_series.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

namespace isochron::index {

/// Remembers the newest thing that was decoded as long as somebody holds it. Not thread-safe.
template <class Decoded>
class SharedDecode {
  public:
    /// The decoded thing. `make` is called if the last one was dropped, or was made differently.
    template <class Make>
    std::shared_ptr<Decoded> of(const std::filesystem::path& path, const ReadOptions& options,
                                const Make& make) {
        const Made wanted{path, state_of(path), options.resample, options.spacing.has_value()};
        auto known = made_ == wanted ? decoded_.lock() : nullptr;
        if (!known) {
            known = make();
            decoded_ = known;
            made_ = wanted;
        }
        return known;
    }

  private:
    /// What the decoded thing was made of, and how; which array the options choose does not matter.
    struct Made {
        std::filesystem::path path;
        FileState state;
        std::optional<std::array<std::uint32_t, 3>> resample;
        bool spacing = false; ///< given by the options, so not needed from the file
        bool operator==(const Made&) const = default;
    };
    Made made_;
    std::weak_ptr<Decoded> decoded_;
};

} // namespace isochron::index
