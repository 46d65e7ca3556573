// berm_kernel: the safety kernel's process.
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "config/one_line.hpp"
#include "config/standard_output.hpp"
#include "io/options.hpp"
#include "io/parameter_loader.hpp"
#include "io/shell.hpp"

namespace {

volatile int stop_requested = 0;  // the one variable a signal handler can reach

void on_stop(int) { stop_requested = 1; }

void install_handlers() {
  struct sigaction action {};
  action.sa_handler = on_stop;
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
}

int fail(const std::string& error) {
  berm::config::put_error("berm_kernel: " + error);
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace berm::kernel;
  berm::config::watch_standard_output("berm_kernel");
  Options options;
  std::string error;
  const OptionsResult parsed = parse_options(argc, argv, options, error);
  if (parsed == OptionsResult::kHelp) {
    std::fputs(options_help(), stdout);
    return EXIT_SUCCESS;
  }
  if (parsed == OptionsResult::kError) return fail(error);
  berm_parameters parameters;
  if (!load_parameters(options.parameters, parameters, error)) return fail(error);
  install_handlers();
  Shell shell(options, parameters);
  if (!shell.open(error)) return fail(error);
  shell.run(stop_requested);
  std::printf("%s\n", shell.report().c_str());
  std::fflush(stdout);
  return EXIT_SUCCESS;
}
