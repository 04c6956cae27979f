// Answers questions beside the frames, one after another, so that no frame waits.
//
//     Asker<index::Instant, std::string> asker(words_of, why_not);
//     asker.set_wake(wake);      // brings the next frame
//     asker.ask(index::Instant(7));            // in one frame
//     messages = asker.take();   // in a later one
#pragma once

#include "app/frame/background_work.h"
#include "index/system/memory_limit.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <new>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// What a function that answers a question looks at, and tells meanwhile.
struct Asking {
    std::stop_token stop;                        ///< nobody wants the answer any more
    std::function<void(std::uint32_t)> progress; ///< takes how much is done [%]
};

/// Questions and answers are values. One thread owns the asker: asks, takes the answers, and cancels.
template <class Question, class Answer>
class Asker {
  public:
    /// Both run on the asker's own thread.
    using Answering = Answer (*)(const Question&, const Asking&);
    /// Answers a question that could not be answered, as `Answering` has thrown, or that was
    /// canceled before its turn. @param canceled nobody wanted the answer any more
    using Failing = Answer (*)(const Question&, const std::string& why, bool canceled);

    Asker(Answering answering, Failing failing) : answering_(answering), failing_(failing) {}
    ~Asker() { cancel(); } ///< waits until the question that is being answered has ended

    /// Sets the function that is called, on the asker's thread, when there is an answer or progress.
    void set_wake(std::function<void()> wake) { work_.set_wake(std::move(wake)); }

    /// Adds a question behind those that wait, and returns at once.
    /// @param most questions that wait for their turn, and answers that wait to be taken
    /// @return false: there are as many already
    bool ask(Question question, std::size_t most = SIZE_MAX) {
        if (const std::scoped_lock lock(mutex_); waiting_ + found_.size() < most)
            ++waiting_;
        else
            return false;
        percent_ = 0;
        work_.post([this, question = std::move(question), stop = stop_.get_token()] {
            answer(question, {stop, [this](std::uint32_t percent) {
                                  if (percent_.exchange(percent) != percent)
                                      work_.wake();
                              }});
            return std::string();
        });
        return true;
    }

    /// The answers since the last call, in the order of their questions: one for each question.
    std::vector<Answer> take() {
        const std::scoped_lock lock(mutex_);
        return std::exchange(found_, {});
    }
    /// How much of the question is done that is being answered [%]; 0 after a question was asked.
    std::uint32_t percent() const { return percent_; }

    /// Nobody wants the answers to the questions so far any more: each of them ends soon, by an
    /// answer all the same.
    void cancel() {
        stop_.request_stop();
        stop_ = std::stop_source();
    }
    /// Blocks until all questions are answered.
    void finish() { work_.finish(); }

  private:
    void answer(const Question& question, const Asking& asking) {
        {
            const std::scoped_lock lock(mutex_);
            --waiting_;
        }
        Answer found = answer_or_failure(question, asking);
        {
            const std::scoped_lock lock(mutex_);
            found_.push_back(std::move(found));
        }
        work_.wake();
    }

    Answer answer_or_failure(const Question& question, const Asking& asking) const {
        const auto canceled = [&] { return asking.stop.stop_requested(); };
        try {
            return canceled() ? failing_(question, "canceled", true) : answering_(question, asking);
        } catch (const std::bad_alloc&) {
            return failing_(question, index::shortage_of_memory(), canceled());
        } catch (const std::exception& error) {
            return failing_(question, error.what(), canceled());
        }
    }

    const Answering answering_;
    const Failing failing_;
    std::stop_source stop_; ///< for the owner's thread alone
    std::atomic<std::uint32_t> percent_{0};
    std::mutex mutex_;
    std::size_t waiting_ = 0;
    std::vector<Answer> found_;
    BackgroundWork work_; ///< last: its thread uses the other members
};

} // namespace isochron::app
