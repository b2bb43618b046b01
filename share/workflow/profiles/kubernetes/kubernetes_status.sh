#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What has become of a Job, for Snakemake.   kubernetes_status.sh NAME
case "$(kubectl get job "$1" -o 'jsonpath={.status.succeeded} {.status.failed}')" in
  1*) echo success ;;
  *[1-9]) echo failed ;;
  *) echo running ;;
esac
