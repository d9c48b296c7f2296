#include "solver/axisymmetric/cycle.hpp"

#include "solver/axisymmetric/dynamics.hpp"

#include <fmt/core.h>

namespace taylorcal::axisymmetric {

std::string take_cycle(Body& body, LocalSteps& steps, SelfContact& self_contact,
                       double end) {
    body.clock.begin_round();
    const double shortest =
        steps.assign(body, end - body.time, self_contact.take_touching());
    if (!(shortest > 0))
        return fmt::format("the stable step vanished after {:.2f} us", 1e6 * body.time);
    body.time_step = shortest;
    body.clock.mark(impact::Phase::motion);
    for (const LocalSteps::Group& group : steps.groups()) {
        const double step = shortest * (1 << group.level);
        for (std::size_t c = group.first; c < group.last; ++c) {
            push_nodes(body, c, (body.cell_step[c] + step) / 2);
            body.cell_step[c] = step;
        }
    }
    body.clock.mark(impact::Phase::forces);
    for (int step = 1; step <= steps.cycle(); ++step) {
        accelerate(body, shortest);
        self_contact.apply(body, shortest);
        drift(body, shortest);
        body.time += shortest;
        ++body.steps;
        body.clock.mark(impact::Phase::motion);
        for (const LocalSteps::Group& group : steps.groups()) {
            if (!LocalSteps::ends_at(group, step)) continue;
            std::string trouble = update_cells(body, group.first, group.last);
            if (!trouble.empty()) return trouble;
            if (step == steps.cycle()) continue;  // pushed when the next steps are known
            for (std::size_t c = group.first; c < group.last; ++c)
                push_nodes(body, c, body.cell_step[c]);
            body.clock.mark(impact::Phase::forces);
        }
    }
    return {};
}

}  // namespace taylorcal::axisymmetric
