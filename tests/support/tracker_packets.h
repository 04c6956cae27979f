// Plays a tracker: makes datagrams of DTrack and Open Sound Control devices, and sends them.
// Written from the protocols' descriptions, without the code under test.
#pragma once

#include "interaction/pose.h"
#include "interaction/trackers/udp_socket.h"

#include <glm/mat3x3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::test_support {

struct PlayedBody {
    int id = 0;
    glm::dvec3 position{0.0}; ///< [m]
    glm::dmat3 rotation{1.0};
    bool tracked = true; ///< for Flysticks only: an untracked body is left out
};
struct PlayedFlystick {
    PlayedBody body;
    std::uint32_t buttons = 0;
    std::vector<double> controllers;
};

/// One frame of DTrack2: fr, ts, 6dcal, 6d, 6df2, 3d, in lines that end with CR LF.
std::string dtrack_datagram(std::uint32_t counter, std::optional<double> stamp,
                            const std::vector<PlayedBody>& bodies,
                            const std::vector<PlayedFlystick>& flysticks = {},
                            const std::vector<glm::dvec3>& markers = {});

/// An argument of type i, f or d.
struct OscArgument {
    char type;
    double value;
};
std::string osc_message(std::string_view address, const std::vector<OscArgument>& arguments);
/// A message with x y z and qx qy qz qw as floats.
std::string osc_pose(std::string_view address, const interaction::Pose& pose);
/// @param stamp [s] since 1900; 0: immediately
std::string osc_bundle(double stamp, const std::vector<std::string>& elements);

/// Sends datagrams to one address.
class UdpSender {
  public:
    explicit UdpSender(const interaction::Endpoint& to);
    ~UdpSender();
    UdpSender(const UdpSender&) = delete;
    UdpSender& operator=(const UdpSender&) = delete;
    /// @return whether it was sent; over loopback it has then arrived
    bool send(std::string_view bytes) const;

  private:
    int socket_ = -1;
};

} // namespace isochron::test_support
