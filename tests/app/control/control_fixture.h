// A control socket of its own for each test, which is the loop of frames.
#pragma once

#include "app/control/control_client.h"
#include "app/control/control_server.h"

#include "index/file/index_file.h"
#include "index/indexing/index_build.h"
#include "interaction/error.h"
#include "tests/support/eventually.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <sys/socket.h>

namespace isochron::app {

using interaction::Seconds;
using test_support::eventually;

/// Calls a function at the end of its life.
class Finally {
  public:
    explicit Finally(std::function<void()> last) : last_(std::move(last)) {}
    ~Finally() { last_(); }
    Finally(const Finally&) = delete;
    Finally& operator=(const Finally&) = delete;

  private:
    std::function<void()> last_;
};

class ControlServerTest : public testing::Test {
  protected:
    ControlServerTest() {
        setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
        index::TestField field({9, 8, 7}, 3, index::ValueType::f32, index::moving_sphere);
        index::MemorySeries series(field.view());
        build_index(series, folder_.path() / "a.isochron", {});
        file_ = index::IndexFile::open(folder_.path() / "a.isochron");
        desk_.set_file(file_);
        show();
    }
    void listen(const std::string& at = "", ControlServerOptions options = {}) {
        server_.emplace(control_address(at), desk_, std::move(options));
    }
    /// A frame of the loop: obeys what waits.
    void show() {
        if (const auto batch = desk_.take()) {
            taken_.push_back(batch->commands);
            auto next = std::make_shared<ExplorerState>(*state_);
            next->apply(batch->commands, file_->info().steps());
            state_ = next;
            obeyed_ = batch->last;
            obeyed_in_ = frames_ + 1;
        }
        desk_.show({.number = ++frames_, .obeyed = obeyed_, .state = state_, .report = {}});
    }
    /// Asks while frames go on.
    ControlClient::Answer ask(ControlClient& client, const ControlRequest& request) {
        std::atomic<bool> answered{false};
        auto answer = std::async(std::launch::async, [&] {
            const Finally tell([&] { answered = true; });
            return client.ask(request);
        });
        eventually([&] {
            show();
            return answered.load();
        });
        return answer.get();
    }
    static ControlRequest step(std::uint32_t number) {
        ControlRequest request;
        request.verb = ControlVerb::commands;
        request.commands.instant = index::Instant(number);
        return request;
    }
    static ControlRequest verb(ControlVerb verb) {
        ControlRequest request;
        request.verb = verb;
        return request;
    }
    /// What is answered to these bytes, up to the connection's end, if nobody waits for more.
    std::string answer_to(const std::string& bytes, const ControlAddress& address) {
        const ControlSocket socket = connect_to(address);
        std::size_t sent = 0;
        while (sent < bytes.size()) {
            const ssize_t count =
                send(socket.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (count <= 0)
                break; // it has heard enough
            sent += static_cast<std::size_t>(count);
        }
        shutdown(socket.get(), SHUT_WR);
        std::string answer;
        std::array<char, 4096> piece;
        for (ssize_t count; (count = recv(socket.get(), piece.data(), piece.size(), 0)) > 0;)
            answer.append(piece.data(), static_cast<std::size_t>(count));
        return answer;
    }
    std::string answer_to(const std::string& bytes) { return answer_to(bytes, server_->address()); }

    test_support::TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_;
    ControlDesk desk_;
    std::shared_ptr<const ExplorerState> state_ = std::make_shared<ExplorerState>();
    std::uint64_t frames_ = 0, obeyed_ = 0, obeyed_in_ = 0;
    std::vector<interaction::Commands> taken_;
    std::atomic<double> now_{0}; ///< [s], of clocks; the server's threads may read it to their end
    std::optional<ControlServer> server_;
};

} // namespace isochron::app
