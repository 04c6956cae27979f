// Connects to a runtime and its headset, and reconnects as long as the program runs.
#include "stereo/openxr/openxr_headset.h"

#include "stereo/openxr/openxr_actions.h"
#include "stereo/openxr/openxr_error.h"
#include "stereo/openxr/openxr_input.h"
#include "stereo/openxr/openxr_instance.h"
#include "stereo/openxr/openxr_session.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

namespace isochron::stereo {
namespace {

using interaction::Seconds;

/// How long a runtime may take to agree that the program ends.
constexpr std::chrono::milliseconds kPatience{2000};
/// Time between two checks whether it has agreed.
constexpr std::chrono::milliseconds kLook{5};

/// After these results, the same calls may succeed when everything has been created anew.
bool is_loss(XrResult result) {
    return result == XR_ERROR_SESSION_LOST || result == XR_ERROR_INSTANCE_LOST ||
           result == XR_ERROR_RUNTIME_FAILURE || result == XR_ERROR_RUNTIME_UNAVAILABLE ||
           result == XR_ERROR_FORM_FACTOR_UNAVAILABLE;
}

class OpenXrHeadset final : public Headset {
  public:
    explicit OpenXrHeadset(const OpenXrOptions& options) : options_(options) {
        try {
            instance_ = std::make_unique<OpenXrInstance>(options);
            actions_ = std::make_unique<OpenXrActions>(*instance_, options.left_handed);
            return;
        } catch (const OpenXrError& error) {
            if (!options.wait || !is_loss(error.result))
                throw;
            lose(Seconds(0), error);
        }
        // The context is made before the runtime can tell which one it prefers.
        if (options_.binding == OpenXrBinding::automatic)
            options_.binding = options_.windowless ? OpenXrBinding::egl : OpenXrBinding::xlib;
    }

    ContextApi context_api() const override {
        const OpenXrBinding binding = instance_ ? instance_->binding() : options_.binding;
        return binding == OpenXrBinding::egl ? ContextApi::egl : ContextApi::native;
    }
    void attach(GlContext& drawing, const render::Gl& gl) override {
        context_ = &drawing;
        gl_ = &gl;
        if (instance_)
            connect();
    }
    void detach() override {
        session_.reset();
        context_ = nullptr;
    }

    HeadsetState update(Seconds now) override {
        if (ended_ || !context_)
            return state();
        if (!session_ && now >= next_try_)
            guarded(now, [&] { connect(); });
        if (!session_ && next_try_ <= now)
            next_try_ = now + options_.retry;
        guarded(now, [&] { take_events(now); });
        return state();
    }

    std::optional<HeadsetFrame> begin_frame(Seconds now) override {
        std::optional<HeadsetFrame> frame;
        if (session_ && session_->running())
            guarded(now, [&] { frame = session_->begin_frame(now); });
        return frame;
    }

    interaction::InputState poll(Seconds now) override {
        interaction::InputState input;
        const OpenXrSession* session = session_ && session_->running() ? session_.get() : nullptr;
        if (!guarded(now, [&] { input = input_.poll(now, session, actions_.get()); }))
            input = input_.poll(now, nullptr, nullptr);
        now_ = now;
        return input;
    }

    std::vector<HeadsetEye> eyes() override {
        std::vector<HeadsetEye> eyes;
        if (session_)
            guarded(now_, [&] { eyes = session_->eyes(); });
        return eyes;
    }

    void end_frame(const HeadsetPictures* pictures, bool again) override {
        if (session_ && session_->in_frame())
            guarded(now_, [&] { session_->end_frame(pictures, again); });
    }

    void vibrate(const std::string& device, Seconds duration, float amplitude) override {
        for (const Hand hand : kHands)
            if (session_ && session_->running() && device == name_of(hand))
                guarded(now_,
                        [&] { actions_->vibrate(session_->handle(), hand, duration, amplitude); });
    }

    void leave() override {
        const auto start = std::chrono::steady_clock::now();
        guarded(now_, [&] {
            if (session_ && session_->running())
                session_->request_exit();
        });
        while (session_ && session_->running() && !ended_ &&
               std::chrono::steady_clock::now() - start < kPatience) {
            guarded(now_, [&] { take_events(now_); });
            if (!session_ || !session_->running())
                break;
            if (!session_->in_frame())
                begin_frame(now_);
            end_frame(nullptr, false);
            std::this_thread::sleep_for(kLook);
        }
    }

    std::string description() const override {
        if (!trouble_.empty())
            return trouble_;
        std::string text = instance_ ? instance_->description() : "OpenXR";
        if (session_)
            text += fmt::format(", {}{}", session_->has_stage() ? "stage" : "local space",
                                session_->has_depth() ? ", with depth" : "");
        return text;
    }
    std::vector<std::string> status() const override {
        std::vector<std::string> lines{description()};
        for (const std::string& line : input_.status())
            lines.push_back(line);
        return lines;
    }

  private:
    HeadsetState state() const {
        if (ended_)
            return HeadsetState::ended;
        if (!session_)
            return HeadsetState::absent;
        return session_->running() ? HeadsetState::running : HeadsetState::idle;
    }

    /// Runs work that may fail in the runtime: notes a loss, and passes on any other error.
    template <typename Work>
    bool guarded(Seconds now, Work work) {
        try {
            work();
            return true;
        } catch (const OpenXrError& error) {
            if (!is_loss(error.result))
                throw;
            lose(now, error);
            return false;
        }
    }

    void lose(Seconds now, const OpenXrError& error) {
        trouble_ = error.what();
        session_.reset();
        // After the loss of only the session, the instance can still be used.
        if (error.result != XR_ERROR_SESSION_LOST &&
            error.result != XR_ERROR_FORM_FACTOR_UNAVAILABLE) {
            actions_.reset();
            instance_.reset();
        }
        next_try_ = now + options_.retry;
    }

    void connect() {
        if (!instance_)
            instance_ = std::make_unique<OpenXrInstance>(options_);
        if (!instance_->find_headset()) {
            trouble_ = fmt::format("{}: no headset is connected", instance_->description());
            return;
        }
        // An attached action set belongs to its session: a new session needs a new one.
        actions_.reset();
        actions_ = std::make_unique<OpenXrActions>(*instance_, options_.left_handed);
        session_ = std::make_unique<OpenXrSession>(*instance_, options_, *context_, *gl_);
        actions_->attach(session_->handle());
        input_.forget();
        trouble_.clear();
    }

    void take_events(Seconds now) {
        while (instance_ && session_) {
            const auto event = instance_->next_event();
            if (!event)
                return;
            switch (event->type) {
            case XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED:
                enter(reinterpret_cast<const XrEventDataSessionStateChanged&>(*event).state, now);
                break;
            case XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING:
                throw OpenXrError(XR_ERROR_INSTANCE_LOST, "OpenXR: the runtime is going");
            case XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING:
                input_.recenter_at(
                    reinterpret_cast<const XrEventDataReferenceSpaceChangePending&>(*event)
                        .changeTime);
                break;
            default: break;
            }
        }
    }

    void enter(XrSessionState state, Seconds) {
        if (state == XR_SESSION_STATE_LOSS_PENDING)
            throw OpenXrError(XR_ERROR_SESSION_LOST, "OpenXR: the headset has gone");
        session_->enter(state);
        ended_ = ended_ || state == XR_SESSION_STATE_EXITING;
    }

    OpenXrOptions options_;
    GlContext* context_ = nullptr;
    const render::Gl* gl_ = nullptr;
    // In the order of creation; they are destroyed in reverse order.
    std::unique_ptr<OpenXrInstance> instance_;
    std::unique_ptr<OpenXrActions> actions_;
    std::unique_ptr<OpenXrSession> session_;
    OpenXrInput input_;
    Seconds next_try_{0}, now_{0};
    bool ended_ = false;
    std::string trouble_; ///< why there is no session; empty while there is one
};

} // namespace

std::unique_ptr<Headset> open_headset(const OpenXrOptions& options) {
    return std::make_unique<OpenXrHeadset>(options);
}

} // namespace isochron::stereo
