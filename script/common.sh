# shellcheck shell=bash
# Sourced by the scripts beside it: the one list of packages, and the one way to install, configure and build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# A python3 in front of the system's (pyenv, conda) does not see ROS's modules.
export PATH="/usr/bin:/bin:/usr/sbin:/sbin:$PATH"

# Debian 12 (bookworm) packages.
core_packages=(build-essential ccache cmake ninja-build pkg-config
  libcli11-dev libeigen3-dev libfmt-dev libhdf5-dev libyaml-cpp-dev nlohmann-json3-dev
  libopenmpi-dev openmpi-bin
  libboost-dev libssl-dev python3-nmea2
  libgtest-dev librapidcheck-dev python3-h5py python3-matplotlib python3-numpy
  python3-tqdm python3-yaml)
ros_packages=(ros-core-dev catkin
  libdiagnostic-updater-dev librosbag-dev libroscpp-dev libtf2-eigen-dev libtf2-geometry-msgs-dev libtf2-ros-dev
  libdiagnostic-msgs-dev libgeometry-msgs-dev libsensor-msgs-dev libstd-msgs-dev libstd-srvs-dev libtrajectory-msgs-dev
  libvisualization-msgs-dev
  python3-diagnostic-msgs python3-geometry-msgs python3-sensor-msgs python3-std-msgs python3-std-srvs python3-tf2-msgs
  python3-trajectory-msgs python3-visualization-msgs
  python3-rosbag python3-roslaunch python3-rosmsg python3-rosnode python3-rosparam python3-rospy python3-rosservice
  python3-rostopic rosbash rosout librostest-dev python3-rostest python3-rosunit
  ros-robot-state-publisher)
demo_packages=(rviz imagemagick xvfb xauth x11-utils libgl1-mesa-dri procps)
browser_packages=(chromium chromium-driver python3-selenium)
lint_packages=(git clang-format clang-tidy catkin-lint)
bench_packages=(libbenchmark-dev)

say() { printf '\n=== %s\n' "$*"; }
fail() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }

# Two gigabytes of memory a compiler, and as many compilers as cores.
jobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/MemAvailable/ { print int($2 / 2097152) }' /proc/meminfo)
  echo $((memory < 1 ? 1 : memory < cores ? memory : cores))
}

# need PACKAGE...: installs what is missing; no network and no root when nothing is.
need() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  [ "$(id -u)" -eq 0 ] || fail "these packages are missing, and only root can install them: ${missing[*]}"
  say "Installing ${#missing[@]} packages and what they need: ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  apt-get -o Acquire::Retries=3 update -qq
  apt-get -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 install -y -qq --no-install-recommends "${missing[@]}" >apt.log 2>&1 ||
    { tail -n 30 apt.log >&2; fail "apt-get could not install the packages; its log is apt.log"; }
  rm -f apt.log
}

ros_noetic() { [ -f /opt/ros/noetic/setup.bash ]; }

# ROS from Debian's own packages, or Noetic's prefix and rosdep where that is installed.
need_ros() {
  if ros_noetic; then
    say "Using /opt/ros/noetic and rosdep (a path that has not been tried, see README.md)"
    set +u
    # shellcheck disable=SC1091
    source /opt/ros/noetic/setup.bash
    set -u
    rosdep install --from-paths . --ignore-src -r -y
  else
    need "${ros_packages[@]}"
  fi
}

# The core is compiled for itself and for ROS with the same flags: ccache makes it once, and once for all checkouts (its
# own folder, CCACHE_DIR, says where): what a second clone compiles is what differs. -march=native is another flag on
# every processor, which ccache does not know.
export CCACHE_BASEDIR="$PWD" CCACHE_NOHASHDIR=1
CCACHE_NAMESPACE=$(grep -m 1 '^flags' /proc/cpuinfo | md5sum | cut -c 1-8)
export CCACHE_NAMESPACE

# configure FOLDER [CMake option...]
configure() {
  local folder=$1 generator=()
  shift
  [ -f "$folder/CMakeCache.txt" ] || generator=(-G Ninja)
  say "Configuring $folder: $*"
  # The same options as the presets of CMakePresets.json, for CMake older than presets.
  cmake -S . -B "$folder" "${generator[@]}" \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 \
    -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache "$@" >"$folder.log" 2>&1 ||
    { cat "$folder.log" >&2; fail "CMake could not configure $folder"; }
  mv "$folder.log" "$folder/configure.log"
}

# build FOLDER [TARGET...]
build() {
  local folder=$1
  shift
  say "Building $folder ${*:+($*)}"
  cmake --build "$folder" -j "$(jobs)" ${@:+--target "$@"}
}

# CI sets WARNINGS_AS_ERRORS=ON.
configure_full() {
  configure build -DCMAKE_BUILD_TYPE=RelWithDebInfo -DGEOCONTAINER_MPM_WITH_ROS=ON \
    -DGEOCONTAINER_MPM_WERROR="${WARNINGS_AS_ERRORS:-OFF}"
}
configure_core() {
  configure build-core -DCMAKE_BUILD_TYPE=RelWithDebInfo -DGEOCONTAINER_MPM_WITH_ROS=OFF \
    -DGEOCONTAINER_MPM_WERROR="${WARNINGS_AS_ERRORS:-OFF}"
}
