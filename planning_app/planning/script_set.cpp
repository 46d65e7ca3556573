#include "planning/script_set.hpp"

#include "planning/pass_script.hpp"

namespace berm::app {

namespace {

ScriptVocabulary vocabulary(const char* name, const std::vector<ScriptAngle>& angles) {
  ScriptVocabulary v;
  v.name = name;
  for (const ScriptAngle& a : angles) v.parameters.push_back({a.name, a.joint});
  return v;
}

}  // namespace

ScriptVocabulary pass_vocabulary() {
  ScriptVocabulary v = vocabulary("pass", pass_angles({}, {}, {}, {}));
  v.events = event_emptied | event_empties | event_scanned | event_weighed;
  v.marks = {{swing, RuleMark::leaves}, {swing, RuleMark::returns}, {boom, RuleMark::extends}, {stick, RuleMark::extends}, {bucket, RuleMark::opens}};
  return v;
}

ScriptVocabulary approach_vocabulary() { return vocabulary("approach", approach_angles({}, {})); }

ScriptSet read_scripts(const std::string& folder) {
  return {ScriptText::read(folder + "/pass.script", pass_vocabulary()), ScriptText::read(folder + "/approach.script", approach_vocabulary())};
}

}  // namespace berm::app
