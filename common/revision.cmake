# Writes ${OUTPUT} with the version, revision and compiler; leaves it untouched when
# nothing changed. Only the folders that make up the programs count: a new row in a table
# of measurements must not make the programs, and all that they made, out of date.
set(sources CMakeLists.txt common solver emulator calibrate)
set(revision "unknown")
execute_process(COMMAND git log -1 --format=%h --abbrev=10 -- ${sources}
  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
  ERROR_QUIET RESULT_VARIABLE failed)
if(NOT failed AND commit)
  set(revision ${commit})
  execute_process(COMMAND git diff --quiet HEAD -- ${sources}
    WORKING_DIRECTORY ${SOURCE} ERROR_QUIET RESULT_VARIABLE modified)
  if(modified)
    string(APPEND revision "-modified")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "common/revision.hpp"

namespace taylorcal {

std::string project_version() { return "@VERSION@"; }
std::string source_revision() { return "@revision@"; }
std::string compiler() { return "@COMPILER@"; }

}  // namespace taylorcal
]])
