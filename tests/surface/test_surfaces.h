#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>

#include "common/error.h"
#include "surface/cage/cage.h"
#include "surface/limit_surface.h"

namespace gnomon::surface {

/// A mesh file that lives as long as the object.
class TemporaryMesh {
 public:
  /// @param ending  ".obj" or ".ply"
  TemporaryMesh(const std::string& bytes, const std::string& ending)
      : path_(std::filesystem::temp_directory_path() /
              ("gnomon_mesh_" + std::to_string(std::random_device{}()) + ending)) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryMesh() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryMesh(const TemporaryMesh&) = delete;
  TemporaryMesh& operator=(const TemporaryMesh&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The cube [-1, 1]³: closed, eight extraordinary vertices of valence 3, each face its own uv
/// square.
inline Cage cubeCage() {
  Cage cage;
  for (int corner = 0; corner < 8; ++corner) {
    cage.positions.emplace_back(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
  }
  cage.faceVertices = {4, 5, 7, 6, 1, 0, 2, 3, 5, 1, 3, 7, 0, 4, 6, 2, 6, 7, 3, 2, 0, 1, 5, 4};
  cage.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int face = 0; face < 6; ++face) {
    for (int corner = 0; corner < 4; ++corner) cage.faceUvs.push_back(corner);
  }
  return cage;
}

/// An open grid of columns × rows quadrilaterals in z = 0 with unit squares and uv = xy.
inline Cage openGrid(int columns, int rows) {
  Cage cage;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      cage.positions.emplace_back(i, j, 0);
      cage.uvs.emplace_back(i, j);
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i;
      for (const int vertex : {a, a + 1, a + columns + 2, a + columns + 1}) {
        cage.faceVertices.push_back(vertex);
        cage.faceUvs.push_back(vertex);
      }
    }
  }
  return cage;
}

/// Two poles of `count` quadrilaterals each.
inline Cage polesCage(int count) {
  Cage cage;
  cage.positions = {{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 2 * count; ++i) {
    const double angle = pi * i / count;
    cage.positions.emplace_back(std::cos(angle), std::sin(angle), i % 2 ? 0.3 : -0.3);
  }
  cage.uvs = {{0, 0}};
  const auto ring = [count](int i) { return 2 + (i + 2 * count) % (2 * count); };
  for (int i = 0; i < 2 * count; i += 2) {
    for (const int v : {0, ring(i - 1), ring(i), ring(i + 1)}) cage.faceVertices.push_back(v);
    for (const int v : {1, ring(i + 2), ring(i + 1), ring(i)}) cage.faceVertices.push_back(v);
  }
  cage.faceUvs.assign(cage.faceVertices.size(), 0);
  return cage;
}

/// Reproducible random numbers.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 vector(double size = 1) {
    return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)};
  }

 private:
  std::mt19937 engine_;
};

inline void expectNear(const Vec3& value, const Vec3& expected, double tolerance,
                       const std::string& what = "") {
  EXPECT_LE(glm::length(value - expected), tolerance)
      << what << ": (" << value.x << ", " << value.y << ", " << value.z << "), expected ("
      << expected.x << ", " << expected.y << ", " << expected.z << ")";
}

inline void expectFinite(const LimitPoint& point) {
  for (const Vec3& vector : {point.position, point.ds, point.dt, point.dss, point.dst, point.dtt}) {
    EXPECT_TRUE(std::isfinite(glm::dot(vector, vector)));
  }
}

/// The action must raise an InputError of one line that says each of the texts.
inline void expectInputError(const std::function<void()>& action,
                             const std::vector<std::string>& texts) {
  try {
    action();
    ADD_FAILURE() << "no error, expected one with '" << texts.front() << "'";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const std::string& text : texts) {
      EXPECT_NE(message.find(text), std::string::npos) << message << "\nlacks: " << text;
    }
  }
}

}  // namespace gnomon::surface
