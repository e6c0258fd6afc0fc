// SPDX-License-Identifier: MIT
/// @file  Eigen's vectors, whose operators build expressions that refer to their operands, where Eigen is installed.
///
/// A renderer that uses Eigen writes these traits and nothing else: inside the library the library's own operators are
/// used, which return vectors, so that no expression outlives its operands.
#pragma once

#include "nephroid/vector/traits.hpp"

#if __has_include(<Eigen/Core>)
#include <Eigen/Core>
#define NEPHROID_TESTS_HAVE_EIGEN 1
#elif __has_include(<eigen3/Eigen/Core>)
#include <eigen3/Eigen/Core>
#define NEPHROID_TESTS_HAVE_EIGEN 1
#else
#define NEPHROID_TESTS_HAVE_EIGEN 0
#endif

#if NEPHROID_TESTS_HAVE_EIGEN
template <class T>
struct nephroid::vector_traits<Eigen::Matrix<T, 3, 1>> {
    using scalar = T;
    using vector = Eigen::Matrix<T, 3, 1>;
    static vector make(T x, T y, T z) { return vector(x, y, z); }
    static T x(const vector& v) { return v[0]; }
    static T y(const vector& v) { return v[1]; }
    static T z(const vector& v) { return v[2]; }
};
#endif
