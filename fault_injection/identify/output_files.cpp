#include "identify/output_files.hpp"

#include <stdexcept>

#include "config/machine_file.hpp"
#include "config/output_file.hpp"
#include "config/strict_table.hpp"
#include "config/whole_file.hpp"
#include "run/kernel_session.hpp"

namespace berm::identify {

void check_writable(const std::string& file) {
  if (file.empty()) return;
  if (const std::string why = config::why_not_written(file); !why.empty()) throw std::runtime_error(file + ": " + why);
}

void check_readable(const std::string& machine_text) {
  const run::RunFolder folder;
  const std::string path = folder.file("measured.toml");
  config::write_whole_file(path, machine_text);
  try {
    config::load_machine_file(path);
  } catch (const config::ConfigError& error) {
    const std::string why = error.what();  // names a file that is gone with its folder
    throw std::runtime_error("the new machine file" + (why.starts_with(path) ? why.substr(path.size()) : ": " + why));
  }
}

}  // namespace berm::identify
