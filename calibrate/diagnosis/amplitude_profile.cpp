#include "calibrate/diagnosis/amplitude_profile.hpp"

#include "calibrate/diagnosis/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace taylorcal::calibrate {
namespace {

constexpr int spans_of_scan = 12;
constexpr double far_below = 18;  // in ln L: six standard errors of a normal one
/// An interval with more of the likelihood than this is halved.
constexpr double most_of_a_span = 0.08;
constexpr std::size_t most_nodes = 48;
/// ln L by which an amplitude must beat the fit for a new one to start there.
constexpr double clearly_higher = 0.5;
constexpr int most_starts = 4;

}  // namespace

AmplitudeProfile::AmplitudeProfile(const DiagnosisProblem& problem, const Refit& base,
                                   BestPlace start)
    : problem_(problem), base_(base), best_(std::move(start)) {
    for (int starts = 1;; ++starts) {
        nodes_.clear();
        insert(node_at(best_.fit.amplitudes(0), best_.fit.unit));
        scan();
        if (starts < most_starts && start_again()) continue;
        halve_the_heaviest();
        if (starts == most_starts || !start_again()) break;
    }
    leave_out_other_hills();
}

AmplitudeProfile::Node AmplitudeProfile::node_at(double amplitude,
                                                 const Eigen::VectorXd& from) const {
    const Eigen::VectorXd held = Eigen::VectorXd::Constant(1, amplitude);
    const Refit fit =
        refit_parameters(problem_, best_.whiten, best_.fit.effects, from, held);
    return {amplitude, log_average_likelihood(fit, best_.whiten.log_determinant()),
            fit.unit};
}

/// Over no candidate, under the place's own errors.
double AmplitudeProfile::gain_of(const BestPlace& place) const {
    return log_average_likelihood(place.fit, place.whiten.log_determinant()) -
           log_average_without(problem_, place.whiten, base_, place.fit);
}

void AmplitudeProfile::insert(Node node) {
    const auto at = std::lower_bound(
        nodes_.begin(), nodes_.end(), node.amplitude,
        [](const Node& other, double amplitude) { return other.amplitude < amplitude; });
    const bool is_known = at != nodes_.end() && at->amplitude == node.amplitude;
    if (!is_known)
        nodes_.insert(at, std::move(node));
    else if (node.log_likelihood > at->log_likelihood)
        *at = std::move(node);
}

const AmplitudeProfile::Node& AmplitudeProfile::highest() const {
    return *std::max_element(
        nodes_.begin(), nodes_.end(),
        [](const Node& a, const Node& b) { return a.log_likelihood < b.log_likelihood; });
}

/// Outward from the fit, each amplitude from the parameters of the one before.
void AmplitudeProfile::scan() {
    const RunRange range = range_of(problem_, best_.fit.effects[0]);
    const double width = (range.highest - range.lowest) / spans_of_scan;
    const double middle = best_.fit.amplitudes(0);
    const Eigen::VectorXd ends =
        Eigen::VectorXd::LinSpaced(spans_of_scan + 1, range.lowest, range.highest);
    for (const bool up : {true, false})
        for (Eigen::Index i = 0; i < ends.size(); ++i) {
            const double amplitude = ends(up ? i : ends.size() - 1 - i);
            if (up ? amplitude <= middle + 1e-6 * width
                   : amplitude >= middle - 1e-6 * width)
                continue;
            insert(node_at(amplitude, (up ? nodes_.back() : nodes_.front()).unit));
        }
}

/// Until every interval holds little of the likelihood.
void AmplitudeProfile::halve_the_heaviest() {
    while (nodes_.size() < most_nodes) {
        const double top = highest().log_likelihood;
        double sum = 0, most = 0;
        std::size_t heaviest = 0;
        for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
            const double width = nodes_[i + 1].amplitude - nodes_[i].amplitude;
            const double a = std::exp(nodes_[i].log_likelihood - top),
                         b = std::exp(nodes_[i + 1].log_likelihood - top);
            sum += 0.5 * width * (a + b);
            if (width * std::max(a, b) > most) {
                most = width * std::max(a, b);
                heaviest = i;
            }
        }
        if (most < most_of_a_span * sum) return;
        const Node &low = nodes_[heaviest], &high = nodes_[heaviest + 1];
        insert(node_at(0.5 * (low.amplitude + high.amplitude),
                       (low.log_likelihood > high.log_likelihood ? low : high).unit));
    }
}

/// Fits parameters and amplitude from the highest of the profile if that is clearly
/// higher than the fit; whether the new fit gains more over none, each under its own
/// errors.
bool AmplitudeProfile::start_again() {
    const Node from = highest();
    if (from.log_likelihood <= height_of_fit() + clearly_higher) return false;
    const Eigen::VectorXd amplitude = Eigen::VectorXd::Constant(1, from.amplitude);
    std::optional<Whitening> whiten(
        covariance_with(problem_, best_.fit.effects, amplitude));
    Refit fit = refit_from(problem_, whiten, best_.fit.effects, from.unit, amplitude);
    BestPlace place{std::move(fit), std::move(*whiten)};
    if (gain_of(place) <= gain_of(best_)) return false;
    best_ = std::move(place);
    return true;
}

/// Where the profile stays higher than at the fit, wider errors take the gain back: what
/// lies beyond the lowest point on the way there does not count.
void AmplitudeProfile::leave_out_other_hills() {
    const auto lower = [](const Node& a, const Node& b) {
        return a.log_likelihood < b.log_likelihood;
    };
    while (highest().log_likelihood > height_of_fit() + clearly_higher) {
        const auto at_fit = std::find_if(
            nodes_.begin(), nodes_.end(),
            [&](const Node& node) { return node.amplitude == best_.fit.amplitudes(0); });
        const auto other = std::max_element(nodes_.begin(), nodes_.end(), lower);
        const auto lowest =
            std::min_element(std::min(at_fit, other), std::max(at_fit, other), lower);
        if (lowest->log_likelihood > height_of_fit() - clearly_higher) return;
        if (other > at_fit)
            nodes_.erase(lowest + 1, nodes_.end());
        else
            nodes_.erase(nodes_.begin(), lowest);
    }
}

double AmplitudeProfile::height_of_fit() const {
    return log_average_likelihood(best_.fit, best_.whiten.log_determinant());
}

Eigen::VectorXd AmplitudeProfile::amplitudes(Eigen::Index count) const {
    const double low = highest().log_likelihood - far_below;
    const auto worth = [&](const Node& node) { return node.log_likelihood > low; };
    auto first = std::find_if(nodes_.begin(), nodes_.end(), worth);
    auto last = std::find_if(nodes_.rbegin(), nodes_.rend(), worth).base();
    if (first != nodes_.begin()) --first;
    if (last == nodes_.end()) --last;
    return Eigen::VectorXd::LinSpaced(count, first->amplitude, last->amplitude);
}

/// Cubics between amplitudes with the slopes of Fritsch and Carlson (1980): no swing
/// where the likelihood falls without bottom, as a parameter reaches its own bound.
double AmplitudeProfile::operator()(double amplitude) const {
    const std::size_t n = nodes_.size();
    const auto above = std::upper_bound(
        nodes_.begin(), nodes_.end(), amplitude,
        [](double place, const Node& node) { return place < node.amplitude; });
    const std::size_t i =
        std::clamp<std::size_t>(static_cast<std::size_t>(above - nodes_.begin()), 1,
                                n - 1) -
        1;
    const auto width = [&](std::size_t j) {
        return nodes_[j + 1].amplitude - nodes_[j].amplitude;
    };
    const auto secant = [&](std::size_t j) {
        return (nodes_[j + 1].log_likelihood - nodes_[j].log_likelihood) / width(j);
    };
    const auto slope = [&](std::size_t j) {
        if (j == 0) return secant(0);
        if (j == n - 1) return secant(n - 2);
        const double left = secant(j - 1), right = secant(j);
        if (left * right <= 0) return 0.0;
        const double a = width(j) + 2 * width(j - 1), b = 2 * width(j) + width(j - 1);
        return 3 * (width(j - 1) + width(j)) / (b / left + a / right);
    };
    const double h = width(i), t = (amplitude - nodes_[i].amplitude) / h;
    const double u = 1 - t;
    return nodes_[i].log_likelihood * u * u * (1 + 2 * t) +
           nodes_[i + 1].log_likelihood * t * t * (1 + 2 * u) +
           h * t * u * (u * slope(i) - t * slope(i + 1));
}

}  // namespace taylorcal::calibrate
