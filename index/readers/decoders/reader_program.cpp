// The main function of a reader process: sets up its limits, serves, and ends.
#include "index/readers/decoders/reader_program.h"

#include "index/error.h"
#include "index/readers/decoders/denied_files.h"
#include "index/readers/decoders/fence.h"
#include "index/readers/process/reader_start.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <string_view>

namespace isochron::index {
namespace {

constexpr int kNotStartedByTheProgram = 2;

bool nobody_is_there() {
    pollfd end{kReaderSocket, POLLRDHUP, 0};
    return ::poll(&end, 1, 0) > 0 && (end.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
}

/// Ends this process as soon as the program closes the socket, even while a library is at work.
void end_with_the_program() {
    struct sigaction action {};
    action.sa_handler = [](int) {
        if (nobody_is_there())
            ::_exit(0);
    };
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGIO, &action, nullptr);
    ::fcntl(kReaderSocket, F_SETOWN, ::getpid());
    ::fcntl(kReaderSocket, F_SETFL, ::fcntl(kReaderSocket, F_GETFL) | O_ASYNC);
}

/// Makes the system kill this process rather than the program when memory runs out.
void go_first() {
    const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
    if (file < 0)
        return;
    constexpr const char* kFirst = "1000";
    [[maybe_unused]] const auto ignored = ::write(file, kFirst, std::strlen(kFirst));
    ::close(file);
}

/// Restricts this process to what the program names first. @return what the system refuses of that
std::string_view fence_in_as_told(MessageSocket& socket) {
    const auto told = socket.receive();
    if (!told)
        ::_exit(0);
    const LeftReadable readable = readable_from(told->bytes);
    return kReaderIsWatched ? std::string_view() : fence_in(readable.places);
}

/// Answers that nothing is read without the fence, and waits until the program has closed the
/// socket: if this process ended before the program asks, the program would see only an ended
/// reader.
void refuse(MessageSocket& socket, std::string_view refused) {
    if (!socket.send(encoded(ReaderReply(Refused{
            fmt::format("its reader cannot be fenced in: the system refuses {}", refused)}))))
        return;
    while (socket.receive()) {
    }
}

} // namespace

int run_reader(std::span<const Decoder> decoders, const OtherFiles& others) {
    int type = 0;
    socklen_t size = sizeof type;
    if (::getsockopt(kReaderSocket, SOL_SOCKET, SO_TYPE, &type, &size) != 0) {
        std::fputs("isochron starts this program where it reads files that a library decodes\n",
                   stderr);
        return kNotStartedByTheProgram;
    }
    end_with_the_program();
    go_first();
    try {
        MessageSocket socket{Descriptor(kReaderSocket)};
        if (const std::string_view refused = fence_in_as_told(socket); !refused.empty()) {
            refuse(socket, refused);
            ::_exit(1);
        }
        serve(socket, decoders, others, take_denied_file);
    } catch (const Error&) {
        ::_exit(1); // the program knows which message it sent
    }
    ::_exit(0); // without the cleanup of libraries, which is not needed
}

} // namespace isochron::index
