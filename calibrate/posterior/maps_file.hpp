#pragma once

#include "calibrate/posterior/maps.hpp"
#include "common/hdf5_file.hpp"

#include <string>

namespace taylorcal::calibrate {

/// Writes maps into the groups <prefix>maps_1d and <prefix>maps_2d.
void write_maps(Hdf5Writer& file, const Maps& maps, const std::string& prefix = "");

}  // namespace taylorcal::calibrate
