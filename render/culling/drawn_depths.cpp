// Reads depths back and reduces them to tiles.
#include "render/culling/drawn_depths.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isochron::render {

void DrawnDepths::clear(const Gl& gl, const View& view) {
    size_ = view.size;
    GLint samples = 0;
    gl.GetIntegerv(GL_SAMPLES, &samples); // samples of the target
    one_sample_ = samples <= 1;
    largest_.clear();
}

void DrawnDepths::read(const Gl& gl, const View& view) {
    if (!one_sample_)
        return; // cannot be read
    GLint framebuffer = 0;
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(framebuffer));
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    const auto width = static_cast<std::size_t>(view.size.x);
    depths_.resize(width * static_cast<std::size_t>(view.size.y));
    gl.ReadPixels(view.corner.x, view.corner.y, view.size.x, view.size.y, GL_DEPTH_COMPONENT,
                  GL_FLOAT, depths_.data());
    columns_ = ((view.size.x - 1) >> kBits) + 1;
    rows_ = ((view.size.y - 1) >> kBits) + 1;
    largest_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0f);
    for (int y = 0; y < view.size.y; ++y) {
        const float* const pixels = depths_.data() + static_cast<std::size_t>(y) * width;
        float* const tiles = largest_.data() + static_cast<std::size_t>(y >> kBits) *
                                                   static_cast<std::size_t>(columns_);
        for (int x = 0; x < view.size.x; ++x)
            tiles[x >> kBits] = std::max(tiles[x >> kBits], pixels[x]);
    }
}

bool DrawnDepths::hide(const BoxBounds& bounds) const {
    // With one sample a pixel, in its middle, only cells over the middles of pixels are drawn.
    const float beside = one_sample_ ? 0.5f : 0.0f;
    const auto first = [beside](float pixel) {
        return static_cast<int>(std::ceil(std::max(pixel, 0.0f) - beside));
    };
    const auto last = [beside](float pixel, int size) {
        return static_cast<int>(std::floor(std::min(pixel, static_cast<float>(size)) - beside));
    };
    const int left = first(bounds.low.x), right = last(bounds.high.x, size_.x);
    const int low = first(bounds.low.y), high = last(bounds.high.y, size_.y);
    if (one_sample_ && (left > right || low > high))
        return true;
    if (largest_.empty())
        return false;
    for (int y = low >> kBits; y <= high >> kBits; ++y) {
        const float* const row = largest_.data() + static_cast<std::ptrdiff_t>(y) * columns_;
        for (int x = left >> kBits; x <= right >> kBits; ++x)
            if (row[x] >= bounds.nearest)
                return false;
    }
    return true;
}

} // namespace isochron::render
