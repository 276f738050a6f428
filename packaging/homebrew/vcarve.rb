# The library, without the program, for Homebrew on Linux:
#   brew install --HEAD --build-from-source packaging/homebrew/vcarve.rb
# HOMEBREW_VCARVE is the path of the checkout.
class Vcarve < Formula
  desc "Surface meshes of COLMAP models"
  license "GPL-3.0-or-later"
  head "file://#{ENV.fetch("HOMEBREW_VCARVE", Dir.pwd)}", using: :git

  depends_on "cmake" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "cgal"
  depends_on "eigen"
  depends_on "fmt"
  depends_on "jpeg-turbo"
  depends_on "libpng"
  depends_on "libtiff"
  depends_on :linux
  depends_on "meshoptimizer"
  depends_on "open-mesh"
  depends_on "stb"
  depends_on "tbb"
  depends_on "webp"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", *std_cmake_args,
           "-DBUILD_SHARED_LIBS=ON", "-DVCARVE_PROGRAM=OFF", "-DVCARVE_TESTS=OFF",
           "-DVCARVE_BENCHMARKS=OFF", "-DVCARVE_LAB=OFF", "-DVCARVE_PYTHON=OFF"
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    assert_path_exists include/"vcarve/vcarve.h"
  end
end
