#pragma once

#include "calibrate/diagnosis/problem.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// Low, middle and high third of the shots by velocity.
class ThirdsOfVelocity {
  public:
    explicit ThirdsOfVelocity(const std::vector<ShotLabel>& shots) {
        std::vector<double> velocities;
        velocities.reserve(shots.size());
        for (const ShotLabel& shot : shots) velocities.push_back(shot.velocity_m_s);
        std::sort(velocities.begin(), velocities.end());
        const std::size_t n = velocities.size();
        middle_ = velocities[n / 3];
        high_ = velocities[2 * n / 3];
    }
    std::size_t index(double velocity_m_s) const {
        return velocity_m_s < middle_ ? 0U : velocity_m_s < high_ ? 1U : 2U;
    }
    std::string word(double velocity_m_s) const {
        static const std::string words[] = {"low", "middle", "high"};
        return words[index(velocity_m_s)];
    }

  private:
    double middle_;  // [m/s]
    double high_;
};

}  // namespace taylorcal::calibrate
