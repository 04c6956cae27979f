// A command that all processes of a cluster's job run: it starts, and fails, in all of them.
//
//     run_in_cluster([&](ClusterJob& job) {
//         job.together([&] { open_files_and_windows(); });
//         job.require_same({{"data", hash}});
//         show_frames();
//         job.finish();
//     });
//
// A process that was started without mpirun is a job of one: then nothing here has an effect.
#pragma once

#include "app/loop/pattern_show.h"
#include "app/loop/replay.h"
#include "app/session/session.h"
#include "stereo/cluster.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// Names and values that must be the same in all processes: `{"configuration", text}`.
using Facts = std::vector<std::pair<std::string, std::string>>;

class ClusterJob {
  public:
    explicit ClusterJob(stereo::Cluster& cluster) : cluster_(cluster) {}

    bool leads() const { return cluster_.rank() == 0; }
    int rank() const { return static_cast<int>(cluster_.rank()); }
    int size() const { return static_cast<int>(cluster_.size()); }

    /// Runs `part` in every process. If it throws in one of them, all throw: rank 0 the error to
    /// report, with the process's name if it was another one; the others ReportedElsewhere.
    void together(const std::function<void()>& part);
    /// Throws like `together` if a fact differs between a process and rank 0; the error names it.
    void require_same(const Facts& facts);
    void set_limits(const stereo::ClusterLimits& limits) { cluster_.set_limits(limits); }

    /// Shares the session's frames among the processes; the job outlives the session. Does nothing
    /// with one process.
    void share_frames(Session& session);
    void share_frames(PatternShow& show);
    /// Takes part in the frames of rank 0 until it ends them.
    void follow(Session& session, const FrameDone& done = {});
    void follow(PatternShow& show, const FrameDone& done = {});

    /// Notes on stderr each machine where processes draw in software with more threads than there
    /// are processors. All processes call it; rank 0 prints.
    void tell_shared_processors(const render::Gl& gl);

    /// Returns when all processes have called it: then they may exit.
    void finish();

    /// Whether all processes have failed together or have finished: none waits for another.
    bool is_over() const { return over_; }

    /// The name of a report's file, different in each process: `timing.json`, `timing_rank1.json`.
    std::filesystem::path own_file(const std::filesystem::path& path) const;

  private:
    stereo::Cluster& cluster_;
    bool over_ = false;
};

/// Adds the operator's window where one is needed.
/// @throws ConfigError when the number of processes does not fit the installation
/// @throws UsageError when several processes are to emulate it
void prepare_walls(Config& config, const ClusterJob& job, bool emulated);

/// Facts that must agree before a session can start.
Facts facts_of(const Config& config);
Facts facts_of(const Config& config, const index::IndexFile& file);
/// The session's start state, which must agree as well.
Facts start_fact(const Session& session);

/// Joins the job that this process was started in and runs its part of a command. If only this
/// process throws, it prints the error and ends the job.
void run_in_cluster(const std::function<void(ClusterJob&)>& command);

} // namespace isochron::app
