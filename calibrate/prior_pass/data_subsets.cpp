#include "calibrate/prior_pass/data_subsets.hpp"

#include <algorithm>
#include <functional>

namespace taylorcal::calibrate {
namespace {

/// The sizes of a datum for which `keep` holds.
Datum with_sizes(const Datum& datum, const std::vector<std::string>& sizes,
                 const std::function<bool(const std::string&)>& keep) {
    Datum kept = datum;
    kept.columns.clear();
    std::vector<Eigen::Index> places;
    for (std::size_t i = 0; i < datum.columns.size(); ++i) {
        if (!keep(sizes[static_cast<std::size_t>(datum.columns[i])])) continue;
        kept.columns.push_back(datum.columns[i]);
        places.push_back(static_cast<Eigen::Index>(i));
    }
    kept.measured_mm = datum.measured_mm(places);
    kept.sd_mm = datum.sd_mm(places);
    kept.scale_mm = datum.scale_mm(places);
    return kept;
}

std::size_t fitted_sizes(const DataSet& set) {
    std::size_t count = 0;
    for (const Datum* datum : set.fitted()) count += datum->columns.size();
    return count;
}

}  // namespace

std::vector<DataSubset> data_subsets(const DataSet& set) {
    std::vector<std::string> shapes;
    for (const Datum* datum : set.fitted())
        if (std::find(shapes.begin(), shapes.end(), datum->shot.shape) == shapes.end())
            shapes.push_back(datum->shot.shape);
    std::vector<DataSubset> subsets;
    const auto add =
        [&](const std::string& name,
            const std::function<bool(const Shot&, const std::string&)>& keep) {
            DataSubset subset{name, {set.sizes, set.lots, {}}};
            for (const Datum& datum : set.data) {
                Datum kept = with_sizes(datum, set.sizes, [&](const std::string& size) {
                    return keep(datum.shot, size);
                });
                if (!kept.columns.empty()) subset.set.data.push_back(std::move(kept));
            }
            const std::size_t size = fitted_sizes(subset.set);
            if (size > 0 && size < fitted_sizes(set))
                subsets.push_back(std::move(subset));
        };
    for (const std::string& shape : shapes) {
        add("shape_" + shape,
            [&](const Shot& shot, const std::string&) { return shot.shape == shape; });
        add("without_" + shape,
            [&](const Shot& shot, const std::string&) { return shot.shape != shape; });
    }
    const std::string length = "final_length_mm", diameter = "impact_diameter_mm";
    add("final_length",
        [&](const Shot&, const std::string& size) { return size == length; });
    add("impact_diameter",
        [&](const Shot&, const std::string& size) { return size == diameter; });
    add("other_sizes", [&](const Shot&, const std::string& size) {
        return size != length && size != diameter;
    });
    return subsets;
}

}  // namespace taylorcal::calibrate
