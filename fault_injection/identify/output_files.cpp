#include "identify/output_files.hpp"

#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "config/machine_file.hpp"
#include "config/whole_file.hpp"
#include "run/kernel_session.hpp"

namespace berm::identify {

namespace fs = std::filesystem;

void check_writable(const std::string& file) {
  if (file.empty()) return;
  const fs::path folder = fs::path(file).has_parent_path() ? fs::path(file).parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) throw std::runtime_error(file + ": its folder does not exist");
  if (access(folder.c_str(), W_OK) != 0 || fs::is_directory(file)) throw std::runtime_error(file + ": cannot be written");
}

void check_readable(const std::string& machine_text) {
  const run::RunFolder folder;
  const std::string path = folder.file("measured.toml");
  config::write_whole_file(path, machine_text);
  config::load_machine_file(path);
}

}  // namespace berm::identify
