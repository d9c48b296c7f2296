#include "calibrate/posterior/simplex.hpp"

#include <algorithm>
#include <vector>

namespace taylorcal::calibrate {
namespace {

constexpr int most_steps_per_dimension = 40;
constexpr double flat = 1e-3;  // difference of heights at which it stops

struct Corner {
    Eigen::VectorXd point;
    double height;
};

}  // namespace

Eigen::VectorXd climb_simplex(const std::function<double(const Eigen::VectorXd&)>& height,
                              const Eigen::VectorXd& start, const Eigen::VectorXd& size) {
    const auto corner = [&height](const Eigen::VectorXd& point) -> Corner {
        const Eigen::VectorXd inside = point.cwiseMax(0.0).cwiseMin(1.0);
        return {inside, height(inside)};
    };
    std::vector<Corner> corners{corner(start)};
    for (Eigen::Index j = 0; j < start.size(); ++j) {
        Eigen::VectorXd point = start;
        point(j) += point(j) + size(j) <= 1 ? size(j) : -size(j);
        corners.push_back(corner(point));
    }
    const auto n = static_cast<double>(start.size());
    const int steps = most_steps_per_dimension * static_cast<int>(start.size());
    for (int step = 0; step < steps; ++step) {
        std::stable_sort(
            corners.begin(), corners.end(),
            [](const auto& a, const auto& b) { return a.height > b.height; });
        Corner& worst = corners.back();
        if (corners.front().height - worst.height < flat) break;
        Eigen::VectorXd centre = Eigen::VectorXd::Zero(start.size());
        for (std::size_t c = 0; c + 1 < corners.size(); ++c)
            centre += corners[c].point / n;
        const Eigen::VectorXd across = centre - worst.point;
        const Corner reflected = corner(centre + across);
        if (reflected.height > corners.front().height) {
            const Corner further = corner(centre + 2 * across);
            worst = further.height > reflected.height ? further : reflected;
        } else if (reflected.height > corners[corners.size() - 2].height) {
            worst = reflected;
        } else {
            const double side = reflected.height > worst.height ? 0.5 : -0.5;
            const Corner nearer = corner(centre + side * across);
            if (nearer.height > std::max(worst.height, reflected.height)) {
                worst = nearer;
            } else {
                for (std::size_t c = 1; c < corners.size(); ++c)
                    corners[c] = corner(0.5 * (corners[c].point + corners.front().point));
            }
        }
    }
    return std::max_element(
               corners.begin(), corners.end(),
               [](const auto& a, const auto& b) { return a.height < b.height; })
        ->point;
}

}  // namespace taylorcal::calibrate
