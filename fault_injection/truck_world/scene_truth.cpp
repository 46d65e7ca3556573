#include "truck_world/scene_truth.hpp"

#include <nlohmann/json.hpp>

namespace berm::truck_world {

nlohmann::ordered_json json_of(const SceneTruth& t) {
  using Json = nlohmann::ordered_json;
  const auto point = [](const auto& p) {
    Json out = Json::array();
    for (const double x : p) out.push_back(x);
    return out;
  };
  Json json;
  json["schema"] = 1;
  json["seed"] = t.seed;
  json["scene"] = t.scene;
  json["truck"] = nullptr;
  if (t.truck) {
    const TruckTruth& k = t.of_truck;
    Json& truck = json["truck"];
    truck["class"] = k.truck_class;
    truck["corners"] = Json::array();
    for (const Vector3d& corner : k.corners) truck["corners"].push_back(point(corner));
    truck["yaw"] = k.yaw;
    truck["pitch"] = k.pitch;
    truck["roll"] = k.roll;
    truck["inside_length"] = k.inside_length;
    truck["inside_width"] = k.inside_width;
    truck["wall_height"] = k.wall_height;
    truck["wall_thickness"] = k.wall_thickness;
    truck["floor_height"] = k.floor_height;
    truck["struck_m3"] = k.struck_m3;
    truck["tailgate"] = k.tailgate;
    truck["canopy"] = k.canopy;
    truck["mud"] = k.mud;
    truck["fill"] = k.fill;
    truck["fill_m3"] = k.fill_m3;
    truck["hidden_share"] = k.hidden_share;
    truck["occluded_share"] = k.occluded_share;
    truck["occluded_drawn"] = k.occluded_drawn;
    truck["occluder"] = k.occluder;
    truck["wall_hidden"] = k.wall_hidden;
    truck["returns"] = k.returns;
    truck["bed_returns"] = k.bed_returns;
  }
  json["look_alike"] = nullptr;
  if (!t.look_alike.empty()) {
    Json because = Json::array();
    if (t.no_truck.outside_sizes) because.push_back("outside_sizes");
    if (t.no_truck.wall_missing) because.push_back("wall_missing");
    if (t.no_truck.floor_missing) because.push_back("floor_missing");
    if (t.no_truck.roofed) because.push_back("roofed");
    const OpenBox& box = t.look_alike_box;
    json["look_alike"] = {
        {"kind", t.look_alike}, {"length", box.length}, {"width", box.width}, {"height", box.height}, {"no_truck_because", because}};
  }
  json["clutter"] = t.clutter;
  json["place"] = point(t.place);
  json["drop"] = t.drop;
  json["sensor"] = name_of(t.sensor);
  json["viewpoint"] = point(t.viewpoint);
  json["swing_begin"] = t.swing_begin;
  json["swing_rate"] = t.swing_rate;
  json["time_begin"] = t.time_begin;
  json["duration"] = t.duration;
  json["samples"] = t.samples;
  json["returns"] = t.returns;
  json["outliers"] = t.outliers;
  return json;
}

}  // namespace berm::truck_world
