#include "calibrate/prediction/shot_inputs.hpp"

#include <map>

namespace taylorcal::calibrate {
namespace {

using Reader = double (*)(const Shot&);

const std::map<std::string, Reader>& readers() {
    static const std::map<std::string, Reader> all{
        {"velocity_m_s", [](const Shot& shot) { return shot.velocity_m_s; }},
        {"initial_diameter_mm",
         [](const Shot& shot) { return shot.initial_diameter_mm; }},
        {"initial_length_mm", [](const Shot& shot) { return shot.initial_length_mm; }},
        {"length_to_diameter",
         [](const Shot& shot) { return shot.length_to_diameter(); }},
        {"initial_temperature_K",
         [](const Shot& shot) { return shot.initial_temperature_K; }}};
    return all;
}

}  // namespace

bool is_shot_input(const std::string& name) { return readers().contains(name); }

double shot_input(const std::string& name, const Shot& shot) {
    return readers().at(name)(shot);
}

}  // namespace taylorcal::calibrate
