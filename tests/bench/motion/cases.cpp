// Plays the cases of the motion benchmark.
#include "tests/bench/motion/cases.h"

#include "app/config/shipped_configs.h"
#include "stereo/context/gl_context.h"
#include "tests/bench/motion/likeness.h"
#include "tests/bench/motion/own_display.h"
#include "tests/bench/motion/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace isochron::bench {
namespace {

const std::vector<Motion> kAllMotions{Motion::sway, Motion::walk_in, Motion::orbit, Motion::scrub,
                                      Motion::jump_on};

app::Config config_of(const MotionCase& of) {
    // In a square picture of a desktop's window the data would be small.
    const bool square = of.size.x / of.eyes == of.size.y;
    const char* name = square ? "headless" : "desktop";
    app::Config config = app::parse_config(*app::shipped_config(name), name);
    stereo::Window& window = config.installation.windows.front();
    window.size = of.size;
    window.stereo = of.eyes == 2 ? stereo::StereoMode::side_by_side : stereo::StereoMode::mono;
    if (!of.window)
        config.rendering.context = stereo::ContextKind::egl;
    return config;
}

app::Config with_budget(app::Config config, double budget_ms) {
    config.quality.frame_budget_ms = budget_ms;
    config.rendering.frame_rate_limit = static_cast<float>(1e3 / budget_ms);
    return config;
}

/// Likeness of all pictures of a motion: means, and the worst.
struct Likenesses {
    std::vector<Likeness> all;

    double mean(double Likeness::* figure) const {
        double sum = 0;
        for (const Likeness& each : all)
            sum += each.*figure;
        return all.empty() ? 0 : sum / static_cast<double>(all.size());
    }
    void fill(MotionRow& row) const {
        row.pictures = all.size();
        row.lit = mean(&Likeness::lit);
        row.overlap = mean(&Likeness::overlap);
        row.luminance_off = mean(&Likeness::luminance_off);
        row.luminance_shift = mean(&Likeness::luminance_shift);
        row.block_lit_off = mean(&Likeness::block_lit_off);
        row.block_light_off = mean(&Likeness::block_light_off);
        row.specks = mean(&Likeness::specks);
        row.pixels_off = mean(&Likeness::pixels_off);
        row.lit_worst = row.overlap_worst = 1;
        for (const Likeness& each : all) {
            if (std::abs(each.lit - 1) > std::abs(row.lit_worst - 1))
                row.lit_worst = each.lit;
            row.overlap_worst = std::min(row.overlap_worst, each.overlap);
            row.luminance_worst = std::max(row.luminance_worst, each.luminance_off);
        }
        row.recognizable = all.empty()
                               ? 0
                               : static_cast<double>(std::ranges::count_if(all, is_recognizable)) /
                                     static_cast<double>(all.size());
    }
};

ComparedMotion compared(Played played, References& references) {
    ComparedMotion compared{std::move(played.row), {}, {}};
    Likenesses likenesses;
    double least = 2;
    for (const ShownPicture& picture : played.moving) {
        const Reference& reference = references.wanted(picture);
        for (std::size_t eye = 0; eye < picture.eyes.size(); ++eye) {
            const Likeness like =
                likeness(picture.eyes[eye], reference.settled[eye], reference.without[eye]);
            likenesses.all.push_back(like);
            if (like.overlap < least) {
                least = like.overlap;
                compared.moving = picture.eyes[eye];
                compared.settled = reference.settled[eye];
            }
        }
    }
    likenesses.fill(compared.row);
    const Reference& end = references.wanted(played.stopped);
    compared.row.left_off =
        likeness(played.stopped.eyes.front(), end.settled.front(), end.without.front()).pixels_off;
    return compared;
}

/// Mean color of the pixels of `from` that a pixel of a smaller picture stands for.
void shrink(const render::Image& from, render::Image& into, int left, int top, int width,
            int height) {
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int x0 = x * from.width / width,
                      x1 = std::max((x + 1) * from.width / width, x0 + 1);
            const int y0 = y * from.height / height,
                      y1 = std::max((y + 1) * from.height / height, y0 + 1);
            int sum[3]{};
            for (int v = y0; v < y1; ++v)
                for (int u = x0; u < x1; ++u)
                    for (int c = 0; c < 3; ++c)
                        sum[c] += from.at(u, v)[c];
            std::uint8_t* out =
                &into.rgba[4 * (static_cast<std::size_t>(top + y) * into.width + left + x)];
            for (int c = 0; c < 3; ++c)
                out[c] = static_cast<std::uint8_t>(sum[c] / ((x1 - x0) * (y1 - y0)));
            out[3] = 255;
        }
}

} // namespace

std::vector<MotionCase> cases_of(const CaseOptions& options) {
    constexpr std::string_view kInWindow[]{"demo", "192", "256"};
    const std::vector<std::string> in_squares{"demo", "192", "256", "512", "tubes"};
    std::vector<MotionCase> cases;
    const auto add = [&](MotionCase of) {
        if (!options.motions.empty())
            std::erase_if(of.motions, [&](Motion motion) {
                return std::ranges::find(options.motions, motion) == options.motions.end();
            });
        if (!options.budgets.empty())
            std::erase_if(of.budgets, [&](double budget) {
                return std::ranges::find(options.budgets, budget) == options.budgets.end();
            });
        if (!of.motions.empty() && !of.budgets.empty())
            cases.push_back(std::move(of));
    };
    for (const MovedData& data : moved_data()) {
        if (std::ranges::find(options.data, data.name) == options.data.end() ||
            (data.large && !options.full))
            continue;
        add({.data = data, .budgets = {33}, .motions = kAllMotions});
        if (std::ranges::find(in_squares, data.name) != in_squares.end())
            add({.data = data,
                 .size = {1024, 1024},
                 .budgets = {8.3, 16.7, 33, 100},
                 .motions = {Motion::sway, Motion::walk_in}});
        const auto in_window = std::ranges::find(kInWindow, data.name);
        if (in_window != std::end(kInWindow))
            add({.data = data,
                 .budgets = {kBudgetOfWindow},
                 .motions = data.name == "192"
                                ? std::vector{Motion::sway, Motion::orbit, Motion::scrub}
                            : data.name == "demo" // what a hand does, from input to picture
                                ? std::vector{Motion::orbit, Motion::scrub, Motion::jump_on}
                                : std::vector{Motion::orbit},
                 .window = true});
        if (data.name == "192")
            add({.data = data,
                 .size = {1920, 960},
                 .eyes = 2,
                 .budgets = {33},
                 .motions = {Motion::sway, Motion::walk_in}});
    }
    return cases;
}

std::vector<ComparedMotion> play_case(const MotionCase& of, const std::filesystem::path& kept,
                                      const PlayOptions& options,
                                      const std::function<void()>& check,
                                      const index::Progress& progress) {
    const auto file = open_moved(of.data, kept, progress);
    PlayOptions own = options;
    if (of.data.large) // two pictures of each motion
        own.every = own.seconds / 3 * 1.001;
    const app::Config config = config_of(of);
    std::optional<OwnDisplay> display;
    if (of.window)
        display.emplace();
    References references(config, file, check);
    std::vector<Played> all;
    for (const double budget : of.budgets) {
        const auto context = stereo::make_context(
            config.rendering.context,
            {.size = config.installation.windows.front().size, .vsync = of.window});
        Player player(of.window ? config : with_budget(config, budget), file, *context, own, check);
        app::ExplorerState start = shown_of(of.data, player.session().state());
        start.panel = of.window;
        for (const Motion motion : of.motions) {
            progress(fmt::format("{} {}", of.data.name, name_of(motion)), 0);
            Played played = player.play(motion, start);
            played.row.data = of.data.name;
            played.row.place = of.window ? "window" : "windowless";
            played.row.width = of.size.x / of.eyes;
            played.row.height = of.size.y;
            played.row.eyes = of.eyes;
            if (!of.window)
                played.row.budget_ms = budget;
            for (const ShownPicture& picture : played.moving)
                references.wanted(picture);
            references.wanted(played.stopped);
            all.push_back(std::move(played));
        }
    }
    progress(fmt::format("{} settled pictures", of.data.name), 0);
    references.make();
    std::vector<ComparedMotion> motions;
    for (Played& played : all)
        motions.push_back(compared(std::move(played), references));
    return motions;
}

render::Image sheet_of(const std::vector<ComparedMotion>& motions, int width) {
    render::Image sheet;
    if (motions.empty())
        return sheet;
    const render::Image& first = motions.front().settled;
    const int height = width * first.height / first.width;
    constexpr int kGap = 4;
    sheet.width = static_cast<int>(motions.size()) * (width + kGap) - kGap;
    sheet.height = 2 * height + kGap;
    sheet.rgba.assign(4 * static_cast<std::size_t>(sheet.width) * sheet.height, 255);
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const int left = static_cast<int>(i) * (width + kGap);
        shrink(motions[i].moving, sheet, left, 0, width, height);
        shrink(motions[i].settled, sheet, left, height + kGap, width, height);
    }
    return sheet;
}

render::Image stacked(const std::vector<render::Image>& sheets) {
    constexpr int kGap = 12;
    render::Image all;
    for (const render::Image& sheet : sheets) {
        all.width = std::max(all.width, sheet.width);
        all.height += (all.height > 0 ? kGap : 0) + sheet.height;
    }
    all.rgba.assign(4 * static_cast<std::size_t>(all.width) * all.height, 255);
    int top = 0;
    for (const render::Image& sheet : sheets) {
        for (int y = 0; y < sheet.height; ++y)
            std::copy_n(sheet.at(0, y), 4 * static_cast<std::size_t>(sheet.width),
                        &all.rgba[4 * static_cast<std::size_t>(top + y) * all.width]);
        top += sheet.height + kGap;
    }
    return all;
}

} // namespace isochron::bench
