// The text that Dear ImGui has laid out, as it will be seen.
#include "tests/app/panel/drawn_text.h"

#include "render/gl/srgb.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace isochron::app {
namespace {

struct PaintColor {
    double r = 0, g = 0, b = 0;
};

PaintColor unpacked(ImU32 color) {
    const auto part = [color](int shift) { return double((color >> shift) & 0xff) / 255; };
    return {part(IM_COL32_R_SHIFT), part(IM_COL32_G_SHIFT), part(IM_COL32_B_SHIFT)};
}
double alpha_of(ImU32 color) {
    return double((color >> IM_COL32_A_SHIFT) & 0xff) / 255;
}
PaintColor over(const PaintColor& below, ImU32 color) {
    const PaintColor above = unpacked(color);
    const double a = alpha_of(color);
    return {std::lerp(below.r, above.r, a), std::lerp(below.g, above.g, a),
            std::lerp(below.b, above.b, a)};
}
double luminance(const PaintColor& color) {
    const auto light = [](double value) {
        return double(render::linear_from_srgb(static_cast<float>(value)));
    };
    return 0.2126 * light(color.r) + 0.7152 * light(color.g) + 0.0722 * light(color.b);
}
double contrast(const PaintColor& a, const PaintColor& b) {
    const auto [low, high] = std::minmax({luminance(a), luminance(b)});
    return (high + 0.05) / (low + 0.05);
}

struct Pixel {
    PaintColor color;
    bool known = false;   ///< something opaque was drawn here
    std::size_t text = 0; ///< number of the run that is seen here; 0: none
};

struct Run {
    std::string text, window;
    ImRect box;
    std::set<std::string> faults;
    int pixels = 0; ///< covered by its characters when they were drawn
};

/// One character's rectangle: two triangles with a part of the font's texture.
struct Quad {
    std::array<ImDrawVert, 4> corners;
    const ImFontGlyph* glyph;
    bool whole; ///< all of the character, and not a part that Dear ImGui has cut out
    ImRect box() const {
        ImRect box(corners[0].pos, corners[0].pos);
        for (const ImDrawVert& corner : corners)
            box.Add(corner.pos);
        return box;
    }
};

class Painter {
  public:
    Painter(const ImDrawData& data, const ImFont& font, double least)
        : font_(font), least_(least), width_(static_cast<int>(std::ceil(data.DisplaySize.x))),
          height_(static_cast<int>(std::ceil(data.DisplaySize.y))),
          pixels_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)), runs_(1) {
        for (const ImFontGlyph& glyph : font.Glyphs)
            if (glyph.Visible)
                glyphs_[{glyph.U0, glyph.V0, glyph.U1, glyph.V1}] = &glyph;
        for (int n = 0; n < data.CmdListsCount; ++n)
            paint(*data.CmdLists[n]);
        find_hidden();
    }

    const std::vector<Run>& runs() const { return runs_; } ///< from 1

  private:
    void paint(const ImDrawList& list) {
        const ImGuiWindow* window = ImGui::FindWindowByName(list._OwnerName);
        const bool scrolls = window && window->ScrollMax.y > 0;
        for (const ImDrawCmd& command : list.CmdBuffer) {
            last_.reset();
            for (unsigned i = 0; i < command.ElemCount;) {
                const ImDrawIdx* index = list.IdxBuffer.Data + command.IdxOffset + i;
                const auto corner = [&](int at) {
                    return list.VtxBuffer[static_cast<int>(command.VtxOffset) + index[at]];
                };
                if (const auto quad = i + 6 <= command.ElemCount ? quad_of(index, corner)
                                                                 : std::optional<Quad>()) {
                    letter(*quad, command.ClipRect, list._OwnerName, scrolls);
                    i += 6;
                } else {
                    fill({corner(0), corner(1), corner(2)}, command.ClipRect);
                    i += 3;
                }
            }
        }
    }

    template <class Corner>
    std::optional<Quad> quad_of(const ImDrawIdx* index, const Corner& corner) const {
        if (index[3] != index[0] || index[4] != index[2] || index[1] != index[0] + 1 ||
            index[2] != index[0] + 2 || index[5] != index[0] + 3)
            return std::nullopt;
        const std::array corners{corner(0), corner(1), corner(2), corner(5)};
        const ImVec2 low = corners[0].uv, high = corners[2].uv;
        const ImVec2 middle((low.x + high.x) / 2, (low.y + high.y) / 2);
        if (low.x == high.x || low.y == high.y)
            return std::nullopt;
        if (const auto whole = glyphs_.find({low.x, low.y, high.x, high.y}); whole != glyphs_.end())
            return Quad{corners, whole->second, true};
        for (const ImFontGlyph& glyph : font_.Glyphs)
            if (glyph.Visible && middle.x > glyph.U0 && middle.x < glyph.U1 &&
                middle.y > glyph.V0 && middle.y < glyph.V1)
                return Quad{corners, &glyph, false};
        return std::nullopt;
    }

    /// Calls `take` for each pixel of a box whose middle lies in it.
    template <class Take>
    void each_pixel(const ImRect& box, const Take& take) {
        const int left = std::max(0, static_cast<int>(std::ceil(box.Min.x - 0.5f)));
        const int top = std::max(0, static_cast<int>(std::ceil(box.Min.y - 0.5f)));
        for (int y = top; y < height_ && float(y) + 0.5f < box.Max.y; ++y)
            for (int x = left; x < width_ && float(x) + 0.5f < box.Max.x; ++x)
                take(pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                             static_cast<std::size_t>(x)],
                     ImVec2(float(x) + 0.5f, float(y) + 0.5f));
    }

    void fill(const std::array<ImDrawVert, 3>& corners, const ImVec4& clip) {
        const auto side = [](const ImVec2& a, const ImVec2& b, const ImVec2& p) {
            return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        };
        const ImVec2 &a = corners[0].pos, &b = corners[1].pos, &c = corners[2].pos;
        ImRect box(a, a);
        box.Add(b);
        box.Add(c);
        box.ClipWithFull(ImRect(clip));
        const ImU32 color = corners[0].col;
        if (alpha_of(color) == 0 || alpha_of(corners[1].col) == 0 || alpha_of(corners[2].col) == 0)
            return; // the soft edge of a shape
        each_pixel(box, [&](Pixel& pixel, const ImVec2& at) {
            const float u = side(a, b, at), v = side(b, c, at), w = side(c, a, at);
            if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0))
                return;
            pixel.color = over(pixel.color, color);
            if (alpha_of(color) > 0.9) {
                pixel.known = true;
                pixel.text = 0;
            }
        });
    }

    void letter(const Quad& quad, const ImVec4& clip, const char* window, bool scrolls) {
        const ImRect box = quad.box();
        if (!ImRect(clip).Overlaps(box))
            return;
        // A letter that follows another one on its line goes on with its run.
        if (!last_ || std::abs(last_->corners[3].pos.y - quad.corners[3].pos.y) > 14 ||
            box.Min.x < last_->box().Min.x - 1 || box.Min.x > last_->box().Max.x + 12)
            runs_.push_back({.text = {}, .window = window, .box = box, .faults = {}});
        last_ = quad;
        Run& run = runs_.back();
        const std::size_t number = runs_.size() - 1;
        run.text += quad.glyph->Codepoint < 128 ? static_cast<char>(quad.glyph->Codepoint) : '?';
        run.box.Add(box);
        const bool beside = box.Min.x < clip.x - 0.6f || box.Max.x > clip.z + 0.6f;
        const bool above = box.Min.y < clip.y - 0.6f || box.Max.y > clip.w + 0.6f;
        if (beside || ((above || !quad.whole) && !scrolls))
            run.faults.insert(fmt::format(
                "is cut: {:.1f} to {:.1f}, {:.1f} to {:.1f} within {:.1f} to "
                "{:.1f}, {:.1f} to {:.1f}",
                box.Min.x, box.Max.x, box.Min.y, box.Max.y, clip.x, clip.z, clip.y, clip.w));
        ImRect inside = box;
        inside.ClipWithFull(ImRect(clip));
        each_pixel(inside, [&](Pixel& pixel, const ImVec2&) {
            if (!pixel.known)
                run.faults.insert("lies on the picture");
            const double seen = contrast(over(pixel.color, quad.corners[0].col), pixel.color);
            if (pixel.known && seen < least_)
                run.faults.insert(fmt::format("has a contrast of {:.1f}", seen));
        });
        inside.Expand(-0.6f);
        each_pixel(inside, [&](Pixel& pixel, const ImVec2&) {
            if (pixel.text != 0 && pixel.text != number)
                run.faults.insert("overlaps '" + runs_[pixel.text].text + "'");
            pixel.text = number;
            ++run.pixels;
        });
    }

    /// Runs of which something that was drawn later hides a part.
    void find_hidden() {
        std::vector<int> left(runs_.size());
        for (const Pixel& pixel : pixels_)
            ++left[pixel.text];
        for (std::size_t number = 1; number < runs_.size(); ++number)
            if (left[number] > 0 && left[number] < 0.8 * runs_[number].pixels &&
                runs_[number].faults.empty())
                runs_[number].faults.insert(kHidden);
    }

    const ImFont& font_;
    std::map<std::array<float, 4>, const ImFontGlyph*> glyphs_; ///< by their place in the texture
    const double least_;
    const int width_, height_;
    std::vector<Pixel> pixels_;
    std::vector<Run> runs_;
    std::optional<Quad> last_;
};

} // namespace

ReadText read_text(const ImDrawData& data, const ImFont& font, double least) {
    const Painter painter(data, font, least);
    ReadText read{painter.runs().size() - 1, {}};
    for (const Run& run : painter.runs())
        for (const std::string& fault : run.faults)
            read.faults.push_back({run.text, fault, run.window});
    // What lies wholly beyond the edge of its window is not even drawn.
    for (const ImGuiWindow* window : GImGui->Windows)
        if (window->WasActive && !window->Hidden &&
            window->ContentSize.x + 2 * window->WindowPadding.x > window->Size.x + 1)
            read.faults.push_back({"", "is wider than its window", window->Name});
    return read;
}

std::optional<ImVec2> place_of_text(const ImDrawData& data, const ImFont& font, std::string text) {
    std::erase(text, ' '); // no glyph is drawn for it
    std::optional<ImVec2> place;
    const Painter painter(data, font, 0);
    for (const Run& run : painter.runs())
        if (run.text == text)
            place = run.box.GetCenter();
    return place;
}

} // namespace isochron::app
