// A recording in whichever of the known formats.
#pragma once

#include <string>

#include "points/point_cloud.hpp"

namespace berm::app {

// By the first bytes, not by the name: PCD, pcap or pcapng of a VLP-16, or the JSON export of an LMS1xx session. Throws PointFileError,
// read_recording also when memory is too small.
PointCloud read_recording(const std::string& path);
PointCloud parse_recording(std::string_view bytes, const std::string& name);

}  // namespace berm::app
