#include "calibrate/diagnosis/diagnosis_study.hpp"

#include "calibrate/comparison/words.hpp"
#include "calibrate/posterior/thinned.hpp"
#include "common/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal::calibrate {
namespace {

constexpr Eigen::Index draws_as_starts = 6;

CorrectedPredictor make_predictor(const DiagnosisInputs& inputs) {
    std::map<std::string, ShapeSignature> shapes;
    std::set<std::string> wanted;
    for (const Datum* datum : inputs.set.fitted()) wanted.insert(datum->shot.shape);
    for (const std::string& shape : wanted) {
        auto signature =
            shape_signature(inputs.runs, shape, inputs.network, inputs.settings,
                            inputs.candidates, inputs.finer);
        if (signature) shapes.emplace(shape, std::move(*signature));
    }
    return {inputs.network, inputs.settings, inputs.candidates, std::move(shapes)};
}

/// The numbers of a shot that its shape's signature has.
Datum covered_part(const Datum& datum, const ShapeSignature& signature) {
    std::vector<Eigen::Index> kept;
    for (std::size_t i = 0; i < datum.columns.size(); ++i)
        if (signature.output_of(datum.columns[i]) >= 0)
            kept.push_back(static_cast<Eigen::Index>(i));
    Datum part = datum;
    part.columns.clear();
    for (const Eigen::Index i : kept)
        part.columns.push_back(datum.columns[static_cast<std::size_t>(i)]);
    part.measured_mm = datum.measured_mm(kept);
    part.sd_mm = datum.sd_mm(kept);
    part.scale_mm = datum.scale_mm(kept);
    return part;
}

}  // namespace

DiagnosisStudy::DiagnosisStudy(DiagnosisInputs inputs)
    : inputs_(std::move(inputs)), predictor_(make_predictor(inputs_)) {
    keep_diagnosable();
}

void DiagnosisStudy::keep_diagnosable() {
    std::set<std::string> unseen;
    for (const Datum* datum : inputs_.set.fitted()) {
        const std::string& shape = datum->shot.shape;
        if (!predictor_.has(shape)) {
            unseen.insert(in_words(shape));
            continue;
        }
        Datum part = covered_part(*datum, predictor_.signature(shape));
        if (part.columns.size() < datum->columns.size())
            unseen.insert("a size of " + in_words(shape) +
                          " that the solver does not give");
        if (!part.columns.empty()) data_.push_back(std::move(part));
    }
    left_out_.assign(unseen.begin(), unseen.end());
    require(!data_.empty(),
            fmt::format("the signatures hold too few finished runs of the shapes of the "
                        "fitted shots ({}): at least {} runs without any effect are "
                        "needed for each. Make the signatures again for this table.",
                        fmt::join(left_out_, ", "), fewest_points));
}

const DiagnosisStudy::View& DiagnosisStudy::view_at(const Eigen::VectorXd& unit) const {
    std::vector<const Datum*> data;
    for (const Datum& datum : data_) data.push_back(&datum);
    CorrectedModel model(predictor_, inputs_.space, data, unit);
    ErrorBudget errors = error_budget(predictor_, model, inputs_.settings);
    views_.push_back(std::make_unique<View>(View{std::move(model), std::move(errors)}));
    return *views_.back();
}

RowMatrix DiagnosisStudy::shot_descriptors(const Eigen::VectorXd& unit) const {
    RowMatrix values = RowMatrix::Constant(
        static_cast<Eigen::Index>(data_.size()),
        static_cast<Eigen::Index>(inputs_.runs.descriptor_names.size()),
        std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index n = 0; n < values.rows(); ++n) {
        const Datum& datum = data_[static_cast<std::size_t>(n)];
        const ShapeSignature& shape = predictor_.signature(datum.shot.shape);
        if (shape.descriptors.coefficients.size() == 0) continue;
        const RowMatrix parameters =
            inputs_.space.lot_parameters(unit.transpose(), datum.lot);
        values.row(n) =
            shape
                .descriptors(shape.terms(
                    shape.descriptors,
                    predictor_.inputs(datum.shot, parameters.row(0).transpose())))
                .transpose();
    }
    return values;
}

DiagnosisProblem DiagnosisStudy::problem_at(const Eigen::VectorXd& unit) const {
    const View& view = view_at(unit);
    DiagnosisProblem problem{view.model};
    problem.covariance = view.errors.total();
    problem.freedom = view.errors.freedom();
    problem.measured.resize(problem.covariance.rows());
    for (const Datum& datum : data_) {
        for (std::size_t i = 0; i < datum.columns.size(); ++i) {
            const auto at = static_cast<Eigen::Index>(i);
            problem.measured(static_cast<Eigen::Index>(problem.data.size())) =
                datum.measured_mm(at);
            problem.data.push_back(
                {problem.shots.size(),
                 inputs_.settings.fit_sizes[static_cast<std::size_t>(datum.columns[i])],
                 datum.scale_mm(at)});
        }
        problem.shots.push_back(
            {datum.shot.id,
             datum.shot.shape,
             datum.shot.lot,
             datum.shot.velocity_m_s,
             {datum.shot.length_to_diameter(), datum.shot.initial_diameter_mm,
              datum.shot.initial_temperature_K}});
    }
    problem.parameters = inputs_.space.names();
    problem.candidates = inputs_.candidates;
    problem.descriptors = inputs_.runs.descriptor_names;
    problem.descriptor_values = shot_descriptors(unit);
    problem.seed = inputs_.settings.seed;
    problem.threads = inputs_.threads;
    return problem;
}

RowMatrix DiagnosisStudy::starts() const {
    const RowMatrix& maxima = inputs_.posterior.maxima_units;
    const RowMatrix draws = thinned(inputs_.posterior.units, draws_as_starts);
    RowMatrix all(maxima.rows() + draws.rows(), maxima.cols());
    all << maxima, draws;
    return all.cwiseMax(0.0).cwiseMin(1.0);
}

DiagnosisFacts DiagnosisStudy::facts(const DiagnosisProblem& problem,
                                     const Diagnosis& diagnosis) const {
    DiagnosisFacts facts;
    const View& view = view_at(diagnosis.modes.front().base.unit);
    facts.errors_in_words = view.errors.words(view.model);
    if (!left_out_.empty())
        facts.errors_in_words +=
            fmt::format(" Left out of the diagnosis, for want of signature runs: {}.",
                        fmt::join(left_out_, ", "));
    if (inputs_.runs.failed > 0)
        facts.errors_in_words +=
            fmt::format(" {} signature runs did not finish.", inputs_.runs.failed);
    for (const auto& [shape, signature] : predictor_.shapes())
        facts.signature_points += signature.points;
    for (std::size_t k = 0; k < problem.candidates.size(); ++k) {
        double worst = -1;
        for (const auto& [shape, signature] : predictor_.shapes())
            if (signature.effects[k])
                worst = std::max(worst, std::sqrt(signature.effects[k]->chosen_error));
        facts.signature_residual_sd.push_back(
            worst < 0 ? std::numeric_limits<double>::quiet_NaN() : worst);
    }
    for (const ModeDiagnosis& mode : diagnosis.modes) {
        const Eigen::VectorXd values = inputs_.space.values(mode.base.unit);
        facts.mode_parameters.emplace_back(values.begin(), values.end());
    }
    return facts;
}

}  // namespace taylorcal::calibrate
