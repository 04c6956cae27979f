// Opens what the test pattern needs, and shows it.
#include "app/explore/pattern_exploration.h"

#include "app/command_line/cancel.h"
#include "app/config/tracker_setup.h"
#include "app/explore/explore_start.h"
#include "app/explore/live_setup.h"
#include "app/loop/live_loop.h"
#include "app/telling.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <utility>

namespace isochron::app {

void explore_test_pattern(const ExploreOptions& options, ClusterJob& job) {
    const CancelOnSignal signals;
    Config config;
    interaction::CompositeInput trackers;
    std::optional<PatternShow> opened;
    job.together([&] {
        if (options.record || options.report)
            throw UsageError("--test-pattern does not go with --record or --report");
        if (options.control)
            throw UsageError("--test-pattern does not go with --control");
        config = configure(options);
        prepare_walls(config, job, options.emulate);
        if (!job.leads())
            return;
        warn(config);
        open_trackers(config, trackers);
    });
    job.require_same(facts_of(config));
    job.set_limits(config.cluster.limits);
    job.together([&] { opened.emplace(config, open_windows(options, config, job, nullptr)); });
    PatternShow& show = *opened;
    if (options.stereo)
        show.set_stereo(*stereo::stereo_mode_from_name(*options.stereo));
    job.require_same({{"stereo mode", std::string(stereo::name_of(show.stereo()))}});
    job.tell_shared_processors(show.outputs().gl());
    job.share_frames(show);
    LiveLoop live(config, std::move(trackers), live_options(options));
    if (job.leads())
        live.run(show);
    else
        job.follow(show);
    show.frames().end();
    print_status(live);
    if (job.leads())
        tell_result({{"configuration", config.name}});
    job.finish();
}

} // namespace isochron::app
