// SPDX-License-Identifier: MIT
#include "common/study/records.hpp"

#include "common/study/bench.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>

namespace nephroid::examples::study {

namespace {

/// The measures that a bandwidth is best by: "rel RMSE".
[[nodiscard]] std::string best_by(const Trial& trial, const Method& method, double bandwidth) {
    std::string names;
    for (const Measure measure : measures)
        if (trial.by(measure).method == &method && trial.by(measure).bandwidth == bandwidth)
            names.append(names.empty() ? "" : " ").append(name_of(measure));
    return names;
}

[[nodiscard]] const Best& best_with(const Trial& trial, const Method& method, double bandwidth) {
    return *std::ranges::find_if(
        trial.best, [&](const Best& best) { return best.method == &method && best.bandwidth == bandwidth; });
}

/// "h", or "h; C = 0.4": without a comma.
[[nodiscard]] std::string symbol_of(const Method& method) {
    return method.symbol + (method.setting.empty() ? "" : "; " + method.setting);
}

/// Empty where it is not finite, as spreadsheets want it.
[[nodiscard]] std::string csv_number(double value) { return std::isfinite(value) ? text("%.9g", value) : ""; }

[[nodiscard]] std::string csv_row(const std::string& scene, const Trial& trial, const Method& method, double bandwidth,
                                  const Errors& errors) {
    const std::string by = best_by(trial, method, bandwidth);
    std::string row = scene + "," + name_of(trial.sequence) + "," + trial.method->id + "," +
                      std::to_string(trial.wanted) + "," + std::to_string(trial.caustic) + "," +
                      std::to_string(trial.emitted) + "," + symbol_of(method) + "," + csv_number(bandwidth);
    for (const double error : {errors.relative, errors.rmse, errors.ssim, errors.energy})
        row.append(",").append(csv_number(error));
    row.append(",").append(by);
    if (by.empty())
        return row + ",,,,,,,,,\n";
    const Timing& timing = best_with(trial, method, bandwidth).timing;
    const Seconds& seconds = timing.seconds;
    for (const double value :
         {seconds.trace, seconds.build, seconds.estimate, seconds.total(), timing.least, timing.most})
        row.append(",").append(csv_number(value));
    row.append(",").append(std::to_string(timing.repeats)).append(",");
    row.append(csv_number(double(trial.emitted) / seconds.total())).append(",");
    return row + (timing.memory ? text("%.0f", *timing.memory) : "") + "\n";
}

[[nodiscard]] std::string json_array(const std::vector<std::string>& values, const std::string& indent) {
    std::string result = "[";
    for (const std::string& value : values)
        result += (result.size() > 1 ? ",\n" : "\n") + indent + "  " + value;
    return result + "\n" + indent + "]";
}

[[nodiscard]] JsonMembers json_errors(const Method& method, double bandwidth, const Errors& errors) {
    return {{"setting", json_string(method.setting)}, {"bandwidth", json_number(bandwidth)},
            {"rel", json_number(errors.relative)},    {"clipped RMSE", json_number(errors.rmse)},
            {"SSIM", json_number(errors.ssim)},       {"energy", json_number(errors.energy)}};
}

[[nodiscard]] std::string json_best(const Trial& trial, const Best& best, const std::string& indent) {
    JsonMembers members = json_errors(*best.method, best.bandwidth, best.errors);
    const Seconds& seconds = best.timing.seconds;
    members.push_back({"trace seconds", json_number(seconds.trace)});
    members.push_back({"build seconds", json_number(seconds.build)});
    members.push_back({"estimate seconds", json_number(seconds.estimate)});
    members.push_back({"total seconds", json_number(seconds.total())});
    members.push_back({"least seconds", json_number(best.timing.least)});
    members.push_back({"most seconds", json_number(best.timing.most)});
    members.push_back({"repeats", std::to_string(best.timing.repeats)});
    members.push_back({"photons per second", json_number(double(trial.emitted) / seconds.total())});
    members.push_back({"peak memory", best.timing.memory ? json_number(*best.timing.memory) : "null"});
    return json_object(members, indent);
}

[[nodiscard]] std::string json_trial(const Trial& trial, const std::string& indent) {
    std::vector<std::string> tried;
    for (const Sweep& sweep : trial.sweeps)
        for (const auto& [bandwidth, errors] : sweep.errors)
            tried.push_back(json_object(json_errors(*sweep.method, bandwidth, errors), indent + "    "));
    JsonMembers best;
    for (const Measure measure : measures)
        best.push_back({name_of(measure), json_best(trial, trial.by(measure), indent + "    ")});
    return json_object({{"method", json_string(trial.method->id)},
                        {"sequence", json_string(name_of(trial.sequence))},
                        {"photons", std::to_string(trial.wanted)},
                        {"caustic photons", std::to_string(trial.caustic)},
                        {"photons emitted", std::to_string(trial.emitted)},
                        {"bandwidth", json_string(trial.method->symbol + ": " + trial.method->bandwidth)},
                        {"best", json_object(best, indent + "  ")},
                        {"sweep", json_array(tried, indent + "  ")}},
                       indent);
}

} // namespace

std::string csv_header() {
    return "case,sequence,method,photons,caustic_photons,emitted,bandwidth_name,bandwidth,rel,rmse,ssim,energy,"
           "best_by,trace_seconds,build_seconds,estimate_seconds,total_seconds,least_seconds,most_seconds,"
           "repeats,photons_per_second,peak_memory\n";
}

std::string csv_rows(const std::string& scene, const std::vector<Trial>& trials) {
    std::string csv;
    for (const Trial& trial : trials)
        for (const Sweep& sweep : trial.sweeps)
            for (const auto& [bandwidth, errors] : sweep.errors)
                csv += csv_row(scene, trial, *sweep.method, bandwidth, errors);
    return csv;
}

std::string json_text(const Options& options, const Bench& bench, const std::vector<Trial>& trials,
                      const std::string& command) {
    std::vector<std::string> entries;
    for (const Trial& trial : trials)
        entries.push_back(json_trial(trial, "    "));
    return json_object({{"case", json_string(options.scene)},
                        {"command", json_string(command)},
                        {"width", std::to_string(options.width)},
                        {"height", std::to_string(options.height)},
                        {"samples", std::to_string(options.samples)},
                        {"seed", std::to_string(options.seed)},
                        {"threads", std::to_string(bench.threads().threads())},
                        {"reference", json_string(bench.is_exact() ? "exact" : options.reference->string())},
                        {"reference noise", json_number(bench.reference_noise())},
                        {"trials", json_array(entries, "  ")}},
                       "") +
           "\n";
}

} // namespace nephroid::examples::study
