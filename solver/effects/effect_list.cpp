#include "solver/effects/effect_list.hpp"

namespace taylorcal::effects {

// A new effect: its file's function here, and its call below.
Effect anvil_friction();
Effect thermal_softening();
Effect hall_petch();
Effect damage_softening();
Effect phonon_drag();
Effect taylor_quinney_shift();
Effect back_stress();
Effect rod_texture();
Effect hard_skin();
Effect forest_storage();
Effect elastic_anvil();
Effect oblique_impact();
Effect dynamic_recovery();
Effect velocity_bias();

const std::vector<Effect>& effect_list() {
    static const std::vector<Effect> list = {
        anvil_friction(),   thermal_softening(),    hall_petch(),    damage_softening(),
        phonon_drag(),      taylor_quinney_shift(), back_stress(),   rod_texture(),
        hard_skin(),        forest_storage(),       elastic_anvil(), oblique_impact(),
        dynamic_recovery(), velocity_bias(),
    };
    return list;
}

}  // namespace taylorcal::effects
