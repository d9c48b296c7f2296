#include "solver/commands/run_cache.hpp"

#include "common/program_code.hpp"
#include "tests/unit/commands/small_batch.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace taylorcal;
using namespace taylorcal::commands;
using taylorcal::testing::quick_answer;
using taylorcal::testing::SmallBatch;

/// A batch with a cache: the bytes of its database, and how many runs it computed.
std::pair<std::string, int> cached(const SmallBatch& batch,
                                   const std::filesystem::path& cache) {
    std::atomic<int> computed = 0;
    const auto count = [&](const impact::ImpactCase& impact_case) {
        ++computed;
        return quick_answer(impact_case);
    };
    const auto out = batch.folder / "cached.h5";
    run_batch(batch.design, batch.cases, batch.configuration.document, out, 2, count,
              RunCache(cache, batch.design, batch.configuration));
    return {read_text(out), computed};
}

std::vector<std::filesystem::path> entries(const std::filesystem::path& cache) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cache))
        if (entry.is_regular_file()) files.push_back(entry.path());
    return files;
}

}  // namespace

TEST_CASE("a batch takes what it can from the cache and gives the same bytes",
          "[cache]") {
    const SmallBatch batch;
    const std::string whole = batch.run("whole.h5", 2);
    const auto cache = batch.folder / "cache";
    CHECK(cached(batch, cache) == std::pair(whole, 9));
    CHECK(entries(cache).size() == 9);
    CHECK(cached(batch, cache) == std::pair(whole, 0));

    SmallBatch larger(12);  // its seeds and inputs continue; the numbers count down anew
    const std::string of_larger = larger.run("whole.h5", 2);
    CHECK(cached(larger, cache) == std::pair(of_larger, 3));
}

TEST_CASE("damaged entries are computed and written anew", "[cache]") {
    const SmallBatch batch;
    const auto cache = batch.folder / "cache";
    const std::string whole = cached(batch, cache).first;
    const auto files = entries(cache);
    const std::string text = read_text(files[0]);
    write_text_atomically(files[0], text.substr(0, text.size() / 2));
    write_text_atomically(files[1], "");
    std::string other = read_text(files[2]);
    other.replace(other.find("\"outputs\":[") + 11, 1, "7");
    write_text_atomically(files[2], other);
    write_text_atomically(files[3], text);  // another run's entry
    CHECK(cached(batch, cache) == std::pair(whole, 4));
    CHECK(cached(batch, cache) == std::pair(whole, 0));
}

TEST_CASE("a run is told by all that it follows from, however it was said", "[cache]") {
    SmallBatch batch;
    const std::string before = run_question(batch.design, 2, batch.configuration);
    SECTION("the solver's sources are part of it") {
        CHECK(before.find(program_code()) != std::string::npos);
    }
    SECTION("an amplitude of 0 and a constant at its default change nothing") {
        batch.configuration.effects["anvil_friction"] = 0;
        batch.configuration.material.drag_slope = material::Parameters().drag_slope;
        CHECK(run_question(batch.design, 2, batch.configuration) == before);
    }
    SECTION("the number of the run changes nothing") {
        batch.design.run_id[2] = 77;
        CHECK(run_question(batch.design, 2, batch.configuration) == before);
    }
    SECTION("the last bit of an input") {
        double& velocity = batch.design.inputs(2, 0);
        velocity = std::nextafter(velocity, 1e9);
        CHECK(run_question(batch.design, 2, batch.configuration) != before);
    }
    SECTION("seed, shape, effect, constant, numerics") {
        std::vector<SmallBatch> other(5);
        other[0].design.seed[2] += 1;
        other[1].design.shape[2] = "reduced_head_3mm";
        other[2].configuration.effects["anvil_friction"] = 0.1;
        other[3].configuration.material.drag_slope *= 2;
        other[4].configuration.document["numerics"] = {{"cfl", 0.1}};
        for (const SmallBatch& changed : other)
            CHECK(run_question(changed.design, 2, changed.configuration) != before);
    }
}

TEST_CASE("runs that failed or met the limit on processor time are not kept", "[cache]") {
    const SmallBatch batch;
    RunCache cache(batch.folder / "cache", batch.design, batch.configuration);
    cache.keep(0, failed_row(batch.design.run_id[0], "tangled cells"));
    FinishedRun given_up = row_of(batch.design.run_id[1], quick_answer(batch.cases[1]));
    given_up.status = impact::Status::over_cpu_limit;
    cache.keep(1, given_up);
    CHECK_FALSE(cache.found(0));
    CHECK_FALSE(cache.found(1));
    given_up.status = impact::Status::not_stopped;
    given_up.reason = "400000 steps, more than 3600 s of processor time";
    cache.keep(1, given_up);
    REQUIRE(cache.found(1));
    CHECK(cache.found(1)->run_id == batch.design.run_id[1]);
}
