// Sessions of a SICK LMS1xx over CoLa-B as tshark exports them: a JSON list of packets with `tcp.payload` as colon-separated hexadecimal bytes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "points/cola_b.hpp"
#include "points/point_cloud.hpp"

namespace berm::app {

// The scans in their order. Telegrams may be split over payloads; where the export tells the ports apart, each direction is a stream of its own.
// Throws PointFileError: unreadable, no such JSON, a wrong byte, frame, checksum or field, a telegram that the recording cuts off, no scan at all.
std::vector<LmsScan> parse_lms_scans(std::string_view bytes, const std::string& name);

// The farthest return of each beam as points in the scanner's plane (x at angle 0, y at 90 degrees, z = 0; origin: optical centre); a scan is a
// scanline; seconds since the scanner's start. Throws as parse_lms_scans, and for scans out of order.
PointCloud lms_points(const std::vector<LmsScan>& scans, const std::string& name);

PointCloud parse_lms(std::string_view bytes, const std::string& name);
PointCloud read_lms(const std::string& path);

}  // namespace berm::app
