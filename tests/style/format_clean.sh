#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The sources are formatted: see the head of tests/format.sh.
exec "$(dirname "$0")/../format.sh"
