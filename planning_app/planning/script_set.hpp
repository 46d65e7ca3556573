// The app's scripts, read from a folder: which there are, and which parameters the planner provides for each.
#pragma once

#include <string>
#include <vector>

#include "motion/script_text.hpp"

namespace berm::app {

// A parameter of a script and its value, rad.
struct ScriptAngle { const char* name; Joint joint; double value; };

// The vocabulary of a script with these parameters.
ScriptVocabulary pass_vocabulary();
ScriptVocabulary approach_vocabulary();

struct ScriptSet {
  ScriptText pass, approach;
};

// folder/pass.script and folder/approach.script. Throws ScriptError, one line with file, line and what is allowed.
ScriptSet read_scripts(const std::string& folder);

}  // namespace berm::app
