#include "truck_world/options.hpp"

#include "config/command_line.hpp"
#include "config/standard_error.hpp"

namespace berm::truck_world {

std::optional<int> read_options(int argc, char** argv, const std::string& classes, ProgramOptions& o) {
  o.classes = classes;
  CLI::App app{
      "Draws scenes with and without a truck, casts one sweep of a scanner over each, and writes the cloud and its truth. For N scenes:\n"
      "DIR/scene_000000.pcd (base frame, metres), .json (truth) and .labels.csv (what each point is of), and so on.\n"
      "Exit status 0: all was written; 1: SIGINT or SIGTERM ended it, and every scene begun is whole; 2: bad input, or something could not be written.",
      "berm truck_world"};
  app.add_option("--scenes", o.scenes, "this many scenes, numbered from 0")->required()->check(CLI::Range(1, 1000000));
  app.add_option("--seed", o.seed, "seed of every draw")->capture_default_str();
  app.add_option("--out", o.out, "folder to write to; made when it is not there. One that holds scenes is refused; with --only, one that holds scenes of another seed")->required();
  app.add_option("--only", o.only, "writes this one scene alone")->check(CLI::Range(0, 999999));
  bool all = false, none = false;
  auto* trucks = app.add_flag("--trucks", all, "a truck in every scene instead of in half of them");
  app.add_flag("--no-trucks", none, "a truck in no scene")->excludes(trucks);
  app.add_flag("--lidar", o.scene.lidar, "a tilted VLP-16 on a mast instead of the panning scanners");
  app.add_option("--points", o.scene.samples, "samples of a sweep; with more of them the head pans more slowly")
      ->check(CLI::Range(9200, 1000000))->capture_default_str();
  app.add_option("--noise", o.scene.noise.stddev, "standard deviation of a range, m")->check(CLI::Range(0.0, 0.5))->capture_default_str();
  app.add_option("--outliers", o.scene.noise.outlier_share, "share of samples with a range drawn anywhere before what is hit")
      ->check(CLI::Range(0.0, 0.5))->capture_default_str();
  app.add_option("--dropouts", o.scene.noise.dropout_share, "share of samples that come back with nothing")
      ->check(CLI::Range(0.0, 0.5))->capture_default_str();
  app.add_option("--hidden", o.scene.hidden_max, "most of the opening's edge that an occluder hides; 0: no occluders")
      ->check(CLI::Range(0.0, 0.3))->capture_default_str();
  app.add_option("--end-hidden", o.scene.end_hidden_share, "share of the trucks of which an occluder hides an end wall whole, where their place allows it")
      ->check(CLI::Range(0.0, 1.0))->capture_default_str();
  app.add_option("--swinging", o.scene.swinging_share, "share of scenes in which the machine swings during the sweep")
      ->check(CLI::Range(0.0, 1.0))->capture_default_str();
  app.add_option("--classes", o.classes, "file of truck classes")->capture_default_str();
  app.add_flag("--picture", o.picture, "also DIR/scene_000000.svg, from above and from the side, with the truth over the points");
  if (const auto status = config::parse_options(app, argc, argv)) return status;
  o.scene.content = all ? Content::truck : none ? Content::no_truck : Content::either;
  const std::string wrong = config::not_below("--only", o.only, "--scenes", o.scenes);
  if (wrong.empty()) return std::nullopt;
  config::print_error("berm truck_world: {} (see --help)\n", wrong);
  return 2;
}

}  // namespace berm::truck_world
