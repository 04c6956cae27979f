// Writes tables of what building costs, of what a set at hand saves, and of moments between steps.
#include "tests/bench/pages/change_page.h"

#include "index/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace isochron::bench {
namespace {

/// @param f makes the section of an object
template <class F>
std::string section_of(const std::string& json, const std::string& path, F&& f) {
    try {
        return f(nlohmann::json::parse(json));
    } catch (const nlohmann::json::exception& error) {
        throw index::Error(fmt::format("{}: {}", path, error.what()));
    }
}

std::string text_of(const nlohmann::json& object, const char* key) {
    return object.at(key).get<std::string>();
}

} // namespace

std::string building_section(const std::string& json, const std::string& path) {
    return section_of(json, path, [&](const nlohmann::json& all) {
        std::string text = fmt::format(
            "\n# Building by type, measured\n\n"
            "From `{}`, which `./run bench building --json` wrote: one step of {}^3 in memory, "
            "with "
            "bricks and all levels of detail; commit {}, {}. Times are of processors. Goal 1.5 "
            "times "
            "`zstd -1` of the same bytes, floor 2.5. Noise of 16 bits does not shrink, which zstd "
            "sees without looking at all of it: statistics, bricks, levels of detail and checksums "
            "look at each value, so no building comes near that.\n\n"
            "| values | index / data | zstd -1 / data | building, ms | zstd -1, ms | ratio |\n"
            "|---|---|---|---|---|---|\n",
            path, all.at("size").get<int>(), text_of(all, "commit"), text_of(all, "processor"));
        for (const nlohmann::json& row : all.at("rows"))
            text += fmt::format(
                "| {} | {:.3f} | {:.3f} | {:.1f} | {:.1f} | {:.2f} |\n", text_of(row, "what"),
                row.at("index_over_data").get<double>(), row.at("zstd_over_data").get<double>(),
                1e3 * row.at("build_seconds").get<double>(),
                1e3 * row.at("zstd_seconds").get<double>(), row.at("over_zstd").get<double>());
        return text;
    });
}

std::string change_section(const std::string& json, const std::string& path) {
    return section_of(json, path, [&](const nlohmann::json& all) {
        std::string text = fmt::format(
            "\n# What stays, measured\n\n"
            "From `{}`, which `./run bench change --json` wrote: a set from a set that is at hand, "
            "over "
            "the same set made anew; commit {}, {}, load of the machine {}. Processor times, from "
            "the "
            "question to the set that {}. *first*: nothing of the step has been "
            "decoded; "
            "*again*: it has been looked at before, with both isovalues twenty times where these "
            "move. "
            "*anew*: right after the other set; *alone*: where nothing of the step before has been "
            "decoded. Planes and triangles depend on the isovalue: where it moves, they are made "
            "anew, "
            "and only searching and the volume around the cells cost less. At a first look, *anew* "
            "is "
            "the second look at that step, which decodes all of it: that is why it takes longer "
            "than "
            "*alone*. Floors that are not met are limits: [LIMITS.md](LIMITS.md#measured-limits) "
            "has "
            "the reasons. *colored*: by a second "
            "array, whose "
            "chunks change where those of the first do. *sphere-55*: the moving sphere of 61 x 50 "
            "x 60 "
            "vertices of u8 over 55 steps, its index with cells and deltas, as `--tiers` asks for "
            "them.\n\n"
            "| change | set | look | cells | from the set at hand, ms | / anew | / alone | floor "
            "|\n"
            "|---|---|---|---|---|---|---|---|\n",
            path, text_of(all, "commit"), text_of(all, "processor"), text_of(all, "load"),
            all.value("until", "is handed over"));
        for (const nlohmann::json& row : all.at("rows"))
            text += fmt::format("| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n",
                                text_of(row, "what"), text_of(row, "use"),
                                row.at("again").get<bool>() ? "again" : "first",
                                row.at("cells").get<std::size_t>(), row.at("kept_ms").get<double>(),
                                row.at("over_anew").get<double>(),
                                row.at("over_alone").get<double>(), row.at("floor").get<double>());
        return text;
    });
}

std::string between_section(const std::string& json, const std::string& path) {
    return section_of(json, path, [&](const nlohmann::json& all) {
        std::string text = fmt::format(
            "\n# Between two steps, measured\n\n"
            "From `{}`, which `./run bench between --json` wrote: the surface of the blend of two "
            "steps beside that of a step, and beside `vtkTemporalInterpolator` with flying edges "
            "and "
            "normals, on one thread; {}, three steps of f32; commit {}, {}, load of the machine "
            "{:.1f}. Times are processor times of all threads, medians, in turn, with both steps "
            "decoded: cells with planes and normals. Where the picture plays, it does so at a "
            "tenth "
            "of the speed: the picture before a step, the step's and the one after it, over the "
            "median of the pictures around.\n\n"
            "| what | measured | goal | floor |\n"
            "|---|---|---|---|\n",
            path, text_of(all, "data"), text_of(all, "commit"), text_of(all, "processor"),
            all.at("load").get<double>());
        const auto bound = [](double of) { return of == 0 ? "" : fmt::format("{:g}", of); };
        for (const nlohmann::json& row : all.at("rows"))
            text += fmt::format("| {} | {:.4g} | {} | {} |\n", text_of(row, "what"),
                                row.at("figure").get<double>(), bound(row.at("goal").get<double>()),
                                bound(row.at("floor").get<double>()));
        return text;
    });
}

} // namespace isochron::bench
