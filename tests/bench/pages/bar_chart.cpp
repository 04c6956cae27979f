// Charts of a few horizontal bars, as SVG.
#include "tests/bench/pages/bar_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace isochron::bench {
namespace {

constexpr double kWidth = 720, kLabels = 290, kValues = 100, kRow = 26, kTop = 48, kBottom = 16;
constexpr std::string_view kOurs = "#1f6f8b", kOthers = "#a3adb5", kInk = "#22282d";

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else
            result += c;
    return result;
}

/// Lengths of bars in pixels. A logarithmic scale begins a little below the smallest value, so that
/// every bar is seen.
class Scale {
  public:
    explicit Scale(const BarChart& chart) : logarithmic_(chart.logarithmic) {
        most_ = std::max(chart.mark, 0.0);
        double least = HUGE_VAL;
        for (const Bar& bar : chart.bars) {
            most_ = std::max(most_, bar.value);
            least = bar.value > 0 ? std::min(least, bar.value) : least;
        }
        low_ = std::isfinite(least) ? least / 2 : 1;
    }

    double length(double value) const {
        constexpr double kMost = kWidth - kLabels - kValues;
        if (value <= 0 || most_ <= 0)
            return 0;
        return kMost *
               (logarithmic_ ? std::log(value / low_) / std::log(most_ / low_) : value / most_);
    }

  private:
    bool logarithmic_;
    double most_ = 0, low_ = 1;
};

} // namespace

std::string svg_of(const BarChart& chart) {
    const Scale scale(chart);
    const double height = kTop + kRow * static_cast<double>(chart.bars.size()) + kBottom;
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
        "height=\"{1}\" role=\"img\" font-family=\"sans-serif\" font-size=\"13\">\n"
        "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" rx=\"6\" fill=\"#ffffff\"/>\n"
        "<text x=\"16\" y=\"26\" font-size=\"15\" font-weight=\"bold\" fill=\"{3}\">{2}</text>\n",
        kWidth, height, escaped(chart.title), kInk);
    if (chart.mark >= 0) {
        const double x = kLabels + scale.length(chart.mark);
        text +=
            fmt::format("<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" "
                        "stroke=\"#b0452b\" stroke-dasharray=\"4 3\"/>\n"
                        "<text x=\"{3:.1f}\" y=\"{4}\" text-anchor=\"end\" font-size=\"12\" "
                        "fill=\"#b0452b\">{5}</text>\n",
                        x, kTop - 8, height - kBottom, x - 5, kTop - 5, escaped(chart.mark_text));
    }
    for (std::size_t i = 0; i < chart.bars.size(); ++i) {
        const Bar& bar = chart.bars[i];
        const double y = kTop + kRow * static_cast<double>(i), length = scale.length(bar.value);
        text += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"{}\">{}</text>\n"
                            "<rect x=\"{}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\" fill=\"{}\"/>\n"
                            "<text x=\"{:.1f}\" y=\"{}\" fill=\"{}\" stroke=\"#ffffff\" "
                            "stroke-width=\"4\" paint-order=\"stroke\">{}</text>\n",
                            kLabels - 10, y + 16, kInk, escaped(bar.label), kLabels, y + 3, length,
                            kRow - 8, bar.ours ? kOurs : kOthers, kLabels + length + 8, y + 16,
                            kInk, escaped(bar.text));
    }
    return text + "</svg>\n";
}

} // namespace isochron::bench
