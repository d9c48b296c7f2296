#include "calibrate/measurements/vocabulary.hpp"

#include "calibrate/measurements/shot.hpp"

namespace taylorcal::calibrate {

const std::vector<std::string>& use_words() {
    static const std::vector<std::string> words{"calibrate", "validate", "ignore"};
    return words;
}

const std::vector<std::string>& size_columns() {
    static const std::vector<std::string> columns{"final_length_mm",
                                                  "impact_diameter_mm",
                                                  "head_length_mm",
                                                  "rear_length_mm",
                                                  "transition_diameter_mm",
                                                  "undeformed_length_mm",
                                                  "diameter_at_0p2L0_mm",
                                                  "outline_pc_1",
                                                  "outline_pc_2",
                                                  "outline_pc_3",
                                                  "outline_pc_4"};
    return columns;
}

bool is_outline_score(const std::string& size) {
    return size.rfind("outline_pc_", 0) == 0;
}

const std::vector<std::string>& required_columns() {
    static const std::vector<std::string> columns{"id",
                                                  "lot",
                                                  "use",
                                                  "shape",
                                                  "velocity_m_s",
                                                  "initial_temperature_K",
                                                  "source",
                                                  "initial_diameter_mm",
                                                  "initial_length_mm"};
    return columns;
}

const std::vector<std::string>& known_columns() {
    static const std::vector<std::string> columns = [] {
        std::vector<std::string> all = required_columns();
        for (const std::string& size : size_columns()) {
            all.push_back(size);
            all.push_back(size + "_sd");
        }
        for (const char* name :
             {"velocity_sd_m_s", "density_kg_m3", "material", "note", "outline"})
            all.emplace_back(name);
        return all;
    }();
    return columns;
}

std::string use_word(Use use) { return use_words()[static_cast<std::size_t>(use)]; }

}  // namespace taylorcal::calibrate
