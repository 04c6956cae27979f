// How like a moving picture is to the settled picture of the same view and instant.
#pragma once

#include "render/gl/image.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::bench {

/// Pixels of a picture, true or false, row after row.
struct PixelMask {
    int width = 0, height = 0;
    std::vector<std::uint8_t> set;

    bool at(int x, int y) const { return set[static_cast<std::size_t>(y) * width + x] != 0; }
    std::size_t count() const;
};

/// A pixel is lit when a channel of its color differs by more than this from the view without
/// cells.
constexpr int kLitBy = 8;

/// The pixels that cells light. @param without the same view without cells
PixelMask lit_pixels(const render::Image& picture, const render::Image& without);
/// A mask and the eight neighbors of each of its pixels.
PixelMask widened(const PixelMask& mask);
/// The share of the set pixels that belong to groups of fewer than `kSpeck` pixels, which touch by
/// their sides or corners; 0 to 1.
double specks_in(const PixelMask& mask);
constexpr std::size_t kSpeck = 4;

struct Likeness {
    double lit = 1;             ///< lit pixels over those of the settled picture
    double overlap = 1;         ///< IoU of both masks, widened by a pixel
    double luminance_off = 0;   ///< mean difference where both are lit, over the mean there
    double luminance_shift = 0; ///< difference of the means there, over the settled mean
    /// Sums of the differences in blocks of 16 x 16 pixels, over the settled picture's sum: of lit
    /// pixels, and of the light that cells bring.
    double block_lit_off = 0, block_light_off = 0;
    double specks = 0;     ///< specks of the settled picture, see `specks_in`
    double pixels_off = 0; ///< share of all pixels with a channel that differs by more than kLitBy
};

/// Whether the picture consists of specks, of which no overlap tells anything: blocks do.
inline bool is_of_specks(const Likeness& like) {
    return like.specks > 0.5;
}
/// Whether somebody sees the same things in both pictures.
bool is_recognizable(const Likeness& like);

/// @param without the same view without cells; all three of one size
Likeness likeness(const render::Image& moving, const render::Image& settled,
                  const render::Image& without);

} // namespace isochron::bench
