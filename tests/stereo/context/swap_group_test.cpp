// Swap groups, with drivers that have them and with drivers that do not.
#include "stereo/context/swap_group.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

namespace isochron::stereo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// What the driver under test has, and what it was asked for.
struct Driver {
    std::string extensions = "GLX_ARB_multisample GLX_NV_swap_group GLX_EXT_swap_control";
    unsigned groups = 1, barriers = 1;
    int joins = 1, binds = 1;
    std::vector<std::string> calls;
};
Driver driver; // NOLINT: entry points of GLX have no user pointer

int token = 0;
void* current() {
    return &token;
}
unsigned long drawable() {
    return 77;
}
int query_context(void*, void*, int, int* screen) {
    *screen = 3;
    return 0;
}
const char* extensions(void*, int screen) {
    driver.calls.push_back("extensions of screen " + std::to_string(screen));
    return driver.extensions.c_str();
}
int max_groups(void*, int, unsigned* groups, unsigned* barriers) {
    *groups = driver.groups;
    *barriers = driver.barriers;
    return 1;
}
int join(void*, unsigned long window, unsigned group) {
    driver.calls.push_back("join " + std::to_string(window) + " to " + std::to_string(group));
    return driver.joins;
}
int bind(void*, unsigned group, unsigned barrier) {
    driver.calls.push_back("bind " + std::to_string(group) + " to " + std::to_string(barrier));
    return driver.binds;
}

void* entry(const char* name) {
    static const std::map<std::string, void*> entries{
        {"glXGetCurrentDisplay", reinterpret_cast<void*>(current)},
        {"glXGetCurrentContext", reinterpret_cast<void*>(current)},
        {"glXGetCurrentDrawable", reinterpret_cast<void*>(drawable)},
        {"glXQueryContext", reinterpret_cast<void*>(query_context)},
        {"glXQueryExtensionsString", reinterpret_cast<void*>(extensions)},
        {"glXQueryMaxSwapGroupsNV", reinterpret_cast<void*>(max_groups)},
        {"glXJoinSwapGroupNV", reinterpret_cast<void*>(join)},
        {"glXBindSwapBarrierNV", reinterpret_cast<void*>(bind)}};
    const auto found = entries.find(name);
    return found == entries.end() ? nullptr : found->second;
}

std::string complaint(const render::GlLoader& load = entry) {
    try {
        join_swap_group(load);
    } catch (const render::Error& error) {
        return error.what();
    }
    return "";
}

class SwapGroup : public testing::Test {
  protected:
    SwapGroup() { driver = {}; }
};

TEST_F(SwapGroup, TheWindowJoinsTheGroupAndTheGroupTheBarrier) {
    EXPECT_EQ(complaint(), "");
    EXPECT_THAT(driver.calls, ElementsAre("extensions of screen 3", "join 77 to 1", "bind 1 to 1"));
}

TEST_F(SwapGroup, ADriverWithoutItIsNamedAndLeftAlone) {
    driver.extensions = "GLX_NV_swap_groups GLX_ARB_multisample";
    EXPECT_THAT(complaint(), HasSubstr("cluster.swap_group: the driver has no GLX_NV_swap_group"));
    EXPECT_THAT(driver.calls, ElementsAre("extensions of screen 3"));
    EXPECT_THAT(complaint([](const char*) -> void* { return nullptr; }),
                HasSubstr("there is no glXGetCurrentDisplay"));
}

TEST_F(SwapGroup, WhatTheBoardsLackIsSaid) {
    driver.barriers = 0;
    EXPECT_THAT(complaint(), HasSubstr("1 swap groups and 0 swap barriers"));
    driver = {};
    driver.joins = 0;
    EXPECT_THAT(complaint(), HasSubstr("join"));
    driver = {};
    driver.binds = 0;
    EXPECT_THAT(complaint(), HasSubstr("synchronization board"));
}

} // namespace
} // namespace isochron::stereo
