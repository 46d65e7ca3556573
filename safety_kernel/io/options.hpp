// The kernel's command line. Hand-written: the kernel links no option library.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

#include "config/parameter_block.h"
#include "io/vlp16.hpp"

namespace berm::kernel {

struct Options {
  std::string parameters;  // parameter block file
  std::string can;         // udp:GROUP:PORT or can:INTERFACE
  std::string socket;      // Unix socket for app and recorder
  std::uint16_t scan_port = 0;
  std::uint16_t vlp16_port = 0;  // 0: no VLP-16
  Vlp16Mount vlp16_mount;
  std::uint16_t lidar_port[BERM_LIDARS] = {};  // of the lidars on the upper body, in the parameter block's order
  int lidar_ports = 0;
  uid_t app_uid = 0;       // own uid unless given
  uid_t recorder_uid = 0;  // own uid unless given
  std::optional<uid_t> journal_uid;  // none: no journal is kept
  bool lockstep = false;
  bool map_only = false;   // map intake without a machine: never leaves INIT, sends nothing, refuses the app
  int ready_fd = -1;
};

enum class OptionsResult { kRun, kHelp, kError };

// Fills options; on kError error holds one line that names the option and its limit.
OptionsResult parse_options(int argc, const char* const* argv, Options& options, std::string& error);
const char* options_help();

}  // namespace berm::kernel
