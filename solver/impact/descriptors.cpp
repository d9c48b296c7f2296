#include "solver/impact/impact_result.hpp"

namespace taylorcal::impact {
namespace {

struct Entry {
    const char* name;
    double Descriptors::*member;
};

constexpr Entry entries[] = {
    {"stop_time_us", &Descriptors::stop_time_us},
    {"largest_temperature_K", &Descriptors::largest_temperature_K},
    {"peak_strain_rate_per_s", &Descriptors::peak_strain_rate_per_s},
    {"plastic_work_J", &Descriptors::plastic_work_J},
    {"sliding_distance_mm", &Descriptors::sliding_distance_mm},
    {"smallest_grain_um", &Descriptors::smallest_grain_um},
    {"largest_weakened_fraction", &Descriptors::largest_weakened_fraction},
    {"largest_plastic_strain", &Descriptors::largest_plastic_strain},
    {"mean_von_mises_GPa", &Descriptors::mean_von_mises_GPa},
    {"viscous_share", &Descriptors::viscous_share},
    {"hourglass_share", &Descriptors::hourglass_share},
    {"energy_error", &Descriptors::energy_error},
};

}  // namespace

const std::vector<std::string>& descriptor_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Entry& entry : entries) list.emplace_back(entry.name);
        return list;
    }();
    return names;
}

std::vector<double> descriptor_values(const Descriptors& descriptors) {
    std::vector<double> values;
    for (const Entry& entry : entries) values.push_back(descriptors.*entry.member);
    return values;
}

}  // namespace taylorcal::impact
