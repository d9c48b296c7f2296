#include "solver/commands/material_point.hpp"

#include "common/errors.hpp"
#include "solver/material/equation_of_state.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace taylorcal::commands {

namespace {

using material::broadcast;

/// One grain between two records.
class MaterialPoint {
  public:
    explicit MaterialPoint(const DeformationPath& path)
        : parameters_(path.parameters),
          eos_(material::make_equation_of_state(path.parameters)),
          strength_(material::make_strength<double>(path.parameters, {path.orientation})),
          density_(path.parameters.initial_density),
          thermo_(eos_->at(density_, 0)) {}

    void prescribe(const Eigen::Matrix3d& velocity_gradient) {
        divergence_ = velocity_gradient.trace();
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                input_.velocity_gradient[3 * i + j] = broadcast(velocity_gradient(i, j));
    }

    void advance(double time_step) {
        const double old_density = density_;
        density_ *= std::exp(-divergence_ * time_step);
        input_.density = broadcast(density_);
        input_.temperature = broadcast(thermo_.temperature);
        input_.shear_modulus = broadcast(
            material::shear_modulus(thermo_.bulk_modulus, parameters_.poisson_ratio));
        input_.time_step = time_step;
        strength_->update(0, input_, output_);
        // Trapezoidal pressure work, Eq. 3: the pressure at the end follows from the
        // energy that the pressure at the start leads to.
        const double expansion = 1 / density_ - 1 / old_density;
        const double heat = parameters_.taylor_quinney * output_.plastic_power[0] *
                            time_step / std::sqrt(density_ * old_density);
        const double start_pressure = thermo_.pressure;
        const double predicted = energy_ + heat - start_pressure * expansion;
        const double end_pressure = eos_->at(density_, predicted).pressure;
        energy_ += heat - 0.5 * (start_pressure + end_pressure) * expansion;
        thermo_ = eos_->at(density_, energy_);
    }

    PointRecord record(double time) const {
        PointRecord record{time, {}, thermo_.temperature, strength_->state(0)};
        for (std::size_t i = 0; i < 6; ++i)
            record.stress_deviator[i] = output_.stress_deviator[i][0];
        return record;
    }

  private:
    material::Parameters parameters_;
    std::unique_ptr<material::EquationOfState> eos_;
    std::unique_ptr<material::Strength<double>> strength_;
    double density_;
    double energy_ = 0;
    double divergence_ = 0;
    material::ThermoState thermo_;
    material::BlockInput<double> input_{};
    material::BlockOutput<double> output_{};
};

double von_mises(const std::array<double, 6>& s) {
    return std::sqrt(1.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) +
                     3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

void check_finite(const PointRecord& record) {
    const double sum = von_mises(record.stress_deviator) + record.temperature +
                       record.grain.mobile_density_m2 + record.grain.immobile_density_m2;
    if (!std::isfinite(sum))
        throw NumericalError(
            fmt::format("the state is not finite at {} s. Choose a "
                        "smaller time_step_s or a slower path.",
                        record.time));
}

}  // namespace

std::vector<PointRecord> follow(const DeformationPath& path) {
    // A quotient that is whole but for rounding must not cost one more step.
    constexpr double rounding = 1e-9;
    MaterialPoint point(path);
    std::vector<PointRecord> records;
    double start = 0;
    for (const PathSegment& segment : path.segments) {
        point.prescribe(segment.velocity_gradient);
        const auto outputs = static_cast<double>(segment.outputs);
        const double interval = segment.duration / outputs;
        const double steps =
            std::max(1.0, std::ceil(interval / path.time_step - rounding));
        for (long long k = 1; k <= segment.outputs; ++k) {
            for (double done = 0; done < steps; ++done) point.advance(interval / steps);
            records.push_back(point.record(start + segment.duration *
                                                       static_cast<double>(k) / outputs));
            check_finite(records.back());
        }
        start += segment.duration;
    }
    return records;
}

std::string to_csv(const std::vector<PointRecord>& records) {
    std::string csv =
        "time_s,von_mises_Pa,stress_deviator_xx_Pa,stress_deviator_yy_Pa,"
        "stress_deviator_zz_Pa,stress_deviator_xy_Pa,stress_deviator_xz_Pa,"
        "stress_deviator_yz_Pa,temperature_K,mobile_density_m2,immobile_density_m2,"
        "slip_resistance_Pa,equivalent_plastic_strain,grain_diameter_m,"
        "weakened_fraction,annihilated_energy_J_m3\n";
    for (const PointRecord& r : records) {
        csv += fmt::format("{},{}", r.time, von_mises(r.stress_deviator));
        for (const double component : r.stress_deviator)
            csv += fmt::format(",{}", component);
        const material::GrainState& g = r.grain;
        csv += fmt::format(
            ",{},{},{},{},{},{},{},{}\n", r.temperature, g.mobile_density_m2,
            g.immobile_density_m2, g.slip_resistance_Pa, g.equivalent_plastic_strain,
            g.grain_diameter_m, g.weakened_fraction, g.annihilated_energy_J_m3);
    }
    return csv;
}

}  // namespace taylorcal::commands
