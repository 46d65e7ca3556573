// The parameter block as a file.
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "config/compile_parameters.hpp"
#include "config/strict_table.hpp"
#include "scan/scan_packet.h"

namespace berm::config {

std::int32_t parameters_crc(const berm_parameters& block) {
  std::array<std::uint8_t, offsetof(berm_parameters, crc32)> bytes{};
  std::memcpy(bytes.data(), &block, bytes.size());
  return static_cast<std::int32_t>(berm_crc32(bytes.data(), bytes.size()));
}

void save_parameters(const berm_parameters& block, const std::string& path) {
  const std::string temporary = fmt::format("{}.tmp{}", path, getpid());
  std::FILE* file = std::fopen(temporary.c_str(), "wbe");
  bool good = file != nullptr && std::fwrite(&block, sizeof block, 1, file) == 1;
  if (file != nullptr) good = (std::fclose(file) == 0) && good;
  if (!good || std::rename(temporary.c_str(), path.c_str()) != 0) {
    const int error = errno;
    std::remove(temporary.c_str());
    throw ConfigError(fmt::format("{}: cannot be written: {}", path, std::strerror(error)));
  }
}

berm_parameters load_parameters(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ConfigError(fmt::format("{}: cannot be read", path));
  berm_parameters block{};
  file.read(reinterpret_cast<char*>(&block), sizeof block);
  if (file.gcount() != static_cast<std::streamsize>(sizeof block) || file.peek() != std::ifstream::traits_type::eof())
    throw ConfigError(fmt::format("{}: size: a parameter block has exactly {} bytes", path, sizeof block));
  if (block.magic != BERM_PARAMETERS_MAGIC) throw ConfigError(fmt::format("{}: magic: no parameter block", path));
  if (block.version != BERM_PARAMETERS_VERSION) throw ConfigError(fmt::format("{}: version: {}, {} is known", path, block.version, BERM_PARAMETERS_VERSION));
  if (block.crc32 != parameters_crc(block)) throw ConfigError(fmt::format("{}: crc32: wrong", path));
  return block;
}

std::string describe(const berm_parameters& p) {
  std::string text;
  const auto row = [&text](const char* name, auto value) { text += fmt::format("{:<26}{}\n", name, value); };
  const auto four = [](const std::int32_t (&v)[4]) { return fmt::format("swing {} boom {} stick {} bucket {}", v[0], v[1], v[2], v[3]); };
  row("version", p.version);
  row("cell_mm", p.cell_mm);
  row("boom_length_mm", p.boom_length_mm);
  row("stick_length_mm", p.stick_length_mm);
  row("bucket_length_mm", p.bucket_length_mm);
  row("own_body_radius_mm", p.own_body_radius_mm);
  row("joint_low_urad", four(p.joint_low_urad));
  row("joint_high_urad", four(p.joint_high_urad));
  row("velocity_max_urad_s", four(p.velocity_max_urad_s));
  row("acceleration_max_urad_s2", four(p.acceleration_max_urad_s2));
  row("creep_velocity_urad_s", four(p.creep_velocity_urad_s));
  row("angle_error_urad", four(p.angle_error_urad));
  row("velocity_error_urad_s", four(p.velocity_error_urad_s));
  row("state_latency_us", p.state_latency_us);
  row("command_latency_us", p.command_latency_us);
  for (int r = 0; r < BERM_BRAKE_REACHES; ++r)
    row("brake, at full speed", fmt::format("reach {} mm: swing {} boom {} stick {} bucket {} urad", p.brake_reach_mm[r], p.brake_angle_urad[0][r][BERM_BRAKE_SPEEDS - 1],
                                            p.brake_angle_urad[1][r][BERM_BRAKE_SPEEDS - 1], p.brake_angle_urad[2][r][BERM_BRAKE_SPEEDS - 1],
                                            p.brake_angle_urad[3][r][BERM_BRAKE_SPEEDS - 1]));
  row("parts", p.parts);
  row("margin_mm", p.margin_mm);
  row("fresh_us", p.fresh_us);
  row("dig_swing_limit_urad_s", p.dig_swing_limit_urad_s);
  for (int i = 0; i < p.dig_zones && i < BERM_DIG_ZONES; ++i)
    row("dig_zone", fmt::format("x {}..{} y {}..{} floor {} mm", p.dig_zone[i].x_low_mm, p.dig_zone[i].x_high_mm, p.dig_zone[i].y_low_mm, p.dig_zone[i].y_high_mm,
                                p.dig_zone[i].floor_mm));
  row("request_hold_us", p.request_hold_us);
  row("request_silent_us", p.request_silent_us);
  row("crc32", fmt::format("{:08x}", static_cast<std::uint32_t>(p.crc32)));
  return text;
}

}  // namespace berm::config
