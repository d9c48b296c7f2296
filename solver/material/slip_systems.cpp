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

}  // namespace taylorcal::material
