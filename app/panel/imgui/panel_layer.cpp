// Runs Dear ImGui inside the program: feeds it events and draws its triangles.
#include "app/panel/imgui/panel_layer.h"

#include "app/panel/imgui/event_taker.h"
#include "app/panel/parts/messages.h"
#include "app/panel/parts/place_menu.h"
#include "app/panel/parts/theme.h"
#include "app/scene/font.h"
#include "interaction/controls/controls.h"
#include "render/gl/limits.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string_view>
#include <variant>

namespace isochron::app {
namespace {

using namespace interaction;

/// A message that names a path, of which something can be done, stays longer.
Seconds shown_for(const std::string& message) {
    return Seconds(path_in(message) ? 8.0 : 4.0);
}

/// Delete over the lane of the film is the chosen key's, not the tool's.
bool removes_key(const WindowEvent& event, FilmLane& film) {
    const auto* key = std::get_if<interaction::KeyEvent>(&event);
    const bool removes = key && key->down && key->alone() && key->key == interaction::Key::del &&
                         film.under_hand && film.chosen && !ImGui::GetIO().WantTextInput;
    film.removes = film.removes || removes;
    return removes;
}

} // namespace

PanelLayer::PanelLayer(const render::Gl& gl, float scale)
    : gl_(gl), imgui_(ImGui::CreateContext()), scale_(scale),
      program_(gl, {render::shader_file("panel.vert"), render::shader_file("panel.frag")}),
      vertex_array_(gl), vertices_(gl), elements_(gl) {
    ImGui::SetCurrentContext(imgui_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.MouseDoubleClickTime = static_cast<float>(interaction::kDoubleClick.count());
    for (const auto& [imgui_key, key] : keys_of_imgui())
        io.KeyMap[imgui_key] = static_cast<int>(key);
    use_theme(Theme::dark);
    use_measures();
    make_font_texture();
    const GLuint array = vertex_array_.name();
    const auto attribute = [&](GLuint index, GLint count, GLenum type, GLboolean normalized,
                               std::size_t offset) {
        gl_.EnableVertexArrayAttrib(array, index);
        gl_.VertexArrayAttribFormat(array, index, count, type, normalized,
                                    static_cast<GLuint>(offset));
        gl_.VertexArrayAttribBinding(array, index, 0);
    };
    attribute(0, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, pos));
    attribute(1, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, uv));
    attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ImDrawVert, col));
    gl_.VertexArrayVertexBuffer(array, 0, vertices_.name(), 0, sizeof(ImDrawVert));
    gl_.VertexArrayElementBuffer(array, elements_.name());
}

PanelLayer::~PanelLayer() {
    ImGui::DestroyContext(imgui_);
}

void PanelLayer::make_font_texture() {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    add_font(fonts, kFontPixels * scale_);
    ImGui::GetIO().FontGlobalScale = 1.0f / scale_;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    fonts.GetTexDataAsRGBA32(&pixels, &width, &height);
    render::expect_texture(render::Limits(gl_), "panel's font", {width, height});
    font_.emplace(gl_, GL_TEXTURE_2D);
    gl_.TextureStorage2D(font_->name(), 1, GL_RGBA8, width, height);
    gl_.TextureSubImage2D(font_->name(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    gl_.TextureParameteri(font_->name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.TextureParameteri(font_->name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void PanelLayer::set_scale(float scale) {
    if (scale == scale_)
        return;
    ImGui::SetCurrentContext(imgui_);
    scale_ = scale;
    make_font_texture();
}

std::vector<WindowEvent> PanelLayer::feed(std::span<const WindowEvent> events, bool shown) {
    ImGui::SetCurrentContext(imgui_);
    std::vector<WindowEvent> left;
    ImGuiIO& io = ImGui::GetIO();
    for (std::size_t button = 0; button < std::size(io.MouseDown); ++button)
        if (late_releases_ & (1u << button))
            io.MouseDown[button] = false;
    const std::uint32_t released = std::exchange(late_releases_, 0);
    EventTaker taker{.io = io,
                     .panel = view_.layout,
                     .late_releases = late_releases_,
                     .cursor = cursor_,
                     .places = places_,
                     .popups = has_popup(),
                     .lists = has_popup() || pages_.has_list(),
                     .closes_popup = closes_popup_,
                     .numbers = numbers_,
                     .released = released};
    if (!io.WantTextInput) { // the field of the search has let the keyboard go
        const auto presses = pages_.take_presses();
        waiting_.insert(waiting_.end(), presses.begin(), presses.end());
    }
    waiting_.insert(waiting_.end(), events.begin(), events.end());
    fed_ = !waiting_.empty();
    // What is typed as soon as a page opens waits for its field.
    const auto waits = [&](const WindowEvent& event) {
        const bool typed =
            std::holds_alternative<KeyEvent>(event) || std::holds_alternative<TextEvent>(event);
        return (typed && pages_.takes_text() && !io.WantTextInput) ||
               (shown && taker.must_wait(event));
    };
    while (!waiting_.empty() && !waits(waiting_.front())) {
        const WindowEvent event = waiting_.front();
        waiting_.pop_front();
        if (pages_.turn(event, has_popup()) ||
            (shown && (leaves_part(event) || removes_key(event, view_.film))))
            continue;
        const bool open = shown || pages_.any() || pages_.takes_text();
        const bool taken = std::visit(taker, event);
        follow_right_button(event, taken);
        if (!taken || !open)
            left.push_back(event);
    }
    if (taker.begun)
        pages_.begin();
    return left;
}

/// Escape leaves what is open beside the pages, before it reaches the tools.
bool PanelLayer::leaves_part(const WindowEvent& event) {
    const auto* key = std::get_if<KeyEvent>(&event);
    return key && key->down && key->alone() && key->key == interaction::Key::escape &&
           !has_popup() && !pages_.leaving() && !ImGui::GetIO().WantTextInput && view_.close_part();
}

/// A press of the right button on the picture that moves nothing opens the menu of the place.
void PanelLayer::follow_right_button(const WindowEvent& event, bool taken) {
    constexpr float kStill = 4.0f; // panel pixels
    const auto* button = std::get_if<MouseButtonEvent>(&event);
    if (!button || button->button != MouseButton::right || !cursor_)
        return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const glm::vec2 at = *cursor_ * glm::vec2(screen.x, screen.y);
    const auto pressed = std::exchange(right_pressed_, std::nullopt);
    if (button->down && !taken)
        right_pressed_ = at;
    else if (!button->down && pressed && glm::distance(*pressed, at) <= kStill)
        opens_menu_ = true;
}

void PanelLayer::lay_out_menu(const PanelModel& model, Commands& commands) {
    if (std::exchange(opens_menu_, false) && !pages_.any() && !model.asked.leaving) {
        menu_place_ = model.pointed ? model.pointed() : std::nullopt;
        open_place_menu();
    }
    if (place_menu(model, menu_place_, commands, pages_.desktop_wish()))
        pages_.press(Action::recenter);
}

void PanelLayer::point(const std::optional<glm::vec2>& at, bool pressed, float notches) {
    ImGui::SetCurrentContext(imgui_);
    ImGuiIO& io = ImGui::GetIO();
    constexpr float kAway = -std::numeric_limits<float>::max(); // as ImGui wants it
    io.MousePos = at ? ImVec2(at->x, at->y) : ImVec2(kAway, kAway);
    io.MouseDown[0] = pressed;
    io.MouseWheel = notches;
}

void PanelLayer::begin_frame(glm::ivec2 picture, Seconds time) {
    // ImGui requires a time above 0. A window at rest has no frames: two clicks with a pause between
    // them are no double click, so the longest time is longer than that of one.
    constexpr double kShortest = 1e-4, kLongest = interaction::kDoubleClick.count() + 0.1;
    ImGui::SetCurrentContext(imgui_);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(picture.x) / scale_,
                      static_cast<float>(picture.y) / scale_};
    if (cursor_) // it may have come before the current size was known
        io.MousePos = {cursor_->x * io.DisplaySize.x, cursor_->y * io.DisplaySize.y};
    const Seconds elapsed = time - std::exchange(laid_out_, time);
    io.DeltaTime = static_cast<float>(std::clamp(elapsed.count(), kShortest, kLongest));
    numbers_.flush();
    ImGui::NewFrame();
    if (std::exchange(closes_popup_, false) && has_popup())
        ImGui::ClosePopupToLevel(imgui_->OpenPopupStack.Size - 1, true);
}

/// What the user is told at the top of the picture, or in a panel that has no picture.
Commands PanelLayer::say(const PanelModel& model, Seconds time) {
    const Seconds said_before = said_;
    if (std::exchange(messages_, model.notes.messages) != model.notes.messages) {
        said_ = time;
        complaint_.clear();
    }
    if (std::string complaint = numbers_.take_complaint(); !complaint.empty()) {
        said_ = time;
        complaint_ = std::move(complaint);
    }
    const bool stands_else = std::exchange(standing_, model.notes.standing) != standing_;
    const std::string message = complaint_.empty() ? model.notes.message() : complaint_;
    shown_until_ = said_ + shown_for(message);
    const bool fresh = time < shown_until_;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const bool hidden = view_.layout == PanelLayout{};
    const PanelBox picture = hidden ? PanelBox{{0, 0}, {screen.x, screen.y}} : view_.layout.picture;
    const PanelBox free = hidden ? PanelBox{{0, 10}, {screen.x, screen.y}} : view_.free;
    if (model.place == PanelPlace::over) {
        const bool closed = !model.notes.failure.empty() && model.notes.failure == closed_;
        if (message_window({.failure = closed ? std::string() : model.notes.failure,
                            .standing = standing_,
                            .message = fresh ? message : std::string()},
                           free, pages_.desktop_wish()))
            closed_ = model.notes.failure;
    } else if (model.place == PanelPlace::whole) {
        message_window({.failure = {}, .standing = {}, .message = fresh ? complaint_ : ""},
                       {{0, 44}, {screen.x, screen.y}}, pages_.desktop_wish());
    }
    float lowest = hidden ? free.low.y : view_.lowest;
    if (const ImGuiWindow* said = ImGui::FindWindowByName("###message"); said && said->Active)
        lowest = std::max(lowest, said->Pos.y + said->Size.y);
    const PanelBox below_title{{0, view_.layout.top.low.y}, {screen.x, screen.y}};
    Commands commands = pages_.lay_out(
        model, model.place == PanelPlace::in_room ? below_title : picture, lowest, time);
    changed_by_words_ =
        said_ != said_before || stands_else || pages_.turned(); // ImGui shows a new window late
    return commands;
}

Commands PanelLayer::lay_out(glm::ivec2 picture, const PanelModel& model, Seconds time) {
    begin_frame(picture, time);
    use_theme(theme_for(model.asked.look));
    // A wand has no keyboard: there a click does not begin to type.
    ImGui::GetIO().ConfigDragClickToInputText = model.place != PanelPlace::in_room;
    if (model.place == PanelPlace::in_room)
        room_keys_.use();
    Commands commands;
    PanelPages asked{.offers_files = pages_.offers_files(),
                     .offers_arrays = pages_.offers_arrays()};
    // The panel in the room replaces the one over the picture.
    if ((model.asked.panel && !model.asked.room_panel.shown) || model.place != PanelPlace::over)
        commands = draw_panel(model, view_, asked);
    else
        view_.layout = {};
    if (asked.files)
        pages_.open_files();
    if (asked.help)
        pages_.open_help();
    if (asked.search)
        pages_.open_search();
    if (asked.arrays)
        pages_.open_arrays();
    if (asked.messages)
        pages_.open_messages();
    if (!asked.text.empty())
        pages_.desktop_wish().text = asked.text;
    if (asked.movie)
        wanted_movie_ = asked.movie;
    pages_.go_on_with(model, asked.session);
    if (model.place == PanelPlace::over)
        lay_out_menu(model, commands);
    merge(commands, say(model, time));
    if (model.place != PanelPlace::in_room)
        leaving_window(model, commands);
    const OpenPages::FoundControl found = pages_.take_found();
    if (found.section) {
        view_.pointed = found.section;
        commands.panel = model.place == PanelPlace::over && !model.asked.panel ? std::optional(true)
                                                                               : commands.panel;
    }
    view_.statistics = view_.statistics || found.statistics;
    if (found.movie)
        wanted_movie_ = found.movie;
    end_frame();
    changed_ = changed_ || found.section || found.statistics; // which the next layout shows
    changed_ |= changed_by_words_;
    return commands;
}

void PanelLayer::lay_out_files(glm::ivec2 picture, const std::string& complaint, Seconds time) {
    begin_frame(picture, time);
    pages_.lay_out_files();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    message_window({.failure = {}, .standing = complaint, .message = {}},
                   {{0, 10}, {screen.x, screen.y}}, pages_.desktop_wish());
    end_frame();
}

void PanelLayer::lay_out_progress(glm::ivec2 picture, const std::string& name,
                                  const std::string& line, float fraction, Seconds time) {
    begin_frame(picture, time);
    progress_window(name, line, fraction);
    end_frame();
}

std::optional<std::size_t> PanelLayer::lay_out_arrays(glm::ivec2 picture, const std::string& name,
                                                      const std::vector<ListedArray>& arrays,
                                                      std::size_t first, Seconds time) {
    begin_frame(picture, time);
    const auto chosen = pages_.arrays().draw(
        {.question = "Which array of " + name + "? Those of its shape can be shown with it.",
         .values = "values, first step",
         .button = "Open (Enter)"},
        arrays, first);
    end_frame();
    return chosen;
}

bool PanelLayer::has_popup() const {
    return imgui_->OpenPopupStack.Size > 0;
}

bool PanelLayer::covers(glm::vec2 at) const {
    ImGui::SetCurrentContext(imgui_);
    const ImVec2 size = imgui_->IO.DisplaySize;
    return has_mouse_at(view_.layout, folded(at, places_) * glm::vec2(size.x, size.y));
}

std::uint32_t PanelLayer::hovered() const {
    return imgui_->HoveredId;
}

std::uint32_t PanelLayer::held() const {
    return imgui_->ActiveId;
}

void PanelLayer::end_frame() {
    ImGui::Render();
    changed_ = std::exchange(digest_, hash_of_layout()) != digest_;
}

FrameOutlook PanelLayer::outlook() const {
    constexpr Seconds kCaretBlinks{0.1}; // and moves by no more in one layout
    const ImGuiIO& io = imgui_->IO;
    const auto is_down = [](bool down) { return down; };
    FrameOutlook next{.changed = changed_ || fed_, .final = true};
    next.busy = late_releases_ != 0 || !waiting_.empty() || closes_popup_ || pages_.has_presses() ||
                view_.film.preview || std::ranges::any_of(io.MouseDown, is_down) ||
                std::ranges::any_of(io.KeysDown, is_down);
    if (io.WantTextInput)
        next.until = laid_out_ + kCaretBlinks;
    for (const Seconds moment : {shown_until_, pages_.introduction_ends()})
        if (moment > laid_out_)
            next.until = std::min(next.until, moment);
    return next;
}

std::size_t PanelLayer::hash_of_layout() const {
    const ImDrawData& data = *ImGui::GetDrawData();
    std::size_t digest = std::hash<float>()(scale_);
    const auto add = [&](const void* bytes, int size) {
        const std::string_view text(static_cast<const char*>(bytes),
                                    static_cast<std::size_t>(size));
        digest = digest * 31 + std::hash<std::string_view>()(text);
    };
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        add(list.VtxBuffer.Data, list.VtxBuffer.size_in_bytes());
        add(list.IdxBuffer.Data, list.IdxBuffer.size_in_bytes());
        for (const ImDrawCmd& command : list.CmdBuffer) {
            add(&command.ClipRect, sizeof command.ClipRect);
            add(&command.TextureId, sizeof command.TextureId);
        }
    }
    return digest;
}

/// The texture of a small picture, or the font's for none.
GLuint PanelLayer::texture_of(const void* picture) {
    if (!picture)
        return font_->name();
    const auto& image = *static_cast<const render::Image*>(picture);
    auto& texture = pictures_[&image];
    if (!texture) {
        texture.emplace(gl_, GL_TEXTURE_2D);
        gl_.TextureStorage2D(texture->name(), 1, GL_RGBA8, image.width, image.height);
        gl_.TextureSubImage2D(texture->name(), 0, 0, 0, image.width, image.height, GL_RGBA,
                              GL_UNSIGNED_BYTE, image.rgba.data());
        gl_.TextureParameteri(texture->name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl_.TextureParameteri(texture->name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl_.TextureParameteri(texture->name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    return texture->name();
}

void PanelLayer::draw(glm::ivec2 picture, glm::ivec2 corner) {
    ImGui::SetCurrentContext(imgui_);
    const ImDrawData& data = *ImGui::GetDrawData();
    gl_.Viewport(corner.x, corner.y, picture.x, picture.y);
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Enable(GL_BLEND);
    gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.UseProgram(program_.name());
    gl_.ProgramUniform2f(program_.name(), gl_.GetUniformLocation(program_.name(), "display_size"),
                         data.DisplaySize.x, data.DisplaySize.y);
    gl_.BindVertexArray(vertex_array_.name());
    static_assert(sizeof(ImDrawIdx) == 2);
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        gl_.NamedBufferData(vertices_.name(), list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data,
                            GL_STREAM_DRAW);
        gl_.NamedBufferData(elements_.name(), list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data,
                            GL_STREAM_DRAW);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const ImVec4& clip = command.ClipRect;
            const int left = static_cast<int>(scale_ * clip.x);
            const int bottom = static_cast<int>(scale_ * clip.w);
            const int width = static_cast<int>(scale_ * (clip.z - clip.x));
            const int height = static_cast<int>(scale_ * (clip.w - clip.y));
            if (width <= 0 || height <= 0)
                continue;
            gl_.BindTextureUnit(0, texture_of(command.TextureId));
            gl_.Scissor(corner.x + left, corner.y + picture.y - bottom, width, height);
            gl_.DrawElementsBaseVertex(
                GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), GL_UNSIGNED_SHORT,
                reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)),
                static_cast<GLint>(command.VtxOffset));
        }
    }
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Disable(GL_BLEND);
}

} // namespace isochron::app
