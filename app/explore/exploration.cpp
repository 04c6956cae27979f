// Opens what a session needs, runs it, and keeps what is left of it.
#include "app/explore/exploration.h"

#include "app/config/series_names.h"
#include "app/config/tracker_setup.h"
#include "app/end_in_time.h"
#include "app/explore/control_options.h"
#include "app/explore/explore_start.h"
#include "app/explore/explored_data.h"
#include "app/explore/kept_session.h"
#include "app/explore/later_advice.h"
#include "app/explore/link_tools.h"
#include "app/explore/live_setup.h"
#include "app/explore/loading.h"
#include "app/explore/pattern_exploration.h"
#include "app/explore/series_movie.h"
#include "app/explore/story_file.h"
#include "app/explore/window_size.h"
#include "app/indexing/open_index.h"
#include "app/loop/data_window.h"
#include "app/loop/live_recording.h"
#include "app/loop/new_steps.h"
#include "app/loop/panel_movies.h"
#include "app/loop/surface_maker.h"
#include "app/telling.h"
#include "index/error.h"
#include "index/system/links/link.h"
#include "index/system/new_file.h"
#include "index/system/user_folders.h"
#include "interaction/navigation/key_frames.h"
#include "interaction/navigation/story.h"
#include "interaction/recording/recording.h"
#include "stereo/context/display_loss.h"
#include "stereo/context/wake.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

namespace isochron::app {
namespace {

/// What the user chooses in a window of its own, where the command line names no data.
/// @param display gets the window's connection to the display
/// @return nothing: they leave
std::optional<std::string> chosen_data(const ExploreOptions& options, ClusterJob& job,
                                       std::shared_ptr<const void>& display) {
    const CancelOnSignal signals;
    Config config = configure(options);
    if (config.rendering.context != stereo::ContextKind::glfw)
        throw UsageError("file is required: the data to show, an index or volume files");
    config.openxr.enabled = false; // nobody chooses a file in a headset
    if (may_keep_window_size(options, config))
        recall_window_size(config);
    const stereo::Windows windows = open_windows(options, config, job, nullptr);
    display = stereo::open_display();
    const auto wake = std::make_shared<stereo::Wake>();
    const WakeOnSignal ends(wake, stereo::Wake::call);
    PageWindowOptions page = page_options(config);
    page.wake = wake;
    BackgroundWork reading;
    reading.set_wake([wake] { (*wake)(); });
    const auto chosen =
        choose_data(windows, {.recent = UserMemory(index::user_state_folder()).recent(),
                              .offers = offers_beside_files(reading),
                              .why_not_open = [&](const auto& data) { return why_not_open(data); },
                              .window = page});
    signals.check();
    return chosen ? std::optional(chosen->string()) : std::nullopt;
}

} // namespace

void explore(const ExploreOptions& options, ClusterJob& job) {
    check_control(options.control);
    if (job.leads())
        tell_result({{"data", nullptr}}); // until some are shown
    ExploreOptions now = with_index(options);
    if (now.test_pattern)
        return explore_test_pattern(now, job);
    std::shared_ptr<const void> display; // one display for all windows, one after the other
    if (now.sources.files.empty() && job.size() == 1) {
        const auto chosen = chosen_data(now, job, display);
        if (!chosen)
            return;
        now = with_data(std::move(now), *chosen);
    }
    std::optional<ExploreOptions> before; // options of the data that were shown last
    std::string said;
    for (;;) {
        Exploration exploration(now, job);
        display = stereo::open_display();
        if (exploration.canceled()) {
            said = fmt::format("canceled: {} is not opened", now.data_name);
            if (!before) {
                print_note("{}", said);
                return;
            }
            now = *std::exchange(before, std::nullopt);
            continue;
        }
        exploration.say(std::exchange(said, {}));
        const auto next = exploration.run();
        if (!next)
            return;
        before = now;
        before->report.reset(); // it is written
        before->resume = false;
        before->array = exploration.array();
        now = next->array.empty() ? with_data(std::move(now), next->data.string())
                                  : with_other_array(std::move(now), next->array);
    }
}

Exploration::Exploration(ExploreOptions options, ClusterJob& job)
    : options_(std::move(options)), job_(job) {
    job_.together([this] { open_data(); });
    signals_.check();
    if (!file_)
        return;
    job_.require_same(facts_of(config_, *file_));
    job_.set_limits(config_.cluster.limits);
    job_.together([this] { open_session(); });
    if (!session_)
        return;
    job_.require_same(start_fact(*session_));
    job_.tell_shared_processors(session_->outputs().gl());
    job_.share_frames(*session_);
}

void Exploration::open_outputs() {
    headset_ = open_headset(config_.openxr);
    windows_.emplace(open_windows(options_, config_, job_, headset_.get()));
    show_loading(*windows_, short_name(), config_, early_, tells());
}

void Exploration::open_data() {
    if (!options_.data && options_.sources.files.empty())
        throw UsageError("file is required in a job: an index made by `isochron build`");
    config_ = configure(options_);
    if (job_.size() == 1)
        config_.pictures.passes = 0; // what is written is what is seen
    if (job_.size() == 1 && may_keep_window_size(options_, config_))
        recall_window_size(config_);
    if (job_.leads())
        warn(config_);
    if (config_.openxr.enabled && job_.size() > 1)
        throw UsageError("a headset belongs to one process: start it without mpirun");
    prepare_walls(config_, job_, options_.emulate);
    if (job_.leads())
        open_trackers(config_, trackers_);
    // Nobody chooses in a window of a given length.
    indexing_ =
        begin_indexing(options_, job_,
                       config_.rendering.context == stereo::ContextKind::glfw && !options_.seconds);
    if (indexing_) {
        open_outputs();
        options_.data = wait_for_index(*indexing_, *windows_, options_, config_, canceled_);
        if (!options_.data)
            return;
    }
    open_index_file();
    if (!file_)
        return;
    if (job_.leads()) {
        warn_of_colors(config_, *file_);
        check_start(options_, *file_, indexing_ ? indexing_->state().of : file_->info().steps());
    }
    check_outputs(options_, job_, *file_);
}

/// The name of the data, as the window says it.
std::string Exploration::short_name() const {
    return said_name(options_.data_name);
}

/// Whether the window says what is being done before there is a picture.
bool Exploration::tells() const {
    return job_.size() == 1 && windows_ && windows_->first().has_window();
}

void Exploration::open_index_file() {
    constexpr std::chrono::milliseconds kNobodyWaits{500};
    IndexOpening opening([path = *options_.data, bytes = config_.memory.cache_bytes()] {
        return open_index_to_show(path, bytes);
    });
    if (job_.size() == 1 && !opening.is_done(kNobodyWaits)) {
        if (!windows_)
            open_outputs();
        const Waited end = wait_until([&] { return opening.is_done(); }, *windows_, short_name(),
                                      "opening", config_);
        canceled_ = end == Waited::canceled;
        if (end != Waited::ready)
            return;
    }
    file_ = opening.take();
    if (!index::is_link(*options_.data))
        return;
    of_link_ = index::settings_of_link(*options_.data);
    if (options_.data_name == *options_.data)
        options_.data_name = file_->name();
    options_.data = file_->name(); // what a page leads to
}

/// Whether the first picture comes before all is compiled that later ones may need: in one window.
bool Exploration::may_prepare_later() const {
    return tells() && !headset_ && windows_->count() == 1 && !windows_->console() &&
           !windows_->room() && config_.installation.windows.front().viewports.size() == 1;
}

/// A context for a thread beside that of the window; null: there is none.
std::unique_ptr<stereo::GlContext> Exploration::context_beside() const {
    std::unique_ptr<stereo::GlContext> beside;
    stereo::GlContext& drawing = session_->outputs().windows().drawing();
    // Mesa 22.3's zink crashes now and then where two threads draw at once.
    if (drawing.description().find("zink") != std::string::npos)
        return beside;
    try {
        beside = stereo::make_context(config_.rendering.context,
                                      {.size = {1, 1}, .vsync = false, .visible = false});
        beside->leave();
    } catch (const render::Error&) { // all is done in the session's context
    }
    drawing.make_current();
    return beside;
}

/// Makes the session, and draws everything once. Meanwhile the window says so, and the user is seen
/// between the parts. @return false: the user has left, and there is no session
bool Exploration::prepare_session() {
    std::optional<stereo::Windows> first; // which stays where it is while the others move
    std::unique_ptr<PreparingPage> page;
    const bool later = may_prepare_later();
    if (tells()) {
        first.emplace(windows_->first());
        page = std::make_unique<PreparingPage>(*first, short_name(), config_, early_);
    }
    const auto look = [&](float share) {
        const bool stays = !page || page->look(share);
        canceled_ = page && page->canceled();
        return stays;
    };
    if (!look(0))
        return false;
    try {
        session_.emplace(config_, file_, std::move(*windows_), index::Extract(),
                         std::move(headset_));
    } catch (...) {
        static_cast<void>(page.release()); // its context is gone with the windows
        throw;
    }
    set_start();
    if (later)
        session_->prepare_first(look, context_beside());
    else if (look(0) && job_.leads())
        session_->warm_up(look);
    const bool stays = look(1);
    page.reset(); // before its context
    if (!stays)
        session_.reset();
    return stays;
}

void Exploration::open_session() {
    if (job_.size() == 1)
        earlier_ = earlier_session(earlier_kept_in(options_, *file_), options_.resume);
    else if (options_.resume)
        throw UsageError("--resume is for one process, without mpirun");
    if (const std::string note =
            earlier_ ? other_reading("--resume", earlier_->reading, *file_) : std::string();
        !note.empty())
        print_note("{}", note);
    if (!windows_)
        open_outputs();
    if (!prepare_session())
        return;
    if (job_.leads())
        control_ = opened_control(options_.control, *session_);
    if (options_.report)
        session_->log().report_to(job_.own_file(*options_.report));
    session_->outputs().set_screenshots(options_.screenshots);
    session_->set_data_name(std::filesystem::path(options_.data_name).filename().string());
    if (config_.cluster.swap_group && job_.size() > 1)
        stereo::join_swap_group(session_->outputs().windows());
}

void Exploration::set_start() {
    const std::size_t steps = file_->info().steps();
    if (job_.size() == 1) {
        ExplorerState home = filling_window(*session_, config_, file_->info());
        if (!passed_over(options_, *file_).empty())
            home.apply(session_->way_to_array(first_array(options_, *file_)), steps);
        session_->set_home(home);
    }
    if (earlier_) {
        session_->set_state(state_of(*earlier_, session_->state(),
                                     held_hash(*file_, earlier_->data_hash), steps, "--resume"));
        session_->recall_arrays(earlier_->arrays);
    } else {
        session_->set_state(session_->state());
        session_->set_state(first_look(*session_, options_, config_, file_));
    }
    if (!of_link_.empty()) {
        ExplorerState linked = session_->state();
        const std::size_t array = array_of_link(of_link_, *file_);
        if (array > 0)
            linked.apply(session_->way_to_array(array), steps);
        session_->set_state(as_linked(std::move(linked), of_link_, *file_, link_screen()));
        if (const std::string lost = lost_of_link(of_link_, *file_); !lost.empty())
            print_note("{}", lost);
    }
    session_->set_state(start_from(session_->state(), options_, steps));
    show_models();
    if (options_.story)
        tell_story();
}

/// Lets those models be opened that this user has shown before: sessions in their own folder name no
/// others. Adds the models of the command line.
void Exploration::show_models() {
    ModelSupply& models = session_->models();
    if (job_.size() > 1)
        models.allow_all(); // the first process has refused what its user has not named
    for (const std::string& file : options_.sources.files)
        if (!index::is_link(file))
            models.add_folder(std::filesystem::path(file).parent_path());
    if (options_.session)
        models.add_folder(std::filesystem::path(*options_.session).parent_path());
    else if (earlier_)
        models.allow_those_of(earlier_->state);
    ExplorerState state = session_->state();
    for (const std::string& file : options_.models) {
        const std::string path = models.allow(std::filesystem::absolute(file));
        if (std::ranges::find(state.models, path, &interaction::Model::path) != state.models.end())
            continue;
        if (state.models.size() < interaction::kMostModels)
            state.models.push_back({.path = path});
        else
            print_note("--model: {} is not shown: the session has {} models already", file,
                       state.models.size());
    }
    session_->set_state(state);
}

/// From its first step, or from the one that a link tells, whose view may have been moved.
void Exploration::tell_story() {
    const StoryFile story = read_story(*options_.story);
    const std::size_t steps = file_->info().steps();
    expect_fit(story.keys, *options_.story, *session_, steps);
    ExplorerState told = session_->state();
    told.keys = story.keys;
    if (options_.told > 0)
        told.story = interaction::story_step(story.keys, options_.told - 1).next;
    if (told.story == 0)
        told.story = interaction::story_step(story.keys, 0).next;
    if (options_.told > 0 && of_link_.contains("view"))
        return session_->set_state(told);
    told.apply(
        interaction::way_to_key(told.keys[told.story - 1], told,
                                {config_.installation.viewers.front().position, {1, 0, 0, 0}}),
        steps);
    session_->set_state(told);
}

/// The first window, as links see it.
LinkScreen Exploration::link_screen() const {
    return {config_.installation.windows.front().viewports.front().screen,
            {config_.installation.viewers.front().position, {1, 0, 0, 0}},
            glm::max(session_->outputs().windows().first().framebuffer_size(), 1)};
}

std::optional<std::string> Exploration::array() const {
    const std::string name = indexing_ ? indexing_->state().array : std::string();
    return name.empty() ? std::nullopt : std::optional(name);
}

std::optional<NextData> Exploration::run() {
    if (!session_) {
        signals_.check();
        return std::nullopt;
    }
    UserMemory memory(job_.size() == 1 ? index::user_state_folder() : std::nullopt);
    BackgroundWork remembering; // no frame waits for that disk
    LiveLoop live(config_, std::move(trackers_), live_options_with(memory, remembering),
                  session_->outputs().headset());
    remembering.set_wake(live.waker());
    const WakeOnSignal ends(live.wake(), stereo::Wake::call);
    session_->set_clock(live.clock());
    std::optional<SavedAtEnd> saved([this, &live] { save(live); });
    if (job_.leads())
        lead(live, remembering);
    else
        job_.follow(*session_);
    session_->frames().end();
    finish(live, memory);
    saved.reset();
    signals_.check();
    if (live.next_data())
        return live.next_data();
    if (indexing_)
        indexing_->check();
    return std::nullopt;
}

/// Greets the user of a process that is alone, too.
LiveOptions Exploration::live_options_with(UserMemory& memory, BackgroundWork& writing) {
    LiveOptions how = live_options(options_);
    how.early = std::exchange(early_, {});
    if (job_.size() > 1)
        return how;
    how.why_not_open = [](const std::filesystem::path& data) { return why_not_open(data); };
    if (index::is_link(*options_.data))
        how.link = [this] {
            return link_to(*options_.data, session_->state(), *session_->file(), link_screen());
        };
    if (indexing_)
        how.standing = [this] {
            const Indexing::State now = indexing_->state();
            return now.failure.empty() ? now.line() : "indexing has ended: " + now.failure;
        };
    greet(*session_, memory, writing, name_to_remember(options_));
    return how;
}

void Exploration::lead(LiveLoop& live, BackgroundWork& reading) {
    if (job_.size() == 1)
        keep(live, reading);
    const auto header = header_of(*session_, config_, *file_, *options_.data);
    const auto recording = std::make_shared<LiveRecording>();
    if (options_.record) {
        recording->begin(index::end_of_links(*options_.record), header);
        session_->set_recording(true);
    }
    live.join(CompanionPlace::recording, recording);
    const std::string passed = earlier_ ? std::string() : passed_over(options_, *file_);
    if ((indexing_ || !passed.empty()) && file_->arrays() > 1)
        session_->show_messages({fmt::format("{}{}{} arrays: Ctrl + A shows the next one", passed,
                                             passed.empty() ? "" : "\n", file_->arrays())});
    if (job_.size() == 1)
        live.join(CompanionPlace::movies,
                  std::make_shared<PanelMovies>(movie_orders(options_, header), recording));
    if (indexing_)
        session_->panel().offer_arrays(listed(indexing_->state().others));
    const auto cache = index::user_cache_folder();
    session_->write_curves_to({.kept = cache ? std::optional(*cache / "curves") : std::nullopt,
                               .tables = options_.screenshots});
    live.join(CompanionPlace::surfaces,
              std::make_shared<SurfaceMaker>(file_, options_.screenshots));
    live.join(CompanionPlace::watch,
              std::make_shared<NewSteps>(*options_.data, file_, live.waker()));
    if (indexing_ && !earlier_ && !options_.between && !config_.between)
        live.join(CompanionPlace::advice, std::make_shared<LaterAdvice>(is_whole(*indexing_)));
    if (control_)
        live.join(CompanionPlace::control, control_);
    const stereo::DisplayLoss loss([&] { save(live); });
    live.run(*session_);
}

/// Saves the session as it goes on, or says why it does not.
void Exploration::keep(LiveLoop& live, BackgroundWork& reading) {
    const auto drops = offer_earlier(reading);
    auto path = kept_in(options_, *file_);
    const std::string why_not = why_not_kept(path);
    if (!why_not.empty()) {
        print_note("{}", why_not);
        session_->show_messages({why_not});
        live.keep_no_session(why_not);
        path.reset();
    } else if (!options_.session) {
        path = claim_.emplace(*path).path();
    }
    keep_session(live, path, options_, *file_, *session_, earlier_,
                 earlier_ && path == kept_in(options_, *file_), drops);
}

/// Lists the sessions before, and offers to go on with one of them. What is beside the last one is said
/// on stderr as well, and which ones go. @return files of those that go
std::vector<std::filesystem::path> Exploration::offer_earlier(BackgroundWork& reading) {
    const auto all = earlier_sessions(options_, *file_);
    if (!earlier_ && all.size() > 1)
        print_note("--resume --session FILE goes on with an earlier one, of which there are {} "
                   "beside it; the newest is {}",
                   all.size() - 1, all[1].path.filename().string());
    std::vector<std::filesystem::path> drops;
    for (const EarlierSession& each :
         sessions_to_drop(all, kept_in(options_, *file_).value_or(std::filesystem::path()))) {
        drops.push_back(each.path);
        say_dropped(each);
    }
    std::vector<OfferedSession> offers;
    for (const EarlierSession& each : all) {
        try {
            const std::string hash = held_hash(*file_, each.session.data_hash);
            if (!options_.session)
                session_->models().allow_those_of(each.session.state);
            const bool goes = std::ranges::find(drops, each.path) != drops.end();
            offers.push_back({words_of(each) + (goes ? ", goes next" : ""),
                              state_of(each.session, session_->state(), hash, file_->info().steps(),
                                       each.path.string())
                                  .as_commands(),
                              each.session.name, each.path,
                              picture_read(reading, [png = each.session.picture] { return png; })});
        } catch (const std::exception&) { // `--resume` would say what is wrong with it
        }
    }
    session_->set_sessions(std::move(offers));
    if (!earlier_ && !options_.story)
        session_->panel().offer_earlier();
    return drops;
}

/// Says that a session goes, before it does.
void Exploration::say_dropped(const EarlierSession& session) {
    const std::string line = fmt::format("{} sessions on these data are kept: that of {} goes when "
                                         "this one is saved. Ctrl + K finds "
                                         "it, Ctrl + S gives it a name, with which it stays",
                                         kMostSessions, words_of(session));
    print_note("{}", line);
    session_->show_messages({line});
}

void Exploration::say(const std::string& message) {
    if (session_ && !message.empty())
        session_->show_messages({message});
}

void Exploration::finish(LiveLoop& live, UserMemory& memory) {
    const std::vector<std::string> words = live.finish(*session_);
    session_->outputs().pictures().finish();
    if (job_.size() == 1 && may_keep_window_size(options_, config_))
        remember_window_size(session_->outputs().windows()[0].framebuffer_size());
    if (session_->panel().introduced())
        memory.set_introduced();
    if (session_->panel().room_explained())
        memory.set_knows_room();
    print_status(live, words);
    if (options_.report)
        session_->log().finish_report(session_->drawing(), session_->reading());
    job_.finish();
    if (!job_.leads())
        return;
    tell_result(
        {{"data", options_.data_name},
         {"frames", session_->log().next()},
         {"recording", options_.record ? nlohmann::ordered_json(*options_.record) : nullptr},
         {"report", options_.report ? nlohmann::ordered_json(*options_.report) : nullptr}});
    if (options_.record)
        print_note("recording: {}", *options_.record);
}

/// What there is of a session whose display is gone, or that a signal ends while it draws.
void Exploration::save(LiveLoop& live) {
    try {
        live.save(*session_);
        session_->outputs().pictures().finish();
        claim_.reset();
        if (options_.record)
            print_note("recording: {}", *options_.record);
    } catch (const std::exception& error) {
        print_safely(stderr, "isochron: {}\n", error.what());
    }
}

} // namespace isochron::app
