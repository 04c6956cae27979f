// A command run by all processes of a cluster's job: it starts, and fails, in all of them.
//
//     run_in_cluster([&](ClusterJob& job) {
//         job.together([&] { open_files_and_windows(); });
//         job.require_same({{"data", hash}});
//         show_frames();
//         job.finish();
//     });
//
// A process that was started without mpirun is a job of one, for which none of this does anything.
#pragma once

#include "app/session/pattern_show.h"
#include "app/session/replay.h"
#include "app/session/session.h"
#include "stereo/cluster.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// What all processes must see alike: `{"configuration", text}`.
using Facts = std::vector<std::pair<std::string, std::string>>;

class ClusterJob {
  public:
    explicit ClusterJob(stereo::Cluster& cluster) : cluster_(cluster) {}

    bool leads() const { return cluster_.rank() == 0; }
    int rank() const { return static_cast<int>(cluster_.rank()); }
    int size() const { return static_cast<int>(cluster_.size()); }

    /// Does a process's part. When it throws in one process, all throw: rank 0 what is to be
    /// reported, with the name of the process where it is another one, the others
    /// ReportedElsewhere.
    void together(const std::function<void()>& part);
    /// Throws, likewise, when a process has another fact than rank 0, and says which.
    void require_same(const Facts& facts);
    void set_limits(const stereo::ClusterLimits& limits) { cluster_.set_limits(limits); }

    /// Shares the session's frames among the processes; the job outlives the session. With one
    /// process there is nothing to share.
    void share_frames(Session& session);
    void share_frames(PatternShow& show);
    /// Takes part in the frames of rank 0 until it ends them.
    void follow(Session& session, const FrameDone& done = {});
    void follow(PatternShow& show, const FrameDone& done = {});

    /// Says once where processes on one machine draw in software and have fewer processors there
    /// than threads that draw. Called by all.
    void tell_shared_processors(const render::Gl& gl);

    /// Returns when all have come so far: then they may leave.
    void finish();

    /// Nobody waits for anybody any more: all have failed together, or have finished.
    bool is_over() const { return over_; }

    /// A report's file, for each process another one: `timing.json`, `timing_rank1.json`.
    std::filesystem::path own_file(const std::filesystem::path& path) const;

  private:
    stereo::Cluster& cluster_;
    bool over_ = false;
};

/// Adds the operator's window where one is needed.
/// @throws ConfigError when so many processes cannot show this installation
void prepare_walls(Config& config, const ClusterJob& job, bool emulated);

/// What must be alike before a session can start, and then its start.
Facts facts_of(const Config& config);
Facts facts_of(const Config& config, const index::IndexFile& file);
Facts start_fact(const Session& session);

/// Joins the job that this process was started in and runs its part of a command. What only this
/// process throws, it prints, and ends the job.
void run_in_cluster(const std::function<void(ClusterJob&)>& command);

} // namespace isochron::app
