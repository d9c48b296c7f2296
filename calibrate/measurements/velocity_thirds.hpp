#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// Low, middle and high third of shots by velocity.
class ThirdsOfVelocity {
  public:
    /// `velocity_of`: the velocity [m/s] of one of `shots`, at least one.
    template <class Shot, class VelocityOf>
    ThirdsOfVelocity(const std::vector<Shot>& shots, const VelocityOf& velocity_of) {
        std::vector<double> velocities;
        velocities.reserve(shots.size());
        for (const Shot& shot : shots)
            velocities.push_back(std::invoke(velocity_of, shot));
        std::sort(velocities.begin(), velocities.end());
        const std::size_t n = velocities.size();
        middle_from_ = velocities[n / 3];
        high_from_ = velocities[2 * n / 3];
    }
    std::size_t index(double velocity_m_s) const {
        return velocity_m_s < middle_from_ ? 0U : velocity_m_s < high_from_ ? 1U : 2U;
    }
    std::string word(double velocity_m_s) const {
        static const std::string words[] = {"low", "middle", "high"};
        return words[index(velocity_m_s)];
    }
    /// Lowest velocity of the middle and of the high third [m/s].
    double middle_from() const { return middle_from_; }
    double high_from() const { return high_from_; }

  private:
    double middle_from_;
    double high_from_;
};

}  // namespace taylorcal::calibrate
