class Skelgen < Formula
  desc "Kinematic skeleton of a human body from its triangle mesh"
  homepage "https://github.com/OWNER/skelgen"
  url "https://github.com/OWNER/skelgen/archive/refs/tags/v0.2.0.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000" # see RELEASE_CHECKLIST.md
  license "MIT"

  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "fast_float" => :build
  depends_on "nanoflann" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "spectra" => :build
  depends_on "eigen"
  depends_on "libpng"
  depends_on :linux

  uses_from_macos "zlib"

  def install
    args = %w[
      -DSKELGEN_BUILD_SYNTH=OFF
      -DSKELGEN_BUILD_TESTS=OFF
      -DSKELGEN_BUILD_BENCH=OFF
      -DSKELGEN_WITH_ASSIMP=OFF
      -DSKELGEN_WITH_DRACO=OFF
      -DSKELGEN_WITH_MESHOPTIMIZER=OFF
    ]
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", *args, *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
    pkgshare.install "data/sample/body.off"
  end

  test do
    system bin/"skelgen", "extract", pkgshare/"body.off", "-o", "body.json"
    assert_match "left_knee", (testpath/"body.json").read
  end
end
