#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes a Job of a script of Snakemake's and prints its name.   kubernetes_submit.sh RULE THREADS MEGABYTES SCRIPT
#   EDGEVO_IMAGE   container with edgevo and snakemake      EDGEVO_VOLUME   claim of the volume (ReadWriteMany)
#   EDGEVO_MOUNT   where it is mounted, here and there
set -eu
rule=$1 threads=$2 memory=$3 script=$4
name=edgevo-$rule-$(basename "$script" | tr -c 'a-z0-9\n' '-' | tail -c 20)-$(date +%s%N | tail -c 10)
command=$(base64 -w 0 "$script")  # the script lies on this machine alone
kubectl create -f - >&2 <<EOF
apiVersion: batch/v1
kind: Job
metadata: {name: "$name"}
spec:
  backoffLimit: 0
  ttlSecondsAfterFinished: 3600
  template:
    spec:
      restartPolicy: Never
      containers:
        - name: job
          image: "${EDGEVO_IMAGE:?name the container image}"
          command: [sh, -c, "echo $command | base64 -d | sh"]
          resources:
            requests: {cpu: "$threads", memory: "${memory}Mi"}
            limits: {memory: "${memory}Mi"}
          volumeMounts: [{name: files, mountPath: "${EDGEVO_MOUNT:?name the folder of the volume}"}]
      volumes: [{name: files, persistentVolumeClaim: {claimName: "${EDGEVO_VOLUME:?name the claim}"}}]
EOF
echo "$name"
