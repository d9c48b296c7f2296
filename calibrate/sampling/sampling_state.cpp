#include "calibrate/sampling/sampling_state.hpp"

#include "calibrate/sampling/number_list.hpp"

#include <spdlog/spdlog.h>

namespace taylorcal::calibrate {

SamplingState::SamplingState(const ParameterSpace& space, std::size_t pool_capacity)
    : adaptation(space), pool(pool_capacity), dimensions_(space.size()) {}

void SamplingState::load(const Checkpoint& checkpoint, std::uint64_t all) {
    const auto numbers = saved(checkpoint);
    if (!numbers) return;
    NumberReader reader(numbers->at("sums"));
    reader(adaptation, draws, weights);
    pool.restore(numbers->at("pool"), dimensions_);
    if (draws > 0)
        spdlog::info("sampling goes on after {} of {} draws", draws, all);
    else
        spdlog::info("sampling goes on after {} passes that look for a proposal",
                     adaptation.passes);
}

void SamplingState::save(const Checkpoint& checkpoint, bool now) {
    const auto time = std::chrono::steady_clock::now();
    if (!now && std::chrono::duration<double>(time - saved_).count() < checkpoint.seconds)
        return;
    NumberWriter writer;
    writer(adaptation, draws, weights);
    calibrate::save(checkpoint,
                    {{"sums", std::move(writer.numbers)}, {"pool", pool.numbers()}});
    saved_ = time;
}

}  // namespace taylorcal::calibrate
