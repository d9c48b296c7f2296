#include "solver/commands/batch.hpp"

#include "common/errors.hpp"
#include "common/hdf5_file.hpp"
#include "solver/commands/journal.hpp"
#include "solver/commands/merge.hpp"
#include "tests/unit/commands/small_batch.hpp"

#include <algorithm>
#include <csignal>

#include <catch2/catch.hpp>
#include <sys/resource.h>

namespace {

using namespace taylorcal;
using namespace taylorcal::commands;
using Catch::Matchers::Contains;
using taylorcal::testing::quick_answer;
using taylorcal::testing::SmallBatch;

/// The journal after `allowed` runs, as a kill would leave it.
std::string journal_of_first(const SmallBatch& batch, std::size_t allowed) {
    const std::filesystem::path path = batch.folder / "probe.h5";
    std::string journal;
    std::size_t count = 0;
    batch.run("probe.h5", 1, [&](const impact::ImpactCase& impact_case) {
        if (count++ == allowed) journal = read_text(path.string() + ".journal.jsonl");
        return quick_answer(impact_case);
    });
    return journal;
}

}  // namespace

TEST_CASE("a batch gives the same bytes for any number of threads", "[batch]") {
    const SmallBatch batch;
    const std::string one = batch.run("one.h5", 1);
    CHECK(one.size() > 1000);
    CHECK(batch.run("two.h5", 2) == one);
    CHECK(batch.run("four.h5", 4) == one);
    CHECK_FALSE(std::filesystem::exists(batch.folder / "one.h5.journal.jsonl"));
}

TEST_CASE("a batch that was killed computes only what is missing", "[batch]") {
    const SmallBatch batch;
    const std::string whole = batch.run("whole.h5", 1);
    const std::string journal = journal_of_first(batch, 4);
    const std::string torn = GENERATE("", "{\"run_id\":5,\"outp", "{");
    write_text_atomically(batch.folder / "again.h5.journal.jsonl", journal + torn);
    std::atomic<int> computed = 0;
    const std::string resumed =
        batch.run("again.h5", 2, [&](const impact::ImpactCase& impact_case) {
            ++computed;
            return quick_answer(impact_case);
        });
    CHECK(computed == 5);
    CHECK(resumed == whole);
}

TEST_CASE("a journal of another batch is refused with the remedy", "[batch]") {
    SmallBatch batch;
    const std::string journal = journal_of_first(batch, 4);
    const auto path = batch.folder / "other.h5.journal.jsonl";
    write_text_atomically(path, journal);
    SECTION("another configuration") {
        batch.configuration.document["fidelity"] = "fine";
        CHECK_THROWS_WITH(batch.run("other.h5", 1),
                          Contains("configuration_digest") && Contains("Delete it"));
    }
    SECTION("another design") {
        batch.design.inputs(3, 0) += 1;
        CHECK_THROWS_WITH(batch.run("other.h5", 1),
                          Contains("design_digest") && Contains("Delete it"));
    }
    SECTION("another SIMD variant, and what would go on with it") {
        std::string elsewhere = journal;
        const std::string key = "\"simd\":\"TAYLORCAL_SIMD=";
        const std::size_t place = elsewhere.find(key);
        REQUIRE(place != std::string::npos);
        elsewhere.insert(place + key.size(), "another_");
        write_text_atomically(path, elsewhere);
        CHECK_THROWS_WITH(
            batch.run("other.h5", 1),
            Contains("its simd is \"TAYLORCAL_SIMD=another_") &&
                Contains("Delete it to start anew, or go back to what it was begun"));
        CHECK(read_text(path) == elsewhere);
    }
    SECTION("a damaged line before the last") {
        write_text_atomically(path, journal + "garbage\n{}");
        CHECK_THROWS_WITH(batch.run("other.h5", 1), Contains("line 6: damaged"));
    }
    SECTION("a run without all of its outputs") {
        std::string less = journal;
        const std::string key = "\"outputs\":[";
        const std::size_t place = less.rfind(key) + key.size();
        less.erase(place, less.find(',', place) + 1 - place);
        write_text_atomically(path, less);
        CHECK_THROWS_WITH(
            batch.run("other.h5", 1),
            Contains("other.h5.journal.jsonl, line 5: damaged (outputs has 6 "
                     "entries (expected 7))"));
    }
    CHECK(std::filesystem::exists(path));
}

TEST_CASE("two batches do not compute one output at once", "[batch]") {
    const SmallBatch batch;
    const std::string whole = batch.run("whole.h5", 1);
    std::string refusal;
    const std::string first =
        batch.run("same.h5", 1, [&](const impact::ImpactCase& impact_case) {
            try {
                if (refusal.empty()) batch.run("same.h5", 1);
            } catch (const InputError& error) {
                refusal = error.what();
            }
            return quick_answer(impact_case);
        });
    CHECK_THAT(refusal,
               Contains("same.h5.journal.jsonl: another batch with this output"));
    CHECK(first == whole);
    CHECK(batch.run("same.h5", 1) == whole);
}

TEST_CASE("a full disk costs no finished run", "[batch]") {
    // A file size limit stands for the full disk; the signal that it sends is ignored.
    const int threads = GENERATE(1, 2);
    const SmallBatch batch;
    const std::string whole = batch.run("whole.h5", 1);
    const auto journal = batch.folder / "full.h5.journal.jsonl";
    const std::size_t room = journal_of_first(batch, 4).size() + 10;
    struct rlimit before {};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const struct rlimit small { room, before.rlim_max };
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    std::string problem;
    try {
        batch.run("full.h5", threads);
    } catch (const std::exception& error) {
        problem = error.what();
    }
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
    std::signal(SIGXFSZ, handler);
    CHECK_THAT(problem, Contains("full.h5.journal.jsonl: cannot be written") &&
                            Contains("finished runs are kept"));
    const std::string kept = read_text(journal);
    CHECK(kept.size() < room);
    CHECK(kept.back() == '\n');
    const auto finished = static_cast<int>(std::ranges::count(kept, '\n')) - 1;
    // Which runs come first is a matter of two threads, and their lines differ in length.
    if (threads == 1) CHECK(finished == 4);
    CHECK(finished >= 2);
    std::atomic<int> computed = 0;
    CHECK(batch.run("full.h5", 2, [&](const impact::ImpactCase& impact_case) {
        ++computed;
        return quick_answer(impact_case);
    }) == whole);
    CHECK(computed == 9 - finished);
}

TEST_CASE("a run that fails becomes a row with its reason", "[batch]") {
    const SmallBatch batch;
    batch.run("rows.h5", 2, [&](const impact::ImpactCase& impact_case) {
        if (impact_case.seed == 103) throw std::runtime_error("tangled cells");
        impact::ImpactResult result = quick_answer(impact_case);
        if (impact_case.seed == 105) {
            result.status = impact::Status::not_stopped;
            result.reason = "time limit";
        }
        return result;
    });
    const Database database = read_database(batch.folder / "rows.h5");
    REQUIRE(database.runs.size() == 9);
    for (std::size_t i = 0; i < database.runs.size(); ++i) {
        const FinishedRun& run = database.runs[i];
        CHECK(run.run_id == static_cast<std::int64_t>(i + 1));
        const std::int64_t seed = database.design.seed[i];
        if (seed == 103) {
            CHECK(run.status == impact::Status::failed);
            CHECK(run.reason == "tangled cells");
            for (const double value : run.outputs) CHECK(std::isnan(value));
            REQUIRE(run.outline_radius.size() == observe::outline_points);
            for (const double radius : run.outline_radius) CHECK(std::isnan(radius));
        } else if (seed == 105) {
            CHECK(run.status == impact::Status::not_stopped);
            CHECK(run.reason == "time limit");
        } else {
            CHECK(run.status == impact::Status::stopped);
            CHECK(run.steps == seed);
            CHECK(run.outputs[0] ==
                  database.design.inputs(static_cast<Eigen::Index>(i), 0) / 3);
            CHECK(std::isnan(run.outputs[4]));
            REQUIRE(run.outline_radius.size() == observe::outline_points);
            CHECK(run.outline_radius[2] == 1 + 2 * run.outputs[0]);
        }
    }
}

TEST_CASE("rows of before an effect was added join with its amplitude 0", "[merge]") {
    const SmallBatch batch;
    batch.run("old.h5", 1);
    Design design = batch.design;
    design.input_names.emplace_back("drag_slope");
    design.inputs.conservativeResize(Eigen::NoChange, design.inputs.cols() + 1);
    design.inputs.rightCols(1).setConstant(1e-8);
    for (std::int64_t& id : design.run_id) id += 100;
    run_batch(design, make_cases(design, batch.configuration, "new.h5"),
              batch.configuration.document, batch.folder / "new.h5", 1,
              testing::quick_answer);
    const std::vector<std::string> files = {(batch.folder / "old.h5").string(),
                                            (batch.folder / "new.h5").string()};
    CHECK_THROWS_WITH(merge(files), Contains("new.h5: has other inputs"));
    const Database old = read_database(files[0]);
    const Database all = merge(files, {"drag_slope"});
    const auto rows = static_cast<Eigen::Index>(old.design.rows());
    CHECK(all.design.input_names == design.input_names);
    REQUIRE(all.design.inputs.rows() == 2 * rows);
    CHECK(all.design.inputs.topRows(rows).leftCols(5) == old.design.inputs);
    CHECK((all.design.inputs.col(5).head(rows).array() == 0).all());
    CHECK((all.design.inputs.col(5).tail(rows).array() == 1e-8).all());
    CHECK(all.provenance == old.provenance);
}

TEST_CASE("a database made before outlines were kept is read without them", "[batch]") {
    const SmallBatch batch;
    batch.run("rows.h5", 2);
    Database older = read_database(batch.folder / "rows.h5");
    for (FinishedRun& run : older.runs) run.outline_radius.clear();
    write_database(batch.folder / "older.h5", older);
    CHECK_FALSE(Hdf5Reader(batch.folder / "older.h5").has("outline_radius"));
    for (const FinishedRun& run : read_database(batch.folder / "older.h5").runs)
        CHECK(run.outline_radius.empty());
}

TEST_CASE("chunks merge to the bytes of the whole", "[merge]") {
    const SmallBatch batch;
    const std::string whole = batch.run("whole.h5", 1);
    std::vector<std::string> chunks;
    for (const std::string rows : {"4:", "0:2", "2:4"}) {
        SmallBatch part;
        part.design = batch.design.subset(parse_rows(rows, batch.design.rows()));
        part.cases = make_cases(part.design, part.configuration, "design.h5");
        const auto path =
            batch.folder / ("chunk" + std::to_string(chunks.size()) + ".h5");
        write_text_atomically(path, part.run("chunk.h5", 1));
        chunks.push_back(path.string());
    }
    write_database(batch.folder / "merged.h5", merge(chunks));
    CHECK(read_text(batch.folder / "merged.h5") == whole);

    CHECK_THROWS_WITH(merge({chunks[0], chunks[0]}), Contains("Give each chunk"));
    Database other = read_database(chunks[1]);
    other.configuration["fidelity"] = "fine";
    write_database(chunks[1], other);
    CHECK_THROWS_WITH(merge(chunks), Contains("another configuration"));
}
