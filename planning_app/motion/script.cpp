#include "motion/script.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

using Relation = Condition::Relation;

bool other_side(const Condition& c, const Joints& angle) {
  if (c.relation == Relation::falls_below) return angle[c.joint] >= c.threshold;
  if (c.relation == Relation::rises_above) return angle[c.joint] <= c.threshold;
  return true;  // the rest need no crossing
}

bool holds(const Condition& c, const Joints& angle, bool armed) {
  const double a = angle[c.joint];
  switch (c.relation) {
    case Relation::above: return a > c.threshold;
    case Relation::below: return a < c.threshold;
    case Relation::falls_below: return armed && a < c.threshold;
    case Relation::rises_above: return armed && a > c.threshold;
    case Relation::near: return std::fabs(a - c.threshold) <= c.tolerance;
  }
  return false;
}

}  // namespace

void JointScript::start() {
  active_ = rules_.empty() ? -1 : 0;
  interrupted_ = false;
  armed_.clear();
  for (const Rule& rule : rules_) armed_.emplace_back(rule.conditions.size(), false);
}

void JointScript::look(const Joints& angle) {
  const std::size_t next = static_cast<std::size_t>(active_ + 1);
  for (std::size_t r = next; r < rules_.size(); ++r)
    for (std::size_t i = 0; i < rules_[r].conditions.size(); ++i) {
      const Condition& c = rules_[r].conditions[i];
      if ((r == next || c.since_start) && (interrupted_ || other_side(c, angle))) armed_[r][i] = true;
    }
}

void JointScript::wait_as(const JointScript& other) {
  for (std::size_t r = static_cast<std::size_t>(active_ + 1); r < std::min(rules_.size(), other.rules_.size()); ++r)
    for (std::size_t i = 0; i < std::min(rules_[r].conditions.size(), other.rules_[r].conditions.size()); ++i) {
      Condition& c = rules_[r].conditions[i];
      const double was = c.threshold;
      c = other.rules_[r].conditions[i];
      const bool sooner = c.relation == Relation::falls_below ? c.threshold > was : c.relation == Relation::rises_above && c.threshold < was;
      if (sooner && running()) armed_[r][i] = false;
    }
}

void JointScript::evaluate(const Joints& angle, std::uint32_t events) {
  if (!running() || at_last()) return;
  look(angle);
  if (next_holds(angle, events)) ++active_;
}

bool JointScript::next_holds(const Joints& angle, std::uint32_t events) const {
  const std::size_t turn = static_cast<std::size_t>(active_ + 1);
  const Rule& next = rules_[turn];
  bool all = (events & next.events) == next.events;
  for (std::size_t i = 0; i < next.conditions.size(); ++i) all = holds(next.conditions[i], angle, armed_[turn][i]) && all;
  return all;
}

bool JointScript::waits_only_for(Event event, const Joints& angle, std::uint32_t events) const {
  if (!running() || at_last()) return false;
  return !next_holds(angle, events & ~event) && next_holds(angle, events | event);
}

bool JointScript::reached(RuleMark mark) const {
  return std::any_of(rules_.begin(), rules_.begin() + active_ + 1, [mark](const Rule& rule) { return rule.mark == mark; });
}

bool JointScript::waited_for(Joint joint) const {
  const std::vector<Condition>& conditions = rules_[static_cast<std::size_t>(active_)].conditions;
  return std::any_of(conditions.begin(), conditions.end(), [joint](const Condition& c) { return c.joint == joint; });
}

void Script::start() {
  for (JointScript& s : scripts_) s.start();
}

void Script::interrupted() {
  for (JointScript& s : scripts_) s.interrupted();
}

void Script::wait_as(const Script& other) {
  for (std::size_t j = 0; j < joints; ++j) scripts_[j].wait_as(other.scripts_[j]);
}

void Script::evaluate(const Joints& angle, std::uint32_t events) {
  for (JointScript& s : scripts_) s.evaluate(angle, events);
}

Joints Script::goals() const {
  Joints g{};
  for (std::size_t j = 0; j < joints; ++j) g[j] = scripts_[j].goal();
  return g;
}

Joints Script::paces() const {
  Joints p{};
  for (std::size_t j = 0; j < joints; ++j) p[j] = scripts_[j].pace();
  return p;
}

bool Script::at_last() const {
  for (const JointScript& s : scripts_)
    if (!s.at_last()) return false;
  return true;
}

}  // namespace berm::app
