// Reads lines of a client of the control socket, and sends it answers.
#include "app/control/control_connection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/uio.h>

namespace isochron::app {

using interaction::Seconds;

namespace {

constexpr std::size_t kSentTogether = 64; ///< lines, and the bytes behind them, of one call

std::size_t behind(const ControlAnswer& answer) {
    return answer.bytes ? answer.bytes->size() : 0;
}

std::size_t bytes_of(const ControlAnswer& answer) {
    return answer.line.size() + behind(answer);
}

} // namespace

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
    : trusted(is_trusted), since(now), took(now), name_(name), socket_(std::move(socket)) {
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
    unsent_behind_ += behind(answer);
    held_ += answer.shared ? 0 : behind(answer);
    unsent_.push_back(std::move(answer));
}

void ControlConnection::flush(Seconds now) {
    if (unsent_.empty())
        took = now;
    while (!unsent_.empty() && !over_) {
        std::array<iovec, kSentTogether> parts;
        std::size_t count = 0, before = sent_; // bytes that the parts have begun with
        const auto add = [&](const void* from, std::size_t bytes) {
            const std::size_t begun = std::min(before, bytes);
            before -= begun;
            if (bytes > begun)
                parts[count++] = {static_cast<char*>(const_cast<void*>(from)) + begun,
                                  bytes - begun};
        };
        for (const ControlAnswer& answer : unsent_) {
            if (count + 2 > parts.size())
                break;
            add(answer.line.data(), answer.line.size());
            if (answer.bytes)
                add(answer.bytes->data(), answer.bytes->size());
        }
        msghdr message{};
        message.msg_iov = parts.data();
        message.msg_iovlen = count;
        const ssize_t sent = sendmsg(socket_.get(), &message, MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent < 0) {
            over_ = errno != EAGAIN && errno != EWOULDBLOCK;
            return;
        }
        took = now;
        sent_ += static_cast<std::size_t>(sent);
        while (!unsent_.empty() && sent_ >= bytes_of(unsent_.front())) {
            sent_ -= bytes_of(unsent_.front());
            unsent_bytes_ -= unsent_.front().line.size();
            unsent_behind_ -= behind(unsent_.front());
            held_ -= unsent_.front().shared ? 0 : behind(unsent_.front());
            unsent_.pop_front();
        }
    }
}

} // namespace isochron::app
