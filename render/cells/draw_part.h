// A part of the work of drawing, so that one picture can be drawn over several frames.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

namespace isochron::render {

/// Some of the things that are drawn one after the other; by default all of them.
struct DrawPart {
    std::size_t first = 0;
    std::size_t count = std::numeric_limits<std::size_t>::max();

    bool operator==(const DrawPart&) const = default;

    /// The overlap of this part with the things from `before` to `before + things`. Its `first` is
    /// counted from `before`; its count is 0 if there is no overlap.
    DrawPart among(std::size_t before, std::size_t things) const {
        const std::size_t most = std::numeric_limits<std::size_t>::max();
        const std::size_t end = count > most - first ? most : first + count;
        const std::size_t from = std::max(first, before), to = std::min(end, before + things);
        return from < to ? DrawPart{from - before, to - from} : DrawPart{0, 0};
    }
};

} // namespace isochron::render
