// The binary part of a GLB file.
#include "index/export/glb_views.h"

#include <cstring>
#include <utility>

namespace isochron::index {
namespace {

// Targets in the glTF specification.
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

} // namespace

std::uint64_t GlbViews::begin() {
    out_.align(4);
    return out_.size();
}

std::size_t GlbViews::push(Json view) {
    views_.push_back(std::move(view));
    return views_.size() - 1;
}

std::size_t GlbViews::end_plain(std::uint64_t begin) {
    return push({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", out_.size() - begin}});
}

std::size_t GlbViews::end_vertices(std::uint64_t begin, std::uint64_t stride) {
    const std::size_t number =
        packing_ ? end_packed(begin, stride, "ATTRIBUTES", packing_->vertices(view_, stride))
                 : end_plain(begin);
    views_[number]["target"] = kArrayBuffer;
    views_[number]["byteStride"] = stride;
    return number;
}

std::size_t GlbViews::end_triangles(std::uint64_t begin, std::size_t vertices) {
    std::size_t number = 0;
    if (packing_) {
        std::vector<std::uint32_t> corners(view_.size() / sizeof(std::uint32_t));
        std::memcpy(corners.data(), view_.data(), view_.size());
        number = end_packed(begin, sizeof(std::uint32_t), "TRIANGLES",
                            packing_->triangles(corners, vertices));
    } else {
        number = end_plain(begin);
    }
    views_[number]["target"] = kElementArrayBuffer;
    return number;
}

std::size_t GlbViews::end_packed(std::uint64_t begin, std::uint64_t stride, const char* mode,
                                 const std::vector<std::byte>& bytes) {
    out_.bytes(bytes);
    Json view{{"buffer", 1}, {"byteOffset", unpacked_}, {"byteLength", view_.size()}};
    view["extensions"][kPacked] = {
        {"buffer", 0},          {"byteOffset", begin}, {"byteLength", bytes.size()},
        {"byteStride", stride}, {"mode", mode},        {"count", view_.size() / stride}};
    unpacked_ += (view_.size() + 3) / 4 * 4;
    view_.clear();
    return push(std::move(view));
}

void GlbViews::complete() {
    out_.align(4);
    out_.flush();
}

GlbViews::Json GlbViews::buffers() const {
    Json buffers = Json::array();
    if (size() > 0)
        buffers.push_back({{"byteLength", size()}});
    if (unpacked_ > 0) // readers make it
        buffers.push_back(
            {{"byteLength", unpacked_}, {"extensions", {{kPacked, {{"fallback", true}}}}}});
    return buffers;
}

} // namespace isochron::index
