// The volume in one hand, or between two.
#pragma once

#include "interaction/navigation.h"
#include "interaction/tool.h"

namespace isochron::interaction {

/// The clutch: the volume follows one hand, or two, as it lay when they closed around it.
class GrabTool final : public Tool {
  public:
    ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) override;

  private:
    struct Grab {
        Pose hand;
        std::optional<Span> span;    ///< between two hands, when they closed
        std::optional<Span> newest;  ///< and in the last frame
        glm::dquat turn{1, 0, 0, 0}; ///< of the span since
        Similarity held;
        Similarity result; ///< what it led to; anything else moved the volume meanwhile
    };
    Similarity held(const Pose& first, const std::optional<Span>& both, const ToolContext& now);

    std::optional<Grab> grab_;
};

} // namespace isochron::interaction
