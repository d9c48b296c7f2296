#include "calibrate/diagnosis/error_budget.hpp"

#include "calibrate/likelihood/errors_of_shot.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/core.h>

namespace taylorcal::calibrate {
namespace {

/// A measured number with what the errors need of it.
struct Place {
    const Datum* datum;
    Eigen::Index output;    // among the shape's fits
    Eigen::VectorXd terms;  // of the fit in question
    double velocity = 0;    // -1 ... 1 over the paired runs of the shape
};

constexpr double missed_reach = 0.6;  // of the scaled velocity

/// Correlation of what a polynomial misses at two shots of a shape.
double correlation_of_missed(const Place& a, const Place& b) {
    const double apart = (a.velocity - b.velocity) / missed_reach;
    return std::exp(-apart * apart / 2);
}

template <class FitOfShape>
std::vector<Place> places_in(const CorrectedPredictor& predictor,
                             const CorrectedModel& model, const FitOfShape& fit_of) {
    std::vector<Place> places;
    for (const Datum* datum : model.data()) {
        const ShapeSignature& shape = predictor.signature(datum->shot.shape);
        const SmoothFit* fit = fit_of(shape);
        const Eigen::VectorXd inputs =
            predictor.inputs(datum->shot, model.reference_of(*datum));
        const Eigen::VectorXd terms =
            fit ? shape.terms(*fit, inputs, 1) : Eigen::VectorXd();
        const double velocity = shape.scaling(inputs)(0);
        for (const Eigen::Index column : datum->columns)
            places.push_back({datum, shape.output_of(column), terms, velocity});
    }
    return places;
}

/// Adds D_i D_j noise_ab x [missed share x its correlation + terms_i spread terms_j] for
/// pairs of a shape, and what grains do within a shot.
void add_fit_errors(const std::vector<Place>& places, const CorrectedPredictor& predictor,
                    const auto& fit_of, const auto& grains_of, Eigen::MatrixXd& of_points,
                    Eigen::MatrixXd& of_coefficients) {
    const auto n = static_cast<Eigen::Index>(places.size());
    for (Eigen::Index i = 0; i < n; ++i) {
        const Place& a = places[static_cast<std::size_t>(i)];
        const ShapeSignature& shape = predictor.signature(a.datum->shot.shape);
        const SmoothFit* fit = fit_of(shape);
        if (!fit) continue;
        const Eigen::MatrixXd grains = grains_of(shape);
        const Eigen::VectorXd spread = fit->spread * a.terms;
        for (Eigen::Index j = 0; j < n; ++j) {
            const Place& b = places[static_cast<std::size_t>(j)];
            if (b.datum->shot.shape != a.datum->shot.shape) continue;
            const double area =
                a.datum->shot.initial_diameter_mm * b.datum->shot.initial_diameter_mm;
            const double noise = fit->noise(a.output, b.output);
            double points = missed_share * noise * correlation_of_missed(a, b);
            if (a.datum == b.datum) points += grains(a.output, b.output);
            of_points(i, j) += area * points;
            of_coefficients(i, j) += area * noise * spread.dot(b.terms);
        }
    }
}

/// At most this is left from the finer runs to the limit of fine cells, over the change
/// from the base runs to them: second order leaves (1/8^2)/(1/5^2 - 1/8^2) = 0.64 for
/// cones, of 5 and 8 columns, and 0.26 to 0.45 for the other shapes, whose finer runs
/// (`standard` cells) have 9 to 11.
constexpr double left_to_limit = 0.7;

/// Share of the resolution's pattern that each size may be off by of its own, as the
/// pattern is known from few runs.
constexpr double resolution_by_size = 0.5;

/// Directions in which finer cells would move all shots of a shape: the whole pattern,
/// and part of it by size.
void add_resolution(const CorrectedPredictor& predictor, const std::vector<Place>& places,
                    Eigen::MatrixXd& covariance) {
    const auto n = static_cast<Eigen::Index>(places.size());
    Eigen::VectorXd pattern = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Place& place = places[static_cast<std::size_t>(i)];
        const auto& fit = predictor.signature(place.datum->shot.shape).resolution;
        if (fit)
            pattern(i) = left_to_limit * place.datum->shot.initial_diameter_mm *
                         (*fit)(place.terms)(place.output);
    }
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const Place& a = places[static_cast<std::size_t>(i)];
            const Place& b = places[static_cast<std::size_t>(j)];
            if (a.datum->shot.shape != b.datum->shot.shape) continue;
            const double share =
                1 + (a.output == b.output ? resolution_by_size * resolution_by_size : 0);
            covariance(i, j) += share * pattern(i) * pattern(j);
        }
}

const SmoothFit* network_error_of(const ShapeSignature& shape) {
    return &shape.network_error;
}

const SmoothFit* resolution_of(const ShapeSignature& shape) {
    return shape.resolution ? &*shape.resolution : nullptr;
}

}  // namespace

ErrorBudget error_budget(const CorrectedPredictor& predictor, const CorrectedModel& model,
                         const Settings& settings) {
    const std::vector<Place> places = places_in(predictor, model, network_error_of);
    const auto n = static_cast<Eigen::Index>(places.size());
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(n, n);
    ErrorBudget budget{none, none, none, none, none, Eigen::VectorXd(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
        const Place& place = places[static_cast<std::size_t>(i)];
        budget.freedom_of_scatter(i) = std::max(
            1.0, predictor.signature(place.datum->shot.shape).network_error.freedom);
    }
    Eigen::Index at = 0;
    for (const Datum* datum : model.data()) {
        const auto count = static_cast<Eigen::Index>(datum->columns.size());
        const Eigen::VectorXd slope =
            predictor.velocity_slope(
                datum->shot, model.reference_of(*datum).transpose())(datum->columns) *
            velocity_sd(settings, datum->shot);
        budget.measurement.diagonal().segment(at, count) = datum->sd_mm.cwiseAbs2();
        budget.velocity.block(at, at, count, count) = slope * slope.transpose();
        at += count;
    }
    const auto grains_of = [](const ShapeSignature& shape) {
        return shape.grain_scatter;
    };
    add_fit_errors(places, predictor, network_error_of, grains_of, budget.scatter,
                   budget.correction);
    add_resolution(predictor, places_in(predictor, model, resolution_of),
                   budget.resolution);
    return budget;
}

Eigen::VectorXd ErrorBudget::freedom() const {
    const Eigen::ArrayXd estimated = (scatter + correction).diagonal().array();
    const Eigen::ArrayXd share = estimated / total().diagonal().array();
    return freedom_of_scatter.array() / share.max(1e-6).square();
}

std::string ErrorBudget::words(const CorrectedModel& model) const {
    Eigen::VectorXd scale(measurement.rows());
    Eigen::Index at = 0;
    for (const Datum* datum : model.data()) {
        scale.segment(at, datum->scale_mm.size()) = datum->scale_mm;
        at += datum->scale_mm.size();
    }
    const auto share = [&](const Eigen::MatrixXd& part) {
        return 100 * std::sqrt((part.diagonal().array() / scale.array().square()).mean());
    };
    return fmt::format(
        "Errors counted, root mean square in per cent of the sizes: measurement {:.2f}, "
        "velocity {:.2f}, grains of the solver and what the network's correction misses "
        "{:.2f}, the correction itself {:.2f}, {}.",
        share(measurement), share(velocity), share(scatter), share(correction),
        resolution.isZero()
            ? std::string("resolution not counted (no finer runs were given)")
            : fmt::format("resolution of the solver {:.2f}", share(resolution)));
}

Eigen::MatrixXd effect_errors(const CorrectedPredictor& predictor,
                              const CorrectedModel& model, std::size_t k) {
    const auto fit_of = [k](const ShapeSignature& shape) {
        return shape.effects[k] ? &*shape.effects[k] : nullptr;
    };
    const std::vector<Place> places = places_in(predictor, model, fit_of);
    const auto n = static_cast<Eigen::Index>(places.size());
    Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(n, n);
    const auto grains_of = [&](const ShapeSignature& shape) -> Eigen::MatrixXd {
        return (1 - missed_share) * fit_of(shape)->noise;
    };
    add_fit_errors(places, predictor, fit_of, grains_of, errors, errors);
    return errors / std::pow(predictor.typical(k), 2);
}

Eigen::MatrixXd covariance_of_new_shot(const CorrectedPredictor& predictor,
                                       const Settings& settings, const Shot& shot,
                                       const RowMatrix& parameters,
                                       const Eigen::VectorXd& relative_sd) {
    const ShapeSignature& shape = predictor.signature(shot.shape);
    const Eigen::VectorXd sizes =
        predictor.predict(shot, parameters).row(0).transpose()(shape.sizes);
    const Eigen::VectorXd slope =
        predictor.velocity_slope(shot, parameters)(shape.sizes) *
        velocity_sd(settings, shot);
    Eigen::MatrixXd covariance = slope * slope.transpose();
    covariance.diagonal() += sizes.cwiseProduct(relative_sd(shape.sizes)).cwiseAbs2();
    const double area = shot.initial_diameter_mm * shot.initial_diameter_mm;
    covariance += area * (missed_share * shape.network_error.noise + shape.grain_scatter);
    if (shape.resolution) {
        const Eigen::VectorXd pattern =
            left_to_limit * (*shape.resolution)(shape.terms(
                                *shape.resolution,
                                predictor.inputs(shot, parameters.row(0).transpose())));
        covariance += area * pattern * pattern.transpose();
        covariance.diagonal() += area * (resolution_by_size * pattern).cwiseAbs2();
    }
    return covariance;
}

}  // namespace taylorcal::calibrate
