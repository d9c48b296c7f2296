#pragma once

#include "calibrate/diagnosis/problem.hpp"
#include "calibrate/diagnosis/shape_signature.hpp"
#include "calibrate/measurements/data_set.hpp"
#include "calibrate/sampling/parameter_space.hpp"

#include <map>
#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// What the solver would say of any shot: network + delta + sum of effects,
/// f = network(theta) + D [delta(v, theta) + sum kappa_k d_k(v, theta, kappa_k)],
/// D the initial diameter; the polynomials are those of the shot's shape.
class CorrectedPredictor {
  public:
    CorrectedPredictor(const Predictor& network, const Settings& settings,
                       const std::vector<Candidate>& candidates,
                       std::map<std::string, ShapeSignature> shapes);

    /// All fitted sizes [mm] for rows of plain parameters; NaN for sizes that the shape
    /// lacks.
    RowMatrix predict(const Shot& shot, const RowMatrix& parameters) const;
    /// What candidate k adds [mm], one amplitude a row.
    RowMatrix shift(std::size_t k, const Shot& shot, const RowMatrix& parameters,
                    const Eigen::VectorXd& amplitudes) const;
    /// d/dv of `predict` [mm/(m/s)] at one point.
    Eigen::VectorXd velocity_slope(const Shot& shot, const RowMatrix& parameters) const;
    /// Why candidate k is unseen for a shape, or nothing.
    std::string why_unseen(std::size_t k, const std::string& shape) const;

    const ShapeSignature& signature(const std::string& shape) const {
        return shapes_.at(shape);
    }
    bool has(const std::string& shape) const { return shapes_.contains(shape); }
    const std::map<std::string, ShapeSignature>& shapes() const { return shapes_; }
    /// Size of a usual amplitude of candidate k.
    double typical(std::size_t k) const { return typical_[k]; }
    Eigen::VectorXd inputs(const Shot& shot, const Eigen::VectorXd& parameters) const {
        return signature_inputs(shot, parameters, settings_.parameters);
    }

  private:
    const Predictor& network_;
    const Settings& settings_;
    std::vector<double> typical_;
    std::map<std::string, ShapeSignature> shapes_;
};

/// The corrected predictor asked for the fitted numbers of a table.
class CorrectedModel final : public DiagnosisModel {
  public:
    /// `data`: shots of shapes that have signatures. `reference`: unit point at which the
    /// errors of signatures are taken.
    CorrectedModel(const CorrectedPredictor& predictor, const ParameterSpace& space,
                   std::vector<const Datum*> data, Eigen::VectorXd reference);

    RowMatrix predict(const RowMatrix& units) const override;
    RowMatrix shift(std::size_t k, const RowMatrix& units,
                    const Eigen::VectorXd& amplitudes) const override;
    Eigen::MatrixXd shift_covariance(std::size_t k) const override;
    /// The range over the shapes of the data, and a quarter of its half beyond: as far as
    /// the polynomials go; of parameters at least a tenth of the prior beyond, and all of
    /// the prior of those that the runs do not vary.
    RunRange run_range(std::size_t k) const override;
    std::string why_unseen(std::size_t k) const override;

    const std::vector<const Datum*>& data() const { return data_; }
    /// Plain parameters of a datum's lot at the reference.
    Eigen::VectorXd reference_of(const Datum& datum) const;

  private:
    Eigen::Index position_of(Eigen::Index coordinate) const;

    const CorrectedPredictor& predictor_;
    const ParameterSpace& space_;
    std::vector<const Datum*> data_;
    Eigen::VectorXd reference_;
    Eigen::Index count_ = 0;  // measured numbers
};

}  // namespace taylorcal::calibrate
