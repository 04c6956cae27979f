// Every way to tell a command where to write.
#pragma once

#include "tests/support/as_words.h"

#include <ostream>
#include <string>
#include <vector>

namespace isochron::app {

/// When an output of an earlier run is replaced.
enum class Replaced { unasked, by_force };

/// One option, or argument, by which a command is told where to write.
struct Way {
    std::string page, option;         ///< as the manual pages call them
    std::vector<std::string> command; ///< OUT stands for the output
    std::string out, file;            ///< what OUT is; the file that is written then
    Replaced replaced;
    std::vector<std::string> read = {}; ///< files that are read, also by way of the index
    bool any_by_force = true;           ///< with --force any other file is replaced, too
};

inline std::ostream& operator<<(std::ostream& out, const Way& way) {
    return out << way.page << ' ' << way.option << ' ' << way.out;
}

/// Run where an index of t0.raw to t2.raw, a recording on it, a picture and a .pvx file lie.
inline std::vector<Way> ways() {
    const std::vector<std::string> explore =
        as_words("explore a.isochron --size 64 48 --no-panel --seconds 0.1");
    const auto exploring = [&](const std::string& option) {
        std::vector<std::string> command = explore;
        command.insert(command.end(), {option, "OUT"});
        return command;
    };
    const std::vector<std::string> values{"a.isochron", "t0.raw", "t2.raw"};
    const std::vector<std::string> replayed{"a.isochron", "t1.raw", "walk.jsonl"};
    return {
        {"build",
         "--output",
         as_words("build t?.raw --dims 8 8 8 --type f32 -o OUT"),
         "new.isochron",
         "new.isochron",
         Replaced::unasked,
         {"t0.raw", "t2.raw"}},
        {"query", "--output", as_words("query a.isochron --isovalue 50 --step 1 -o OUT"), "ids.bin",
         "ids.bin", Replaced::unasked, values},
        {"change", "--added",
         as_words("change a.isochron --isovalue 50 --step 0 --to-step 1 --added OUT"), "added.bin",
         "added.bin", Replaced::unasked, values},
        {"change", "--removed",
         as_words("change a.isochron --isovalue 50 --step 0 --to-step 1 --removed OUT"),
         "removed.bin", "removed.bin", Replaced::unasked, values},
        {"export", "--output",
         as_words("export a.isochron --isovalue 50 --steps 1 --format ply -o OUT"), "surface.ply",
         "surface.ply", Replaced::by_force, values},
        {"export", "--output", as_words("export a.isochron --isovalue 50 --format vtp -o OUT"),
         "surfaces/", "surfaces/a_0001.vtp", Replaced::by_force},
        {"table",
         "--output",
         as_words("table walk.jsonl -o OUT"),
         "marks.csv",
         "marks.csv",
         Replaced::by_force,
         {"walk.jsonl"}},
        {"measure", "--output", as_words("measure a.isochron --isovalue 50 -o OUT"), "measures.csv",
         "measures.csv", Replaced::by_force, values},
        {"replay", "--report", as_words("replay walk.jsonl --report OUT"), "report.json",
         "report.json", Replaced::unasked, replayed},
        {"replay", "--output", as_words("replay walk.jsonl --every 2 --out OUT"), "shots",
         "shots/frame_00002.png", Replaced::unasked},
        {"replay", "--output",
         as_words("replay walk.jsonl --test-pattern --every 2 --format exr --out OUT"), "patterns",
         "patterns/frame_00002.exr", Replaced::unasked},
        {"reproduce",
         "--output",
         as_words("reproduce shown/frame_00002.png --data a.isochron -o OUT"),
         "again.png",
         "again.png",
         Replaced::unasked,
         {"shown/frame_00002.png", "a.isochron", "t0.raw"}},
        {"figure",
         "--output",
         as_words("figure figure.toml -o OUT"),
         "figure.pdf",
         "figure.pdf",
         Replaced::unasked,
         {"figure.toml", "a.isochron"}},
        {"movie", "--output", as_words("movie walk.jsonl --rate 2 -o OUT"), "walk.mp4", "walk.mp4",
         Replaced::by_force, replayed},
        {"movie", "--output", as_words("movie walk.jsonl --rate 2 -o OUT"), "frames",
         "frames/frame_00001.png", Replaced::by_force},
        {"config-import",
         "--output",
         as_words("config import cave.pvx -o OUT"),
         "cave.toml",
         "cave.toml",
         Replaced::unasked,
         {"cave.pvx"}},
        {"explore", "--record", exploring("--record"), "new.jsonl", "new.jsonl", Replaced::by_force,
         values, false},
        {"explore", "--report", exploring("--report"), "times.json", "times.json",
         Replaced::unasked, values},
        {"explore", "--session", exploring("--session"), "s.isochron-session", "s.isochron-session",
         Replaced::unasked, values},
        {"generate-sphere", "--output", as_words("generate sphere --steps 2 -o OUT"), "sphere",
         "sphere/sphere_0001.vti", Replaced::unasked},
        {"manual", "--output", as_words("manual -o OUT"), "man", "man/isochron.1",
         Replaced::unasked},
    };
}

} // namespace isochron::app
