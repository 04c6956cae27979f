// In how many pixels the cells of a picture may be drawn.
#pragma once

#include <array>

namespace isochron::app {

/// Shares of a view's width and height; the picture of the cells is made as large as the view, and
/// what lies over them is drawn in all pixels.
inline constexpr std::array<float, 4> kCellResolutions{1.0f, 0.71f, 0.5f, 0.35f};

} // namespace isochron::app
