// Finished extractions that are kept: for stepping back, and steps that a playback comes to.
#pragma once

#include "index/extraction/extraction.h"

#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <unordered_map>
#include <vector>

namespace isochron::index {

/// Whether two queries ask for the same but for the step. Isovalues are compared bitwise, so that a
/// NaN equals itself: otherwise asking for one again would be something new.
bool same_but_for_step(const SurfacesQuery& a, const SurfacesQuery& b);

/// The steps that a playback comes to, in their order.
struct StepsAhead {
    std::uint32_t next = 0;  ///< the first of them
    std::uint32_t steps = 0; ///< of the series, which goes round; 0: `next` alone
    bool reverse = false;
    bool operator==(const StepsAhead&) const = default;

    std::uint32_t count() const { return steps == 0 ? 1 : steps - 1; }
    /// @param i below `count()`
    std::uint32_t at(std::uint32_t i) const {
        return steps == 0 ? next : (next + (reverse ? steps - i : i)) % steps;
    }
};

/// The newest few, and as many as a number of bytes allows of those that ask for the same surfaces
/// as the newest one.
class RecentExtractions {
  public:
    explicit RecentExtractions(std::uint64_t budget) : budget_(budget) {}

    ExtractionPtr find(const SurfacesQuery& query) const;
    /// The first step ahead that is not at hand and for which there is room.
    /// @param query for any step
    std::optional<std::uint32_t> missing(const SurfacesQuery& query, const StepsAhead& ahead) const;
    /// Steps that are at hand for these surfaces, ascending.
    std::vector<std::uint32_t> steps(const SurfacesQuery& query) const;

    using Dropped = std::vector<ExtractionPtr>;
    /// @param ahead these steps go last
    /// @return what had to go, for the caller to free where that does not hold anybody up
    Dropped add(ExtractionPtr extraction, const std::optional<StepsAhead>& ahead);
    Dropped take_all();

  private:
    struct Kept {
        ExtractionPtr extraction;
        std::uint64_t bytes;
    };
    using Place = std::list<Kept>::iterator;

    Place victim(const std::optional<StepsAhead>& ahead);
    void drop(Place place, Dropped& dropped);

    std::uint64_t budget_, bytes_ = 0;
    std::uint64_t largest_ = 0; ///< of those for the same surfaces as the newest one
    std::list<Kept> kept_;      ///< newest first
    /// Of those for the same surfaces as the newest one.
    std::unordered_map<std::uint32_t, Place> by_step_;
};

} // namespace isochron::index
