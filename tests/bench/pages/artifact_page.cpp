// The part of the page of results on the paper's two sources of error.
#include "tests/bench/pages/artifact_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace isochron::bench {

namespace {

/// The largest share of pixels over all rows of one MaxVariation.
double most(const std::vector<ArtifactRow>& rows, std::uint32_t max_variation,
            double ArtifactRow::* figure) {
    double largest = 0;
    for (const ArtifactRow& row : rows)
        if (row.max_variation == max_variation)
            largest = std::max(largest, row.*figure);
    return largest;
}

std::string summary(const std::vector<ArtifactRow>& rows) {
    std::string text;
    for (const std::uint32_t max_variation : {1u, 2u, 3u})
        text += fmt::format(
            "- MaxVariation {}: kept normals change up to {:.3g} % of the pixels, false positives "
            "up to {:.3g} %.\n",
            max_variation, most(rows, max_variation, &ArtifactRow::normals_changed_percent),
            most(rows, max_variation, &ArtifactRow::false_changed_percent));
    return text +
           "\nFalse positives are no scattered cells: they are the shell that the surface passes "
           "through during a span, so splats of them cover what lies behind. Kept normals light a "
           "surface as it stood in the middle of the span.\n\n";
}

} // namespace

std::string artifact_section(const ArtifactResults& results, const std::string& source) {
    const Header& header = results.header;
    std::string text = fmt::format(
        "\n# Two sources of error, in pixels\n\nMade from `{}`. Measured on {} with commit {}, {}, "
        "on {}.\n\n",
        source, header.date, header.commit, header.compiler, header.processor);
    text += fmt::format(
        "Section 7 of the paper leaves two questions open: what normals that are stored once for a "
        "time span do to the picture, and what the drawing of false positives does. Both are of "
        "the published structure; the tiers of this program have neither. Each row compares "
        "pictures of 512^2 from the camera of the benchmark, over pixels where either shows the "
        "surface, means over every 8th step. *Kept normals*: the angle between the normal in the "
        "middle of a cell's span and that of the step on screen, and what it does to pixels: the "
        "mean and the 99th percentile of the difference of the color channel that differs most, "
        "of 255, and the share of pixels that change by more than {}. *False positives*: cells "
        "found in addition, in percent of the active ones, and the same of pixels when they are "
        "drawn.\n\n",
        PixelDifference::kVisible);
    text += summary(results.rows);
    text += "| series | footprint | L | MaxVariation | angle mean | 99 % | kept normals: mean | "
            "99 % | pixels changed | false positives | drawn: mean | 99 % | pixels changed |\n"
            "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const ArtifactRow& row : results.rows)
        text += fmt::format(
            "| {} | {} | {} | {} | {:.3g} deg | {:.3g} deg | {:.3g} | {:.3g} | {:.3g} % | {:.3g} % "
            "| {:.3g} | {:.3g} | {:.3g} % |\n",
            row.data, row.footprint, row.l, row.max_variation, row.angle_mean, row.angle_p99,
            row.normals_mean, row.normals_p99, row.normals_changed_percent,
            row.false_positive_percent, row.false_mean, row.false_p99, row.false_changed_percent);
    for (const char* data : {"sphere", "vorticity64"})
        text += fmt::format(
            "\n![Exact normals, kept normals, difference](pictures/{0}_kept_normals.png)\n\n"
            "*{0}, ShellSplatting, L 32, MaxVariation 3: exact normals, normals kept over spans, "
            "and their difference, four times as bright.*\n\n"
            "![Without, with false positives, difference](pictures/{0}_false_positives.png)\n\n"
            "*The same without and with false positives, and the difference.*\n",
            data);
    return text;
}

} // namespace isochron::bench
