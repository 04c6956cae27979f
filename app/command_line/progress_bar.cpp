// Shows the progress of long work on the terminal.
#include "app/command_line/progress_bar.h"

#include "app/safe_text.h"
#include "app/telling.h"
#include "app/text.h"

#include <fmt/format.h>

#include <algorithm>

#include <unistd.h>

namespace isochron::app {

ProgressBar::ProgressBar(std::FILE* out, double bytes, Of of)
    : out_(out), terminal_(isatty(fileno(out)) == 1), bytes_(bytes), of_(of) {}

ProgressBar::~ProgressBar() {
    if (terminal_ && !phase_.empty())
        std::fputc('\n', out_);
}

void ProgressBar::show(std::string_view name, double fraction) {
    if (!tells(Telling::usual))
        return;
    const std::string phase = one_line(name);
    const bool new_phase = phase != phase_;
    const int percent = static_cast<int>(100.0 * std::clamp(fraction, 0.0, 1.0));
    if (!new_phase && (percent == percent_ || !terminal_))
        return;
    const auto now = std::chrono::steady_clock::now();
    const bool new_bar = new_phase && (of_ == Of::phase || phase_.empty());
    if (new_bar)
        start_ = now;
    std::string text;
    if (!terminal_) {
        text = phase + " ...\n";
    } else {
        constexpr int kWidth = 24;
        text = fmt::format(
            "{}\r{:<16} [{:<{}}] {:3} %", new_bar && !phase_.empty() ? "\n" : "", phase,
            std::string(static_cast<std::size_t>(percent * kWidth / 100), '#'), kWidth, percent);
        const std::chrono::duration<double> elapsed = now - start_;
        if (fraction > 0 && elapsed.count() > 0.2) {
            if (bytes_ > 0)
                text += fmt::format("  {}/s", human_bytes(bytes_ * fraction / elapsed.count()));
            text += fmt::format("  {} left", human_time(elapsed * (1 - fraction) / fraction));
        }
        text += "\033[K"; // the line before may have been longer
    }
    // Where nothing can be shown, as on a full disk or a terminal that is gone, the work goes on.
    std::fwrite(text.data(), 1, text.size(), out_);
    std::fflush(out_);
    phase_ = phase;
    percent_ = percent;
}

index::Progress ProgressBar::progress() {
    return [this](std::string_view phase, double fraction) { show(phase, fraction); };
}

} // namespace isochron::app
