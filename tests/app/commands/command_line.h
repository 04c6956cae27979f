// A folder with a small series, and the commands run in it as a user runs them.
#pragma once

#include "tests/support/as_words.h"
#include "tests/support/child_process.h"
#include "tests/support/paths.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>

namespace isochron::app {

/// A folder with a series of raw float steps `t0.raw` ... `t4.raw`.
class CommandLine : public testing::Test {
  protected:
    CommandLine() {
        setenv("XDG_STATE_HOME", home_.path().c_str(), 1); // not the user's
        std::mt19937 random(test_seed());
        std::uniform_real_distribution<double> phase(0, 6.28);
        const double a = phase(random), b = phase(random), c = phase(random);
        for (std::size_t t = 0; t < kSteps; ++t) {
            std::vector<float> values;
            for (std::size_t z = 0; z < kZ; ++z)
                for (std::size_t y = 0; y < kY; ++y)
                    for (std::size_t x = 0; x < kX; ++x)
                        values.push_back(static_cast<float>(
                            std::sin(0.5 * double(x) + a + 0.1 * double(t)) +
                            std::cos(0.6 * double(y) + b) * std::sin(0.7 * double(z) + c)));
            folder.write(fmt::format("t{}.raw", t),
                         {reinterpret_cast<const char*>(values.data()), values.size() * 4});
            steps.push_back(std::move(values));
        }
    }

    ChildResult isochron(const std::vector<std::string>& arguments, const ChildOptions& how = {}) {
        return run_child(test_support::binary_root() + "/isochron", arguments, folder.path(), how);
    }
    static std::vector<std::string> build_of(const std::string& files,
                                             const std::vector<std::string>& more = {}) {
        std::vector<std::string> all{"build", files,    "--dims", "14", "11",
                                     "9",     "--type", "f32",    "-o", "a.isochron"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    /// The definition of active cells, written out.
    std::vector<std::uint32_t> active(std::size_t step, double isovalue) const {
        std::vector<std::uint32_t> ids;
        std::uint32_t id = 0;
        for (std::size_t z = 0; z + 1 < kZ; ++z)
            for (std::size_t y = 0; y + 1 < kY; ++y)
                for (std::size_t x = 0; x + 1 < kX; ++x, ++id) {
                    double low = INFINITY, high = -INFINITY;
                    for (std::size_t corner = 0; corner < 8; ++corner) {
                        const double v =
                            steps[step][((z + corner / 4) * kY + y + corner / 2 % 2) * kX + x +
                                        corner % 2];
                        low = std::min(low, v);
                        high = std::max(high, v);
                    }
                    if (low < isovalue && isovalue <= high)
                        ids.push_back(id);
                }
        return ids;
    }

    /// One line on stderr that starts with the program's name, nothing on stdout.
    static void expect_failure(const ChildResult& result, int status, const std::string& message) {
        EXPECT_EQ(result.status, status) << result.err;
        EXPECT_THAT(result.out, testing::IsEmpty());
        EXPECT_THAT(result.err, testing::HasSubstr(message));
        EXPECT_THAT(result.err, testing::StartsWith("isochron: "));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }

    std::vector<std::uint32_t> ids_in(const std::string& name) const {
        const std::string bytes = folder.read(name);
        std::vector<std::uint32_t> ids(bytes.size() / 4);
        if (!ids.empty())
            std::memcpy(ids.data(), bytes.data(), bytes.size());
        return ids;
    }

    static constexpr std::size_t kX = 14, kY = 11, kZ = 9, kSteps = 5;
    TestFolder folder;
    std::vector<std::vector<float>> steps;

  private:
    TestFolder home_;
};

} // namespace isochron::app
