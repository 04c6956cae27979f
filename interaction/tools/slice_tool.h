// Slices: planes on which the values of the field are shown as colors.
#pragma once

#include "interaction/tools/plane_hold.h"

namespace isochron::interaction {

/// While no slice is seen, choosing a place lays one through the surface there, or through the
/// middle of the data, across the data's axis that is nearest to the ray. Otherwise hands hold the
/// slice that their ray meets first, or the picked one (`PlaneHold`).
class SliceTool final : public Tool {
  public:
    ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) override;
    bool takes_drag() const override { return hold_.pulls(); }

  private:
    PlaneHold hold_;
};

/// With one more slice, which is picked: through the middle of the data across an axis that has none
/// yet. As they are if there are kMostSlices.
Slices with_slice(Slices slices, const DataFrame& data);
/// Without the picked one.
Slices without_slice(Slices slices);
/// The picked slice turned across one of the data's axes, 0 to 2, about its point; the first slice if
/// there is none.
Slices snapped(Slices slices, int axis, const DataFrame& data);
/// `snapped` across the axis after the one that it lies across, or the first.
Slices snapped_next(const Slices& slices, const DataFrame& data);
/// The picked slice moved along its normal: across an axis to the next vertices of the grid, else as
/// far as takes it by a cell along the axis that it is most across. It stays within the data.
/// @param forward where the normal points to
Slices stepped(Slices slices, bool forward, const DataFrame& data);

/// Outlines, the picked one lighter.
ToolDrawing draw_slices(const Settings& settings, const DataFrame& data);

} // namespace isochron::interaction
