#pragma once

#include <optional>
#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// What a row of the measurement table is for.
enum class Use { calibrate, validate, ignore };

/// One measured size of a shot.
struct Measurement {
    std::string size;  ///< column name, e.g. "final_length_mm"
    double value_mm = 0;
    double sd_mm = 0;  ///< standard deviation of the measurement
};

/// One Taylor test: a row of the measurement table.
struct Shot {
    std::string id;
    std::string place;  ///< file and line, to start messages with
    std::string lot;    ///< stock of metal
    Use use = Use::calibrate;
    std::string shape;
    double velocity_m_s = 0;
    std::optional<double> velocity_sd_m_s;
    double initial_temperature_K = 0;
    double initial_diameter_mm = 0;
    double initial_length_mm = 0;
    std::string source;
    std::vector<Measurement> sizes;

    double length_to_diameter() const { return initial_length_mm / initial_diameter_mm; }
};

std::string use_word(Use use);

}  // namespace taylorcal::calibrate
