#include "calibrate/measurements/data_set.hpp"

#include "calibrate/measurements/vocabulary.hpp"
#include "common/errors.hpp"

#include <algorithm>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal::calibrate {
namespace {

/// What relative deviations of a measured size refer to [mm].
double scale_of(const Shot& shot, const Measurement& m) {
    if (is_outline_score(m.size)) return shot.initial_diameter_mm;
    return m.size == "undeformed_length_mm" ? shot.initial_length_mm : m.value_mm;
}

Datum make_datum(const Shot& shot, const std::vector<std::string>& sizes) {
    Datum datum;
    datum.shot = shot;
    std::vector<double> values, sds, scales;
    for (std::size_t c = 0; c < sizes.size(); ++c)
        for (const Measurement& m : shot.sizes)
            if (m.size == sizes[c]) {
                datum.columns.push_back(static_cast<Eigen::Index>(c));
                values.push_back(m.value_mm);
                sds.push_back(m.sd_mm);
                scales.push_back(scale_of(shot, m));
            }
    const auto count = static_cast<Eigen::Index>(values.size());
    datum.measured_mm = Eigen::Map<Eigen::VectorXd>(values.data(), count);
    datum.sd_mm = Eigen::Map<Eigen::VectorXd>(sds.data(), count);
    datum.scale_mm = Eigen::Map<Eigen::VectorXd>(scales.data(), count);
    return datum;
}

}  // namespace

std::vector<const Datum*> DataSet::fitted() const {
    std::vector<const Datum*> chosen;
    for (const Datum& datum : data)
        if (datum.shot.use == Use::calibrate) chosen.push_back(&datum);
    return chosen;
}

DataSet make_data_set(const std::vector<Shot>& shots,
                      const std::vector<std::string>& sizes) {
    DataSet set;
    set.sizes = sizes;
    for (const Shot& shot : shots) {
        if (shot.use == Use::ignore) continue;
        Datum datum = make_datum(shot, sizes);
        if (datum.columns.empty()) continue;
        const auto lot = std::find(set.lots.begin(), set.lots.end(), shot.lot);
        datum.lot = static_cast<std::size_t>(lot - set.lots.begin());
        if (lot == set.lots.end()) set.lots.push_back(shot.lot);
        set.data.push_back(std::move(datum));
    }
    require(
        !set.fitted().empty(),
        fmt::format("no shot to fit: no row with use = calibrate has one of the sizes "
                    "in fit_sizes ({}). Set use to calibrate or name another size.",
                    fmt::join(sizes, ", ")));
    return set;
}

}  // namespace taylorcal::calibrate
