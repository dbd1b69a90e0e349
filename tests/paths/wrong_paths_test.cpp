// Paths that are refused, each with its culprit.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "paths/path_set.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::wrong_paths_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

PathSet good() {
  return {PolynomialPaths::Basis::monomial,
          {{0, 0, 5, {{0, 0, 0}, {1, 0, 0}}},
           {0, 5, 10, {{5, 0, 0}, {1, 0, 0}}},
           {2, 0, 10, {{5, 2, 0}, {0, 0, 0}}}},
          {0, 0, 0}};
}

void refuse(PathSet paths, ErrorCode code, const std::string& argument, BodyId body = no_body) {
  expect_error(Approaches::of(paths.view(), 1.0), code, argument, "Approaches::of", body);
}

TEST(WrongPaths, TimesAndNumbers) {
  for (const double wrong : {nan, infinite, -infinite}) {
    PathSet paths = good();
    paths.arcs[2].begin = wrong;
    refuse(paths, ErrorCode::not_finite, "paths.begins", BodyId{.index = 2});
    paths = good();
    paths.arcs[2].end = wrong;
    refuse(paths, ErrorCode::not_finite, "paths.ends", BodyId{.index = 2});
    paths = good();
    paths.arcs[1].coefficients[1].y = wrong;
    refuse(paths, ErrorCode::not_finite, "paths.coefficients", BodyId{.index = 0});
    paths = good();
    paths.errors[1] = wrong;
    refuse(paths, ErrorCode::not_finite, "paths.errors", BodyId{.index = 1});
  }
  PathSet paths = good();
  std::swap(paths.arcs[0], paths.arcs[1]);
  refuse(paths, ErrorCode::out_of_range, "paths.begins", BodyId{.index = 0});
  paths = good();
  std::swap(paths.arcs[0], paths.arcs[2]);
  refuse(paths, ErrorCode::out_of_range, "paths.bodies");
  paths = good();
  paths.arcs[1].end = 5;
  refuse(paths, ErrorCode::out_of_range, "paths.ends", BodyId{.index = 0});
  paths = good();
  paths.arcs[2].coefficients[1].x = 1e200;
  refuse(paths, ErrorCode::out_of_range, "paths.coefficients", BodyId{.index = 2});
  paths = good();
  paths.errors[2] = -1;
  refuse(paths, ErrorCode::out_of_range, "paths.errors", BodyId{.index = 2});
}

TEST(WrongPaths, OfTemporariesDoNotCompile) {
  using Numbers = PolynomialPaths::Array<double>;
  EXPECT_FALSE((std::is_assignable_v<Numbers&, std::vector<double>>));
  EXPECT_FALSE((std::is_constructible_v<Numbers, const std::vector<double>>));
  EXPECT_FALSE((std::is_constructible_v<Numbers, std::array<double, 3>>));
  EXPECT_TRUE((std::is_assignable_v<Numbers&, std::vector<double>&>));
  EXPECT_TRUE((std::is_assignable_v<Numbers&, const std::vector<double>&>));
  EXPECT_TRUE((std::is_assignable_v<Numbers&, const double(&)[3]>));
  EXPECT_TRUE((std::is_assignable_v<Numbers&, std::span<double>>));
}

TEST(WrongPaths, Sizes) {
  PathSet paths = good();
  const PolynomialPaths right = paths.view();
  const auto refuse_view = [](const PolynomialPaths& view, const std::string& argument) {
    expect_error(Approaches::of(view, 1.0), ErrorCode::out_of_range, argument, "Approaches::of");
  };
  PolynomialPaths view = right;
  view.begins = view.begins.first(2);
  refuse_view(view, "paths.begins");
  view = right;
  view.ends = view.ends.first(1);
  refuse_view(view, "paths.ends");
  view = right;
  view.terms = 1;
  refuse_view(view, "paths.coefficients");
  for (const std::size_t terms : {0, 25}) {
    view.terms = terms;
    refuse_view(view, "paths.terms");
  }
  view = right;
  view.errors = view.errors.first(2);
  refuse_view(view, "paths.errors");
}

TEST(WrongPaths, Options) {
  PathSet paths = good();
  const PolynomialPaths view = paths.view();
  const auto refuse_options = [&](const Approaches::Options& options, ErrorCode code,
                                  const std::string& argument, BodyId body = no_body) {
    expect_error(Approaches::of(view, 1.0, options), code, argument, "Approaches::of", body);
  };
  for (const double distance : {0.0, -1.0, 1e101})
    expect_error(Approaches::of(view, distance), ErrorCode::out_of_range, "distance", "Approaches::of");
  for (const double distance : {nan, infinite})
    expect_error(Approaches::of(view, distance), ErrorCode::not_finite, "distance", "Approaches::of");
  refuse_options({.body = 3}, ErrorCode::unknown_body, "options.body", BodyId{.index = 3});
  refuse_options({.begin = nan}, ErrorCode::not_finite, "options.begin");
  refuse_options({.end = infinite}, ErrorCode::not_finite, "options.end");
  refuse_options({.progress = std::function<void(double)>()}, ErrorCode::null_callback, "options.progress");
}

TEST(WrongPaths, AProgressThatThrowsEndsTheCall) {
  PathSet paths = good();
  struct Stop {};
  Workers workers = Workers::create(2).value();
  EXPECT_THROW((void)Approaches::of(paths.view(), 1.0,
                                    {.workers = &workers, .progress = [](double) { throw Stop{}; }}),
               Stop);
  EXPECT_EQ(Approaches::of(paths.view(), 3.0, {.workers = &workers})->approaches.size(), 1u);
}

}  // namespace
}  // namespace kinesphere::wrong_paths_test
