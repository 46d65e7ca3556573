#include "run/parameter_file.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "config/one_line.hpp"
#include "run/child_process.hpp"
#include "run/kernel_session.hpp"

namespace berm::run {

namespace {

std::string find_file(const std::string& kind, const std::string& folder, const std::string& name) {
  if (name.find('/') != std::string::npos || name.ends_with(".toml")) return name;
  const std::filesystem::path shelf = std::filesystem::path(BERM_DATA_DIR) / folder;
  const auto path = shelf / (name + ".toml");
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) return path.string();  // too long a name is none of ours
  std::vector<std::string> known;
  for (const auto& entry : std::filesystem::directory_iterator(shelf, ignored))
    if (entry.path().extension() == ".toml") known.push_back(entry.path().stem().string());
  std::sort(known.begin(), known.end());
  std::string list;
  for (const auto& one : known) list += (list.empty() ? "" : ", ") + one;
  throw std::runtime_error(kind + " '" + config::excerpt(name) + "': there is none of that name (there are: " + list + ")");
}

}  // namespace

std::string find_machine(const std::string& name) { return find_file("machine", "interface_spec/config/machines", name); }
std::string find_site(const std::string& name) { return find_file("site", "interface_spec/config/sites", name); }
std::string truck_classes_file() { return find_file("truck classes", "interface_spec/config", "truck_classes"); }
std::string scripts_folder() { return (std::filesystem::path(BERM_DATA_DIR) / "planning_app/scripts").string(); }
std::string find_scenario(const std::string& name) { return find_file("scenario", "fault_injection/scenarios", name); }
std::string find_soil(const std::string& name) { return find_file("soil", "fault_injection/soils", name); }

void expect_content(const ChildProcess& child) {
  if (WIFSIGNALED(child.exit_status())) throw std::runtime_error(child.name() + " died: " + child.describe_end());
  if (child.exit_status() != 0) throw ToldAlready();
}

void compile_parameter_file(const std::string& machine, const std::string& site, const std::string& path) {
  ChildProcess compiler;
  ChildOptions options;
  options.program = program_folder() + "/berm_params";
  options.arguments = {machine, site, "-o", path};
  compiler.start(options);
  constexpr double kPatience_s = 20.0;
  if (!compiler.wait_ended(kPatience_s)) throw std::runtime_error("berm_params does not end");
  expect_content(compiler);
  open_to_children(path);
}

}  // namespace berm::run
