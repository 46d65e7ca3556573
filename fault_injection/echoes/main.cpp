// berm echoes: last-pulse and trailing-edge ranging on a truck in clear air and in dust.
#include <fmt/format.h>

#include <exception>
#include <nlohmann/json.hpp>

#include "config/command_line.hpp"
#include "config/json_text.hpp"
#include "config/standard_error.hpp"
#include "config/whole_file.hpp"
#include "echoes/clear_air.hpp"
#include "echoes/echo_picture.hpp"
#include "echoes/echo_table.hpp"

namespace berm::echoes {
namespace {

struct Options {
  StageOptions stage;
  int scanlines = 100, pulses = 5000;
  std::vector<double> extinctions{0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 5.0};
  double shown = 0.5;
  std::string json, picture;
};

std::optional<int> read(int argc, char** argv, Options& o) {
  CLI::App app{
      "Scans the rear of a truck (simulated) in clear air, in a cloud of dust about it and behind a cloud before it, with a receiver that ranges by the\n"
      "last pulse and one that ranges by the trailing edge, and says what each returned. Exit status 0: done; 2: bad input, or a file could not be written.",
      "berm echoes"};
  app.add_option("--seed", o.stage.seed, "seed of every draw")->capture_default_str();
  app.add_option("--scanlines", o.scanlines, "scanlines for each row of the table")->check(CLI::Range(2, 100000))->capture_default_str();
  app.add_option("--pulses", o.pulses, "pulses for each row of the table of clear air")->check(CLI::Range(100, 1000000))->capture_default_str();
  app.add_option("--extinction", o.extinctions, "of the dust, 1/m, one way: one row or several")->check(CLI::Range(0.001, 20.0))->capture_default_str();
  app.add_option("--shown", o.shown, "extinction in the picture, 1/m")->check(CLI::Range(0.001, 20.0))->capture_default_str();
  app.add_option("--rear", o.stage.rear_m, "from the scanner to the truck's rear, m")->check(CLI::Range(5.0, 8.0))->capture_default_str();
  app.add_option("--ahead", o.stage.ahead_m, "how far before the rear the cloud about the truck begins, m")->check(CLI::Range(0.0, 4.0))->capture_default_str();
  app.add_option("--reflectivity", o.stage.reflectivity, "of truck and ground")->check(CLI::Range(0.01, 1.0))->capture_default_str();
  app.add_option("--range-stddev", o.stage.range_stddev, "of the scanner's clock, m; 0: the receivers' own errors alone")
      ->check(CLI::Range(0.0, 0.5))->capture_default_str();
  app.add_option("--window", o.stage.window_percent, "transmission of the exit window, percent")->check(CLI::Range(1.0, 100.0))->capture_default_str();
  berm::config::output(app.add_option("--json", o.json, "the table as JSON to this file"));
  berm::config::output(app.add_option("--picture", o.picture, "SVG: one scanline of each receiver in clear air and in dust, and the return of one pulse"));
  return config::parse_options(app, argc, argv);
}

int run(int argc, char** argv) {
  Options o;
  if (const auto status = read(argc, argv, o)) return *status;
  const Stage stage(o.stage);
  const std::vector<EchoRow> rows = sweep(stage, o.extinctions, o.scanlines);
  fmt::print("{}", text_of(rows));
  fmt::print("{} beams a row meet the rear; rear: ranged within {:g} m; front: within {:g} m of where the beam enters the cloud; dust: more than one echo told;\n"
             "unmarked: returned from elsewhere without a sign of dust\n", rows.front().samples, met_m, front_m);
  const std::vector<ClearRow> clear = clear_air(o.stage.window_percent, o.stage.seed, o.pulses);
  fmt::print("\n{}", text_of(clear));
  if (!o.json.empty()) {
    nlohmann::json out = json_of(rows, o.stage, o.scanlines);
    out["clear_air"] = json_of(clear);
    config::write_whole_file(o.json, config::json_text(out, 2));
  }
  if (!o.picture.empty()) write_echo_picture(o.picture, stage, o.stage, o.shown);
  return 0;
}

}  // namespace
}  // namespace berm::echoes

int main(int argc, char** argv) {
  try {
    return berm::echoes::run(argc, argv);
  } catch (const std::exception& error) {
    berm::config::print_error("berm echoes: {}\n", error.what());
    return 2;
  }
}
