// The Workspace Monitor's two maps at one moment, or what its histograms hold, with the truth about the people on the site.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/monitor_rules.h"
#include "run/site_picture.hpp"
#include "watch/footprint.hpp"
#include "watch/intruder_watch.hpp"

namespace berm::watch {

struct MonitorPictureInput {
  std::string title;
  sk_monitor monitor;
  std::unique_ptr<sk_monitor_histogram> histogram;  // null: heights are compared with
  sk_monitor_rules rules;
  run::SitePictureInput site;                 // dig zones and the truck's bed
  std::vector<run::MoverPath> paths;          // of the whole run, true
  std::vector<Footprint> now;                 // where people and vehicles were at this moment
  std::vector<Alarm> alarms;                  // of the whole run
};

void write_monitor_picture(const std::string& path, const MonitorPictureInput& input);

}  // namespace berm::watch
