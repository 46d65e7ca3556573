// Point Cloud Data files, version 0.7: fields x y z (metres), scanline and time (seconds) where there; other fields are skipped.
// DATA ascii, binary and binary_compressed. Source: the PCD format's description of the Point Cloud Library.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "points/point_cloud.hpp"

namespace berm::app {

constexpr double kCoordinateLimit = 1e7;  // metres either way
constexpr double kTimeLimit = 1e10;       // seconds either way: three centuries of any clock

// Throws PointFileError: unreadable, malformed or truncated, data that go on, a VIEWPOINT that is turned, a value that is not finite or beyond its limit, scanlines that run backwards, or a time
// that runs backwards within a scanline.
std::vector<ScanPoint> read_pcd(const std::string& path);

// As read_pcd, with the file's VIEWPOINT.
PointCloud read_pcd_cloud(const std::string& path);

// The same from bytes; name stands for the file in errors.
PointCloud parse_pcd(std::string_view bytes, const std::string& name);

// The viewpoint is the translation of VIEWPOINT; nothing is rotated. Binary. Throws PointFileError when the file cannot be written.
void write_pcd(const std::string& path, const std::vector<ScanPoint>& points, const std::array<double, 3>& viewpoint = {0, 0, 0});

}  // namespace berm::app
