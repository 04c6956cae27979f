// Runs Dear ImGui inside the program: feeds it events and draws its triangles.
#pragma once

#include "app/frame/idle_wait.h"
#include "app/panel/imgui/number_entry.h"
#include "app/panel/open_pages.h"
#include "app/panel/panel.h"
#include "app/panel/parts/room_keys.h"
#include "interaction/input/window_event.h"
#include "interaction/pose.h"
#include "render/gl/gl_objects.h"
#include "render/gl/shader.h"

#include <glm/vec2.hpp>

#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

struct ImGuiContext;

namespace isochron::app {

class PanelLayer {
  public:
    static constexpr float kFontPixels = 15.0f; ///< height of a line, in panel pixels

    /// @param scale target pixels per panel pixel, see `set_scale`
    explicit PanelLayer(const render::Gl& gl, float scale = 1.0f);
    ~PanelLayer();
    PanelLayer(const PanelLayer&) = delete;
    PanelLayer& operator=(const PanelLayer&) = delete;

    /// Draws the panel larger or smaller from the next frame on, with equally sharp letters.
    /// @param scale target pixels per panel pixel
    void set_scale(float scale);
    float scale() const { return scale_; }
    OpenPages& pages() { return pages_; }
    const OpenPages& pages() const { return pages_; }

    /// The movie that the user wants made, or given up; returned once.
    std::optional<MovieWish> take_wanted_movie() { return std::exchange(wanted_movie_, {}); }

    /// Passes events to Dear ImGui, which sees the state of keys and buttons once per frame. An
    /// event that it could not tell apart within one frame (a key that goes down twice, or Enter
    /// before a digit) waits for the next frame, with all events after it.
    /// @param shown the panel is visible
    /// @return the events that the panel does not use, and all releases, so that nothing sticks
    std::vector<interaction::WindowEvent> feed(std::span<const interaction::WindowEvent> events,
                                               bool shown);

    /// Sets the mouse of a panel that gets no events.
    /// @param at panel pixels from the top left; empty: away from the panel
    /// @param notches that the wheel has turned, up positive
    void point(const std::optional<glm::vec2>& at, bool pressed, float notches);

    /// Lays out one frame of the panel.
    /// @param picture size of the target, pixels
    /// @param time of the session
    /// @return commands of the user
    interaction::Commands lay_out(glm::ivec2 picture, const PanelModel& model,
                                  interaction::Seconds time);

    /// One frame of a window in which there is nothing but the choice of data.
    /// @param complaint shown below it; empty: none
    void lay_out_files(glm::ivec2 picture, const std::string& complaint, interaction::Seconds time);

    /// One frame of a window in which there is nothing but the progress of work, see
    /// `progress_window`.
    void lay_out_progress(glm::ivec2 picture, const std::string& name, const std::string& line,
                          float fraction, interaction::Seconds time);

    /// One frame of a window in which there is nothing but the choice of an array, see
    /// `ArrayWindow`. @return the number of the array that the user has chosen
    std::optional<std::size_t> lay_out_arrays(glm::ivec2 picture, const std::string& name,
                                              const std::vector<ListedArray>& arrays,
                                              std::size_t first, interaction::Seconds time);

    /// Draws the last layout onto a part of the bound framebuffer, which has the size of the
    /// layout.
    /// @param corner lower left, pixels
    void draw(glm::ivec2 picture, glm::ivec2 corner = glm::ivec2(0));

    /// Sets how many times the panel appears in its window side by side (x) and above each other
    /// (y), such as in each eye's half: the cursor works in all of them.
    void repeat(glm::ivec2 places) { places_ = places; }

    /// A hash of all that `draw` would draw: panels that look the same have the same one.
    std::size_t digest() const { return digest_; }
    /// What the last layout tells about the next one.
    FrameOutlook outlook() const;
    /// Where the last layout put the parts.
    const PanelLayout& layout() const { return view_.layout; }
    /// Whether the panel, or a page that it has opened, covers a place.
    /// @param at fractions of the picture from the top left
    bool covers(glm::vec2 at) const;
    /// The widget under the pointer, and the widget that is pressed; 0: none.
    std::uint32_t hovered() const;
    std::uint32_t held() const;

  private:
    void make_font_texture();
    GLuint texture_of(const void* picture);
    void end_frame();
    std::size_t hash_of_layout() const;
    bool has_popup() const;
    bool leaves_part(const interaction::WindowEvent& event);
    void follow_right_button(const interaction::WindowEvent& event, bool taken);
    void lay_out_menu(const PanelModel& model, interaction::Commands& commands);
    interaction::Commands say(const PanelModel& model, interaction::Seconds time);
    void begin_frame(glm::ivec2 picture, interaction::Seconds time);

    const render::Gl& gl_;
    ImGuiContext* imgui_;
    float scale_;
    interaction::Seconds laid_out_{0}; ///< session time
    PanelView view_;
    std::uint32_t late_releases_ = 0; ///< mouse buttons, by bit, to release in the next `feed`
    std::optional<glm::vec2> cursor_; ///< in the panel's picture, fractions from the top left
    std::deque<interaction::WindowEvent> waiting_; ///< for the next frame, see `feed`
    glm::ivec2 places_{1};
    std::size_t digest_ = 0;          ///< digest of the last layout
    bool changed_ = false;            ///< it looks different from the one before
    bool fed_ = false;                ///< events came for it
    std::size_t messages_ = 0;        ///< number so far
    interaction::Seconds said_{-1e9}; ///< when the newest one came
    interaction::Seconds shown_until_{-1e9};
    std::string standing_;          ///< in the last layout
    std::string closed_;            ///< the failure that the user has read and closed
    bool changed_by_words_ = false; ///< a window with words has come or gone
    NumberEntry numbers_;
    std::string complaint_;     ///< complaint of `numbers_`, if nothing was said since
    bool closes_popup_ = false; ///< Escape was pressed
    OpenPages pages_;
    /// Where the right button went down on the picture, panel pixels; empty: it is up.
    std::optional<glm::vec2> right_pressed_;
    bool opens_menu_ = false;                        ///< it came up there again
    std::optional<interaction::Pointed> menu_place_; ///< place of the menu that is open
    RoomKeys room_keys_;                             ///< keys of the panel in the room
    std::optional<MovieWish> wanted_movie_;
    render::LazyProgram program_;
    render::VertexArray vertex_array_;
    render::Buffer vertices_, elements_;
    std::optional<render::Texture> font_;
    /// Textures of small pictures, which stay as they are as long as the panel shows them.
    std::map<const render::Image*, std::optional<render::Texture>> pictures_;
};

} // namespace isochron::app
