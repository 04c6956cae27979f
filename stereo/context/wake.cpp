// Wakes a loop that waits for its windows.
#include "stereo/context/wake.h"

#include "render/gl/gl.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace isochron::stereo {

Wake::Wake() : descriptor_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (descriptor_ < 0)
        throw render::Error("eventfd: {}", std::strerror(errno));
}

Wake::~Wake() {
    close(descriptor_);
}

void Wake::operator()() const noexcept {
    const int before = errno; // a signal handler must leave it as it is
    const std::uint64_t one = 1;
    // It fails only when 2^64 calls wait to be taken. One waiting call is enough, so no matter.
    [[maybe_unused]] const auto written = write(descriptor_, &one, sizeof one);
    errno = before;
}

bool Wake::take() const noexcept {
    std::uint64_t calls = 0;
    return read(descriptor_, &calls, sizeof calls) == sizeof calls;
}

void Wake::wait(int also, std::chrono::duration<double> longest) const noexcept {
    constexpr double kLongest = 3600; // whoever waits longer looks once an hour
    const double seconds = std::clamp(longest.count(), 0.0, kLongest);
    const double whole = std::floor(seconds);
    const timespec time{static_cast<time_t>(whole), static_cast<long>((seconds - whole) * 1e9)};
    std::array<pollfd, 2> both{pollfd{descriptor_, POLLIN, 0}, pollfd{also, POLLIN, 0}};
    ppoll(both.data(), both.size(), &time, nullptr); // poll leaves out a descriptor of -1
}

} // namespace isochron::stereo
