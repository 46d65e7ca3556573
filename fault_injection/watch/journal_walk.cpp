#include "watch/journal_walk.hpp"

#include <cstring>
#include <memory>
#include <stdexcept>

#include "io/parameter_loader.hpp"
#include "record/cycle_record.hpp"
#include "record/journal_file.hpp"
#include "journal/mcap_reader.hpp"

namespace berm::watch {

namespace {

using record::McapItem;
using record::McapReader;
namespace names = record::names;

class Walk {
 public:
  explicit Walk(const std::string& path) : path_(path) {
    if (!reader_.open(path)) throw std::runtime_error(reader_.error());
  }

  void each(const std::function<void()>& visit) {
    McapItem item;
    McapReader::Result got;
    while ((got = reader_.next(item)) == McapReader::Result::kItem)
      if (take(item)) visit();
    if (got != McapReader::Result::kEnd) throw std::runtime_error(reader_.error());
    if (next_sequence_ == 0) throw std::runtime_error(path_ + ": no journal of the kernel");
  }

  const berm_parameters& parameters() const { return parameters_; }
  bool map_only() const { return start_.map_only; }
  const kernel::CycleInputs& inputs() const { return *in_; }
  const record::RecordedOutputs& recorded() const { return recorded_; }

 private:
  // True when inputs() and recorded() are those of a new cycle.
  bool take(const McapItem& item) {
    std::string error;
    bool good = true, is_cycle = false;
    if (item.kind == McapItem::Kind::kMetadata && item.name == names::kStart) {
      good = have_start_ = record::read_start(item.map, start_, error);
    } else if (item.kind == McapItem::Kind::kAttachment && item.name == names::kParameters) {
      good = have_block_ = kernel::parse_parameters(names::kParameters, item.bytes, item.size, parameters_, error);
    } else if (item.kind == McapItem::Kind::kMessage && item.name == names::kCycleTopic && item.encoding == names::kCycleEncoding) {
      is_cycle = true;
      if (!have_start_ || !have_block_) error = "a cycle before the start conditions and the parameter block";
      good = error.empty() && record::decode_cycle(item.bytes, item.size, start_.mount, *in_, recorded_, error);
      if (good && recorded_.sequence != next_sequence_) {
        good = false;
        error = "cycles are missing before record " + std::to_string(recorded_.sequence);
      }
      ++next_sequence_;
    }
    if (!good) throw std::runtime_error(path_ + ": " + error);
    return is_cycle;
  }

  std::string path_;
  McapReader reader_;
  record::StartConditions start_;
  berm_parameters parameters_{};
  bool have_start_ = false, have_block_ = false;
  std::uint64_t next_sequence_ = 0;
  std::unique_ptr<kernel::CycleInputs> in_ = std::make_unique<kernel::CycleInputs>();
  record::RecordedOutputs recorded_;
};

}  // namespace

void walk_decisions(const std::string& path, const std::function<void(const berm_decision&)>& visit) {
  Walk walk(path);
  walk.each([&] { visit(walk.recorded().decision); });
}

void walk_replayed(const std::string& path, const std::function<void(const kernel::Cycle&, const kernel::CycleOutputs&)>& visit) {
  Walk walk(path);
  std::unique_ptr<kernel::Cycle> cycle;
  const auto out = std::make_unique<kernel::CycleOutputs>();
  walk.each([&] {
    if (!cycle) cycle = std::make_unique<kernel::Cycle>(walk.parameters(), walk.map_only());
    cycle->step(walk.inputs(), *out);
    if (std::memcmp(&out->decision, &walk.recorded().decision, sizeof out->decision) != 0)
      throw std::runtime_error(path + ": replaying it gives another decision in cycle " + std::to_string(walk.inputs().cycle));
    visit(*cycle, *out);
  });
}

}  // namespace berm::watch
