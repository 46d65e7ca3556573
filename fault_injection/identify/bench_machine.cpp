#include "identify/bench_machine.hpp"

#include <signal.h>
#include <sys/wait.h>

#include <stdexcept>

#include "run/child_process.hpp"
#include "run/kernel_session.hpp"
#include "run/parameter_file.hpp"
#include "run/reserved_port.hpp"

namespace berm::identify {

namespace {

constexpr double kEndPatience_s = 20.0;

// The plant, which ends with the object.
class Plant {
 public:
  Plant(const BenchPlace& place, const std::string& can, const std::string& out) {
    run::ChildOptions options;
    options.program = run::program_folder() + "/berm_plant";
    options.arguments = {"--scenario",  place.scenario, "--seed", std::to_string(place.seed), "--can", can,
                         "--scan-port", scan_port_.text(), "--out", out, "--lockstep"};
    child_.start(options);
  }
  // Its lines are read so that it never waits for a reader; true while it runs.
  bool runs() {
    child_.take_lines();
    return !child_.ended();
  }
  void end() {
    child_.signal(SIGTERM);
    if (!child_.wait_ended(kEndPatience_s)) throw std::runtime_error("the plant does not end");
  }
  std::string describe_end() { return child_.describe_end(); }
  // It did not like its input, and has said so.
  bool refused() const { return WIFEXITED(child_.exit_status()) && WEXITSTATUS(child_.exit_status()) != 0; }
  bool wait_ended(double seconds) { return child_.wait_ended(seconds); }

 private:
  const run::ReservedPort scan_port_;  // nobody listens there: reserved, so that no kernel of another run does
  run::ChildProcess child_;
};

}  // namespace

void on_bench(const config::MachineFile& machine, const BenchPlace& place, const run::Interruption& interruption,
              const std::function<void(Driver&, MachineLink&)>& tests) {
  const run::RunFolder folder;
  const run::ReservedPort can_port;
  const std::string can = can_port.can_address();
  MachineLink link(can);  // before the plant: its first cycle must not be missed
  Plant plant(place, can, place.plant_out.empty() ? folder.file("out") : place.plant_out);
  try {
    const auto watch = [&] {
      interruption.check();
      if (!plant.runs()) throw std::runtime_error("the plant ended before the tests: " + plant.describe_end());
    };
    link.while_silent(watch);  // a terminal's interrupt ends the plant, and then nothing comes any more
    while (!link.heard(100)) watch();
    Driver driver(link, machine, watch);
    tests(driver, link);
  } catch (const std::runtime_error&) {
    interruption.check();  // the plant hears the same signal, and falls silent
    if (plant.wait_ended(0.2) && plant.refused()) throw run::ToldAlready();
    throw;
  }
  plant.end();
}

}  // namespace berm::identify
