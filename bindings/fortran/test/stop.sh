#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# stop.sh PROGRAM: an error whose status nobody asked for ends the program, and says what it was on the error unit.
set -u
said=$("$1" stop 2>&1 >/dev/null) && {
    echo "the program went on"
    exit 1
}
case $said in
    *"DELAM_ERROR_ARGUMENT: "*"no-such-law"*) echo "ended with the message" ;;
    *)
        printf 'ended without the message:\n%s\n' "$said"
        exit 1
        ;;
esac
