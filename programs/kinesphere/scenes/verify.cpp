// `kinesphere verify`: runs a detector and the oracle on one scene and compares every begin and end.
#include "scenes/verify.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "base/help_text.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"

namespace kinesphere::program {

CLI::App* add_verify_command(CLI::App& program, VerifyOptions& options) {
  CLI::App* command = program.add_subcommand(
      "verify", "Compare every contact of a scene with an exact oracle (bodies pass through each other)");
  add_scene_options(*command, options.scene);
  add_examples(*command, {"kinesphere verify paper1", "kinesphere verify rain --seed 7 --seconds 3",
                          "kinesphere verify my_scene.json"});
  return command;
}

int verify(const VerifyOptions& options, const NamedDetector& detector) {
  SceneSource source = options.scene.source();
  source.parameters.response = SceneResponse::pass_through;
  const Scene scene = make_scene(source);
  const ContactComparison comparison = require(kinesphere::verify(scene, detector.make));
  Summary summary;
  add_scene(summary, source.parameters);
  summary.row("detector", detector.name);
  summary.row("seconds", number(source.parameters.seconds));
  summary.space();
  add_comparison(summary, comparison);
  print("{}", summary.text(output_has_colour()));
  return comparison.agrees() ? exit_fine : exit_disagreement;
}

void add_comparison(Summary& summary, const ContactComparison& comparison) {
  summary.row("matched", grouped(comparison.matched),
              fmt::format("begins and ends, at most {} s apart", number(comparison.largest_time_difference)));
  summary.row("grazing", grouped(comparison.grazing), "too shallow to count as either");
  summary.row("late", grouped(comparison.late), "later than the tolerance allows");
  summary.row("missed", grouped(comparison.missed), "in the oracle only");
  summary.row("invented", grouped(comparison.invented), "in the detector only");
  if (comparison.oracle_faults > 0) summary.row("oracle faults", grouped(comparison.oracle_faults));
  summary.row("verdict", comparison.agrees() ? "detector and oracle agree" : "detector and oracle DISAGREE",
              "", comparison.agrees() ? Tone::good : Tone::bad);
  if (comparison.first_difference) summary.row("first difference", *comparison.first_difference);
}

}  // namespace kinesphere::program
