#include "motion/script_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

namespace berm::app {

namespace {

constexpr std::size_t most_bytes = 64 * 1024, most_rules = 32;
constexpr std::array<const char*, 7> relation_names{"above", "below", "rises_above", "falls_below", "beyond", "back_past", "near"};
constexpr std::array<const char*, 4> mark_names{"leaves", "extends", "opens", "returns"};  // RuleMark from 1 on
struct NamedEvent { const char* name; Event event; };
constexpr std::array<NamedEvent, 4> event_names{{{"emptied", event_emptied}, {"empties", event_empties}, {"scanned", event_scanned}, {"weighed", event_weighed}}};

template <typename Names>
std::string listed(const Names& names) {
  std::string out;
  for (const auto& name : names) out += (out.empty() ? "" : ", ") + std::string(name);
  return out.empty() ? "none" : out;
}

// For a message: one line, whatever was in the file.
std::string shown(std::string_view word) {
  std::string out;
  for (const char c : word.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return "'" + out + "'";
}

}  // namespace

const char* joint_name(std::size_t joint) { return joint_names.at(joint); }

// Of one file: a line at a time, a word at a time.
class ScriptParser {
public:
  ScriptParser(std::string_view text, const std::string& file, const ScriptVocabulary& vocabulary) : text_(text), file_(file), vocabulary_(vocabulary) {}

  ScriptText parse() {
    out_.parameters_ = vocabulary_.parameters.size();
    if (text_.size() > most_bytes) fail_file("longer than 65536 bytes");
    while (!text_.empty()) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      rest_ = text_.substr(0, end);
      if (!rest_.empty() && rest_.back() == '\r') rest_.remove_suffix(1);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++line_;
      take_line();
    }
    check_whole();
    return std::move(out_);
  }

private:
  using Operand = ScriptText::Operand;
  using Relation = ScriptText::Relation;

  [[noreturn]] void fail_file(const std::string& reason) const { throw ScriptError(file_ + ": " + reason); }
  [[noreturn]] void fail(const std::string& reason) const { throw ScriptError(file_ + ": line " + std::to_string(line_) + ": " + reason); }

  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t')) rest_.remove_prefix(1);
    if (!rest_.empty() && rest_.front() == '#') rest_ = {};
  }
  std::string_view next() {
    skip_blanks();
    std::size_t n = 0;
    if (!rest_.empty() && rest_.front() == ':') n = 1;
    else while (n < rest_.size() && std::string_view(" \t:#\"").find(rest_[n]) == std::string_view::npos) ++n;
    if (n == 0 && !rest_.empty()) n = 1;
    const std::string_view word = rest_.substr(0, n);
    rest_.remove_prefix(n);
    skip_blanks();
    return word;
  }
  bool next_is(std::string_view word) {
    const std::string_view before = rest_;
    if (next() == word) return true;
    rest_ = before;
    return false;
  }
  std::string_view expect(const char* what) {
    const std::string_view word = next();
    if (word.empty()) fail(std::string("ends where ") + what + " is due");
    return word;
  }

  void take_line() {
    skip_blanks();
    if (rest_.empty()) return;
    const std::string_view word = next();
    if (!named_) {
      if (word != "script") fail("must be 'script " + vocabulary_.name + "' before anything else, is " + shown(word));
      if (const auto name = expect("the script's name"); name != vocabulary_.name) fail("script " + shown(name) + ", must be '" + vocabulary_.name + "'");
      named_ = true;
    } else if (word == "joint") {
      begin_joint();
    } else if (word == "rule") {
      take_rule();
    } else {
      fail("begins with " + shown(word) + " (allowed: joint, rule)");
    }
    if (!rest_.empty()) fail("does not end before " + shown(rest_));
  }

  std::optional<Joint> joint_of(std::string_view word) const {
    const auto found = std::find(joint_names.begin(), joint_names.end(), word);
    return found == joint_names.end() ? std::nullopt : std::optional(static_cast<Joint>(found - joint_names.begin()));
  }

  void begin_joint() {
    const auto word = expect("a joint");
    joint_ = joint_of(word);
    if (!joint_) fail("joint " + shown(word) + " (allowed: " + listed(joint_names) + ")");
    if (begun_[*joint_]) fail("joint " + shown(word) + " stands twice");
    begun_[*joint_] = true;
  }

  std::string quoted() {
    if (rest_.empty() || rest_.front() != '"') fail("a rule's name is due, in quotation marks");
    const std::size_t end = rest_.find('"', 1);
    if (end == std::string_view::npos) fail("the name has no second quotation mark");
    const std::string name(rest_.substr(1, end - 1));
    if (name.empty() || name.size() > 80) fail("a rule's name has 1 to 80 characters");
    if (!std::all_of(name.begin(), name.end(), [](char c) { return c >= ' ' && c <= '~'; })) fail("a rule's name has a character that is not printable ASCII");
    rest_.remove_prefix(end + 1);
    skip_blanks();
    return name;
  }

  double number(const char* what, double low, double high) {
    const std::string_view word = expect(what);
    double x = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
    const auto brief = [](double limit) {
      std::string digits = std::to_string(limit);
      digits.erase(digits.find_last_not_of('0') + 1);
      if (digits.back() == '.') digits.pop_back();
      return digits;
    };
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(x) || x < low || x > high)
      fail(std::string(what) + " " + shown(word) + " (allowed: " + brief(low) + " .. " + brief(high) + ")");
    return x;
  }
  double angle(const char* what, double low_deg, double high_deg) {
    const double x = number(what, low_deg, high_deg);
    if (!next_is("deg")) fail(std::string(what) + " has no unit (allowed: deg)");
    return radians(x);
  }

  // An angle of a joint: NAME, NAME + 2 deg, NAME - 2 deg, 30 deg.
  Operand operand(Joint joint) {
    const std::string_view before = rest_, word = expect("an angle");
    if (word.front() == '-' || word.front() == '+' || (word.front() >= '0' && word.front() <= '9')) {
      rest_ = before;
      return {-1, angle("angle", -360.0, 360.0)};
    }
    const auto& all = vocabulary_.parameters;
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.name == word; });
    if (found == all.end() || found->joint != joint) {
      std::vector<std::string> known;
      for (const auto& p : all)
        if (p.joint == joint) known.push_back(p.name);
      fail((found == all.end() ? "no parameter " + shown(word) : shown(word) + " is no angle of the " + joint_name(joint)) + " (of the " + joint_name(joint) +
           ": " + listed(known) + ")");
    }
    Operand out{static_cast<int>(found - all.begin()), 0.0};
    const bool plus = next_is("+");
    if (plus || next_is("-")) out.offset = (plus ? 1.0 : -1.0) * angle("offset", 0.0, 90.0);
    return out;
  }

  void take_condition(ScriptText::TextRule& rule) {
    const std::string_view word = expect("a condition");
    if (word == "event") {
      const std::string_view name = expect("an event");
      std::vector<std::string> known;
      for (const NamedEvent& e : event_names) {
        if ((vocabulary_.events & e.event) == 0) continue;
        known.emplace_back(e.name);
        if (name == e.name) {
          rule.events |= e.event;
          return;
        }
      }
      fail("no event " + shown(name) + " in this script (allowed: " + listed(known) + ")");
    }
    const auto joint = joint_of(word);
    if (!joint) fail("a condition begins with " + shown(word) + " (allowed: event, " + listed(joint_names) + ")");
    const std::string_view name = expect("a comparison");
    const auto found = std::find(relation_names.begin(), relation_names.end(), name);
    if (found == relation_names.end()) fail("no comparison " + shown(name) + " (allowed: " + listed(relation_names) + ")");
    const auto relation = static_cast<Relation>(found - relation_names.begin());
    if (*joint != swing && (relation == Relation::beyond || relation == Relation::back_past)) fail(shown(name) + " is for the swing alone");
    const Operand threshold = operand(*joint);
    double tolerance = 0.0;
    if (relation == Relation::near) {
      if (!next_is("within")) fail("'near' has no 'within'");
      tolerance = angle("tolerance", 0.1, 90.0);
    }
    rule.conditions.push_back({*joint, relation, threshold, tolerance});
  }

  void take_rule() {
    if (!joint_) fail("a rule before the first joint");
    auto& rules = out_.rules_[*joint_];
    if (rules.size() == most_rules) fail("more than 32 rules of a joint");
    ScriptText::TextRule rule;
    rule.name = quoted();
    if (next_is("when")) {
      do take_condition(rule);
      while (next_is("and"));
    }
    const bool conditional = rule.events != event_none || !rule.conditions.empty();
    if (rules.empty() && conditional) fail("the first rule of a joint is active from the start: it has no 'when'");
    if (!rules.empty() && !conditional) fail("a rule after the first needs 'when'");
    if (!next_is(":")) fail("':' is due" + (rest_.empty() ? std::string() : " before " + shown(rest_)));
    if (!next_is("goal")) fail("'goal' is due after ':'");
    rule.goal = operand(*joint_);
    if (next_is("pace")) rule.pace = number("pace", 0.05, 1.0);
    if (next_is("mark")) {
      const std::string_view name = expect("a mark");
      const auto found = std::find(mark_names.begin(), mark_names.end(), name);
      if (found == mark_names.end()) fail("no mark " + shown(name) + " (allowed: " + listed(mark_names) + ")");
      rule.mark = static_cast<RuleMark>(1 + (found - mark_names.begin()));
      const bool needed = std::any_of(vocabulary_.marks.begin(), vocabulary_.marks.end(), [&](const auto& m) { return m.joint == *joint_ && m.mark == rule.mark; });
      if (!needed) fail("mark " + shown(name) + " has no meaning for the " + joint_name(*joint_) + " of this script");
      if (std::any_of(rules.begin(), rules.end(), [&](const auto& r) { return r.mark == rule.mark; })) fail("mark " + shown(name) + " stands twice for the " + joint_name(*joint_));
    }
    rules.push_back(std::move(rule));
  }

  void check_whole() const {
    if (!named_) fail_file("holds no script; must begin with 'script " + vocabulary_.name + "'");
    for (std::size_t j = 0; j < joints; ++j)
      if (out_.rules_[j].empty()) fail_file(std::string("joint ") + joint_name(j) + " has no rules");
    std::array<std::ptrdiff_t, joints> last{-1, -1, -1, -1};
    for (const auto& [joint, mark] : vocabulary_.marks) {
      const auto& rules = out_.rules_[joint];
      const auto found = std::find_if(rules.begin(), rules.end(), [m = mark](const auto& r) { return r.mark == m; });
      const std::string name = mark_names.at(static_cast<std::size_t>(mark) - 1);
      if (found == rules.end()) fail_file(std::string("joint ") + joint_name(joint) + " has no rule with the mark '" + name + "'");
      if (found == rules.begin()) fail_file(std::string("joint ") + joint_name(joint) + ": the first rule cannot have the mark '" + name + "'");
      if (found - rules.begin() < last[joint]) fail_file(std::string("joint ") + joint_name(joint) + ": the mark '" + name + "' comes too early");
      last[joint] = found - rules.begin();
    }
  }

  std::string_view text_, rest_;
  std::string file_;
  const ScriptVocabulary& vocabulary_;
  ScriptText out_;
  int line_ = 0;
  bool named_ = false;
  std::optional<Joint> joint_;
  std::array<bool, joints> begun_{};
};

ScriptText ScriptText::parse(std::string_view text, const std::string& file, const ScriptVocabulary& vocabulary) {
  return ScriptParser(text, file, vocabulary).parse();
}

ScriptText ScriptText::read(const std::string& file, const ScriptVocabulary& vocabulary) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw ScriptError(file + ": cannot be read");
  std::string text(most_bytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad() || (stream.gcount() == 0 && !stream.eof())) throw ScriptError(file + ": cannot be read");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return parse(text, file, vocabulary);
}

Script ScriptText::bind(std::span<const double> values, double side) const {
  if (values.size() != parameters_) throw std::invalid_argument("script: a value for each parameter is due");
  const auto value = [&](const Operand& o) {
    if (o.parameter < 0) return o.offset;
    const double x = values[static_cast<std::size_t>(o.parameter)];
    return o.offset == 0.0 ? x : x + o.offset;
  };
  const auto turned = [side](Relation r) {
    switch (r) {
      case Relation::above: return Condition::Relation::above;
      case Relation::below: return Condition::Relation::below;
      case Relation::rises_above: return Condition::Relation::rises_above;
      case Relation::falls_below: return Condition::Relation::falls_below;
      case Relation::beyond: return side > 0.0 ? Condition::Relation::above : Condition::Relation::below;
      case Relation::back_past: return side > 0.0 ? Condition::Relation::falls_below : Condition::Relation::rises_above;
      case Relation::near: break;
    }
    return Condition::Relation::near;
  };
  std::array<JointScript, joints> out;
  for (std::size_t j = 0; j < joints; ++j) {
    std::vector<Rule> rules;
    for (const TextRule& from : rules_[j]) {
      Rule rule{from.name, {}, from.events, value(from.goal), from.pace, from.mark};
      for (const TextCondition& c : from.conditions) rule.conditions.push_back({c.joint, turned(c.relation), value(c.threshold), c.tolerance, c.relation == Relation::back_past});
      rules.push_back(std::move(rule));
    }
    out[j] = JointScript(std::move(rules));
  }
  return Script(std::move(out));
}

double ScriptText::pace_of(Joint joint, RuleMark mark) const {
  for (const TextRule& rule : rules_[joint])
    if (rule.mark == mark) return rule.pace;
  return 1.0;
}

std::vector<bool> ScriptText::used() const {
  std::vector<bool> out(parameters_, false);
  const auto note = [&](const Operand& o) {
    if (o.parameter >= 0) out[static_cast<std::size_t>(o.parameter)] = true;
  };
  for (const auto& rules : rules_)
    for (const TextRule& rule : rules) {
      note(rule.goal);
      for (const TextCondition& c : rule.conditions) note(c.threshold);
    }
  return out;
}

std::string goal_out_of_range(const MachineModel& machine, const Script& script) {
  for (std::size_t j = 0; j < joints; ++j)
    for (const Rule& rule : script.of(static_cast<Joint>(j)).rules()) {
      const JointLimits& limits = machine.joint[j];
      if (std::isfinite(rule.goal) && rule.goal >= limits.low - limits.angle_error && rule.goal <= limits.high + limits.angle_error) continue;
      return std::string(joint_name(j)) + ", rule '" + rule.name + "': goal " + std::to_string(degrees(rule.goal)) + " deg (allowed: " +
             std::to_string(degrees(limits.low)) + " .. " + std::to_string(degrees(limits.high)) + ")";
    }
  return {};
}

}  // namespace berm::app
