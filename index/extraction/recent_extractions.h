// Keeps finished extractions, for stepping back and for the next steps of a playback.
#pragma once

#include "index/extraction/extraction.h"

#include <cstdint>
#include <list>
#include <optional>
#include <unordered_map>
#include <vector>

namespace isochron::index {

/// Whether two queries are the same except for the step. Isovalues are compared bitwise, so that a
/// NaN equals itself; otherwise a repeated query with a NaN would count as a new one.
bool same_but_for_step(const SurfacesQuery& a, const SurfacesQuery& b);

/// The next steps of a playback, in order, each once.
struct StepsAhead {
    std::uint32_t next = 0; ///< the first of them, counted among the steps that are played
    /// Number of steps that are played, in which playback loops; 0: `next` only.
    std::uint32_t steps = 0;
    bool reverse = false;
    bool to_and_fro =
        false; ///< playback turns at both ends instead; the step before `next` is shown
    /// Steps of the series that are played: from `first` on, every so manieth.
    std::uint32_t first = 0, every = 1;
    bool operator==(const StepsAhead&) const = default;

    std::uint32_t count() const { return steps == 0 ? 1 : steps - 1; }
    /// @param i below `count()`
    std::uint32_t at(std::uint32_t i) const { return first + every * place(i); }

  private:
    std::uint32_t place(std::uint32_t i) const {
        if (steps == 0)
            return next;
        if (!to_and_fro)
            return (next + (reverse ? steps - i : i)) % steps;
        const std::uint32_t to_end = reverse ? next + 1 : steps - next;
        if (i < to_end)
            return reverse ? next - i : next + i;
        return reverse ? next + 2 + (i - to_end) : next - 2 - (i - to_end);
    }
};

/// Keeps the newest few extractions, and as many other steps of the newest one's surfaces as fit
/// the budget.
class RecentExtractions {
  public:
    explicit RecentExtractions(std::uint64_t budget) : budget_(budget) {}

    ExtractionPtr find(const SurfacesQuery& query) const;
    /// The first step ahead that is not kept and for which there is room.
    /// @param query whose surfaces are wanted; its step is ignored
    std::optional<std::uint32_t> missing(const SurfacesQuery& query, const StepsAhead& ahead) const;
    /// The kept steps for these surfaces, ascending.
    std::vector<std::uint32_t> steps(const SurfacesQuery& query) const;

    using Dropped = std::vector<ExtractionPtr>;
    /// Adds an extraction and drops others to fit the budget. @param ahead steps to drop last
    /// @return the dropped extractions, which the caller should free where nobody waits
    Dropped add(ExtractionPtr extraction, const std::optional<StepsAhead>& ahead);
    /// Meshes of a kept extraction have come later: counts them, too.
    Dropped count_again(const ExtractionPtr& extraction, const std::optional<StepsAhead>& ahead);
    Dropped take_all();

  private:
    struct Kept {
        ExtractionPtr extraction;
        std::uint64_t bytes;
    };
    using Place = std::list<Kept>::iterator;

    Place victim(const std::optional<StepsAhead>& ahead);
    void drop(Place place, Dropped& dropped);
    void drop_to_fit(const std::optional<StepsAhead>& ahead, Dropped& dropped);

    std::uint64_t budget_, bytes_ = 0;
    std::uint64_t largest_ = 0; ///< [bytes] of extractions for the newest one's surfaces
    std::list<Kept> kept_;      ///< newest first
    /// The extractions for the newest one's surfaces, by Instant::number.
    std::unordered_map<std::uint64_t, Place> by_step_;
};

} // namespace isochron::index
