// Undo and redo: the states that a session was in.
//
//     history.add(before, after, commands, input);   // once a frame
//     if (const auto* back = history.undo())         // what pressing undo leads to
//         interaction::merge(commands, *back);
#pragma once

#include "app/frame/explorer_state.h"
#include "interaction/input/tracked_input.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// What differs between two states, in words: `isovalue 9.4 to 7.2`, `view, clip plane`. Empty: no
/// setting that can be undone differs.
std::string words_for_change(const ExplorerState& before, const ExplorerState& after);
/// What commands would change. @param way null: nothing @param held number of steps of the index
std::string words_for_way(const ExplorerState& now, const interaction::Commands* way,
                          std::size_t held);

/// Depends only on the frames that are added, so a replay undoes as the session did.
///
/// A drag is one change: changes of the same settings by dragging count together if they follow one
/// another closely or a button stays pressed. Time steps while playing do not count.
class History {
  public:
    static constexpr std::size_t kMost =
        200; ///< changes that can be undone; older ones are dropped

    /// Adds one frame. @param commands led from `before` to `after`
    void add(const ExplorerState& before, const ExplorerState& after,
             const interaction::Commands& commands, const interaction::InputState& input);

    /// Commands that undo the newest change, or redo the last undone one; null if there is none.
    const interaction::Commands* undo() const { return undo_ ? &*undo_ : nullptr; }
    const interaction::Commands* redo() const { return redo_ ? &*redo_ : nullptr; }
    /// Whether there is a change to undo.
    bool has_changes() const { return !past_.empty(); }

  private:
    ExplorerState as_seen(ExplorerState before, const interaction::InputState& input) const;
    void adopt(const ExplorerState& before, const ExplorerState& after);
    void add_change(const ExplorerState& before, const ExplorerState& after,
                    const interaction::InputState& input);
    bool continues(std::uint64_t fields, const interaction::InputState& input) const;

    std::deque<ExplorerState> past_;
    std::vector<ExplorerState> future_;
    std::optional<interaction::Commands> undo_, redo_;
    std::uint64_t fields_ = 0; ///< settings of the newest change, one bit each; 0: it is complete
    interaction::Seconds changed_{0};
    bool held_ = false;                     ///< a button was pressed in every frame since
    std::optional<interaction::Pose> head_; ///< in the previous frame
};

} // namespace isochron::app
