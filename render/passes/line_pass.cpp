// Buffers and GL state for drawing lines.
#include "render/passes/line_pass.h"

#include "render/gl/soft_edges.h"
#include "render/gl/viewport.h"

namespace isochron::render {

BoxLines box_lines(const glm::vec3& extent, const glm::vec4& color, const glm::vec3& eye) {
    BoxLines lines;
    for (int axis = 0; axis < 3; ++axis)
        for (int edge = 0; edge < 4; ++edge) {
            glm::vec3 from(0.0f);
            int towards = 0; // faces
            for (int i = 0; i < 2; ++i) {
                const int other = (axis + 1 + i) % 3;
                const bool upper = (edge >> i & 1) != 0;
                from[other] = upper ? extent[other] : 0.0f;
                towards += (upper ? eye[other] > extent[other] : eye[other] < 0.0f) ? 1 : 0;
            }
            glm::vec3 to = from;
            to[axis] = extent[axis];
            (towards == 2   ? lines.front
             : towards == 1 ? lines.outline
                            : lines.back)
                .push_back({from, to, color});
        }
    return lines;
}

LinePass::LinePass(const Gl& gl)
    : gl_(&gl), program_(gl, {shader_file("line.vert"), shader_file("line.frag")}),
      quads_(gl), segments_(gl, "lines", 3), frame_(gl) {}

void LinePass::draw(const View& view, const glm::mat4& room_from_model, std::span<const Line> lines,
                    float width) {
    if (lines.empty())
        return;
    struct Frame {
        glm::mat4 clip_from_model;
        glm::vec4 size;
    } frame{view.steady().clip_from_eye * view.eye_from_room * room_from_model,
            glm::vec4(view.size, 0.5f * width + 0.25f, 0.0f)};
    std::vector<glm::vec4> segments;
    segments.reserve(3 * lines.size());
    for (const Line& line : lines) {
        segments.emplace_back(line.from, 1.0f);
        segments.emplace_back(line.to, 1.0f);
        segments.push_back(line.color);
    }
    segments_.set(std::as_bytes(std::span(segments)));
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_.name());
    gl_->BindTextureUnit(0, segments_.texture());

    set_viewport(*gl_, view);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    gl_->Disable(GL_CULL_FACE);
    blend_over(*gl_);
    gl_->UseProgram(program_.name());
    draw_colors_then_depth(*gl_, true, [&](bool depth_only) {
        frame.size.w = depth_only ? 1.0f : 0.0f;
        gl_->NamedBufferData(frame_.name(), sizeof(frame), &frame, GL_STREAM_DRAW);
        quads_.draw(lines.size());
    });
    gl_->Disable(GL_BLEND);
    gl_->UseProgram(0);
}

} // namespace isochron::render
