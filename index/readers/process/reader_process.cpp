// Starts a reader, exchanges messages with it, and finds how it ended.
#include "index/readers/process/reader_process.h"

#include "index/interrupted.h"
#include "index/readers/process/reader_start.h"
#include "index/system/module.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>
#include <utility>

namespace isochron::index {
namespace {

/// How a reader is started: only its socket is open, and signals of the terminal are blocked.
class SpawnSetup {
  public:
    explicit SpawnSetup(int socket) {
        ::posix_spawn_file_actions_init(&files);
        ::posix_spawn_file_actions_adddup2(&files, socket, kReaderSocket);
        for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
            ::posix_spawn_file_actions_addopen(&files, standard, "/dev/null", O_RDWR, 0);
        ::posix_spawn_file_actions_addclosefrom_np(&files, kReaderSocket + 1);
        // Readers notice when this program ends, and end too. They block these signals, since
        // Ctrl-C reaches all processes of a terminal and would look like a crash of the reader.
        sigset_t blocked, restored;
        ::sigemptyset(&blocked);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
            ::sigaddset(&blocked, signal);
        ::sigfillset(&restored);
        ::posix_spawnattr_init(&attributes);
        ::posix_spawnattr_setsigmask(&attributes, &blocked);
        ::posix_spawnattr_setsigdefault(&attributes, &restored);
        ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    }
    ~SpawnSetup() {
        ::posix_spawn_file_actions_destroy(&files);
        ::posix_spawnattr_destroy(&attributes);
    }
    SpawnSetup(const SpawnSetup&) = delete;
    SpawnSetup& operator=(const SpawnSetup&) = delete;

    posix_spawn_file_actions_t files{};
    posix_spawnattr_t attributes{};
};

/// HDF5 locks a file that it writes. Its reader cannot see that, since its fence takes locks away.
void expect_unlocked(const std::filesystem::path& path) {
    if (const char* const use = std::getenv("HDF5_USE_FILE_LOCKING"); use && use[0] == 'F')
        return;
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file && ::flock(file.number(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        throw Error("{}: cannot be read: another program is writing it, and has locked it",
                    path.string());
}

/// Waits for the end of a process that has closed its socket: it may end a moment after that.
std::optional<int> status_at_end(pid_t process) {
    constexpr std::chrono::milliseconds kPause{1};
    constexpr int kPauses = 2000;
    for (int i = 0; i < kPauses; ++i) {
        int status = 0;
        if (::waitpid(process, &status, WNOHANG) == process)
            return status;
        std::this_thread::sleep_for(kPause);
    }
    return std::nullopt;
}

std::string text_of_end(int status) {
    if (WIFEXITED(status))
        return fmt::format("its reader ended with status {}", WEXITSTATUS(status));
    const int signal = WTERMSIG(status);
    const char* name = ::sigabbrev_np(signal);
    const std::string text = name ? fmt::format("SIG{}", name) : fmt::format("signal {}", signal);
    if (signal == SIGKILL)
        return fmt::format("its reader was killed ({}), as systems do when memory runs out", text);
    if (signal == SIGXCPU)
        return fmt::format("its reader took longer than any such file does ({})", text);
    return fmt::format("its reader crashed on it ({}): the file is damaged, or holds what its "
                       "library cannot read",
                       text);
}

} // namespace

ReaderProcess::ReaderProcess(std::string program, ReaderLimits limits, const LeftReadable& readable,
                             std::uint64_t readable_age, WhileWaiting waiting)
    : program_(std::move(program)), limits_(limits), readable_age_(readable_age),
      parent_(::getpid()), waiting_(waiting) {
    const std::string file = file_of_program(program_).string();
    auto [ours, theirs] = MessageSocket::pair();
    const SpawnSetup setup(theirs.number());
    char* const arguments[]{program_.data(), nullptr};
    const int failure =
        ::posix_spawn(&process_, file.c_str(), &setup.files, &setup.attributes, arguments, environ);
    if (failure != 0)
        throw Error("{}: cannot be started: {}", file, std::strerror(failure));
    socket_.emplace(std::move(ours));
    socket_->send(encoded(readable)); // where the reader has ended, the first reply says so
}

ReaderProcess::~ReaderProcess() {
    if (process_ < 0 || !is_ours())
        return;
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

bool ReaderProcess::is_ours() const {
    return parent_ == ::getpid();
}

void ReaderProcess::ask(const ReaderRequest& request) {
    const auto* open = std::get_if<OpenFile>(&request);
    const bool locks = program_.ends_with("hdf5") || program_.ends_with("netcdf");
    if (open && locks)
        expect_unlocked(open->path);
    if (std::holds_alternative<OpenFile>(request) ||
        std::holds_alternative<ReadCollection>(request) ||
        std::holds_alternative<ReadModel>(request))
        ++files_;
    limit(request);
    send(request);
}

void ReaderProcess::limit(const ReaderRequest& request) try {
    constexpr std::uint64_t kLargestPicture = std::uint64_t{1} << 30; // [bytes] of its pixels
    if (limits_.memory == 0)
        limits_.memory = free_memory();
    if (const auto* open = std::get_if<OpenFile>(&request))
        budget_.emplace(process_, open->path, limits_.memory);
    else if (const auto* listed = std::get_if<ReadCollection>(&request))
        budget_.emplace(process_, listed->path, limits_.memory);
    else if (const auto* picture = std::get_if<ReadPicture>(&request))
        budget_.emplace(process_, picture->path, limits_.memory).expect(kLargestPicture);
    else if (const auto* model = std::get_if<ReadModel>(&request))
        budget_.emplace(process_, model->path, limits_.memory);
} catch (const Error& error) {
    fail(error.what());
}

void ReaderProcess::limit_after(const ReaderReply& reply) try {
    if (!budget_)
        return;
    budget_->renew_time(); // the next request may wait already
    if (const auto* described = std::get_if<Described>(&reply))
        budget_->expect(described->decoded_bytes);
} catch (const Error& error) {
    fail(error.what());
}

void ReaderProcess::send(const ReaderRequest& request, int attached) {
    if (!socket_->send(encoded(request), attached))
        fail_as_it_ended();
}

ReaderReply ReaderProcess::reply(const std::stop_token& stop) {
    if (!ready_) {
        const ReaderReply first = next_reply(stop);
        if (const auto* refused = std::get_if<Refused>(&first))
            fail(refused->message);
        const auto* ready = std::get_if<Ready>(&first);
        if (!ready || ready->version != kReaderVersion)
            fail(fmt::format("{} is of another version, expected {}", program_, kReaderVersion));
        ready_ = true;
    }
    return next_reply(stop);
}

ReaderReply ReaderProcess::next_reply(const std::stop_token& stop) {
    watch_.begin(limits_.patience, budget_ ? budget_->time_of_bytes() : std::chrono::seconds{0});
    const auto expect_wanted = [&] {
        if (stop.stop_requested())
            throw Interrupted("nobody waits for the reply any more");
    };
    std::optional<ReaderReply> reply;
    try {
        expect_wanted();
        if (const auto message = socket_->receive([&] {
                expect_wanted();
                look();
            }))
            reply = reply_from(message->bytes);
    } catch (const ReaderEnded&) {
        throw;
    } catch (const Error& error) {
        fail(fmt::format("its reader sent {}", error.what()));
    } catch (...) { // from `waiting_`, or stopped: the reply will not be waited for
        kill();
        throw;
    }
    if (!reply)
        fail_as_it_ended();
    limit_after(*reply);
    return std::move(*reply);
}

void ReaderProcess::look() {
    if (waiting_)
        waiting_();
    if (const auto why = watch_.look(signs_of(process_)))
        fail(*why);
}

std::span<std::byte> ReaderProcess::memory(std::size_t bytes) {
    if (!memory_ || memory_->bytes().size() < bytes) {
        memory_.reset();
        try {
            memory_ = std::make_unique<SharedMemory>(bytes);
        } catch (const Error& error) {
            fail(error.what());
        }
        send(UseMemory{bytes}, memory_->descriptor());
    }
    return memory_->bytes();
}

void ReaderProcess::kill() {
    ::kill(process_, SIGKILL);
    killed_ = true;
}

void ReaderProcess::fail(const std::string& why) {
    kill();
    throw ReaderEnded(why, ReaderEnded::How::by_our_hand);
}

void ReaderProcess::fail_as_it_ended() {
    const std::optional<int> status = status_at_end(process_);
    if (!status)
        fail("its reader no longer answers");
    process_ = -1;
    throw ReaderEnded((ready_ ? "" : "at the start: ") + text_of_end(*status),
                      ReaderEnded::How::by_itself);
}

} // namespace isochron::index
