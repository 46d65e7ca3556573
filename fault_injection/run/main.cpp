// berm load: the main job.
#include <fmt/format.h>

#include <exception>

#include "config/json_text.hpp"
#include "config/standard_error.hpp"
#include "config/whole_file.hpp"
#include "run/load_run.hpp"
#include "run/parameter_file.hpp"

int main(int argc, char** argv) {
  berm::run::RunOptions options;
  if (const auto status = berm::run::read_options(argc, argv, options)) return *status;
  try {
    const auto result = berm::run::load_trucks(options);
    fmt::print("{}", berm::run::summary_text(result));
    if (!options.json.empty()) berm::config::write_whole_file(options.json, berm::config::json_text(berm::run::flat_json(result), 2));
    const auto reasons = berm::run::shortcomings(result);
    for (const auto& reason : reasons) berm::config::print_error("berm load: {}\n", reason);
    return reasons.empty() ? 0 : 1;
  } catch (const berm::run::ToldAlready&) {
    return 2;
  } catch (const std::exception& error) {
    berm::config::print_error("berm load: {}\n", error.what());
    return 2;
  }
}
