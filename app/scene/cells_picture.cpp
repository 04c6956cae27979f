// The picture of the cells, kept apart from what is drawn over it.
#include "app/scene/cells_picture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>
#include <limits>

namespace isochron::app {
namespace {

/// Whether cells hide by their depth what is drawn after them.
bool hides_by_depth(const Picture& picture) {
    return !picture.surfaces || (picture.footprint != render::Footprint::gaussian &&
                                 !interaction::any_is(picture.isosurfaces, true));
}

/// The picture without what is drawn over cells.
Picture without_lines(Picture picture) {
    picture.mark = {};
    picture.marks.clear();
    picture.pointed.reset();
    picture.tools = {};
    picture.guides = {};
    picture.veil = {};
    picture.values = {};
    picture.ghosts.clear();
    std::erase_if(picture.further, [](const ShownFurther& each) { return each.look.opacity < 1; });
    picture.bounding_box = false;
    picture.orientation = false;
    picture.caption.clear();
    picture.audience.wand.reset();
    picture.audience.panel.reset();
    picture.audience.aids = false;
    return picture;
}

glm::ivec2 size_of(std::span<const render::View> views) {
    glm::ivec2 size(1);
    for (const render::View& view : views)
        size = glm::max(size, view.corner + view.size);
    return size;
}

int samples_of_bound(const render::Gl& gl) {
    GLint samples = 0;
    gl.GetIntegerv(GL_SAMPLES, &samples);
    return std::max(samples, 1);
}

bool same_kind(const render::View& a, const render::View& b) {
    return a.is_parallel() == b.is_parallel(); // a panel beside them may have changed their size
}

/// How different the screens of two views are. Eyes move little beside the size of a screen.
float apart_by(const render::View& a, const render::View& b) {
    const glm::mat4 difference =
        a.clip_from_eye * a.eye_from_room - b.clip_from_eye * b.eye_from_room;
    float sum = 0;
    for (int column = 0; column < 4; ++column)
        sum += glm::length(difference[column]);
    return sum;
}

GLuint bound_framebuffer(const render::Gl& gl) {
    GLint bound = 0;
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    return static_cast<GLuint>(bound);
}

} // namespace

bool same_cells(const Picture& a, const Picture& b) {
    if (a.footprint != b.footprint || a.cells != b.cells)
        return false;
    return hides_by_depth(a) && hides_by_depth(b) ? without_lines(a) == without_lines(b) : a == b;
}

Picture drawn_as(Picture picture, const Picture& drawn) {
    picture.cells = drawn.cells;
    picture.footprint = drawn.footprint;
    picture.resolution = drawn.resolution;
    picture.mesh_level = drawn.mesh_level;
    picture.moved = drawn.moved;
    picture.scale = drawn.scale; // whose range may be percentiles of the cells
    return picture;
}

/// Color and depth, of all samples.
void CellsPicture::copy(GLuint from, GLuint to, std::span<const render::View> views) const {
    gl_.Disable(GL_SCISSOR_TEST);
    for (const render::View& view : views) {
        const glm::ivec2 low = view.corner, high = view.corner + view.size;
        gl_.BlitNamedFramebuffer(from, to, low.x, low.y, high.x, high.y, low.x, low.y, high.x,
                                 high.y, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    }
    gl_.Enable(GL_SCISSOR_TEST);
}

std::deque<CellsPicture::Kept>::const_iterator
CellsPicture::find(std::span<const render::View> views) const {
    const int samples = samples_of_bound(gl_);
    return std::ranges::find_if(kept_, [&](const Kept& kept) {
        return kept.newest && kept.target.samples() == samples &&
               std::ranges::equal(kept.views, views);
    });
}

bool CellsPicture::hold(const Picture& picture, std::size_t viewports) const {
    const auto kept = std::ranges::count(kept_, true, &Kept::newest);
    return picture_ && static_cast<std::size_t>(kept) >= viewports &&
           same_cells(*picture_, picture);
}

void CellsPicture::keep(const Picture& picture, std::span<const render::View> views) {
    if (!hides_by_depth(picture))
        return forget();
    if (!picture_ || !same_cells(*picture_, picture))
        for (Kept& kept : kept_)
            kept.newest = false;
    picture_ = picture;
    if (find(views) != kept_.end())
        return;
    const glm::ivec2 size = size_of(views);
    const int samples = samples_of_bound(gl_);
    auto place = std::ranges::find_if(kept_, [&](const Kept& kept) {
        return !kept.newest && kept.target.size() == size && kept.target.samples() == samples;
    });
    if (place == kept_.end()) {
        std::erase_if(kept_, [](const Kept& kept) { return !kept.newest; });
        kept_.push_back({{}, render::RenderTarget(gl_, size, samples), false});
        place = std::prev(kept_.end());
    }
    place->views.assign(views.begin(), views.end());
    place->newest = true;
    copy(bound_framebuffer(gl_), place->target.drawn_framebuffer(), views);
}

const Picture* CellsPicture::movable(std::size_t viewports) const {
    const auto of_one_sample = std::ranges::count_if(
        kept_, [](const Kept& kept) { return kept.newest && kept.target.samples() == 1; });
    return picture_ && static_cast<std::size_t>(of_one_sample) >= viewports ? &*picture_ : nullptr;
}

std::vector<render::PictureWithDepth>
CellsPicture::for_screens_of(std::span<const render::View> views) const {
    const Kept* nearest = nullptr;
    float least = std::numeric_limits<float>::max();
    for (const Kept& kept : kept_) {
        if (!kept.newest || kept.target.samples() > 1 || samples_of_bound(gl_) > 1 ||
            !std::ranges::equal(kept.views, views, same_kind))
            continue;
        const float apart = apart_by(kept.views.front(), views.front());
        if (apart < least) {
            least = apart;
            nearest = &kept;
        }
    }
    std::vector<render::PictureWithDepth> pictures;
    if (nearest)
        for (const render::View& view : nearest->views)
            pictures.push_back(
                {nearest->target.color_texture(), nearest->target.depth_texture(), view});
    return pictures;
}

bool CellsPicture::draw_again(const Picture& picture, std::span<const render::View> views) const {
    if (!picture_ || !same_cells(*picture_, picture))
        return false;
    const auto found = find(views);
    if (found == kept_.end())
        return false;
    copy(found->target.drawn_framebuffer(), bound_framebuffer(gl_), views);
    return true;
}

} // namespace isochron::app
