// What is typed into a field of the panel is the number that its user means, or refused.
#include "app/panel/imgui/number_entry.h"
#include "app/panel/parts/rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <string_view>

namespace isochron::app {
namespace {

using interaction::Key;
using testing::HasSubstr;
using testing::IsEmpty;

/// A window with the kinds of fields that the panel has.
class NumberEntryTest : public testing::Test {
  protected:
    NumberEntryTest() : imgui_(ImGui::CreateContext()) {
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {640, 480};
        io.KeyMap[ImGuiKey_Enter] = static_cast<int>(Key::enter);
        io.KeyMap[ImGuiKey_Backspace] = static_cast<int>(Key::backspace);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        frame();
        frame(); // a window is there once laid out
    }
    ~NumberEntryTest() override { ImGui::DestroyContext(imgui_); }

    void frame() {
        numbers_.flush();
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({400, 400});
        ImGui::Begin("fields");
        const auto place = [](ImVec2& at) {
            const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
            at = {low.x + 10, (low.y + high.y) / 2};
        };
        const double low = 0, high = 10;
        number_field("isovalue", isovalue_, {.low = low, .high = high}, "%.6g %%");
        place(at_isovalue_);
        number_field("speed", speed_, {.low = low, .high = high}, "x %.3g");
        place(at_speed_);
        whole_number_field("step", &step_, 0, 9999, "%d");
        place(at_step_);
        ImGui::InputScalarN("range", ImGuiDataType_Double, range_.data(), 2, nullptr, nullptr,
                            "%.6g", ImGuiInputTextFlags_CharsScientific);
        place(at_range_);
        ImGui::End();
        ImGui::Render();
    }

    /// Begins an entry with Ctrl + click; all of the field is selected then.
    void begin(const ImVec2& at) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = at;
        frame();
        bool& control = io.KeysDown[static_cast<int>(Key::left_control)];
        control = io.KeyCtrl = io.MouseDown[0] = true;
        frame();
        control = io.KeyCtrl = io.MouseDown[0] = false;
        frame();
    }
    void press(Key key) {
        numbers_.press(key);
        ImGui::GetIO().KeysDown[static_cast<int>(key)] = true;
        frame();
        ImGui::GetIO().KeysDown[static_cast<int>(key)] = false;
        frame();
    }
    /// @param at_once all characters come in one frame, as after a slow one
    void type(std::string_view text, bool at_once) {
        for (const char character : text) {
            numbers_.type(static_cast<char32_t>(character));
            if (!at_once)
                frame();
        }
        frame();
    }
    void enter(const ImVec2& at, std::string_view text, bool at_once) {
        begin(at);
        type(text, at_once);
        press(Key::enter);
    }

    double isovalue_ = 3;
    float speed_ = 2;
    int step_ = 7;
    std::array<double, 2> range_{1, 9};
    ImVec2 at_isovalue_, at_speed_, at_step_, at_range_;
    NumberEntry numbers_;

  private:
    ImGuiContext* imgui_;
};

TEST_F(NumberEntryTest, ACommaIsADecimalPoint) {
    for (const bool at_once : {false, true}) {
        SCOPED_TRACE(at_once);
        isovalue_ = 3;
        speed_ = 2;
        range_ = {1, 9};
        enter(at_isovalue_, "1,5", at_once);
        EXPECT_EQ(isovalue_, 1.5);
        enter(at_speed_, "0,25", at_once);
        EXPECT_EQ(speed_, 0.25f);
        enter(at_range_, "-2,5e-1", at_once);
        EXPECT_EQ(range_[0], -0.25);
        enter(at_isovalue_, "1.75", at_once);
        EXPECT_EQ(isovalue_, 1.75);
        EXPECT_THAT(numbers_.take_complaint(), IsEmpty());
    }
}

TEST_F(NumberEntryTest, WithSeparatorsOfThousandsItIsRefusedAndStays) {
    for (const bool at_once : {false, true})
        for (const char* text : {"1,234.5", "1.234,5", "1,234,567", "1..5"}) {
            SCOPED_TRACE(testing::Message() << text << ' ' << at_once);
            isovalue_ = 3;
            enter(at_isovalue_, text, at_once);
            EXPECT_EQ(isovalue_, 3) << "and not what the digits would make";
            EXPECT_THAT(
                numbers_.take_complaint(),
                HasSubstr(
                    "expected a number with one decimal point or comma, without separators of "
                    "thousands; it stays 3"));
        }
}

TEST_F(NumberEntryTest, AWholeNumberHasNoSeparator) {
    for (const char* text : {"1,500", "1.5"}) {
        step_ = 7;
        enter(at_step_, text, false);
        EXPECT_EQ(step_, 7) << text;
        EXPECT_THAT(numbers_.take_complaint(), HasSubstr("expected a whole number"));
    }
    enter(at_step_, "1500", false);
    EXPECT_EQ(step_, 1500);
    EXPECT_THAT(numbers_.take_complaint(), IsEmpty());
}

TEST_F(NumberEntryTest, ARefusedEntryCanBeTypedAgain) {
    begin(at_isovalue_);
    type("1,234.5", false);
    press(Key::backspace); // takes away the 3 that it had
    type("2,5", false);
    press(Key::enter);
    EXPECT_EQ(isovalue_, 2.5);
}

TEST_F(NumberEntryTest, ASelectedSeparatorIsReplacedByTheOneThatIsTyped) {
    isovalue_ = 1.25;
    enter(at_isovalue_, ",5", false);
    EXPECT_EQ(isovalue_, 0.5);
    EXPECT_THAT(numbers_.take_complaint(), IsEmpty());
}

} // namespace
} // namespace isochron::app
