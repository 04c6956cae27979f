// Reads lines of a client of the control socket, and sends it answers.
#include "app/control/control_connection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>

#include <fcntl.h>
#include <sys/socket.h>

namespace isochron::app {

using interaction::Seconds;

bool RequestRate::take(Seconds now) {
    if (before_)
        left_ = std::min(left_ + (now - *before_).count() * kMostRequestsASecond, kMostAtOnce);
    before_ = now;
    if (left_ < 1)
        return false;
    left_ -= 1;
    return true;
}

Seconds RequestRate::wait() const {
    return Seconds(std::max(0.0, (1 - left_) / kMostRequestsASecond));
}

ControlConnection::ControlConnection(std::uint64_t name, ControlSocket socket, bool is_trusted,
                                     Seconds now)
    : trusted(is_trusted), since(now), name_(name), socket_(std::move(socket)) {
    fcntl(socket_.get(), F_SETFL, O_NONBLOCK);
}

void ControlConnection::receive() {
    constexpr std::size_t kPiece = 16 * 1024;
    received_.erase(0, read_);
    read_ = 0;
    const std::size_t before = received_.size();
    received_.resize(before + kPiece);
    const ssize_t count = recv(socket_.get(), received_.data() + before, kPiece, MSG_DONTWAIT);
    received_.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count == 0)
        ends_ = true; // it may still read its answers
    else if (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)
        over_ = true;
}

std::optional<std::string> ControlConnection::next_line() {
    const std::size_t end = received_.find('\n', read_);
    const std::size_t length = (end == std::string::npos ? received_.size() : end) - read_;
    if (length > kLongestLine) {
        send(refused("null", fmt::format("request: a line of more than {} bytes", kLongestLine)));
        finish();
        return std::nullopt;
    }
    if (end == std::string::npos)
        return std::nullopt;
    std::string line = received_.substr(read_, length);
    read_ = end + 1;
    if (!line.empty() && line.back() == '\r')
        line.pop_back();
    return line;
}

void ControlConnection::finish() {
    received_.clear();
    read_ = 0;
    ends_ = true;
}

void ControlConnection::send(ControlAnswer answer) {
    unsent_bytes_ += answer.line.size();
    unsent_.push_back(std::move(answer));
}

void ControlConnection::flush() {
    while (!unsent_.empty() && !over_) {
        const ControlAnswer& first = unsent_.front();
        const std::size_t line = first.line.size(), bytes = first.bytes ? first.bytes->size() : 0;
        const void* const from = sent_ < line
                                     ? static_cast<const void*>(first.line.data() + sent_)
                                     : static_cast<const void*>(first.bytes->data() + sent_ - line);
        const std::size_t left = sent_ < line ? line - sent_ : line + bytes - sent_;
        const ssize_t count = ::send(socket_.get(), from, left, MSG_DONTWAIT | MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0) {
            over_ = errno != EAGAIN && errno != EWOULDBLOCK;
            return;
        }
        sent_ += static_cast<std::size_t>(count);
        if (sent_ < line + bytes)
            continue;
        unsent_bytes_ -= line;
        sent_ = 0;
        unsent_.pop_front();
    }
}

} // namespace isochron::app
