#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/masonry.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/modelling/textures.h"

namespace plenolab {
namespace {

constexpr double kPi = EIGEN_PI;

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.positions_m[t[0]], &b = mesh.positions_m[t[1]], &c = mesh.positions_m[t[2]];
    area += 0.5 * static_cast<double>((b - a).cross(c - a).norm());
  }
  return area;
}

/// By the divergence theorem; positive if closed with triangles that face outwards.
double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.positions_m[t[0]], &b = mesh.positions_m[t[1]], &c = mesh.positions_m[t[2]];
    volume += static_cast<double>(a.dot(b.cross(c))) / 6;
  }
  return volume;
}

void expect_normals_on_the_side_of_the_triangles(const Mesh& mesh) {
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.positions_m[t[0]], &b = mesh.positions_m[t[1]], &c = mesh.positions_m[t[2]];
    const Vec3 cross = (b - a).cross(c - a);
    if (cross.norm() < 1e-6f) continue;  // a pole
    const Vec3 mean = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
    EXPECT_GT(cross.dot(mean), 0) << a.transpose();
  }
}

TEST(Parts, ABevelledBoxIsClosedAndAlmostAsLargeAsTheBox) {
  const Mesh box = bevelled_box({1, 2, 0.5f}, 0.01f);
  EXPECT_NEAR(volume_of(box), 1.0, 0.01);
  EXPECT_NEAR(area_of(box), 7.0, 0.1);
  expect_normals_on_the_side_of_the_triangles(box);
}

TEST(Parts, ARodIsACylinderWithCaps) {
  const Mesh cylinder = rod({0, 0, 0}, {0, 3, 0}, 0.5f, 0.5f, 64);
  EXPECT_NEAR(volume_of(cylinder), kPi * 0.25 * 3, 0.01);
  EXPECT_NEAR(area_of(cylinder), kPi * 3 + 2 * kPi * 0.25, 0.02);
  expect_normals_on_the_side_of_the_triangles(cylinder);
}

TEST(Parts, AnEllipsoidFacesOutwards) {
  const Mesh ball = ellipsoid({1, 2, 0.5f}, 64);
  EXPECT_NEAR(volume_of(ball), 4.0 / 3 * kPi, 0.02);
  expect_normals_on_the_side_of_the_triangles(ball);
}

TEST(Parts, RoughStonesStayWithinTheirBoxAndTheirRoughness) {
  const Vec3 size(0.4f, 0.2f, 0.25f);
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Mesh stone = rough_stone(size, 0.03f, 0.015f, 4, seed);
    EXPECT_GT(volume_of(stone), 0.75 * static_cast<double>(size.prod()));
    for (const Vec3& p : stone.positions_m) {
      EXPECT_TRUE((p.cwiseAbs().array() <= size.array() / 2 + 0.0151f).all()) << p.transpose();
    }
  }
}

TEST(Parts, PlacingMovesPositionsAndTurnsNormals) {
  const Mesh part = bevelled_box({1, 1, 1}, 0.1f);
  const Mesh turned = placed(part, pose({3, 0, 0}, 90));
  for (std::size_t i = 0; i < part.positions_m.size(); ++i) {
    const Vec3 &p = part.positions_m[i], &n = part.normals[i];
    EXPECT_LT((turned.positions_m[i] - Vec3(3 - p.y(), p.x(), p.z())).norm(), 1e-6f);
    EXPECT_LT((turned.normals[i] - Vec3(-n.y(), n.x(), n.z())).norm(), 1e-6f);
  }
}

TEST(Parts, MirroringKeepsTrianglesOutside) {
  Eigen::Affine3f mirror = Eigen::Affine3f::Identity();
  mirror.linear().diagonal() << -1, 1, 1;
  const Mesh part = placed(bevelled_box({1, 2, 3}, 0.1f), mirror);
  EXPECT_GT(volume_of(part), 0);
  expect_normals_on_the_side_of_the_triangles(part);
}

TEST(Parts, NumbersSurviveTheTripThroughCoordinates) {
  Mesh part = bevelled_box({1, 2, 0.5f}, 0.01f);
  for (const int number : {0, 1, 255, 256, 1000, -3}) {
    const Mesh labelled = numbered(part, number);
    for (std::size_t i = 0; i < part.uvs.size(); ++i) {
      const PartPoint point = part_of({.position_m = Vec3::Zero(),
                                       .normal = Vec3::UnitZ(),
                                       .u = labelled.uvs[i][0],
                                       .v = labelled.uvs[i][1]});
      EXPECT_EQ(point.number, (number % 256 + 256) % 256);
      EXPECT_NEAR(point.u, part.uvs[i][0], 1e-3);
    }
  }
}

TEST(Parts, AHangingLineSagsInItsMiddle) {
  const auto line = hanging_line({0, 0, 2}, {4, 0, 2}, 0.5f, 8);
  EXPECT_EQ(line.front(), Vec3(0, 0, 2));
  EXPECT_EQ(line.back(), Vec3(4, 0, 2));
  EXPECT_FLOAT_EQ(line[4].z(), 1.5f);
}

TEST(Masonry, CoversTheWallButForItsJoints) {
  const MasonryLook look{.roughness = 0, .proud = 0};
  const Mesh wall = stone_courses(4, 2.4f, look);
  for (std::size_t i = 0; i < wall.positions_m.size(); ++i) {
    const Vec3& p = wall.positions_m[i];
    EXPECT_TRUE(p.x() >= 0 && p.x() <= 4 && p.z() >= 0 && p.z() <= 2.4f) << p.transpose();
  }
  const double stones = volume_of(wall) / static_cast<double>(look.depth);
  EXPECT_GT(stones, 4 * 2.4 * 0.8);
  EXPECT_LT(stones, 4 * 2.4);
}

TEST(Noise, IsSmoothBoundedAndOfMeanZero) {
  RandomStream random(1, 2, 3);
  double sum = 0, largest = 0, steepest = 0;
  constexpr int kPoints = 20000;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 p(200 * random.next_float() - 100, 200 * random.next_float() - 100,
                 200 * random.next_float() - 100);
    const double value = static_cast<double>(gradient_noise(p, 7));
    sum += value;
    largest = std::max(largest, std::abs(value));
    steepest =
        std::max(steepest, std::abs(static_cast<double>(gradient_noise(p + Vec3(1e-3f, 0, 0), 7)) - value));
  }
  EXPECT_NEAR(sum / kPoints, 0, 0.02);
  EXPECT_GT(largest, 0.6);
  EXPECT_LT(largest, 1.3);
  EXPECT_LT(steepest, 0.01);
}

TEST(Noise, SlopesAreDerivatives) {
  RandomStream random(4, 5, 6);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(8 * random.next_float() - 4, 8 * random.next_float() - 4, 8 * random.next_float() - 4);
    const Vec3 slope = fractal_noise_slope(p, 3, 11);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 step = Vec3::Zero();
      step[axis] = 2e-3f;
      const float difference = (fractal_noise(p + step, 3, 11) - fractal_noise(p - step, 3, 11)) / 4e-3f;
      EXPECT_NEAR(slope[axis], difference, 0.02) << p.transpose();
    }
  }
}

TEST(Noise, CellularDistancesAreThoseOfTheNearestPoints) {
  RandomStream random(7, 8, 9);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p(20 * random.next_float(), 20 * random.next_float(), 20 * random.next_float());
    const CellularNoise cells = cellular_noise(p);
    EXPECT_GE(cells.nearest, 0);
    EXPECT_LE(cells.nearest, cells.second);
    EXPECT_LT(cells.nearest, std::sqrt(3.f));
    EXPECT_TRUE(cells.cell >= 0 && cells.cell < 1);
  }
}

TEST(Noise, RandomNumbersOfCellsAreSpreadEvenly) {
  std::array<int, 10> counts{};
  for (int x = -50; x < 50; ++x) {
    for (int y = -50; y < 50; ++y) ++counts[static_cast<std::size_t>(10 * cell_random(x, y, 3, 1))];
  }
  for (const int count : counts) EXPECT_NEAR(count, 1000, 130);
}

TEST(Textures, BumpsTiltNormalsButDoNotTurnThemOver) {
  const NormalTexture bumps = bumpy({.height_m = 0.004f});
  RandomStream random(10, 11, 12);
  double tilted = 0;
  for (int i = 0; i < 500; ++i) {
    SurfacePoint point;
    point.position_m = {random.next_float(), random.next_float(), random.next_float()};
    point.normal = Vec3::UnitZ();
    const Vec3 normal = bumps(point);
    EXPECT_NEAR(normal.norm(), 1, 1e-5);
    EXPECT_GT(normal.z(), 0);
    tilted += static_cast<double>(1 - normal.z());
  }
  EXPECT_GT(tilted / 500, 1e-4);
}

TEST(Textures, PartsOfWoodDifferInTone) {
  const ColourTexture texture = wood({});
  std::set<float> tones;
  for (int number = 0; number < 20; ++number) {
    const Rgb colour = texture({.position_m = Vec3::Zero(),
                                .normal = Vec3::UnitZ(),
                                .u = kPartPitch * static_cast<float>(number) + 0.03f,
                                .v = 0.2f});
    tones.insert(colour.r);
  }
  EXPECT_GT(tones.size(), 15u);
}

}  // namespace
}  // namespace plenolab
