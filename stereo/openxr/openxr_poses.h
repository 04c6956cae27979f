// Converts poses and vectors between OpenXR and the program.
#pragma once

#include "interaction/pose.h"

#include <openxr/openxr.h>

namespace isochron::stereo {

inline interaction::Pose pose_of(const XrPosef& pose) {
    return {{pose.position.x, pose.position.y, pose.position.z},
            {pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z}};
}

inline XrPosef xr_pose(const interaction::Pose& pose) {
    return {{pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w},
            {pose.position.x, pose.position.y, pose.position.z}};
}

inline glm::dvec3 vector_of(const XrVector3f& v) {
    return {v.x, v.y, v.z};
}

/// Transforms `child` from the frame of `parent` to the frame that `parent` is given in.
inline interaction::Pose placed(const interaction::Pose& parent, const interaction::Pose& child) {
    return {parent.position + parent.orientation * child.position,
            parent.orientation * child.orientation};
}

} // namespace isochron::stereo
