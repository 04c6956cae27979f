// Commands in which one call on a file, or one allocation, fails.
#pragma once

#include "tests/app/commands/command_line.h"
#include "tests/support/eventually.h"
#include "tests/support/every_fault.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <sstream>

namespace isochron::app {

/// Runs commands with the n-th call made to fail, for many n. With ISOCHRON_EVERY_FAULT in the
/// environment all are tried, else some.
class Faults : public CommandLine {
  protected:
    struct Fault {
        std::string kind, how;
    };
    static std::vector<Fault> file_faults() {
        std::vector<Fault> all;
        for (const char* kind : {"open", "read", "write", "sync", "rename", "size"})
            for (const char* how : {"ENOSPC", "EIO"})
                all.push_back({kind, how});
        for (const char* kind : {"read", "write"})
            for (const char* how : {"EINTR", "short"})
                all.push_back({kind, how});
        return all;
    }

    ChildResult with(const Fault& fault, long at, const std::vector<std::string>& arguments) {
        std::filesystem::remove(mark());
        return isochron(
            arguments,
            {.dies_after = test_support::kPatience,
             .environment = {"LD_PRELOAD=" + test_support::binary_root() + "/libfaulty_calls.so",
                             fmt::format("ISOCHRON_FAULT={}:{}:{}", fault.kind, at, fault.how),
                             "ISOCHRON_FAULT_MARK=" + mark()}});
    }
    bool was_met() const { return std::filesystem::exists(mark()); }
    std::string mark() const { return marks_.path() / "met"; }

    /// Calls `each` with the result of the command for many n, until it makes fewer calls than n.
    /// @return how often the fault was met
    template <class Prepare, class Check>
    int each_call(const Fault& fault, const std::vector<std::string>& arguments, Prepare prepare,
                  Check check) {
        int met = 0;
        test_support::FaultyCalls calls([](long at) { return 3 * at + 1; });
        for (long at = calls.next();; at = calls.next()) {
            prepare();
            const ChildResult result = with(fault, at, arguments);
            SCOPED_TRACE(fmt::format("{} {} {}: status {}, {}", fault.kind, at, fault.how,
                                     result.status, result.err));
            if (!was_met()) {
                EXPECT_EQ(result.status, 0);
                return met;
            }
            ++met;
            if (ended_by_a_library(result)) {
                ++library_ends_;
                for (const std::string& name : folder.names())
                    if (name.ends_with(".tmp"))
                        std::filesystem::remove(folder.path() / name);
                check(result);
                continue;
            }
            EXPECT_LT(result.status, 128); // killed by no signal
            if (result.status != 0) {
                EXPECT_EQ(complaints(result.err), 1) << result.err;
            }
            // Interrupted and short transfers are no errors: the rest follows.
            if (fault.kind != "new" && (fault.how == "EINTR" || fault.how == "short")) {
                EXPECT_EQ(result.status, 0);
            }
            check(result);
            if (HasFailure())
                return met;
        }
    }

    /// What the program keeps of its user lies in the same folder, so that calls on it fail, too.
    void keep_state_here() {
        std::filesystem::create_directory(folder.path() / "state");
        setenv("XDG_STATE_HOME", (folder.path() / "state").c_str(), 1);
    }

    std::string hash_of(const std::string& index) {
        const ChildResult verified = isochron({"verify", index});
        EXPECT_EQ(verified.status, 0) << verified.err;
        const std::string info = isochron({"info", index, "--json"}).out;
        const std::size_t at = info.find("\"content_hash\"");
        return info.substr(at, info.find('\n', at) - at);
    }
    void copy(const std::string& from, const std::string& to) {
        std::filesystem::copy_file(folder.path() / from, folder.path() / to,
                                   std::filesystem::copy_options::overwrite_existing);
    }

    /// Makes a recording one of 12 frames, all as its first one and a sixtieth of a second apart,
    /// however many were drawn.
    void make_twelve_frames(const std::string& recording) {
        std::istringstream lines(folder.read(recording));
        std::string text, first;
        std::getline(lines, text);
        std::getline(lines, first);
        nlohmann::json frame = nlohmann::json::parse(first);
        frame.erase("latched");
        for (int i = 0; i < 12; ++i) {
            frame["t"] = i / 60.0;
            text += "\n" + frame.dump();
        }
        folder.write(recording, text + "\n");
    }

    /// The lines that are errors; the last must be one. Some commands first say what they do.
    static long complaints(const std::string& text) {
        const std::string lines = "\n" + text;
        long count = 0;
        for (std::size_t at = lines.find("\nisochron: "); at != std::string::npos;
             at = lines.find("\nisochron: ", at + 1)) {
            ++count;
            if (lines.find('\n', at + 1) == lines.size() - 1)
                return count;
        }
        return -1;
    }

    /// nlohmann's JSON asks for memory when it is destroyed, and ends the program where there is
    /// none.
    static bool ended_by_a_library(const ChildResult& result) {
        return result.status == 1000 + SIGABRT && result.err.ends_with("what():  std::bad_alloc\n");
    }
    int library_ends() const { return library_ends_; }

  private:
    TestFolder marks_;
    int library_ends_ = 0;
};

} // namespace isochron::app
