// Work that may wait for a disk, on a thread of its own.
#include "app/frame/background_work.h"

#include "index/error.h"
#include "index/system/memory_limit.h"

#include <new>
#include <utility>

namespace isochron::app {

BackgroundWork::BackgroundWork() : worker_([this](const std::stop_token& stop) { work(stop); }) {}

BackgroundWork::~BackgroundWork() {
    worker_.request_stop();
    worker_.join();
}

void BackgroundWork::set_wake(std::function<void()> wake) {
    const std::scoped_lock lock(mutex_);
    wake_ = std::move(wake);
}

void BackgroundWork::wake() {
    const std::scoped_lock lock(mutex_);
    if (wake_)
        wake_();
}

void BackgroundWork::post(Task task) {
    const std::scoped_lock lock(mutex_);
    tasks_.push_back(std::move(task));
    changed_.notify_all();
}

void BackgroundWork::wait_for_room() {
    constexpr std::size_t kFew = 4;
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return tasks_.size() < kFew; });
}

std::vector<std::string> BackgroundWork::messages() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(messages_, {});
}

void BackgroundWork::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return tasks_.empty() && !working_; });
    if (!first_failure_.empty())
        throw index::Error(first_failure_);
}

void BackgroundWork::work(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    // A stop ends only the waiting: tasks in the queue are still done.
    while (changed_.wait(lock, stop, [&] { return !tasks_.empty(); })) {
        const Task task = std::move(tasks_.front());
        tasks_.pop_front();
        working_ = true;
        lock.unlock();
        std::string message, failure;
        try {
            message = task();
        } catch (const std::bad_alloc&) {
            failure = message = index::shortage_of_memory();
        } catch (const std::exception& error) {
            failure = message = error.what();
        }
        lock.lock();
        working_ = false;
        if (first_failure_.empty())
            first_failure_ = failure;
        if (!message.empty()) {
            messages_.push_back(std::move(message));
            if (wake_)
                wake_();
        }
        changed_.notify_all();
    }
}

} // namespace isochron::app
