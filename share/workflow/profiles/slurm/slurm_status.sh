#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What has become of a job, for Snakemake: running, success or failed.   slurm_status.sh JOB
# A job that was ended by its limit of time or memory writes nothing; without this it would be waited for for ever.
state=$(sacct -X -n -P -j "$1" -o State 2>/dev/null | head -n 1)
case "$state" in
  COMPLETED) echo success ;;
  "" | PENDING* | CONFIGURING* | RUNNING* | COMPLETING* | SUSPENDED* | PREEMPTED* | REQUEUED* | RESIZING*) echo running ;;
  *) echo failed ;;
esac
