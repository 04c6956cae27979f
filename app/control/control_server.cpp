// The thread of the control socket.
#include "app/control/control_server.h"

#include "app/safe_text.h"
#include "index/system/new_file.h"
#include "interaction/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace isochron::app {
namespace {

using interaction::Seconds;

constexpr Seconds kNever{3600};
constexpr Seconds kLookAgain{0.005}; ///< for room at the desk, or in the rate

/// A file that nobody else can read, in place of an older one.
void write_token(const std::filesystem::path& path, const std::string& token) {
    unlink(path.c_str());
    const ControlSocket file(
        open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600));
    const std::string line = token + "\n";
    if (file.get() < 0 ||
        write(file.get(), line.data(), line.size()) != static_cast<ssize_t>(line.size()))
        throw interaction::Error("{}: cannot be written", path.string());
}

ControlServerOptions with_clock(ControlServerOptions options) {
    if (!options.clock)
        options.clock = [] { return Seconds(std::chrono::steady_clock::now().time_since_epoch()); };
    return options;
}

} // namespace

ControlServer::ControlServer(ControlAddress address, ControlDesk& desk,
                             ControlServerOptions options)
    : address_(std::move(address)), desk_(desk), options_(with_clock(std::move(options))),
      listener_(listen_at(address_)) {
    searches_.set_wake([this] { wake_(); });
    fcntl(listener_.get(), F_SETFL, O_NONBLOCK);
    if (address_.is_tcp()) {
        token_ = new_control_token();
        write_token(control_token_file(address_.port), token_);
    }
    desk_.set_socket_wake([this] { wake_(); });
    thread_ = std::jthread([this] { run(); });
}

ControlServer::~ControlServer() {
    ends_ = true;
    wake_();
    thread_.join();
    desk_.set_socket_wake({});
    withdraw();
}

void ControlServer::withdraw() const {
    unlink((address_.is_tcp() ? control_token_file(address_.port) : address_.path).c_str());
}

std::string ControlServer::where() const {
    return address_.is_tcp() ? fmt::format("127.0.0.1:{}, token in {}", address_.port,
                                           control_token_file(address_.port).string())
                             : address_.path.string();
}

void ControlServer::run() {
    while (!ends_) {
        wait_for_something();
        take_found();
        delayed_ = false;
        for (const auto& client : connections_) {
            read_requests(*client);
            const Seconds now = options_.clock(), open = now - client->since;
            if ((!client->trusted && open > kTokenWithin) ||
                (!client->seated && open > kTurnedAway))
                client->drop();
            client->flush(now);
        }
        std::erase_if(connections_, [](const auto& client) { return client->is_over(); });
        accept_clients();
        clients_ = seated();
        begin_search();
        desk_.set_interested(std::ranges::any_of(connections_, [](const auto& client) {
            return client->events_a_second > 0 || !client->waits.empty();
        }));
        // Frames that came before the interest have woken nobody.
        tell_frames();
    }
}

void ControlServer::wait_for_something() {
    std::vector<pollfd> all{{wake_.descriptor(), POLLIN, 0}};
    if (connections_.size() < kMostClients + kMostTurnedAway)
        all.push_back({listener_.get(), POLLIN, 0});
    Seconds longest = delayed_ ? kLookAgain : kNever;
    for (const auto& client : connections_) {
        const bool reads = client->may_read();
        all.push_back(
            {client->descriptor(),
             static_cast<short>((reads ? POLLIN : 0) | (client->wants_to_write() ? POLLOUT : 0)),
             0});
        if (!client->trusted)
            longest = std::min(longest, kTokenWithin);
        if (!client->seated || !to_search_.empty())
            longest = std::min(longest, kTurnedAway);
    }
    if (next_look_ > Seconds(0))
        longest = std::clamp(next_look_ - options_.clock(), Seconds(0), longest);
    poll(all.data(), all.size(), static_cast<int>(longest.count() * 1000) + 1);
    wake_.take();
    const std::size_t first = all.size() - connections_.size();
    for (std::size_t i = 0; i < connections_.size(); ++i) {
        const short found = all[first + i].revents;
        if (found & POLLIN)
            connections_[i]->receive();
        else if (found & (POLLERR | POLLNVAL | POLLHUP))
            connections_[i]->drop();
    }
}

void ControlServer::accept_clients() {
    while (connections_.size() < kMostClients + kMostTurnedAway) {
        ControlSocket accepted(accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
        if (accepted.get() < 0)
            return;
        if (!address_.is_tcp() && !is_of_this_user(accepted.get()))
            continue;
        connections_.push_back(std::make_unique<Connection>(++named_, std::move(accepted),
                                                            token_.empty(), options_.clock()));
        connections_.back()->seated = seated() <= kMostClients;
    }
}

/// Reads as many requests as the client's rate and its unread answers allow.
void ControlServer::read_requests(Connection& client) {
    while (client.has_room()) {
        if (client.has_line() && !client.rate.take(options_.clock())) {
            delayed_ = true;
            return;
        }
        const auto line = client.next_line();
        if (!line)
            return;
        if (!line->empty())
            obey(client, *line);
    }
    delayed_ = delayed_ || client.has_line();
}

void ControlServer::obey(Connection& client, const std::string& line) {
    std::string id = "null";
    try {
        const ControlRequest request = request_from(line, id);
        if (!client.seated) {
            client.send(refused(id, fmt::format("busy: the session has {} clients, as many as it "
                                                "takes; try again when one has ended",
                                                kMostClients)));
            return client.finish();
        }
        if (!client.trusted) {
            client.trusted =
                request.verb == ControlVerb::hello && same_token(request.token, token_);
            client.send(client.trusted ? done(id)
                                       : refused(id, "hello: the token is wrong or missing"));
            if (!client.trusted)
                client.finish();
            return;
        }
        answer(client, request, id);
    } catch (const interaction::Error& error) {
        client.send(refused(id, error.what()));
        if (!client.trusted)
            client.finish();
    }
}

void ControlServer::answer(Connection& client, const ControlRequest& request,
                           const std::string& id) {
    const auto shown = desk_.shown();
    const bool steers = request.verb == ControlVerb::commands || is_search(request.verb);
    if (options_.only_watches && steers)
        throw interaction::Error("a replay answers state, subscribe and picture alone");
    switch (request.verb) {
    case ControlVerb::hello: client.send(done(id)); break;
    case ControlVerb::state: client.send(state_answer(id, *shown)); break;
    case ControlVerb::commands: {
        const auto file = desk_.file();
        const auto wrong = shown->state->refusals(request.commands, file->info().steps());
        if (!wrong.empty())
            throw interaction::Error(wrong.front());
        if (const auto& array = request.commands.array;
            array && !array->empty() && !file->array_called(*array))
            throw interaction::Error("array: the index has no array {}", *array);
        for (const auto& surface :
             request.commands.isosurfaces.value_or(std::vector<interaction::Isosurface>()))
            if (!surface.array.empty() && !file->array_called(surface.array))
                throw interaction::Error("isosurfaces: the index has no array {}", surface.array);
        const std::uint64_t number = desk_.post(request.commands);
        if (number == 0)
            throw interaction::Error("busy: more commands wait than frames have taken; try again");
        client.waits.push_back({Unanswered::For::frame, number, id});
        break;
    }
    case ControlVerb::subscribe:
        client.told_of = request.to;
        client.events_a_second =
            std::ranges::any_of(request.to, [](bool to) { return to; }) ? request.rate : 0;
        client.told.reset();
        client.send(done(id));
        break;
    case ControlVerb::picture:
        client.waits.push_back(
            {request.now ? Unanswered::For::picture_now : Unanswered::For::picture_final,
             desk_.want_picture(request.now), id});
        break;
    case ControlVerb::cells:
    case ControlVerb::mesh:
    case ControlVerb::profile: add_search(client, request, id); break;
    }
}

ControlServer::Found ControlServer::found_by(const Search& search, const Asking& asking) {
    try {
        return {search.client, searched_answer(search.id, search.request, search.file,
                                               *search.shown, asking.stop)};
    } catch (const std::bad_alloc&) {
        return not_found(search, "there is no memory for the answer", false);
    }
}

ControlServer::Found ControlServer::not_found(const Search& search, const std::string& why, bool) {
    return {search.client, refused(search.id, one_line(why))};
}

void ControlServer::add_search(Connection& client, const ControlRequest& request,
                               const std::string& id) {
    if (std::ranges::count(to_search_, client.name(), &Search::client) >= kMostSearches)
        throw interaction::Error("busy: {} searches wait already; try again", kMostSearches);
    to_search_.push_back({client.name(), id, request, desk_.file(), desk_.shown()->state});
    client.waits.push_back({Unanswered::For::search, 0, id});
}

/// Begins the next search whose client has read what was found for it, while little is kept for all
/// of them. Whoever keeps others from that, as it takes nothing for long, is closed.
void ControlServer::begin_search() {
    std::erase_if(to_search_, [&](const Search& search) { return !client_called(search.client); });
    if (searching_ || to_search_.empty())
        return;
    std::size_t held = 0;
    for (const auto& client : connections_)
        held += client->held();
    const auto next = std::ranges::find_if(to_search_, [&](const Search& search) {
        return client_called(search.client)->held() == 0;
    });
    const bool may_begin = next != to_search_.end();
    if (may_begin && held < options_.most_held) {
        searching_ = searches_.ask(*next);
        to_search_.erase(next);
        return;
    }
    if (!may_begin)
        return; // none of those who wait is kept by another
    for (const auto& client : connections_)
        if (client->held() > 0 && options_.clock() - client->took > kTakesNothing)
            client->drop();
}

void ControlServer::tell_frames() {
    const auto shown = desk_.shown();
    if (auto picture = desk_.picture(); picture != picture_) {
        picture_ = std::move(picture);
        picture_bytes_.reset();
    }
    next_look_ = Seconds(0);
    for (const auto& client : connections_) {
        answer_waiting(*client, *shown);
        tell_events(*client, shown);
        client->flush(options_.clock());
    }
}

/// All who wait for a picture get the same bytes, however many they are.
ControlAnswer ControlServer::picture_for(const std::string& id) {
    if (!picture_bytes_)
        picture_bytes_ = picture_bytes(*picture_);
    return picture_answer(id, *picture_, picture_bytes_);
}

void ControlServer::answer_waiting(Connection& client, const ShownFrame& shown) {
    const auto is_done = [&](const Unanswered& one) {
        switch (one.what) {
        case Unanswered::For::frame: return one.number <= shown.obeyed;
        case Unanswered::For::picture_now: return picture_ && one.number <= picture_->answers.now;
        case Unanswered::For::picture_final:
            return picture_ && one.number <= picture_->answers.final;
        case Unanswered::For::search: break;
        }
        return false;
    };
    std::erase_if(client.waits, [&](const Unanswered& one) {
        if (!is_done(one))
            return false;
        // Another frame may have been shown since.
        client.send(one.what == Unanswered::For::frame ? done(one.id, desk_.frame_of(one.number))
                                                       : picture_for(one.id));
        return true;
    });
}

void ControlServer::tell_events(Connection& client,
                                const std::shared_ptr<const ShownFrame>& shown) {
    if (client.events_a_second <= 0 || client.told == shown)
        return;
    const Seconds now = options_.clock();
    if (now < client.next_event || !client.keeps_up()) {
        const Seconds look = std::max(client.next_event, now + kLookAgain);
        next_look_ = next_look_ > Seconds(0) ? std::min(next_look_, look) : look;
        return;
    }
    for (std::size_t i = 0; i < client.told_of.size(); ++i)
        if (client.told_of[i])
            if (std::string line =
                    event_line(static_cast<ControlTopic>(i), client.told.get(), *shown);
                !line.empty())
                client.send({std::move(line)});
    client.told = shown;
    client.next_event = now + Seconds(1 / client.events_a_second);
}

void ControlServer::take_found() {
    for (Found& found : searches_.take()) {
        searching_ = false;
        Connection* const client = client_called(found.client);
        if (!client)
            continue;
        const auto wait = std::ranges::find_if(client->waits, [](const Unanswered& one) {
            return one.what == Unanswered::For::search;
        });
        if (wait != client->waits.end())
            client->waits.erase(wait);
        client->send(std::move(found.answer));
    }
}

ControlServer::Connection* ControlServer::client_called(std::uint64_t name) const {
    const auto client =
        std::ranges::find(connections_, name, [](const auto& each) { return each->name(); });
    return client == connections_.end() ? nullptr : client->get();
}

std::size_t ControlServer::seated() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(connections_, [](const auto& client) { return client->seated; }));
}

} // namespace isochron::app
