#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace taylorcal::testing {

/// The recipe that an emulator file carries, followed word by word in double precision
/// and without any of the program's own code.
inline std::vector<double> follow_recipe(const nlohmann::json& file, std::size_t member,
                                         const std::map<std::string, double>& point,
                                         const std::string& category) {
    std::vector<double> z;
    for (const auto& input : file["inputs"]) {
        if (!input["used"].get<bool>()) continue;
        double x = point.at(input["name"].get<std::string>());
        if (input["transform"] == "log10") x = std::log10(x);
        if (input["transform"] == "square_root") x = std::sqrt(x);
        z.push_back((x - input["shift"].get<double>()) / input["scale"].get<double>());
    }
    if (!file["category"].is_null()) {
        for (const auto& value : file["category"]["values"])
            z.push_back(value == category);
    }
    const auto& layers = file["members"][member]["layers"];
    for (std::size_t l = 0; l < layers.size(); ++l) {
        std::vector<double> sums;
        for (std::size_t i = 0; i < layers[l]["bias"].size(); ++i) {
            double sum = layers[l]["bias"][i].get<double>();
            for (std::size_t j = 0; j < z.size(); ++j) {
                sum += layers[l]["weights"][i][j].get<double>() * z[j];
            }
            sums.push_back(l + 1 < layers.size() ? sum / (1 + std::exp(-sum)) : sum);
        }
        z = sums;
    }
    for (std::size_t k = 0; k < z.size(); ++k) {
        const auto& output = file["outputs"][k];
        z[k] = z[k] * output["scale"].get<double>() + output["shift"].get<double>();
        for (const auto& name : output["divide_by"])
            z[k] *= point.at(name.get<std::string>());
    }
    return z;
}

}  // namespace taylorcal::testing
