// Captures (pcap, pcapng) of a Velodyne VLP-16: every firing of the sixteen lasers is one scanline, a vertical column.
#pragma once

#include <string>
#include <string_view>

#include "points/point_cloud.hpp"

namespace berm::app {

// UDP datagrams of 1206 bytes, in their order; others are passed over. Points in the sensor's frame (origin: its optical centre), by rising elevation
// within a firing; firings without a return count as scanlines too. Seconds of the sensor's clock since the hour of the first packet.
// Throws PointFileError: unreadable, no capture, truncated, a malformed packet, packets out of order, no lidar packet at all.
PointCloud read_pcap(const std::string& path);

// The same from bytes; name stands for the file in errors.
PointCloud parse_pcap(std::string_view bytes, const std::string& name);

}  // namespace berm::app
