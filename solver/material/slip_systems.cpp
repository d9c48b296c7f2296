#include "solver/material/slip_systems.hpp"

#include <cmath>

namespace taylorcal::material {

Deviator deviator_from_tensor(const Eigen::Matrix3d& tensor) {
    const double root2 = std::sqrt(2.0);
    const double root6 = std::sqrt(6.0);
    return {(tensor(0, 0) - tensor(1, 1)) / root2,
            (2 * tensor(2, 2) - tensor(0, 0) - tensor(1, 1)) / root6,
            root2 * tensor(0, 1), root2 * tensor(0, 2), root2 * tensor(1, 2)};
}

Eigen::Matrix3d tensor_from_deviator(const Deviator& deviator) {
    const double root2 = std::sqrt(2.0);
    const double root6 = std::sqrt(6.0);
    Eigen::Matrix3d tensor;
    tensor(0, 0) = deviator[0] / root2 - deviator[1] / root6;
    tensor(1, 1) = -deviator[0] / root2 - deviator[1] / root6;
    tensor(2, 2) = 2 * deviator[1] / root6;
    tensor(0, 1) = tensor(1, 0) = deviator[2] / root2;
    tensor(0, 2) = tensor(2, 0) = deviator[3] / root2;
    tensor(1, 2) = tensor(2, 1) = deviator[4] / root2;
    return tensor;
}

const std::array<Deviator, slip_system_count>& schmid_tensors() {
    static const std::array<Deviator, slip_system_count> tensors = [] {
        std::array<Deviator, slip_system_count> made{};
        const std::array<Eigen::Vector3d, 4> planes = {
            Eigen::Vector3d{1, 1, 1}, Eigen::Vector3d{-1, 1, 1},
            Eigen::Vector3d{1, -1, 1}, Eigen::Vector3d{1, 1, -1}};
        const std::array<Eigen::Vector3d, 6> directions = {
            Eigen::Vector3d{0, 1, -1}, Eigen::Vector3d{1, 0, -1},
            Eigen::Vector3d{1, -1, 0}, Eigen::Vector3d{0, 1, 1},
            Eigen::Vector3d{1, 0, 1},  Eigen::Vector3d{1, 1, 0}};
        std::size_t system = 0;
        for (const auto& plane : planes) {
            for (const auto& direction : directions) {
                if (plane.dot(direction) != 0) continue;
                const Eigen::Matrix3d outer =
                    direction.normalized() * plane.normalized().transpose();
                made[system++] = deviator_from_tensor(0.5 * (outer + outer.transpose()));
            }
        }
        return made;
    }();
    return tensors;
}

}  // namespace taylorcal::material
