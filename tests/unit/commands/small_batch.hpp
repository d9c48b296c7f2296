#pragma once

#include "common/atomic_file.hpp"
#include "solver/commands/batch.hpp"
#include "solver/observe/outline.hpp"
#include "tests/unit/common/temporary_folder.hpp"

#include <atomic>
#include <cmath>
#include <limits>

namespace taylorcal::testing {

/// A design of `rows` uniform cylinders whose run numbers count down.
inline commands::Design small_design(std::size_t rows) {
    commands::Design design;
    design.input_names = {"velocity_m_s", "initial_diameter_mm", "length_to_diameter",
                          "initial_temperature_K", "hardening_coefficient"};
    design.inputs.resize(static_cast<Eigen::Index>(rows), 5);
    for (std::size_t i = 0; i < rows; ++i) {
        const auto number = static_cast<double>(i);
        design.run_id.push_back(static_cast<std::int64_t>(rows - i));
        design.seed.push_back(static_cast<std::int64_t>(100 + i));
        design.shape.push_back(i % 2 == 0 ? "uniform_cylinder" : "truncated_cone");
        design.inputs.row(static_cast<Eigen::Index>(i)) << 60 + 7 * number, 8, 5, 300,
            0.1 * number;
    }
    return design;
}

/// Stands for the physics: a quick answer that depends on the whole case. Its third and
/// fifth size are not finite, as those of a real run may be.
inline impact::ImpactResult quick_answer(const impact::ImpactCase& impact_case) {
    impact::ImpactResult result;
    result.status = impact::Status::stopped;
    const double v = impact_case.velocity_m_s / 3;
    result.sizes = {v,
                    v * v,
                    -std::numeric_limits<double>::quiet_NaN(),
                    1 / v,
                    std::numeric_limits<double>::infinity(),
                    std::sqrt(v),
                    impact_case.material.hardening_coefficient};
    for (std::size_t i = 0; i < observe::outline_points; ++i)
        result.outline_radius.push_back(1 + v * static_cast<double>(i));
    result.descriptors.plastic_work_J = impact_case.shape.station_radius.front();
    result.steps = static_cast<std::int64_t>(impact_case.seed);
    return result;
}

/// A folder, a design and its cases, to run as a batch.
class SmallBatch {
  public:
    explicit SmallBatch(std::size_t rows = 9)
        : design(small_design(rows)),
          configuration(commands::read_configuration(std::string())),
          cases(commands::make_cases(design, configuration, "design.h5")) {}

    /// Runs it into `name` and returns the file's bytes.
    std::string run(const std::string& name, int threads,
                    const commands::Simulate& simulate = quick_answer) const {
        commands::run_batch(design, cases, configuration.document, folder / name, threads,
                            simulate);
        return read_text(folder / name);
    }

    TemporaryFolder folder;
    commands::Design design;
    commands::Configuration configuration;
    std::vector<impact::ImpactCase> cases;
};

}  // namespace taylorcal::testing
