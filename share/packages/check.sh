#!/bin/sh
# What Debian's checker says of packages: share/packages/check.sh FILE.deb ... Exit code 1 if it finds an error.
# Nothing is said of the maintainer's address, which is that of whoever makes the packages.
set -eu
exec lintian --allow-root --fail-on error --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog "$@"
