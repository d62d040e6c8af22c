#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests how a program without the argument stat ends after an error.
# usage: stop.sh <test_stop>
set -eu
program=$1

ends() { # argument, exit status, text on standard error
  status=0
  message=$("$program" "$1" 2>&1 > /dev/null) || status=$?
  if [ "$status" != "$2" ]; then
    echo "$1: exit status $status, not $2: $message" >&2
    exit 1
  fi
  case $message in
    *"$3"*) ;;
    *)
      echo "$1: no \"$3\" in: $message" >&2
      exit 1
      ;;
  esac
}

ends library 1 "pnpbs: context%set: unknown option or statistic: "
ends library 1 "steps"
ends module 1 "pnpbs: domain%add_hole: invalid argument: argument point has an extent of 1; 2 was expected"
ends stat 1 "pnpbs: domain%create: argument stat must be an integer of four or eight bytes"
ends outcome 3 ""
