// The histograms of heights once more, cell by cell in ordered maps and lists, as their requirements say it. Shares nothing with the core but its
// constants of format.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace berm::core_test {

struct ReferenceRules {
  std::int64_t rise, wait, period, dwell;
};

class ReferenceHistogram {
 public:
  enum class State { kLearning, kClear, kSomebody };
  struct Cell {
    State state = State::kLearning;
    std::map<int, int> seen;                    // bin to points, none of 0
    int observed = 0;
    std::int64_t line = 0;
    int votes = 0;                              // for that line
    std::vector<std::int64_t> departed;         // times, all of them
    std::int64_t ground = -1;                   // time; -1 none
  };
  using Place = std::pair<int, int>;  // row, column

  void begin() { cells_.clear(), somebody_ = -1; }
  // others: stand for what this one has not seen; itself for none. yields: to what they know the lines do.
  bool insert(const ReferenceRules& r, const ReferenceHistogram& others, bool yields, Place at, std::int64_t z, std::int64_t now);
  void pass(const ReferenceRules& r, const ReferenceHistogram& others, Place at, std::int64_t z, std::int64_t now);
  void beside(Place at, std::int64_t z);  // of another cell's point
  void line(Place at, std::int64_t z);
  void forget(double x_low, double y_low, double x_high, double y_high);
  void settle(double x_low, double y_low, double x_high, double y_high);
  // watched: whether a column is. *where: the first cell with somebody, or {-1, -1}.
  bool step(const ReferenceRules& r, bool (*watched)(Place), std::int64_t now, Place& where);
  Cell cell(Place at) const;

 private:
  static bool inside(Place at) { return at.first >= 0 && at.first < 104 && at.second >= 0 && at.second < 104; }
  static bool touched(Place at, double x_low, double y_low, double x_high, double y_high);
  long recent_around(const ReferenceRules& r, Place at, std::int64_t now) const;  // points that departed in a cell and its neighbours
  void see_ground(const ReferenceRules& r, Cell& c, long around, std::int64_t now) const;
  bool departs(const ReferenceRules& r, const Cell& c, const Cell& known, bool yields, std::int64_t z) const;
  void count(Cell& c, std::int64_t z) const;
  Cell& make(Place at);

  std::map<Place, Cell> cells_;  // those that were ever touched by a call
  std::int64_t somebody_ = -1;
};

}  // namespace berm::core_test
