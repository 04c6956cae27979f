// The surfaces of other instants that a session shows as ghosts, made beside the frames.
#pragma once

#include "app/choice/frame.h"
#include "app/choice/surfaces_asker.h"
#include "index/extraction/instant_surfaces.h"
#include "index/file/index_file.h"
#include "interaction/step_gaps.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// The instants of the ghosts, the nearest first, within the range that plays: those that the series
/// does not have are left out. Between two steps ghosts are as far between two steps; where there is a
/// gap behind a step, the step is held.
/// @param steps known ones
std::vector<index::Instant> ghost_instants(const interaction::Ghosts& ghosts, index::Instant shown,
                                           const interaction::StepRange& range, std::size_t steps,
                                           const interaction::StepGaps& gaps);

/// `ghosts of steps 3, 5 and 9`, as people count; empty without any.
std::string ghost_words(std::span<const index::Instant> instants);

/// One ghost is made at a time, and the next one is chosen by what is wished then. What was made is
/// kept while it may serve again, as when time plays. A ghost that is not there yet is stood in for by
/// one near to it, which is shown as what it is.
class GhostSupply {
  public:
    /// Triangles of all ghosts together: a GPU draws so many in a moment, and a processor sorts them.
    static constexpr std::uint64_t kMostTriangles = 1 << 18;

    explicit GhostSupply(std::shared_ptr<const index::IndexFile> file);

    /// Continues with the same data that have more steps.
    void set_file(std::shared_ptr<const index::IndexFile> file) { file_ = std::move(file); }
    /// Sets the function that is called, on the making thread, when a ghost has been made.
    void set_wake(std::function<void()> wake) { making_.set_wake(std::move(wake)); }

    /// Called once a frame. Never waits in a live session; a replay waits for what it asks for.
    void update(const Frame& frame, const interaction::StepGaps& gaps);
    /// By time.
    const std::vector<index::InstantSurfacesPtr>& shown() const { return shown_; }
    /// The instants that are wished, by time.
    const std::vector<index::Instant>& wished() const { return wished_; }
    /// Whether ghosts are still to be made.
    bool come() const { return come_; }
    /// What is shown, and what is not yet; empty if none are wished.
    std::string words() const;
    /// Why ghosts could not be made; taken by the call.
    std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }
    /// Ghosts that were made so far.
    std::uint64_t made() const { return made_; }

  private:
    void take();
    void drop_all();
    std::optional<index::SurfacesQuery> next(std::span<const index::SurfacesQuery> queries) const;
    index::InstantSurfacesPtr at_hand(const index::SurfacesQuery& query) const;
    index::InstantSurfacesPtr stand_in(index::Instant wished, index::Instant now,
                                       std::uint32_t within) const;
    void choose(std::span<const index::SurfacesQuery> queries, index::Instant now,
                std::uint32_t every);

    std::shared_ptr<const index::IndexFile> file_;
    std::vector<index::InstantSurfacesPtr> kept_, shown_; ///< `kept_`: all of the same isovalues
    std::vector<index::SurfacesQuery> failed_;
    std::vector<index::Instant> wished_;
    std::uint64_t most_ = 0; ///< triangles of a ghost
    std::uint64_t made_ = 0;
    bool makes_ = false, come_ = false;
    std::vector<std::string> messages_;
    SurfacesAsker making_;
};

/// The ghosts of a picture: colored as their surfaces are, earlier ones bluer, later ones warmer.
/// @param made as `GhostSupply::shown` @param now instant of the surfaces
std::vector<ShownGhost> shown_ghosts(const std::vector<index::InstantSurfacesPtr>& made,
                                     const ExplorerState& state, index::Instant now);

} // namespace isochron::app
