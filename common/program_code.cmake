# Writes ${OUTPUT} with the digest of the sources that ${PROGRAM} is made of; leaves it
# untouched when nothing changed. Neither dates, paths of the build nor commits count, so
# that every checkout of the same sources gives the same digest, and the workflow knows
# whether a program that was rebuilt computes what it did before. Lines that are comments
# alone do not count. The compiler does not count either, nor do options of the command
# line: they may change the last digits, as another processor does.
# The solver asks the network of its equation of state.
set(solver CMakeLists.txt common emulator/CMakeLists.txt emulator/inference
  experiments/equation_of_state/network.json solver)
set(emulator CMakeLists.txt common emulator)
# The sampler answers by the network, and does not train it.
set(calibrate CMakeLists.txt common emulator/CMakeLists.txt emulator/inference calibrate)

set(files "")
foreach(source IN LISTS ${PROGRAM})
  if(IS_DIRECTORY ${SOURCE}/${source})
    file(GLOB_RECURSE found RELATIVE ${SOURCE} ${SOURCE}/${source}/*.cpp
      ${SOURCE}/${source}/*.hpp ${SOURCE}/${source}/CMakeLists.txt)
    list(APPEND files ${found})
  else()
    list(APPEND files ${source})
  endif()
endforeach()
list(FILTER files EXCLUDE REGEX "/bench_")
list(SORT files)

set(digests "")
foreach(name IN LISTS files)
  file(READ ${SOURCE}/${name} text)
  if(NOT name MATCHES "CMakeLists.txt$")
    string(REGEX REPLACE "(^|\n)[ \t]*//[^\n]*" "" text "${text}")
  endif()
  string(SHA256 digest "${text}")
  string(APPEND digests "${name} ${digest}\n")
endforeach()
string(SHA256 code "${digests}")
string(SUBSTRING ${code} 0 16 code)

file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "common/program_code.hpp"

namespace taylorcal {

std::string program_code() { return "@code@"; }

}  // namespace taylorcal
]])
