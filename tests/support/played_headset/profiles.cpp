// The interaction profiles, as the specification lists them.
#include "tests/support/played_headset/profiles.h"

#include <algorithm>
#include <map>
#include <vector>

namespace isochron::played {
namespace {

struct Profile {
    std::vector<std::string> both, left, right;
};

const std::map<std::string, Profile>& profiles() {
    static const std::map<std::string, Profile> all{
        {"/interaction_profiles/khr/simple_controller", {{"select/click", "menu/click"}, {}, {}}},
        {"/interaction_profiles/htc/vive_controller",
         {{"system/click", "squeeze/click", "menu/click", "trigger/click", "trigger/value",
           "trackpad/x", "trackpad/y", "trackpad/click", "trackpad/touch"},
          {},
          {}}},
        {"/interaction_profiles/microsoft/motion_controller",
         {{"menu/click", "squeeze/click", "trigger/value", "thumbstick/x", "thumbstick/y",
           "thumbstick/click", "trackpad/x", "trackpad/y", "trackpad/click", "trackpad/touch"},
          {},
          {}}},
        {"/interaction_profiles/oculus/touch_controller",
         {{"squeeze/value", "trigger/value", "trigger/touch", "thumbstick/x", "thumbstick/y",
           "thumbstick/click", "thumbstick/touch", "thumbrest/touch"},
          {"x/click", "x/touch", "y/click", "y/touch", "menu/click"},
          {"a/click", "a/touch", "b/click", "b/touch", "system/click"}}},
        {"/interaction_profiles/valve/index_controller",
         {{"system/click", "system/touch", "a/click", "a/touch", "b/click", "b/touch",
           "squeeze/value", "squeeze/force", "trigger/click", "trigger/value", "trigger/touch",
           "thumbstick/x", "thumbstick/y", "thumbstick/click", "thumbstick/touch", "trackpad/x",
           "trackpad/y", "trackpad/force", "trackpad/touch"},
          {},
          {}}},
    };
    return all;
}

bool lists(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

bool is_profile(const std::string& profile) {
    return profiles().contains(profile);
}

bool has_path(const std::string& profile, const std::string& path) {
    const bool left = path.starts_with("/user/hand/left/");
    const std::string hand = left ? "/user/hand/left" : "/user/hand/right";
    if (!path.starts_with(hand + "/"))
        return false;
    const std::string rest = path.substr(hand.size());
    if (rest == "/input/grip/pose" || rest == "/input/aim/pose" || rest == "/output/haptic")
        return true;
    const std::string input = "/input/";
    if (!rest.starts_with(input))
        return false;
    const Profile& one = profiles().at(profile);
    const std::string name = rest.substr(input.size());
    return lists(one.both, name) || lists(left ? one.left : one.right, name);
}

} // namespace isochron::played
