#include "calibrate/posterior/plain_findings.hpp"

#include "calibrate/posterior/maps_file.hpp"

#include <limits>

namespace taylorcal::calibrate {
namespace {

std::vector<double> line_of(const Progression& p, bool has_evidence) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> line{p.draws, has_evidence ? p.log_evidence : none,
                             has_evidence ? p.log_evidence_sd : none, p.effective_size};
    line.insert(line.end(), p.mean.begin(), p.mean.end());
    line.insert(line.end(), p.sd.begin(), p.sd.end());
    return line;
}

std::vector<std::string> columns_of(const ParameterSpace& space) {
    std::vector<std::string> names{"draws", "ln_evidence", "ln_evidence_sd",
                                   "effective_sample_size"};
    for (const char* moment : {"mean", "sd"})
        for (std::size_t d = 0; d < space.size(); ++d)
            names.push_back(std::string(moment) + " " +
                            (space.parameter(d).log_uniform ? "log10 " : "") +
                            space.names()[d]);
    return names;
}

void write_table(Hdf5Writer& file, const std::string& name,
                 const std::vector<Progression>& lines, const ParameterSpace& space,
                 bool has_evidence) {
    const std::vector<std::string> columns = columns_of(space);
    RowMatrix table(static_cast<Eigen::Index>(lines.size()),
                    static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::vector<double> line = line_of(lines[i], has_evidence);
        table.row(static_cast<Eigen::Index>(i)) = Eigen::Map<const Eigen::RowVectorXd>(
            line.data(), static_cast<Eigen::Index>(line.size()));
    }
    file.matrix(name, table);
    file.attribute("names", columns, name);
}

}  // namespace

void write_findings(Hdf5Writer& file, const PlainFindings& findings,
                    const ParameterSpace& space, const Settings& settings) {
    // The paper's one sigma is not a model of the errors: no evidence.
    const bool has_evidence = settings.likelihood == LikelihoodForm::full;
    file.attribute("dropped_mass_bound", findings.dropping.mass_bound);
    file.attribute("rows_per_draw", findings.dropping.rows_per_draw);
    write_table(file, "convergence", findings.convergence, space, has_evidence);
    for (const SubsetFindings& subset : findings.subsets) {
        const std::string group = "subsets/" + subset.name;
        write_table(file, group + "/summary", {subset.summary}, space, has_evidence);
        write_maps(file, subset.maps, group + "/");
    }
}

}  // namespace taylorcal::calibrate
