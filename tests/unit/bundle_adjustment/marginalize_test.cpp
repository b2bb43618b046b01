// SPDX-License-Identifier: BSD-3-Clause
// The marginalisation prior: compared with dense elimination, and as a replacement of the marginalised poses.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "residuals/edge_residual.h"
#include "support/bundle_adjustment_scene.h"

namespace edgevo {
namespace {

using namespace test;

SceneOptions small_noise() {
  SceneOptions o;
  o.noise_px = 0.05;
  o.fixed_point_share = 0.1;
  return o;
}

BaResult solve(BaProblem* problem, const std::string& name = "schur") {
  return make_bundle_adjuster(name)->solve(problem, to_the_end());
}

int index_of(const BaProblem& problem, int pose_id) {
  return static_cast<int>(std::find(problem.pose_ids.begin(), problem.pose_ids.end(), pose_id) -
                          problem.pose_ids.begin());
}

// The window without pose `pose_id` and the dropped points, with `prior` instead.
BaProblem without(const BaProblem& p, int pose_id, const std::vector<bool>& drop, const BaPrior& prior) {
  const int leaving = index_of(p, pose_id);
  const auto shifted = [&](int pose) { return pose - (pose > leaving); };
  BaProblem q = p;
  q.poses.erase(q.poses.begin() + leaving);
  q.pose_ids.erase(q.pose_ids.begin() + leaving);
  q.prior = prior;
  q.points.clear();
  q.observations.clear();
  std::vector<int> new_index(p.points.size(), -1);
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    if (drop[i]) continue;
    new_index[i] = static_cast<int>(q.points.size());
    q.points.push_back(p.points[i]);
    q.points.back().host = shifted(p.points[i].host);
  }
  for (BaObservation o : p.observations) {
    if (drop[o.point]) continue;
    o.target = shifted(o.target);
    o.point = new_index[o.point];
    q.observations.push_back(o);
  }
  return q;
}

BaProblem marginalized(const BaProblem& p, int pose_id) {
  std::vector<bool> drop;
  const BaPrior prior = marginalize(p, pose_id, to_the_end(), &drop);
  return without(p, pose_id, drop, prior);
}

// Largest pose difference over the poses of `rest`, which `all` contains too.
double difference(const BaProblem& rest, const BaProblem& all) {
  double largest = 0;
  for (std::size_t i = 0; i < rest.poses.size(); ++i) {
    const SE3& T = all.poses[index_of(all, rest.pose_ids[i])].T_cam_world;
    largest = std::max(largest, (rest.poses[i].T_cam_world * T.inverse()).log().cwiseAbs().maxCoeff());
  }
  return largest;
}

// Dense quadratic of the dropped points (6 rows per pose, then a row per point).
struct Dense {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;
  double cost = 0;
};

Dense dense_system(const BaProblem& p, const std::vector<bool>& use, double width) {
  const Eigen::Index poses = 6 * static_cast<Eigen::Index>(p.poses.size());
  const Eigen::Index size = poses + static_cast<Eigen::Index>(p.points.size());
  Dense d{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  for (const BaObservation& o : p.observations) {
    if (!use[o.point]) continue;
    const BaPoint& x = p.points[o.point];
    const ba::EdgeLinearization lin =
        ba::linearize(p.pinhole, p.poses[o.target].T_cam_world, p.poses[x.host].T_cam_world, x, o);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2, size);
    J.middleCols<6>(6 * o.target) = lin.J_target;
    J.middleCols<6>(6 * x.host) = lin.J_host;
    if (!x.fixed) J.col(poses + o.point) = lin.J_idepth;
    const double r = lin.residual.norm(), w = r <= width ? 1 : width / r;
    d.H += w * J.transpose() * J;
    d.b += w * J.transpose() * lin.residual;
    d.cost += r <= width ? 0.5 * r * r : width * (r - 0.5 * width);
  }
  return d;
}

// Minimises over all but the first `keep` of `order`ed unknowns by a dense Schur complement.
void eliminate(const std::vector<int>& keep, const std::vector<int>& gone, const Dense& d, Dense* out) {
  const auto pick = [&](const std::vector<int>& rows, const std::vector<int>& cols) {
    Eigen::MatrixXd M(rows.size(), cols.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < cols.size(); ++j) M(i, j) = d.H(rows[i], cols[j]);
    return M;
  };
  Eigen::VectorXd b_keep(keep.size()), b_gone(gone.size());
  for (std::size_t i = 0; i < keep.size(); ++i) b_keep[i] = d.b[keep[i]];
  for (std::size_t i = 0; i < gone.size(); ++i) b_gone[i] = d.b[gone[i]];
  const Eigen::LDLT<Eigen::MatrixXd> factor(pick(gone, gone));
  const Eigen::MatrixXd coupling = pick(gone, keep);
  out->H = pick(keep, keep) - coupling.transpose() * factor.solve(coupling);
  out->b = b_keep - coupling.transpose() * factor.solve(b_gone);
  out->cost = d.cost - 0.5 * b_gone.dot(factor.solve(b_gone));
}

TEST(BundleAdjustmentMarginalize, EqualsDenseElimination) {
  SceneOptions o = small_noise();
  o.poses = 4;
  o.points = 60;
  o.noise_px = 0.7;
  o.outlier_share = 0.1;
  o.fixed_poses = 0;
  const BaProblem p = make_scene(o);
  std::vector<bool> drop;
  const BaPrior prior = marginalize(p, 101, to_the_end(), &drop);
  const Dense d = dense_system(p, drop, to_the_end().huber_width);
  std::vector<int> keep, gone;
  for (int i = 0; i < d.b.size(); ++i) {
    const bool stays = i < 24 && i / 6 != 1;
    if (stays) keep.push_back(i);
    if (!stays && d.H(i, i) > 0) gone.push_back(i);
  }
  Dense expected;
  eliminate(keep, gone, d, &expected);
  EXPECT_EQ(prior.pose_ids, (std::vector<int>{100, 102, 103}));
  EXPECT_LT((prior.H - expected.H).norm(), 1e-9 * d.H.topLeftCorner(24, 24).norm());
  EXPECT_LT((prior.b - expected.b).norm(), 1e-9 * d.b.head(24).norm());
  EXPECT_NEAR(prior.constant, expected.cost, 1e-8 * expected.cost);
  EXPECT_GT(prior.constant, 0);
}

TEST(BundleAdjustmentMarginalize, DropsThePointsHostedByThePoseAndSeenFromIt) {
  const BaProblem p = make_scene(small_noise());
  std::vector<bool> drop, expected(p.points.size(), false);
  marginalize(p, 102, to_the_end(), &drop);
  for (std::size_t i = 0; i < p.points.size(); ++i) expected[i] = p.points[i].host == 2;
  for (const BaObservation& o : p.observations)
    if (o.target == 2) expected[o.point] = true;
  EXPECT_EQ(drop, expected);
  EXPECT_GT(std::count(drop.begin(), drop.end(), false), 0);
}

// At the solution the gradients of the marginalised and of the remaining part cancel: the minimum must not
// move.
TEST(BundleAdjustmentMarginalize, RestKeepsTheSolutionOfTheFullProblem) {
  for (const char* name : {"schur", "ceres"}) {
    BaProblem whole = make_scene(small_noise());
    const BaResult whole_result = solve(&whole);
    BaProblem rest = marginalized(whole, 100);
    rest = perturb(rest, 0.02, 0.005, 0.05, 9);
    const BaResult result = solve(&rest, name);
    ASSERT_TRUE(result.usable);
    EXPECT_LT(difference(rest, whole), 1e-6) << name;
    EXPECT_NEAR(result.final_cost, whole_result.final_cost, 1e-6 * whole_result.final_cost) << name;
  }
}

// The second fixed pose is marginalised, too: only the prior fixes position, rotation and scale.
TEST(BundleAdjustmentMarginalize, PriorSurvivesFurtherMarginalisationAndFixesTheGauge) {
  BaProblem whole = make_scene(small_noise());
  solve(&whole);
  BaProblem rest = whole;
  for (const int pose_id : {100, 101, 102, 103}) {
    rest = marginalized(rest, pose_id);
    rest = perturb(rest, 0.01, 0.003, 0.02, pose_id);
    ASSERT_TRUE(solve(&rest).usable);
    EXPECT_LT(difference(rest, whole), 1e-6) << "after pose " << pose_id;
  }
  EXPECT_EQ(rest.prior->pose_ids, (std::vector<int>{104, 105, 106}));
}

// Marginalised away from the solution, so that the poses move away from the prior's linearisation point: the
// next prior must keep that point and still have its minimum at that of the window.
TEST(BundleAdjustmentMarginalize, LinearisationPointIsTheFirstEstimate) {
  const BaProblem start = perturb(make_scene(small_noise()), 0.03, 0.005, 0.02, 5);
  BaProblem window = marginalized(start, 100);
  solve(&window);
  const BaProblem before = window;
  BaProblem next = marginalized(window, 101);
  for (std::size_t i = 0; i < next.prior->pose_ids.size(); ++i) {
    const auto& first = *window.prior;
    const auto found = std::find(first.pose_ids.begin(), first.pose_ids.end(), next.prior->pose_ids[i]);
    ASSERT_NE(found, first.pose_ids.end());
    const SE3& T = first.linearization[found - first.pose_ids.begin()];
    EXPECT_EQ(T.matrix(), next.prior->linearization[i].matrix());
    EXPECT_GT((T * next.poses[index_of(next, *found)].T_cam_world.inverse()).log().norm(), 1e-4);
  }
  next = perturb(next, 0.01, 0.003, 0.02, 6);
  solve(&next);
  EXPECT_LT(difference(next, before), 1e-6);
}

TEST(BundleAdjustmentMarginalize, LinearisedBeforeTheSolutionTheErrorIsSecondOrder) {
  BaProblem whole = make_scene(small_noise());
  const BaProblem truth = whole;
  solve(&whole);
  BaProblem rest = marginalized(truth, 100);  // at the truth, some 1e-3 from the solution
  solve(&rest);
  const double moved = difference(rest, truth);
  EXPECT_GT(moved, 2e-4);
  EXPECT_LT(difference(rest, whole), 0.05 * moved);
}

TEST(BundleAdjustmentMarginalize, SolversAgreeUnderAPrior) {
  SceneOptions o = small_noise();
  o.noise_px = 0.5;
  o.outlier_share = 0.05;
  const BaProblem start = perturb(make_scene(o), 0.03, 0.005, 0.05, 5);
  BaProblem schur = marginalized(marginalized(start, 100), 101), ceres = schur;
  const BaResult a = solve(&schur), b = solve(&ceres, "ceres");
  EXPECT_NEAR(a.initial_cost, b.initial_cost, 1e-9 * b.initial_cost);
  EXPECT_NEAR(a.final_cost, b.final_cost, 1e-8 * b.final_cost);
  EXPECT_LT(pose_difference(schur, ceres), 1e-5);
}

TEST(BundleAdjustmentMarginalize, PriorAloneIsSolvedToItsOwnMinimum) {
  BaProblem whole = make_scene(small_noise());
  BaProblem rest = marginalized(marginalized(whole, 100), 101);
  rest.points.clear();
  rest.observations.clear();
  for (const char* name : {"schur", "ceres"}) {
    BaProblem p = rest;
    const BaResult result = solve(&p, name);
    ASSERT_TRUE(result.usable) << name;
    const Eigen::VectorXd minimum = rest.prior->H.ldlt().solve(-rest.prior->b);
    for (std::size_t i = 0; i < p.poses.size(); ++i) {
      const Vector6d xi = (p.poses[i].T_cam_world * rest.prior->linearization[i].inverse()).log();
      EXPECT_LT((xi - minimum.segment<6>(6 * i)).norm(), 1e-7) << name;
    }
  }
}

TEST(BundleAdjustmentMarginalize, MarginalisingAnUnobservedPoseChangesNothing) {
  BaProblem p = make_scene(small_noise());
  p.poses.push_back(p.poses.back());
  p.pose_ids.push_back(200);
  std::vector<bool> drop;
  const BaPrior prior = marginalize(p, 200, to_the_end(), &drop);
  EXPECT_TRUE(prior.pose_ids.empty());
  EXPECT_EQ(prior.H.size(), 0);
  EXPECT_EQ(prior.constant, 0);
  EXPECT_EQ(std::count(drop.begin(), drop.end(), true), 0);
}

// ---- covariance relative to poses that stay ----

// A scene at its true values whose points are all hosted by pose 2, with matches known to a tenth of a pixel.
BaProblem points_of_one_host() {
  SceneOptions o;
  o.poses = 5;
  o.points = 400;
  const BaProblem p = make_scene(o);
  BaProblem q = p;
  q.points.clear();
  q.observations.clear();
  int last = -1;
  for (BaObservation m : p.observations) {
    if (p.points[m.point].host != 2) continue;
    if (m.point != last) q.points.push_back(p.points[m.point]);
    last = m.point;
    m.point = int(q.points.size()) - 1;
    m.inv_sigma_normal *= 10, m.inv_sigma_tangent *= 10;
    q.observations.push_back(m);
  }
  return q;
}

// Errors as large as the matches claim.
BaProblem with_noise(BaProblem p, Random* random) {
  for (BaObservation& m : p.observations) {
    m.px += random->normal() / m.inv_sigma_normal * m.normal;
    if (m.inv_sigma_tangent > 0)
      m.px += random->normal() / m.inv_sigma_tangent * Eigen::Vector2d(-m.normal.y(), m.normal.x());
  }
  return p;
}

SE3 relative(const BaProblem& p, int a, int b) {
  return p.poses[a].T_cam_world * p.poses[b].T_cam_world.inverse();
}

// Solved again and again with other errors, relative poses scatter as much as their covariance says: to fixed
// poses and to free ones.
TEST(BundleAdjustmentMarginalize, RelativeCovarianceIsThatOfRepeatedSolves) {
  constexpr int kTrials = 400;
  const BaProblem truth = points_of_one_host();
  BaOptions options = to_the_end();
  options.huber_width = 1e3;
  std::vector<bool> drop;
  std::vector<RelativeCovariance> relatives{{101}, {103}, {104}};
  marginalize(truth, 102, options, &drop, &relatives);
  std::vector<double> squares(relatives.size());
  Random random(3);
  for (int n = 0; n < kTrials; ++n) {
    BaProblem p = with_noise(truth, &random);
    ASSERT_TRUE(make_bundle_adjuster("schur")->solve(&p, options).usable);
    for (std::size_t i = 0; i < relatives.size(); ++i) {
      const int other = relatives[i].pose_id - 100;
      const Vector6d xi = (relative(p, 2, other) * relative(truth, 2, other).inverse()).log();
      squares[i] += xi.dot(relatives[i].covariance.ldlt().solve(xi)) / kTrials;
    }
  }
  // The mean of a chi-squared variable with 6 degrees of freedom, standard deviation 0.17.
  for (std::size_t i = 0; i < squares.size(); ++i) EXPECT_NEAR(squares[i], 6, 0.7) << relatives[i].pose_id;
}

// Away from the prior's linearisation point, too: all information is in the prior, expressed there.
TEST(BundleAdjustmentMarginalize, RelativeCovarianceUsesThePrior) {
  BaProblem whole = make_scene(small_noise());
  solve(&whole);
  BaProblem rest = marginalized(marginalized(whole, 100), 101);
  rest.points.clear();
  rest.observations.clear();
  rest = perturb(rest, 0.3, 0.1, 0, 4);
  std::vector<bool> drop;
  std::vector<RelativeCovariance> relatives{{104}};
  marginalize(rest, 102, to_the_end(), &drop, &relatives);
  // d T_rel / d xi, by differences, of poses exp(xi) linearization.
  const auto& prior = *rest.prior;
  const Eigen::Index n = prior.H.rows();
  Eigen::MatrixXd J(6, n);
  const int a = index_of(rest, 102), b = index_of(rest, 104);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto moved = [&](double step) {
      BaProblem p = rest;
      for (std::size_t i = 0; i < prior.pose_ids.size(); ++i) {
        SE3& T = p.poses[index_of(p, prior.pose_ids[i])].T_cam_world;
        Vector6d xi = (T * prior.linearization[i].inverse()).log();
        if (k / 6 == Eigen::Index(i)) xi[k % 6] += step;
        T = SE3::exp(xi) * prior.linearization[i];
      }
      return (relative(p, a, b) * relative(rest, a, b).inverse()).log();
    };
    J.col(k) = (moved(1e-6) - moved(-1e-6)) / 2e-6;
  }
  const Matrix6d expected = J * prior.H.inverse() * J.transpose();
  EXPECT_LT((relatives[0].covariance - expected).norm(), 1e-5 * expected.norm());
}

TEST(BundleAdjustmentMarginalize, CovariancesChangeNoBitOfThePrior) {
  BaProblem p = make_scene(small_noise());
  solve(&p);
  const BaProblem window = marginalized(p, 100);
  std::vector<bool> drop;
  std::vector<RelativeCovariance> relatives{{102}, {104}};
  const BaPrior without = marginalize(window, 101, to_the_end(), &drop);
  const BaPrior with = marginalize(window, 101, to_the_end(), &drop, &relatives);
  EXPECT_EQ(with.H, without.H);
  EXPECT_EQ(with.b, without.b);
  EXPECT_EQ(with.constant, without.constant);
}

TEST(BundleAdjustmentMarginalize, WithoutMatchesTheCovarianceIsUnknown) {
  SceneOptions o = small_noise();
  o.poses = 3;
  o.points = 0;
  const BaProblem p = make_scene(o);
  std::vector<bool> drop;
  std::vector<RelativeCovariance> relatives{{102}};
  marginalize(p, 101, to_the_end(), &drop, &relatives);
  EXPECT_TRUE(relatives[0].covariance.isZero(0));
}

}  // namespace
}  // namespace edgevo
