// Compares a moving picture with a settled one.
#include "tests/bench/motion/likeness.h"

#include "index/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace isochron::bench {
namespace {

constexpr int kBlock = 16; ///< pixels along each side

int most_off(const std::uint8_t* a, const std::uint8_t* b) {
    int most = 0;
    for (int channel = 0; channel < 3; ++channel)
        most = std::max(most, std::abs(int{a[channel]} - int{b[channel]}));
    return most;
}

/// Luminance of display values, 0 to 255.
double luminance(const std::uint8_t* color) {
    return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
}

void expect_same_size(const render::Image& a, const render::Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw index::Error("pictures of different sizes are compared");
}

/// `part` over `whole`; where there is no whole, 0 for no part, and else infinitely much.
double over(double part, double whole) {
    if (whole > 0)
        return part / whole;
    return part > 0 ? std::numeric_limits<double>::infinity() : 0;
}

double overlap_of(const PixelMask& a, const PixelMask& b) {
    std::size_t both = 0, any = 0;
    for (std::size_t i = 0; i < a.set.size(); ++i) {
        both += a.set[i] && b.set[i];
        any += a.set[i] || b.set[i];
    }
    return any > 0 ? static_cast<double>(both) / static_cast<double>(any) : 1;
}

/// What cells bring to the blocks of a picture.
struct Blocks {
    std::vector<double> lit, light;

    Blocks(const render::Image& picture, const render::Image& without, const PixelMask& mask) {
        const int across = (picture.width + kBlock - 1) / kBlock;
        const int down = (picture.height + kBlock - 1) / kBlock;
        lit.resize(static_cast<std::size_t>(across) * down);
        light.resize(lit.size());
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                if (!mask.at(x, y))
                    continue;
                const auto block = static_cast<std::size_t>(y / kBlock) * across + x / kBlock;
                lit[block] += 1;
                light[block] += luminance(picture.at(x, y)) - luminance(without.at(x, y));
            }
    }
};

double blocks_off(const std::vector<double>& moving, const std::vector<double>& settled) {
    double off = 0, all = 0;
    for (std::size_t i = 0; i < settled.size(); ++i) {
        off += std::abs(moving[i] - settled[i]);
        all += std::abs(settled[i]);
    }
    return over(off, all);
}

} // namespace

std::size_t PixelMask::count() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(set, [](std::uint8_t pixel) { return pixel != 0; }));
}

PixelMask lit_pixels(const render::Image& picture, const render::Image& without) {
    expect_same_size(picture, without);
    PixelMask mask{picture.width, picture.height, {}};
    mask.set.resize(picture.rgba.size() / 4);
    for (std::size_t i = 0; i < mask.set.size(); ++i)
        mask.set[i] = most_off(&picture.rgba[4 * i], &without.rgba[4 * i]) > kLitBy;
    return mask;
}

PixelMask widened(const PixelMask& mask) {
    PixelMask wide = mask;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            if (!mask.at(x, y))
                continue;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, mask.height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, mask.width - 1); ++u)
                    wide.set[static_cast<std::size_t>(v) * mask.width + u] = 1;
        }
    return wide;
}

double specks_in(const PixelMask& mask) {
    PixelMask left = mask; // pixels that belong to no group yet
    std::size_t all = 0, in_specks = 0;
    std::vector<std::array<int, 2>> waiting;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            if (!left.at(x, y))
                continue;
            std::size_t size = 0;
            const auto take = [&](int u, int v) {
                left.set[static_cast<std::size_t>(v) * mask.width + u] = 0;
                waiting.push_back({u, v});
                ++size;
            };
            take(x, y);
            while (!waiting.empty()) {
                const auto [a, b] = waiting.back();
                waiting.pop_back();
                for (int v = std::max(b - 1, 0); v <= std::min(b + 1, mask.height - 1); ++v)
                    for (int u = std::max(a - 1, 0); u <= std::min(a + 1, mask.width - 1); ++u)
                        if (left.at(u, v))
                            take(u, v);
            }
            all += size;
            in_specks += size < kSpeck ? size : 0;
        }
    return all > 0 ? static_cast<double>(in_specks) / static_cast<double>(all) : 0;
}

bool is_recognizable(const Likeness& like) {
    constexpr double kLitOff = 0.1, kOverlap = 0.85, kBlocksOff = 0.15;
    if (is_of_specks(like))
        return like.block_lit_off <= kBlocksOff && like.block_light_off <= kBlocksOff;
    return std::abs(like.lit - 1) <= kLitOff && like.overlap >= kOverlap;
}

Likeness likeness(const render::Image& moving, const render::Image& settled,
                  const render::Image& without) {
    expect_same_size(moving, settled);
    const PixelMask mask = lit_pixels(moving, without), wanted = lit_pixels(settled, without);
    Likeness like;
    const auto lit = static_cast<double>(mask.count()), all = static_cast<double>(wanted.count());
    like.lit = lit == all ? 1 : over(lit, all);
    like.overlap = overlap_of(widened(mask), widened(wanted));
    double off = 0, sum = 0, wanted_sum = 0;
    std::size_t pixels_off = 0;
    for (std::size_t i = 0; i < mask.set.size(); ++i) {
        const std::uint8_t *a = &moving.rgba[4 * i], *b = &settled.rgba[4 * i];
        pixels_off += most_off(a, b) > kLitBy;
        if (!mask.set[i] || !wanted.set[i])
            continue;
        off += std::abs(luminance(a) - luminance(b));
        sum += luminance(a);
        wanted_sum += luminance(b);
    }
    like.luminance_off = over(off, wanted_sum);
    like.luminance_shift = over(std::abs(sum - wanted_sum), wanted_sum);
    const Blocks blocks(moving, without, mask), wanted_blocks(settled, without, wanted);
    like.block_lit_off = blocks_off(blocks.lit, wanted_blocks.lit);
    like.block_light_off = blocks_off(blocks.light, wanted_blocks.light);
    like.specks = specks_in(wanted);
    like.pixels_off = mask.set.empty()
                          ? 0
                          : static_cast<double>(pixels_off) / static_cast<double>(mask.set.size());
    return like;
}

} // namespace isochron::bench
