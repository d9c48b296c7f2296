#include "calibrate/comparison/groups.hpp"

#include "calibrate/comparison/words.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace taylorcal::calibrate {
namespace {

/// One measured size with everything that groups are made by.
struct Residual {
    std::string size, shape, lot, third, use;
    double relative = 0;
    double standardised = 0;
    double whitened = 0;
    Eigen::Index place = 0;  ///< among all sizes
};

std::vector<Residual> list_residuals(const std::vector<ShotComparison>& shots,
                                     const std::vector<std::string>& sizes) {
    const ThirdsOfVelocity thirds = thirds_of(shots);
    std::vector<Residual> all;
    for (const ShotComparison& shot : shots) {
        const Shot& row = shot.datum->shot;
        for (Eigen::Index i = 0; i < shot.residual.size(); ++i) {
            const auto column = shot.datum->columns[static_cast<std::size_t>(i)];
            all.push_back({sizes[static_cast<std::size_t>(column)], row.shape, row.lot,
                           thirds.word(row.velocity_m_s), use_word(row.use),
                           shot.residual(i) / shot.datum->scale_mm(i),
                           shot.standardised(i), shot.whitened(i), std::ssize(all)});
        }
    }
    return all;
}

ResidualGroup summarise_group(const std::string& by, const std::string& key,
                              const std::vector<const Residual*>& members,
                              bool has_one_shape, const JointErrors& errors) {
    const Residual& first = *members.front();
    ResidualGroup group{by, key, first.size, first.shape, first.third};
    const auto n = static_cast<double>(members.size());
    std::vector<Eigen::Index> places;
    for (const Residual* r : members) {
        places.push_back(r->place);
        group.rms_relative += r->relative * r->relative / n;
        group.mean_relative += r->relative / n;
        group.mean_standardised += r->standardised / n;
        group.mean_whitened += r->whitened / n;
        group.whitened_rms += r->whitened * r->whitened / n;
        if (r->size != group.size) group.size.clear();
        if (has_one_shape || r->shape != group.shape) group.shape.clear();
        if (r->third != group.velocity_third) group.velocity_third.clear();
    }
    group.n = members.size();
    group.rms_relative = std::sqrt(group.rms_relative);
    group.whitened_rms = std::sqrt(group.whitened_rms);
    group.mean_standardised_sd =
        std::sqrt(std::max(errors.standardised(places, places).sum(), 0.0)) / n;
    // The mean square of correlated unit normals has the variance 2 |W|^2/n^2, its root
    // half the standard deviation.
    group.whitened_rms_sd =
        Eigen::MatrixXd(errors.whitened(places, places)).norm() / (std::sqrt(2.0) * n);
    group.words = group_words(group);
    return group;
}

template <class Key>
void add_groups(std::vector<ResidualGroup>& groups, const std::string& by,
                const std::vector<Residual>& residuals, const JointErrors& errors,
                const Key& key_of) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<const Residual*>> members;
    const bool has_one_shape =
        std::all_of(residuals.begin(), residuals.end(), [&](const Residual& residual) {
            return residual.shape == residuals.front().shape;
        });
    for (const Residual& residual : residuals) {
        const std::string key = key_of(residual);
        auto& list = members[key];
        if (list.empty()) order.push_back(key);
        list.push_back(&residual);
    }
    for (const std::string& key : order)
        groups.push_back(summarise_group(by, key, members[key], has_one_shape, errors));
}

}  // namespace

ThirdsOfVelocity thirds_of(const std::vector<ShotComparison>& shots) {
    return {shots,
            [](const ShotComparison& shot) { return shot.datum->shot.velocity_m_s; }};
}

std::vector<ResidualGroup> group_residuals(const std::vector<ShotComparison>& shots,
                                           const std::vector<std::string>& sizes,
                                           const JointErrors& errors) {
    const std::vector<Residual> all = list_residuals(shots, sizes);
    std::vector<ResidualGroup> groups;
    const auto add = [&](const std::string& by, const auto& key_of) {
        add_groups(groups, by, all, errors, key_of);
    };
    add("use", [](const Residual& r) { return r.use; });
    add("size", [](const Residual& r) { return r.size; });
    add("shape", [](const Residual& r) { return r.shape; });
    add("lot", [](const Residual& r) { return r.lot; });
    add("velocity_third", [](const Residual& r) { return r.third; });
    add("shape x size x velocity_third",
        [](const Residual& r) { return r.shape + " x " + r.size + " x " + r.third; });
    return groups;
}

}  // namespace taylorcal::calibrate
