// The panel over a window, event by event.
#pragma once

#include "app/panel/imgui/panel_layer.h"
#include "stereo/context/gl_context.h"
#include "tests/app/panel/drawn_text.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

class LayerTest : public testing::Test {
  protected:
    LayerTest() {
        for (int step = 0; step < 2000; ++step)
            info_.times.push_back(step);
        stats_.low = 0;
        stats_.high = 100;
        stats_.histogram.assign(256, 1);
        asked_.panel = true;
    }

    /// @return commands of the frame
    interaction::Commands frame(const std::vector<interaction::WindowEvent>& events = {}) {
        left_ = layer_.feed(events, true);
        time_ += interaction::Seconds(0.1);
        return layer_.lay_out(size_,
                              {.info = info_,
                               .stats = stats_,
                               .asked = asked_,
                               .frame = report_,
                               .gaps = gaps_,
                               .arrays = arrays_,
                               .curves = curves_,
                               .notes = notes_,
                               .movies = {.offered = true},
                               .sessions = sessions_,
                               .controls = controls_,
                               .pointed = pointed_},
                              time_);
    }
    /// @param at panel pixels
    void point(glm::vec2 at) {
        const ImVec2 laid_out = ImGui::GetIO().DisplaySize; // in the last frame
        const glm::vec2 screen =
            laid_out.x > 0 ? glm::vec2(laid_out.x, laid_out.y) : glm::vec2(size_);
        frame({interaction::MouseMoveEvent{at.x / screen.x, at.y / screen.y, size_.x, size_.y}});
    }
    /// A click at a place, in pixels from the top left. @return the commands that it led to
    interaction::Commands click(glm::vec2 at) {
        using interaction::MouseButton;
        using interaction::MouseButtonEvent;
        point(at);
        interaction::Commands all = frame({MouseButtonEvent{MouseButton::left, true}});
        merge(all, frame({MouseButtonEvent{MouseButton::left, false}}));
        merge(all, frame());
        return all;
    }
    /// Clicks a word of the panel, wherever it stands. @return the commands that it led to
    interaction::Commands click_word(const std::string& word) {
        for (int i = 0; i < 3; ++i) // a popup takes some to know its size
            frame();
        const auto at =
            place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), word);
        EXPECT_TRUE(at) << word;
        return at ? click({at->x, at->y}) : interaction::Commands();
    }
    void press(interaction::Key key, std::uint8_t modifiers = 0) {
        frame({interaction::KeyEvent{key, true, modifiers},
               interaction::KeyEvent{key, false, modifiers}});
        frame();
    }
    void type(std::string_view text) {
        for (const char character : text)
            frame({interaction::TextEvent{static_cast<char32_t>(character)}});
    }

    /// From now on the data have three arrays.
    void offer_three_arrays() {
        static const std::vector<std::string> names{"heat", "rho", "speed"};
        static const std::vector<ListedArray> lines{
            {"heat", "6 x 6 x 6, 1 step", "K", "0 to 3", ""},
            {"rho", "6 x 6 x 6, 1 step", "kg", "0 to 4", ""},
            {"speed", "6 x 6 x 6, 1 step", "", "0 to 5", ""}};
        arrays_.names = names;
        arrays_.lines = lines;
        arrays_.way_to = [](std::size_t number) {
            interaction::Commands way;
            way.array = names[number];
            return way;
        };
    }

    static constexpr glm::ivec2 kSize{1280, 800};
    glm::ivec2 size_ = kSize;
    std::unique_ptr<stereo::GlContext> context_ =
        stereo::make_context(stereo::ContextKind::egl, {.size = {64, 64}});
    render::Gl gl_{context_->loader()};
    PanelLayer layer_{gl_};
    index::SeriesInfo info_;
    index::IndexStats stats_;
    ExplorerState asked_;
    FrameReport report_;
    std::vector<std::uint32_t> gaps_;
    PanelArrays arrays_;
    PanelCurves curves_;
    PanelNotes notes_;
    std::vector<OfferedSession> sessions_;
    std::function<std::optional<interaction::Pointed>()> pointed_;
    std::vector<interaction::ControlGroup> controls_;
    interaction::Seconds time_{0};
    std::vector<interaction::WindowEvent> left_; ///< that the last frame did not use
};

} // namespace isochron::app
