// berm truck_world: scenes for a truck recogniser, as files.
#include <fmt/format.h>
#include <string.h>
#include <unistd.h>

#include <chrono>
#include <exception>
#include <filesystem>

#include "config/standard_error.hpp"
#include "run/interruption.hpp"
#include "run/out_folder.hpp"
#include "truck_world/options.hpp"
#include "truck_world/scene_files.hpp"

namespace berm::truck_world {
namespace {

int run(int argc, char** argv) {
  ProgramOptions o;
  if (const auto status = read_options(argc, argv, BERM_TRUCK_CLASSES, o)) return *status;
  const std::vector<TruckClass> classes = read_truck_classes(o.classes);
  std::error_code error;
  std::filesystem::create_directories(o.out, error);
  if (!std::filesystem::is_directory(o.out)) throw std::runtime_error(fmt::format("--out: {}: cannot be made a folder", o.out));
  const run::OutFolder held(o.out);
  if (const std::string wrong = of_another_run(o.out, o.seed, o.only >= 0); !wrong.empty()) throw std::runtime_error("--out: " + wrong);

  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto begin = std::chrono::steady_clock::now();
  const int first = o.only >= 0 ? o.only : 0, end = o.only >= 0 ? o.only + 1 : o.scenes, asked = end - first;
  const run::Interruption interruption;
  int trucks = 0, look_alikes = 0, done = 0;
  for (int number = first; number < end && !interruption.asked(); ++number) {
    const Scene scene = draw_scene(classes, o.scene, o.seed, number);
    write_scene(o.out, scene, o.picture);
    trucks += scene.truth.truck ? 1 : 0;
    look_alikes += scene.truth.look_alike.empty() ? 0 : 1;
    done = number - first + 1;
    if (terminal) config::print_error("\r{} of {} scenes", done, asked);
    else if (done % 100 == 0) config::print_error("{} of {} scenes\n", done, asked);
  }
  if (terminal) config::print_error("\n");
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const int signal = done < asked ? interruption.take() : 0;
  if (signal != 0) config::print_error("berm truck_world: interrupted ({}) after {} of {} scenes\n", strsignal(signal), done, asked);
  if (done == 0) return 1;
  const std::string of = done < asked ? fmt::format(" of {}", asked) : "";
  fmt::print("{}{} scenes in {}{}: {} with a truck, {} with something like one, {} with neither; {:.1f} scenes/s\n", done, of, o.out,
             of.empty() ? "" : " (interrupted)", trucks, look_alikes, done - trucks - look_alikes, done / std::max(seconds, 1e-9));
  return signal == 0 ? 0 : 1;
}

}  // namespace
}  // namespace berm::truck_world

int main(int argc, char** argv) {
  try {
    return berm::truck_world::run(argc, argv);
  } catch (const std::exception& error) {
    berm::config::print_error("berm truck_world: {}\n", error.what());
    return 2;
  }
}
