// Writes the demo data as files.
#include "app/generate/demo_series.h"

#include "index/error.h"
#include "index/readers/formats/series/series_writer.h"
#include "index/system/input_file.h"
#include "index/system/new_file.h"

#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <system_error>

namespace isochron::app {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json recipe_of(const SphereSeries& series) {
    return {
        {"series", series.kName}, {"type", index::name_of(series.type)}, {"steps", series.steps}};
}

json recipe_of(const VorticitySeries& series) {
    return {{"series", series.kName},
            {"seed", series.seed},
            {"type", index::name_of(series.type)},
            {"size", series.size},
            {"steps", series.steps},
            {"viscosity", series.kViscosity},
            {"spectrum_peak", series.kPeak},
            {"first_enstrophy", series.kFirstEnstrophy},
            {"time_step", static_cast<double>(series.kSubsteps) * series.substep()}};
}

json recipe_of(const FourierSeries& series) {
    json recipe{{"series", series.kName},
                {"seed", series.seed},
                {"type", index::name_of(series.type)},
                {"size", series.size},
                {"steps", series.steps}};
    // Only if they differ from the defaults: earlier versions had no choice and did not note them.
    if (const FourierSeries usual; series.modes != usual.modes || series.longest != usual.longest) {
        recipe["modes"] = series.modes;
        recipe["longest"] = series.longest;
    }
    return recipe;
}

/// The files of a series, with the note (`recipe`) that says how it was made.
struct Destination {
    fs::path dir;
    std::string name;
    json recipe;

    fs::path note() const { return dir / (name + ".json"); }

    fs::path pvd() const { return dir / (name + ".pvd"); }

    /// Whether the note is there and says that this series was made, or was about to be.
    bool is_noted() const {
        constexpr std::uint64_t kMost = 1 << 20;
        std::error_code ignored;
        return fs::is_regular_file(note(), ignored) && fs::file_size(note(), ignored) <= kMost &&
               json::parse(index::read_text(note(), kMost), nullptr, false) == recipe;
    }

    /// Whether the series exists already. The .pvd is written last, so if it is there, all files
    /// are.
    /// @throws Error when it exists with another recipe, unless `force` is set
    bool complete(bool force) const {
        std::error_code ignored;
        if (!fs::exists(pvd(), ignored))
            return false;
        if (is_noted())
            return true;
        if (force)
            return false;
        throw index::Error("{}: is another series than {}; remove it or choose another folder, or "
                           "--force replaces it",
                           pvd().string(), recipe.dump());
    }

    /// @throws Error when a file that would be written is there, and nothing says that it is of this
    /// series
    void refuse_foreign_files(std::size_t steps) const {
        if (is_noted())
            return;
        refuse(note());
        for (std::size_t step = 0; step < steps; ++step)
            refuse(dir / index::SeriesWriter::file_of(name, step));
    }

    static void refuse(const fs::path& file) {
        std::error_code ignored;
        if (fs::exists(file, ignored))
            throw index::Error(
                "{}: exists and is not of this series: expected a new name; --force replaces it",
                file.string());
    }

    void write_note() const {
        const std::string text = recipe.dump(2) + "\n";
        index::write_file(note(), text);
    }
};

template <class Series>
bool generate_files(const Series& series, const fs::path& dir, const index::Progress& progress,
                    bool force) {
    const Destination destination{dir, series.kName, recipe_of(series)};
    if (destination.complete(force))
        return false;
    if (!force)
        destination.refuse_foreign_files(static_cast<std::size_t>(series.steps));
    index::SeriesWriter writer(dir, destination.name, describe(series));
    make_steps(
        series,
        [&](std::span<const std::byte> values, double time) { writer.append(values, time); },
        progress);
    destination.write_note();
    writer.finish();
    return true;
}

} // namespace

bool generate(const SphereSeries& series, const fs::path& dir, const index::Progress& progress,
              bool force) {
    return generate_files(series, dir, progress, force);
}

bool generate(const VorticitySeries& series, const fs::path& dir, const index::Progress& progress,
              bool force) {
    return generate_files(series, dir, progress, force);
}

bool generate(const FourierSeries& series, const fs::path& dir, const index::Progress& progress,
              bool force) {
    return generate_files(series, dir, progress, force);
}

} // namespace isochron::app
