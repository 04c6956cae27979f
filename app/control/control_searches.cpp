// Searches for clients of the control socket.
#include "app/control/control_searches.h"

#include "app/text.h"
#include "index/file/chunks/chunk_store.h"

#include <exception>
#include <new>
#include <utility>

namespace isochron::app {
namespace {

ControlAnswer answer_of(const ControlSearch& search, const std::stop_token& stop) {
    try {
        return searched_answer(search.id, search.request, search.file, *search.shown, stop);
    } catch (const index::Stopped&) {
        return refused(search.id, "the session ends");
    } catch (const std::bad_alloc&) {
        return refused(search.id, "there is no memory for the answer");
    } catch (const std::exception& error) {
        return refused(search.id, one_line(error.what()));
    }
}

} // namespace

ControlSearches::ControlSearches(std::function<void()> done)
    : done_(std::move(done)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

ControlSearches::~ControlSearches() {
    thread_.request_stop();
}

bool ControlSearches::add(ControlSearch search) {
    {
        const std::lock_guard lock(mutex_);
        if (waiting_.size() + found_.size() >= kMostWaiting)
            return false;
        waiting_.push_back(std::move(search));
    }
    changed_.notify_one();
    return true;
}

std::vector<ControlSearches::Found> ControlSearches::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(found_, {});
}

void ControlSearches::run(const std::stop_token& stop) {
    for (;;) {
        std::unique_lock lock(mutex_);
        if (!changed_.wait(lock, stop, [this] { return !waiting_.empty(); }))
            return;
        const ControlSearch search = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        ControlAnswer answer = answer_of(search, stop);
        lock.lock();
        found_.push_back({search.client, std::move(answer)});
        lock.unlock();
        done_();
    }
}

} // namespace isochron::app
