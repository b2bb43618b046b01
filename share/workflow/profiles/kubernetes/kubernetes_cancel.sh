#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Ends Jobs.   kubernetes_cancel.sh NAME...
kubectl delete job --ignore-not-found "$@"
