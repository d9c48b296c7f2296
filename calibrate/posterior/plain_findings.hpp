#pragma once

#include "calibrate/posterior/maps.hpp"
#include "calibrate/sampling/parameter_space.hpp"
#include "calibrate/settings/settings.hpp"
#include "common/hdf5_file.hpp"

#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// How far a pass of plain draws had come: one line of the table of convergence.
struct Progression {
    double draws = 0, log_evidence = 0, log_evidence_sd = 0, effective_size = 0;
    Eigen::VectorXd mean, sd;  ///< of the parameters (of log10 where log-uniform)
};

/// Mass that dropping draws cost, and what it saved.
struct Dropping {
    double mass_bound = 0;     ///< of the posterior, by all dropped draws together
    double rows_per_draw = 0;  ///< seen on average before a draw was dropped
};

/// A part of the table fitted alone.
struct SubsetFindings {
    std::string name;
    Progression summary;
    Maps maps;
};

/// What a pass of plain draws finds beyond posterior and maps.
struct PlainFindings {
    std::vector<Progression> convergence;
    Dropping dropping;
    std::vector<SubsetFindings> subsets;
};

/// Writes the attributes dropped_mass_bound and rows_per_draw, the table `convergence`,
/// and the group subsets/<name> with a line of that table, `summary`, and maps for each.
void write_findings(Hdf5Writer& file, const PlainFindings& findings,
                    const ParameterSpace& space, const Settings& settings);

}  // namespace taylorcal::calibrate
