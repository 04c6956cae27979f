// Dear ImGui inside the program: its events, its frame, and its triangles through our own GL table.
#pragma once

#include "app/panel.h"
#include "interaction/window_event.h"
#include "render/gl_objects.h"

#include <glm/vec2.hpp>

#include <span>
#include <vector>

struct ImDrawData;
struct ImGuiContext;

namespace isochron::app {

class PanelLayer {
  public:
    explicit PanelLayer(const render::Gl& gl);
    ~PanelLayer();
    PanelLayer(const PanelLayer&) = delete;
    PanelLayer& operator=(const PanelLayer&) = delete;

    /// Takes events into account. @return those that the panel has no use for; releases always
    /// pass, so that nothing sticks
    std::vector<interaction::WindowEvent> feed(std::span<const interaction::WindowEvent> events,
                                               bool shown);

    /// Lays out and draws the panel onto the bound framebuffer. @return what the user did
    interaction::Commands draw(glm::ivec2 framebuffer, const PanelModel& model);

    /// Draws what was laid out last once more, onto another framebuffer of that size.
    void draw_again(glm::ivec2 framebuffer);

  private:
    void render(const ImDrawData& data, glm::ivec2 framebuffer);
    void make_font_texture();

    const render::Gl& gl_;
    ImGuiContext* imgui_;
    PanelArea area_;                  ///< of the panel when it was laid out last
    std::uint32_t late_releases_ = 0; ///< mouse buttons, by bit, that go up with the next events
    render::Program program_;
    render::VertexArray vertex_array_;
    render::Buffer vertices_, elements_;
    render::Texture font_;
};

} // namespace isochron::app
