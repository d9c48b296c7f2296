#include <spdlog/spdlog.h>

// Progress of a hundred small calibrations would bury what the tests say.
static const bool quiet = (spdlog::set_level(spdlog::level::warn), true);
