#include "transition_table.hpp"

#include <map>
#include <sstream>
#include <vector>

#include "monitor_scene.hpp"

namespace berm::core_test {
namespace {

constexpr int kFlags[] = {SK_FLAG_EMPTY,   SK_FLAG_SET,      SK_FLAG_INTERPOLATED, SK_FLAG_NOT_VISITED, SK_FLAG_INTERPOLATED_NOT_VISITED,
                          SK_FLAG_CHANGED, SK_FLAG_OBSTACLE, 0x00};  // the last for every value that is no flag

struct Difference {
  const char* name;
  std::int32_t mm;
};
// New height less the cell's height, about the thresholds of Figures 6, 7 and 8 (500 mm, half of it, minus it).
constexpr Difference kDifferences[] = {{"above threshold", 501},     {"threshold", 500},          {"half threshold", 250}, {"below half", 249},
                                       {"minus threshold", -500}, {"below minus threshold", -501}};

struct Neighbourhood {
  const char* name;
  int empty, set_mm;      // so many EMPTY neighbours; one SET neighbour at this height over the cell, none if kNone
  int other;              // flag of all others, SET neighbours at -3000 mm if it is SET
};
constexpr int kNone = -3000;
constexpr Neighbourhood kNeighbourhoods[] = {{"all SET and low", 0, kNone, SK_FLAG_SET},
                                             {"one SET at neighbour threshold below the new height", 0, 1, SK_FLAG_SET},
                                             {"one SET less below the new height", 0, 2, SK_FLAG_SET},
                                             {"one SET higher than the cell by the slope threshold and more", 0, 3, SK_FLAG_SET},
                                             {"one EMPTY", 1, kNone, SK_FLAG_SET},
                                             {"two EMPTY", 2, kNone, SK_FLAG_SET},
                                             {"all INTERPOLATED", 0, kNone, SK_FLAG_INTERPOLATED},
                                             {"all CHANGED", 0, kNone, SK_FLAG_CHANGED},
                                             {"all OBSTACLE", 0, kNone, SK_FLAG_OBSTACLE}};

struct Border {
  const char* name;
  int iy, ix;
};
constexpr Border kBorders[] = {{"inside", 50, 50}, {"edge", 0, 50}, {"far edge", 50, SK_MAP_CELLS - 1}, {"corner", SK_MAP_CELLS - 1, 0}};

void surround(MonitorScene& scene, const Border& at, const Neighbourhood& n, std::int32_t new_mm) {
  int empty = n.empty;
  bool set = n.set_mm != kNone;
  for (int iy = at.iy - 1; iy <= at.iy + 1; ++iy)
    for (int ix = at.ix - 1; ix <= at.ix + 1; ++ix) {
      if ((iy == at.iy && ix == at.ix) || iy < 0 || ix < 0 || iy >= SK_MAP_CELLS || ix >= SK_MAP_CELLS) continue;
      MonitorCell cell{n.other, n.other == SK_FLAG_SET ? -3000 : 5000, 6000};
      if (empty > 0) {
        --empty;
        cell = {SK_FLAG_EMPTY, -20000, -20000};
      } else if (set) {
        set = false;
        const std::int32_t height[] = {0, new_mm - kNeighbourThreshold, new_mm - kNeighbourThreshold + 1, kSlopeThreshold + 1};
        cell = {SK_FLAG_SET, height[n.set_mm], -20000};
      }
      scene.accumulated(iy, ix, cell);
    }
}

int checked(MonitorScene& scene, int temporary, int accumulated, const Difference& d, const Neighbourhood& n, const Border& at) {
  scene.accumulated(at.iy, at.ix, {accumulated, 0, 1000});
  surround(scene, at, n, d.mm);
  scene.temporary(at.iy, at.ix, temporary, d.mm);
  sk_check_cell(scene.monitor.get(), scene.rules.get(), 0, at.iy, at.ix);
  return scene.temporary_flag(at.iy, at.ix);
}

std::string joined(const std::vector<std::string>& words, std::size_t all) {
  if (words.size() == all) return "any";
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string plain_name(int flag) { return flag == 0 ? "no flag" : flag_name(flag); }

// Rows that differ in one column only, and have the same outcome, become one.
void check_section(std::ostream& out) {
  out << "## CheckCell: the flag of the temporary cell after it\n\n"
         "| temporary | accumulated | new height less the cell's | neighbours | place in the map | becomes |\n|---|---|---|---|---|---|\n";
  MonitorScene scene(true);
  for (const int temporary : kFlags) {
    std::map<std::string, std::vector<std::string>> accumulated_of;  // the rest of the row, to the flags that have it
    std::vector<std::string> order;
    for (const int accumulated : kFlags) {
      std::ostringstream rows;
      for (const Difference& d : kDifferences) {
        std::map<std::string, std::vector<std::string>> neighbours_of;
        for (const Neighbourhood& n : kNeighbourhoods) {
          std::map<int, std::vector<std::string>> places_of;
          for (const Border& at : kBorders) places_of[checked(scene, temporary, accumulated, d, n, at)].push_back(at.name);
          for (const auto& [flag, places] : places_of) neighbours_of[joined(places, std::size(kBorders)) + " | " + plain_name(flag)].push_back(n.name);
        }
        for (const auto& [rest, names] : neighbours_of) rows << d.name << " | " << joined(names, std::size(kNeighbourhoods)) << " | " << rest << "\n";
      }
      if (accumulated_of.find(rows.str()) == accumulated_of.end()) order.push_back(rows.str());
      accumulated_of[rows.str()].push_back(plain_name(accumulated));
    }
    for (const std::string& rows : order) {
      std::map<std::string, std::vector<std::string>> differences_of;
      std::vector<std::string> ends;
      std::istringstream lines(rows);
      for (std::string line; std::getline(lines, line);) {
        const std::string end = line.substr(line.find(" | "));
        if (differences_of.find(end) == differences_of.end()) ends.push_back(end);
        differences_of[end].push_back(line.substr(0, line.find(" | ")));
      }
      for (const std::string& end : ends)
        out << "| " << plain_name(temporary) << " | " << joined(accumulated_of[rows], std::size(kFlags)) << " | "
            << joined(differences_of[end], std::size(kDifferences)) << end << " |\n";
    }
  }
}

std::string merged(MonitorScene& scene, int temporary, int accumulated, std::int32_t difference_mm, std::int32_t obstacle_mm) {
  scene.accumulated(50, 50, {accumulated, 0, obstacle_mm});
  scene.temporary(50, 50, temporary, difference_mm);
  sk_merge_cell(scene.monitor.get(), scene.rules.get(), 50, 50);
  const MonitorCell after = scene.accumulated(50, 50);
  std::string text = plain_name(scene.temporary_flag(50, 50)) + " | " + plain_name(after.flag) + " | ";
  text += after.height_mm == 0 ? "kept" : after.height_mm == difference_mm ? "new" : "WRONG";
  text += after.obstacle_height_mm == obstacle_mm ? " | kept" : after.obstacle_height_mm == difference_mm ? " | new" : " | WRONG";
  for (const bool watched : {true, false}) {
    scene.rules->watched[50][50] = watched;
    text += sk_find_obstacle(scene.monitor.get(), scene.rules.get(), &scene.where) ? " | stop" : " | -";
  }
  return text;
}

void merge_section(std::ostream& out, bool continuous) {
  out << "\n## MergeCell, " << (continuous ? "continuous updating (Figure 7)" : "initial map with continuous comparison (Figure 8)")
      << "\n\n| temporary | accumulated | new height less the cell's | obstacle height less the new | temporary becomes | accumulated becomes | height | "
         "obstacle height | in the region | outside |\n|---|---|---|---|---|---|---|---|---|---|\n";
  MonitorScene scene(continuous);
  constexpr Difference kOver[] = {{"above threshold", 501}, {"threshold", 500}, {"below new", -1}};
  for (const int temporary : kFlags)
    for (const int accumulated : kFlags) {
      std::map<std::string, std::vector<std::string>> differences_of;
      std::vector<std::string> order;
      for (const Difference& d : kDifferences) {
        std::map<std::string, std::vector<std::string>> over_of;
        for (const Difference& over : kOver) over_of[merged(scene, temporary, accumulated, d.mm, d.mm + over.mm)].push_back(over.name);
        for (const auto& [outcome, names] : over_of) {
          const std::string end = joined(names, std::size(kOver)) + " | " + outcome;
          if (differences_of.find(end) == differences_of.end()) order.push_back(end);
          differences_of[end].push_back(d.name);
        }
      }
      for (const std::string& end : order)
        out << "| " << plain_name(temporary) << " | " << plain_name(accumulated) << " | " << joined(differences_of[end], std::size(kDifferences)) << " | " << end << " |\n";
    }
}

}  // namespace

std::string transition_page() {
  std::ostringstream out;
  out << "# Transitions of the Workspace Monitor's flags\n\n"
         "Found by running `core/monitor_check` and `core/monitor_merge`; written by the program `build/bin/monitor_transitions`, and a test holds this page\n"
         "against the code. A SET cell that is `wait_us` old is judged as if it were NOT_VISITED. Thresholds: height 500 mm, neighbour 300 mm, slope 1000 mm. The requirements are in\n"
         "`safety_kernel/requirements/workspace_monitor.md`. \"no flag\" stands for every value that is none of the seven: it counts as an obstacle.\n\n";
  check_section(out);
  merge_section(out, true);
  merge_section(out, false);
  return out.str();
}

}  // namespace berm::core_test
