// A command that all processes of a cluster's job run.
#include "app/explore/cluster_job.h"

#include "app/cluster/processor_shares.h"
#include "app/cluster/shared_frames.h"
#include "app/command_line/cancel.h"
#include "app/command_line/subcommands.h"
#include "app/config/display_config_text.h"
#include "app/end_in_time.h"
#include "app/telling.h"
#include "app/version.h"
#include "interaction/recording/commands_json.h"
#include "render/gl/driver.h"
#include "stereo/context/raster_threads.h"
#include "stereo/nodes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace isochron::app {
namespace {

using nlohmann::json;

/// A process that only follows has no end of its own: a signal ends the job, at once, as taking a
/// session apart may take longer than the others wait for a sign of life.
void obey_signals(stereo::Cluster& cluster) {
    const int signal = CancelOnSignal::received();
    if (signal == 0)
        return;
    // Where one process was lost, mpirun ends the others: the loss has been told by its name.
    if (const char* const name = ::sigabbrev_np(signal); !CancelOnSignal::sent_by_the_launcher())
        print_safely(stderr, "isochron: {}: ended by SIG{}\n", cluster.name_of(cluster.rank()),
                     name ? name : "NAL");
    cluster.abandon(Canceled(signal).status);
}

/// Where two facts first differ, and what each says there.
struct FactDifference {
    std::string field; ///< empty if the facts are plain texts
    std::string here, there;
};

/// Cuts a long line to a part around its first difference. @param common equal characters before it
std::string excerpt(const std::string& line, std::size_t common) {
    constexpr std::size_t kLongest = 80, kBefore = 20;
    const std::size_t from = line.size() <= kLongest || common <= kBefore ? 0 : common - kBefore;
    return (from > 0 ? "..." : "") + line.substr(from, kLongest);
}

/// The first line in which two texts differ, from each text.
FactDifference difference_of_texts(const std::string& a, const std::string& b) {
    std::istringstream lines_a(a), lines_b(b);
    std::string line_a, line_b;
    bool more_a = true, more_b = true;
    while (more_a && more_b && line_a == line_b) {
        more_a = static_cast<bool>(std::getline(lines_a, line_a));
        more_b = static_cast<bool>(std::getline(lines_b, line_b));
    }
    const auto common =
        static_cast<std::size_t>(std::ranges::mismatch(line_a, line_b).in1 - line_a.begin());
    return {"", more_a ? excerpt(line_a, common) : "its end",
            more_b ? excerpt(line_b, common) : "its end"};
}

/// The first field in which two JSON objects differ, with both values.
FactDifference first_difference(const std::string& a, const std::string& b) {
    const json here = json::parse(a, nullptr, false), there = json::parse(b, nullptr, false);
    if (!here.is_object() || !there.is_object())
        return difference_of_texts(a, b);
    const json changes = json::diff(here, there);
    if (changes.empty())
        return difference_of_texts(a, b);
    const std::string path = changes.front().at("path");
    const json::json_pointer field(path);
    const auto value = [&](const json& of) {
        return of.contains(field) ? excerpt(of.at(field).dump(), 0) : std::string("nothing");
    };
    return {path.substr(1), value(here), value(there)};
}

/// Shows each frame that rank 0 orders, until there are no more.
template <typename Shown>
void each_order(stereo::Cluster& cluster, Shown& shown, const FrameDone& done,
                const std::function<void(const FrameOrder&, const Latch&)>& show) {
    for (std::size_t number = 0; auto order = shown.frames().next(); ++number) {
        obey_signals(cluster);
        shown.outputs().windows().poll_events();
        show(
            *order, order->latched.devices.empty() ? Latch{} : [&order] { return order->latched; });
        if (done)
            done(number, {std::move(order->input),
                          std::move(order->commands),
                          {},
                          {},
                          std::move(order->latched)});
    }
}

} // namespace

void ClusterJob::together(const std::function<void()>& part) {
    try {
        cluster_.together([&] {
            try {
                part();
            } catch (const std::exception& error) {
                if (leads())
                    throw;
                throw std::runtime_error(
                    fmt::format("{}: {}", cluster_.name_of(cluster_.rank()), error.what()));
            }
        });
    } catch (const stereo::ProcessLost&) {
        throw;
    } catch (const std::exception&) {
        over_ = true;
        if (!leads())
            throw ReportedElsewhere();
        throw;
    }
}

void ClusterJob::require_same(const Facts& facts) {
    const std::string mine =
        nlohmann::json(facts).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    const auto all = cluster_.gather(std::as_bytes(std::span(mine)));
    together([&] {
        if (!leads())
            return;
        for (unsigned rank = 1; rank < all.size(); ++rank) {
            const auto* text = reinterpret_cast<const char*>(all[rank].data());
            const auto theirs = nlohmann::json::parse(text, text + all[rank].size()).get<Facts>();
            for (std::size_t i = 0; i < facts.size(); ++i) {
                if (theirs.at(i) == facts[i])
                    continue;
                const FactDifference found = first_difference(facts[i].second, theirs.at(i).second);
                throw std::runtime_error(fmt::format(
                    "{}: another {}: {}'{}', process 0 has '{}'", cluster_.name_of(rank),
                    facts[i].first, found.field.empty() ? "" : found.field + " is ", found.there,
                    found.here));
            }
        }
    });
}

void ClusterJob::share_frames(Session& session) {
    if (size() > 1)
        session.share_frames(std::make_unique<SharedFrames>(cluster_));
}

void ClusterJob::share_frames(PatternShow& show) {
    if (size() > 1)
        show.share_frames(std::make_unique<SharedFrames>(cluster_));
}

void ClusterJob::follow(Session& session, const FrameDone& done) {
    each_order(cluster_, session, done, [&](const FrameOrder& order, const Latch& latch) {
        session.frame(order.input, order.commands, order.waiting, latch);
    });
}

void ClusterJob::follow(PatternShow& show, const FrameDone& done) {
    each_order(cluster_, show, done, [&](const FrameOrder& order, const Latch& latch) {
        show.frame(order.input, order.commands, latch);
    });
}

void ClusterJob::tell_shared_processors(const render::Gl& gl) {
    if (size() == 1)
        return;
    const stereo::RasterThreads mine = stereo::raster_threads();
    // Without threads of its own, the driver draws on the thread that gives the commands.
    const std::size_t threads =
        render::draws_in_software(gl) ? std::max<std::size_t>(mine.threads, 1) : 0;
    const std::string text = json{{"processors", mine.processors}, {"threads", threads}}.dump();
    std::vector<ProcessorShare> shares;
    for (const auto& told : cluster_.gather(std::as_bytes(std::span(text)))) {
        const json share = json::parse(reinterpret_cast<const char*>(told.data()),
                                       reinterpret_cast<const char*>(told.data()) + told.size());
        shares.push_back({cluster_.host_of(static_cast<unsigned>(shares.size())),
                          share.at("processors").get<std::vector<int>>(),
                          share.at("threads").get<std::size_t>()});
    }
    if (leads())
        for (const std::string& line : shared_processors(shares))
            print_note("note: {}", line);
}

void ClusterJob::finish() {
    cluster_.gather({});
    over_ = true;
}

std::filesystem::path ClusterJob::own_file(const std::filesystem::path& path) const {
    if (leads())
        return path;
    return path.parent_path() /
           fmt::format("{}_rank{}{}", path.stem().string(), rank(), path.extension().string());
}

void prepare_walls(Config& config, const ClusterJob& job, bool emulated) {
    if (job.size() == 1)
        return;
    if (emulated)
        throw UsageError("--emulate shows every wall in one window: start it without mpirun");
    const std::string misfit = stereo::misfit(config.installation, job.size());
    if (!misfit.empty())
        throw ConfigError("{}: {}", config.name, misfit);
    stereo::add_console(config.installation, job.size());
}

Facts facts_of(const Config& config) {
    return {{"program", std::string(kProgram)},
            {"configuration", config.text},
            {"installation", display_config_text(config.installation)}};
}

Facts facts_of(const Config& config, const index::IndexFile& file) {
    Facts facts = facts_of(config);
    std::string hashes;
    for (std::size_t number = 0; number < file.arrays(); ++number)
        hashes += fmt::format(" {:016x}", file.array(number).content_hash());
    facts.emplace_back("data set", "content hash" + hashes);
    return facts;
}

Facts start_fact(const Session& session) {
    return {{"start", interaction::commands_json(session.state().as_commands()).dump()}};
}

void run_in_cluster(const std::function<void(ClusterJob&)>& command) {
    const auto team = index::join_team();
    stereo::Cluster cluster(*team);
    if (cluster.size() > 1)
        EndInTime::leave_to_the_job();
    ClusterJob job(cluster);
    // Signals are heard from here on: a window may be there before the command hears them.
    std::optional<CancelOnSignal> signals;
    if (!job.leads()) {
        signals.emplace();
        cluster.while_waiting([&cluster] { obey_signals(cluster); });
    }
    try {
        command(job);
    } catch (const Canceled&) {
        if (cluster.size() > 1 && !job.is_over() && !job.leads())
            obey_signals(cluster);
        throw;
    } catch (const std::exception& error) {
        if (cluster.size() == 1 || job.is_over())
            throw;
        const auto* lost = dynamic_cast<const stereo::ProcessLost*>(&error);
        const std::string where = lost ? "" : cluster.name_of(cluster.rank()) + ": ";
        print_safely(stderr, "isochron: {}\n", where + error.what());
        cluster.abandon(1);
    }
}

} // namespace isochron::app
