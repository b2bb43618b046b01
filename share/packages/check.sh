#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Checks packages with lintian: share/packages/check.sh FILE.deb ... Exit code 1 if it finds an error.
# Findings about the address of the maintainer are ignored: it is that of whoever builds the packages.
set -eu
exec lintian --allow-root --fail-on error --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog "$@"
