// Tests cells against the depths of what is drawn.
#include "render/culling/cells_in_sight.h"

#include <algorithm>

namespace isochron::render {

namespace {

/// Cells that are drawn before depths are read again, which takes about as long as drawing a tenth
/// of these.
constexpr std::size_t kUnread = 1 << 14;

} // namespace

CellsInSight::CellsInSight(const Gl& gl) : gl_(&gl), texels_(gl) {}

void CellsInSight::begin(const SightWanted& wanted, std::size_t first) {
    GLint framebuffer = 0;
    gl_->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    places_ = wanted.cells.slots().places;
    all_cells_ = wanted.all_cells;
    if (first > 0 && first == passed_ && version_ == wanted.cells.version() &&
        framebuffer_ == framebuffer && std::ranges::equal(views_, wanted.views) &&
        placement_ == wanted.placement && surfaces_ == wanted.surfaces)
        return;
    version_ = wanted.cells.version();
    framebuffer_ = framebuffer;
    if (placement_.rectilinear != wanted.placement.rectilinear)
        axes_ = wanted.placement.rectilinear ? axis_places(*wanted.placement.rectilinear)
                                             : std::array<AxisPlaces, 3>();
    placement_ = wanted.placement;
    surfaces_ = wanted.surfaces;
    passed_ = first;
    unread_ = first > 0 ? kUnread : 0;
    views_.assign(wanted.views.begin(), wanted.views.end());
    projections_.clear();
    for (const View& view : views_)
        projections_.emplace_back(view, placement_);
    depths_.resize(views_.size());
    for (std::size_t i = 0; i < views_.size(); ++i)
        depths_[i].clear(*gl_, views_[i]);
}

bool CellsInSight::is_in_sight(const CellPlace& place) const {
    constexpr unsigned kSurfaces = (1u << kColorShift) - 1;
    if (((surfaces_ >> (place.style & kSurfaces)) & 1) == 0)
        return false;
    if (all_cells_)
        return true;
    glm::vec3 half(0.5f), middle = glm::vec3(place.x, place.y, place.z) + half;
    if (placement_.rectilinear) {
        const auto along = [&](std::size_t axis, std::uint16_t cell) {
            half[static_cast<int>(axis)] = 0.5f * axes_[axis].side[cell];
            return axes_[axis].place[cell] + half[static_cast<int>(axis)];
        };
        middle = {along(0, place.x), along(1, place.y), along(2, place.z)};
    }
    for (std::size_t i = 0; i < projections_.size(); ++i)
        if (const auto bounds = projections_[i].bounds(middle, half);
            bounds && !depths_[i].hide(*bounds))
            return true;
    return false;
}

std::span<const std::uint32_t> CellsInSight::next(std::span<const std::uint32_t> back_to_front,
                                                  std::size_t most, double& effort) {
    if (unread_ >= kUnread) {
        for (std::size_t i = 0; i < views_.size(); ++i)
            depths_[i].read(*gl_, views_[i]);
        unread_ = 0;
    }
    found_.clear();
    const std::size_t cells = back_to_front.size(), room = std::min(most, kUnread - unread_);
    while (passed_ < cells && effort > 0 && found_.size() < room) {
        const std::uint32_t slot = back_to_front[cells - 1 - passed_++];
        const bool seen = is_in_sight(places_[slot]);
        effort -= seen ? 1.0 : kHidden;
        if (seen)
            found_.push_back(slot);
    }
    unread_ += found_.size();
    texels_.set(GL_R32UI, sizeof(found_[0]), std::as_bytes(std::span(found_)));
    return found_;
}

} // namespace isochron::render
