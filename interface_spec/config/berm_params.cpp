// berm_params: compiles a machine and a site file into the kernel's parameter block, or shows a block.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "config/command_line.hpp"
#include "config/compile_parameters.hpp"
#include "config/standard_error.hpp"

int main(int argc, char** argv) {
  std::string machine, site, out, show;
  CLI::App app{"Compiles a machine file and a site file (TOML) into the kernel's parameter block, or shows a block.", "berm_params"};
  auto* machine_option = app.add_option("MACHINE", machine, "machine profile, TOML");
  auto* site_option = app.add_option("SITE", site, "site, TOML");
  auto* out_option = berm::config::output(app.add_option("-o,--out", out, "where the block goes"));
  app.add_option("--show", show, "print what a block says")->excludes(machine_option)->excludes(site_option)->excludes(out_option);
  if (const auto status = berm::config::parse_options(app, argc, argv)) return *status;
  try {
    if (!show.empty()) {
      fmt::print("{}", berm::config::describe(berm::config::load_parameters(show)));
      return 0;
    }
    if (machine.empty() || site.empty() || out.empty()) {
      berm::config::print_error("berm_params: MACHINE, SITE and --out are needed, or --show FILE (see --help)\n");
      return 2;
    }
    const auto block = berm::config::compile_parameters(berm::config::load_machine_file(machine), berm::config::load_site_file(site));
    berm::config::save_parameters(block, out);
    return 0;
  } catch (const std::exception& error) {
    berm::config::print_error("berm_params: {}\n", error.what());
    return 2;
  }
}
