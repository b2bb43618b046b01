#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The Debian packages of this build: contents and dependencies. share/packages/make.sh runs lintian on them, which takes as long as
# making them.
. "$(dirname "$0")/cli_common.sh"
build=$(cd "$(dirname "$edgevo")/.." && pwd)

run_code 0 cpack --config "$build/CPackConfig.cmake" -B debs -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip
[ -f debs/edgevo-servo_*.deb ] 2>/dev/null && visp=1 || visp=0
[ -f debs/python3-edgevo_*.deb ] 2>/dev/null && python=1 || python=0
check "packages" "$(ls debs/*.deb | wc -l)" -eq $((5 + 2 * visp + python))
deb() { echo debs/"$1"_*.deb; }
# holds PACKAGE PATH: a regular expression for a whole path.
holds() {
  if dpkg-deb -c $(deb "$1") | awk '{ print $6 }' | grep -q -x "\./usr/$2"; then ok "$1 holds $2"; else fail "$1 lacks $2"; fi
}
depends() { dpkg-deb -f $(deb "$1") Depends | tr ',|' '\n\n' | sed 's/^ *//; s/[ (].*//'; }
needs() { if depends "$1" | grep -q -x "$2"; then ok "$1 needs $2"; else fail "$1 does not need $2"; fi; }

holds edgevo bin/edgevo
holds edgevo libexec/edgevo/edgevo-commands
holds edgevo-view libexec/edgevo/edgevo-view
holds edgevo share/edgevo/help/edgevo-run.txt
holds edgevo share/edgevo/params/default.yaml
holds edgevo share/edgevo/datasets/scenes/street.yaml
holds edgevo share/edgevo/rawlog_grabber_camera.ini
holds edgevo share/doc/edgevo/copyright
holds edgevo-mrpt-plugin "lib/.*edgevo_mrpt_plugin.so"
holds libedgevo-dev "lib/.*libedgevo_odometry.a"
holds libedgevo-dev include/edgevo/odometry/odometry.h
holds libedgevo-dev "lib/.*edgevoConfig.cmake"
holds edgevo-doc share/doc/edgevo/modules/mapping/README.md
mkdir doc && dpkg-deb --fsys-tarfile $(deb edgevo-doc) | tar xC doc
check "links between pages that lead nowhere" "$("$here/../links.sh" doc/usr/share/doc/edgevo | grep -c ': [^ ]*\.md[^ ]*: ')" -eq 0
if [ -d "$build/manuals" ]; then
  holds edgevo "share/man/man1/edgevo-run.1.gz"
  holds edgevo share/bash-completion/completions/edgevo
fi
needs edgevo "libopencv-core.*"
needs edgevo "libmrpt-obs.*"
check "what libedgevo-dev needs of MRPT, OctoMap and X11" "$(depends libedgevo-dev | grep -c 'mrpt\|octomap\|x11')" -eq 0
needs edgevo-view "libmrpt-gui.*"
check "what edgevo needs of MRPT's windows" "$(depends edgevo | grep -c 'mrpt-gui')" -eq 0
needs edgevo-mrpt-plugin "libmrpt-hwdrivers.*"
check "scripts in Python, which it does not depend on" "$(dpkg-deb -c $(deb edgevo) | grep -c '\.py$')" -eq 0
if [ $python -eq 1 ]; then
  holds python3-edgevo "lib/python3/dist-packages/edgevo/_edgevo.*\\.so"
  holds python3-edgevo lib/python3/dist-packages/edgevo/__init__.py
  holds python3-edgevo lib/python3/dist-packages/edgevo/py.typed
  holds python3-edgevo share/doc/python3-edgevo/examples/webcam.py
  needs python3-edgevo python3-numpy
  check "what it needs of ViSP and MRPT's windows" "$(depends python3-edgevo | grep -c 'visp\|mrpt-gui')" -eq 0
fi
# Code that links ViSP, which is under the GPL, is in separate packages.
for package in edgevo libedgevo-dev edgevo-mrpt-plugin; do
  check "what $package needs of ViSP" "$(depends $package | grep -c visp)" -eq 0
  check "what $package holds of it" "$(dpkg-deb -c $(deb $package) | grep -v '/$' | grep -c 'visp_bridge\|/servo/\|edgevo[-_]servo')" -eq 0
done
if [ $visp -eq 1 ]; then
  holds edgevo-servo libexec/edgevo/edgevo-servo
  holds edgevo-servo share/edgevo/help/edgevo-servo.txt
  holds libedgevo-visp-dev "lib/.*libedgevo_visp_bridge.a"
  needs edgevo-servo "libvisp-core.*"
  dpkg-deb --fsys-tarfile $(deb edgevo-servo) | tar xO ./usr/share/doc/edgevo-servo/copyright >copyright
  check "its licence" "$(grep -c '^License: GPL-2+' copyright)" -eq 1
fi
dpkg-deb --fsys-tarfile $(deb edgevo) | tar xO ./usr/share/doc/edgevo/copyright >copyright
check "the licence's last words" "$(grep -c 'POSSIBILITY OF SUCH DAMAGE' copyright)" -eq 1

finish
