// A script that has every kind of rule, and what it may name.
#pragma once

#include <string>

#include "motion/script_text.hpp"

namespace berm::app::test {

inline ScriptVocabulary vocabulary() {
  ScriptVocabulary v;
  v.name = "pass";
  v.parameters = {{"truck", swing}, {"high", boom}, {"out", stick}, {"open", bucket}};
  v.events = event_emptied;
  v.marks = {{swing, RuleMark::leaves}, {swing, RuleMark::returns}};
  return v;
}

inline const std::string good = R"(# a comment
script pass
joint swing
rule "wait" : goal 0 deg
rule "go" when boom above high - 2 deg and swing back_past truck : goal truck pace 0.5 mark leaves   # and another
rule "back" when event emptied : goal truck + 1.5 deg mark returns
joint boom
rule "up" : goal high
joint stick
rule "out" : goal out
joint bucket
rule "shut" : goal open
rule "open" when swing beyond truck and stick near out within 3 deg : goal -30 deg
)";

inline ScriptText parsed(const std::string& text) { return ScriptText::parse(text, "my.script", vocabulary()); }

}  // namespace berm::app::test
