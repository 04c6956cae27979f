// What can be taken back: the states that a session was in.
//
//     history.add(before, after, commands, input);   // once a frame
//     if (const auto* back = history.undo())         // what pressing undo leads to
//         interaction::merge(commands, *back);
#pragma once

#include "app/frame/explorer_state.h"
#include "interaction/tracked_input.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace isochron::app {

/// A pure function of the frames that it is told, so that a replay undoes as the session did.
///
/// Changes of the same settings that follow one another closely, or while a button is held, are one
/// step where drags make them. The steps in time that playing goes through are none.
class History {
  public:
    static constexpr std::size_t kMost = 200; ///< steps; the oldest go

    /// One frame. @param commands that led from `before` to `after`
    void add(const ExplorerState& before, const ExplorerState& after,
             const interaction::Commands& commands, const interaction::InputState& input);

    /// Commands that take the newest change back, or bring it back; null where there is none.
    const interaction::Commands* undo() const { return undo_ ? &*undo_ : nullptr; }
    const interaction::Commands* redo() const { return redo_ ? &*redo_ : nullptr; }
    /// Something has changed since the session began.
    bool has_changes() const { return !past_.empty(); }

  private:
    ExplorerState as_seen(ExplorerState before, const interaction::InputState& input) const;
    void add_change(const ExplorerState& before, const ExplorerState& after,
                    const interaction::InputState& input);
    bool continues(std::uint64_t fields, const interaction::InputState& input) const;

    std::deque<ExplorerState> past_;
    std::vector<ExplorerState> future_;
    std::optional<interaction::Commands> undo_, redo_;
    std::uint64_t fields_ = 0; ///< of the newest change, a bit each; 0: it is complete
    interaction::Seconds changed_{0};
    bool held_ = false;                     ///< some button, in every frame since
    std::optional<interaction::Pose> head_; ///< in the frame before
};

} // namespace isochron::app
