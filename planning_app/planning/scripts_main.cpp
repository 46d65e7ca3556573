// berm_scripts: checks a folder of scripts for whoever edits them.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "config/command_line.hpp"
#include "config/standard_error.hpp"
#include "planning/script_set.hpp"

namespace {

using namespace berm::app;

void show(const ScriptText& text, const ScriptVocabulary& vocabulary) {
  fmt::print("{}:", vocabulary.name);
  for (std::size_t j = 0; j < joints; ++j) fmt::print(" {} {} rules{}", joint_name(j), text.rules_of(static_cast<Joint>(j)), j + 1 < joints ? "," : "\n");
  const std::vector<bool> used = text.used();
  for (std::size_t j = 0; j < joints; ++j) {
    fmt::print("  angles of the {}:", joint_name(j));
    for (std::size_t i = 0; i < used.size(); ++i)
      if (vocabulary.parameters[i].joint == j) fmt::print(" {}{}", vocabulary.parameters[i].name, used[i] ? "" : " (not used)");
    fmt::print("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App cli{"Checks the scripts of a folder, pass.script and approach.script, and lists the parameters that rules may name. Exit status 0: the app takes them.",
               "berm_scripts"};
  std::string folder = BERM_SCRIPTS;
  bool quiet = false;
  cli.add_flag("--quiet", quiet, "says nothing but what is wrong");
  cli.add_option("folder", folder, "folder of scripts")->capture_default_str();
  if (const auto status = berm::config::parse_options(cli, argc, argv)) return *status;
  try {
    const ScriptSet scripts = read_scripts(folder);
    if (quiet) return 0;
    show(scripts.pass, pass_vocabulary());
    show(scripts.approach, approach_vocabulary());
    return 0;
  } catch (const std::exception& e) {
    berm::config::print_error("berm scripts: {}\n", e.what());
    return 1;
  }
}
