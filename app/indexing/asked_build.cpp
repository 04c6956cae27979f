// Builds the index that arguments ask for, or appends to it.
#include "app/indexing/asked_build.h"

#include "index/file/index_states.h"
#include "index/indexing/index_build.h"
#include "index/missing_file.h"

#include <fmt/format.h>

#include <new>
#include <system_error>
#include <utility>

namespace isochron::app {
namespace fs = std::filesystem;

AskedBuild::AskedBuild(const BuildArguments& asked, index::Team& team)
    : arguments_(asked), team_(team) {
    if (!asked.append)
        return;
    std::error_code ignored;
    if (!fs::exists(asked.out, ignored))
        throw index::MissingFile(
            "{}: there is no index to append to yet; build it once without --append",
            asked.out.string());
    team_.together([&] { file_.emplace(asked.out, team_.rank() == 0); });
    team_.together([&] {
        held_ = index::IndexFile::open(asked.out);
        if (const auto lost = index::lost_state(*held_))
            throw index::Error(*lost); // appending would overwrite what is left of it
        arguments_ = with_held(asked, *held_);
    });
}

bool AskedBuild::take(BuildSources sources, const std::vector<fs::path>& files) {
    sources_ = std::move(sources);
    if (held_)
        append_sources(sources_, held_, arguments_.out.string());
    options_ = build_options(arguments_, sources_);
    for (std::size_t i = 0; held_ && arguments_.tiers.empty() && i < options_.further.size(); ++i)
        options_.further[i].plan = held_->array(i + 1).plan();
    if (arguments_.refer) {
        options_.referral = referral_to(files, arguments_);
        options_.referral->options.array = sources_.array;
        options_.referral->options.component = sources_.component;
    }
    return sources_.volume != nullptr;
}

std::string AskedBuild::reread() const {
    const std::uint32_t reading = held_ ? held_->metadata().reading_number : index::kReading;
    return reading == index::kReading
               ? std::string()
               : fmt::format("{}: built with reading {} of the files, this program has {}: the "
                             "sources of its {} steps were read again, and are the same",
                             arguments_.out.string(), reading, index::kReading,
                             held_->info().steps());
}

double AskedBuild::bytes() const {
    const index::SeriesInfo& info = sources_.volume->info();
    const std::size_t known = held_ ? held_->info().steps() : 0;
    return static_cast<double>(info.step_bytes()) * static_cast<double>(info.steps() - known);
}

std::string AskedBuild::write(const index::Progress& progress) {
    const std::string reason = held_ ? reason_to_rewrite(*held_, options_) : std::string();
    try {
        if (held_ && reason.empty()) {
            held_ = index::append_index(*sources_.volume, *held_, *file_, arguments_.out, options_,
                                        progress, team_);
            return {};
        }
        held_ = index::build_index(*sources_.volume, arguments_.out, options_, progress, team_);
    } catch (const std::bad_alloc&) {
        throw index::Error("{}: there is not enough memory to build it", arguments_.out.string());
    }
    return reason;
}

} // namespace isochron::app
