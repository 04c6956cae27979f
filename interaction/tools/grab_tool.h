// The grab tool: one hand, or two, hold the volume.
#pragma once

#include "interaction/navigation/navigation.h"
#include "interaction/tools/tool.h"

namespace isochron::interaction {

/// Works like a clutch: while the buttons of one or two hands are down, the volume keeps its place
/// relative to them. Two hands also scale it.
class GrabTool final : public Tool {
  public:
    ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) override;

  private:
    struct Grab {
        Pose hand;
        std::optional<Span> span;    ///< between two hands, when the grab began
        std::optional<Span> newest;  ///< between them in the last frame
        glm::dquat turn{1, 0, 0, 0}; ///< turn of the span since the grab began
        Similarity held;             ///< the volume when the grab began
        Similarity result;           ///< the last result; differs if anything else moved the volume
    };
    Similarity held(const Pose& first, const std::optional<Span>& both, const ToolContext& now);

    std::optional<Grab> grab_;
};

} // namespace isochron::interaction
