#include "solver/sph/particles.hpp"

namespace taylorcal::sph {

Particles::Particles(std::size_t slots) {
    for (auto& component : position) component.assign(slots, 0.0);
    for (auto& component : velocity) component.assign(slots, 0.0);
    for (std::size_t c = 0; c < 9; ++c) {
        deformation[c].assign(slots, c % 4 == 0 ? 1.0 : 0.0);
    }
    energy.assign(slots, 0.0);
    const auto allocate = [&](auto& fields) {
        for (Field& field : fields) field = Field(slots);
    };
    allocate(speed);
    for (auto& means : mean_speed) allocate(means);
    allocate(acceleration);
    allocate(rate);
    allocate(pull);
    allocate(misfit_rate);
    allocate(elastic_misfit);
    allocate(misfit_pull);
    allocate(stress_deviator);
    for (Field* field : {&pressure, &temperature, &bulk_modulus, &density})
        *field = Field(slots);
}

}  // namespace taylorcal::sph
