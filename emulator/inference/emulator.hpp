#pragma once

#include "emulator/inference/forward.hpp"
#include "emulator/inference/model.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::emulator {

/// A trained network, ready to be asked. Constant after construction: threads may share
/// it, each with a Workspace of its own.
class Emulator {
  public:
    /// InputError naming the file and the remedy if it is not a whole emulator file.
    static Emulator from_file(const std::filesystem::path& path);
    explicit Emulator(Model model);

    const std::vector<InputInfo>& inputs() const { return model_.inputs; }
    const std::vector<OutputInfo>& outputs() const { return model_.outputs; }
    const Category& category() const { return model_.category; }
    std::size_t members() const { return model_.members.size(); }
    std::size_t best() const { return model_.best; }
    /// The same ensemble with another member answering.
    Emulator answering_with(std::size_t member) const;
    /// What answers: of a file that corrects cheaper runs without their column.
    const Model& model() const { return model_; }

    /// Positions by name; InputError with the nearest name when unknown.
    int input_index(const std::string& name) const;
    int output_index(const std::string& name) const;
    /// InputError if the network learnt from one other shape only.
    void check_shape(const std::string& shape) const;
    /// 0 when the emulator has no category.
    int category_index(const std::string& value) const;

    /// InputError unless `value` lies in the range that the network was trained on (or at
    /// most 1 % of its span beyond, for a range's ends are seldom sampled). `context`
    /// starts the message, e.g. "measurements.csv, line 7".
    void check_range(const std::string& name, double value,
                     const std::string& context) const;

    /// Whether the database had this output for this category value; what the network
    /// says of one that it never saw means nothing.
    bool has_output(const std::string& output, const std::string& category_value) const;

    /// Product of the inputs named in `divide_by` of an output, at one point (all
    /// inputs).
    double divisor(int output, const Eigen::Ref<const Eigen::VectorXd>& point) const;

    /// Outputs [n_out x n] in their own units of n points of one category value: `points`
    /// [n_in x n] holds all inputs in the order of inputs(), untransformed; ranges are
    /// not checked here. Best at n a multiple of 128. `points` and `results` must not
    /// overlap.
    void evaluate(const Block& points, int category, Block& results,
                  Workspace& workspace) const {
        evaluate_member(model_.best, points, category, results, workspace);
    }
    /// The same with another member of the ensemble.
    void evaluate_member(std::size_t member, const Block& points, int category,
                         Block& results, Workspace& workspace) const;

    /// Held-out covariance of a category value (any text when there is no category).
    const Covariance& covariance(const std::string& category_value) const;
    /// The same near a point (all inputs, plain), from the held-out rows next to it.
    Covariance covariance_near(const std::string& category_value,
                               const Eigen::VectorXd& point) const;

  private:
    Model model_;
    std::vector<ForwardPass> forward_;        ///< By member.
    std::vector<std::vector<int>> divisors_;  ///< Inputs that multiply each output.
};

}  // namespace taylorcal::emulator
