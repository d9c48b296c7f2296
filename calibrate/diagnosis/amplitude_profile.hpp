#pragma once

#include "calibrate/diagnosis/refit.hpp"

#include <vector>

namespace taylorcal::calibrate {

/// One candidate's parameters and amplitude where they fit best, and the errors there.
struct BestPlace {
    Refit fit;
    Whitening whiten;
};

/// ln of the likelihood of one candidate's amplitude over all that its paired runs span:
/// at each amplitude the parameters are refitted, with their own slopes, and averaged
/// over, under the errors at the fit. If it is higher elsewhere than at the fit,
/// parameters and amplitude are fitted again from there, and the profile is made anew;
/// so that all that is said of the candidate belongs to its best place.
class AmplitudeProfile {
  public:
    /// `start`: a fit of candidate `start.fit.effects[0]`; `base`: without it.
    AmplitudeProfile(const DiagnosisProblem& problem, const Refit& base, BestPlace start);

    const BestPlace& best() const { return best_; }
    /// Equally spaced amplitudes from end to end of where the likelihood is worth
    /// anything.
    Eigen::VectorXd amplitudes(Eigen::Index count) const;
    /// ln of the likelihood, by cubics between those amplitudes that were refitted.
    double operator()(double amplitude) const;

  private:
    struct Node {
        double amplitude;
        double log_likelihood;
        Eigen::VectorXd unit;
    };
    double gain_of(const BestPlace& place) const;
    Node node_at(double amplitude, const Eigen::VectorXd& from) const;
    void insert(Node node);
    const Node& highest() const;
    void scan();
    void halve_the_heaviest();
    bool start_again();
    void leave_out_other_hills();
    double height_of_fit() const;

    const DiagnosisProblem& problem_;
    const Refit& base_;
    BestPlace best_;
    std::vector<Node> nodes_;  // by amplitude
};

}  // namespace taylorcal::calibrate
